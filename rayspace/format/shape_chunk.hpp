#pragma once
// The payload of chunk `shap`, a ring's shape map: encode/FORMAT.md, section "shap". As in object_chunks.hpp, a parser
// checks what it needs in order to read and to allocate safely; validate_object() checks the rest.

#include "rayspace/base/result.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::object_chunks {

// The cells of a shape map as two planes of bytes, which is what the file compresses: by which pictures each cell's
// surface is shown, and the residuals of depths against a prediction. encode/FORMAT.md, section "shap", "Planes".

inline std::size_t shown_plane_bytes(std::size_t cells) {
    return (cells + 3) / 4;
}

// Cells that have a surface; the residual plane has one byte for each.
std::size_t surfaces_of(const ShapeMap& shape);

std::vector<std::uint8_t> shown_plane(const ShapeMap& shape);
std::vector<std::uint8_t> residual_plane(const ShapeMap& shape);

// The reverse, into shape.cells, which has its size and is zero before: first what is shown, then the depths. `plane`
// must be shown_plane_bytes(shape.cells.size()) or surfaces_of() long.
Status put_shown(std::span<const std::uint8_t> plane, ShapeMap& shape);
void put_residuals(std::span<const std::uint8_t> plane, ShapeMap& shape);

// Makes each depth what it is predicted to be, which takes next to nothing in the file, where that is at most
// `tolerance` steps away.
void settle_depths(ShapeMap& shape, int tolerance);

inline constexpr std::uint64_t kMaxShapeCells = std::uint64_t{1} << 27;
inline constexpr int kMaxGapLines = 1024;

// The shape map must be there and valid. The same map gives the same bytes, with the same version of libzstd.
Payload shape_payload(const Ring& ring);

// What parse_shape_head() leaves for parse_shape_cells(): the sizes were compared with each other and with the payload,
// which must live on.
struct CodedShapeCells {
    std::uint64_t cells = 0;           // at most kMaxShapeCells
    std::uint64_t surfaces = 0;        // cells that have one
    std::span<const std::byte> shown;  // compressed planes
    std::span<const std::byte> residuals;
};

// In two steps, so that the caller can refuse the memory that the cells take (`cells` * sizeof(ShapeCell)) in between.
// `ring` has its planes and views from RING. The first step reads all of ring.shape but the cells.
Result<CodedShapeCells> parse_shape_head(std::span<const std::byte> payload, Ring& ring);
Status parse_shape_cells(const CodedShapeCells& coded, ShapeMap& shape);

}  // namespace rs::object_chunks
