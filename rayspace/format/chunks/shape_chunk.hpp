#pragma once
// shap r: a ring's shape map; encode/FORMAT.md, section "shap". For tests and measurements: the file itself is read and
// written through chunk_table.hpp.

#include "rayspace/base/result.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::object_chunks {

inline constexpr std::uint64_t kMaxShapeCells = std::uint64_t{1} << 27;
inline constexpr int kMaxGapLines = 1024;

// The shape map must be there and valid. The same map gives the same bytes.
Payload shape_payload(const Ring& ring);

// What parse_shape_head() leaves for parse_shape_cells(): the sizes were compared with each other and with the payload,
// which must live on.
struct CodedShapeCells {
    std::uint64_t cells = 0;     // at most kMaxShapeCells
    std::uint64_t surfaces = 0;  // cells that have one
    std::span<const std::byte> bytes;
};

// In two steps, so that the caller can refuse the memory that the cells take (`cells` * sizeof(ShapeCell)) in between.
// `ring` has its planes and views from RING. The first step reads all of ring.shape but the cells.
Result<CodedShapeCells> parse_shape_head(std::span<const std::byte> payload, Ring& ring);
Status parse_shape_cells(const CodedShapeCells& coded, ShapeMap& shape);

// ring.shape is empty in all its members, or has the sizes that the ring and its own numbers need and all numbers
// within their ranges. The ring's own numbers must have been checked. The error states what is wrong, without a place.
// Cost: one look at every cell.
Status check_shape(const Ring& ring);

}  // namespace rs::object_chunks
