#pragma once
// Chunk shap r: a ring's shape map; encode/FORMAT.md, section "shap". Declared for tests and benchmarks; files are read
// and written through chunk_table.hpp.

#include "rayspace/base/result.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::object_chunks {

inline constexpr std::uint64_t kMaxShapeCells = std::uint64_t{1} << 27;
inline constexpr int kMaxGapLines = 1024;

/// Encodes the shape map, which must exist and be valid. Deterministic.
Payload shape_payload(const Ring& ring);

/// Result of parse_shape_head() for parse_shape_cells(). The sizes are checked against each other and the payload,
/// which must outlive it.
struct CodedShapeCells {
    std::uint64_t cells = 0;     // at most kMaxShapeCells
    std::uint64_t surfaces = 0;  // cells that have one
    std::span<const std::byte> bytes;
};

/// Parse in two steps, so that the caller can reject the memory of the cells (`cells` * sizeof(ShapeCell)) in between.
/// `ring` has its planes and views from RING. The first step reads all of ring.shape except the cells.
Result<CodedShapeCells> parse_shape_head(std::span<const std::byte> payload, Ring& ring);
Status parse_shape_cells(const CodedShapeCells& coded, ShapeMap& shape);

/// Checks that ring.shape is either empty in all its members, or has consistent sizes and all numbers in range. The
/// ring's own numbers must have been checked. The error does not name a place. Cost: one pass over the cells.
Status check_shape(const Ring& ring);

}  // namespace rs::object_chunks
