#pragma once
// The payload of chunk `shap`, a ring's shape map: encode/FORMAT.md, section "shap". As in object_chunks.hpp, a parser
// checks what it needs in order to read and to allocate safely; validate_object() checks the rest.

#include "rayspace/base/result.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::object_chunks {

// The cells of a shape map as planes of bytes, which is what the file compresses: which cells have a surface, and for
// each of its two depths the residuals against a prediction. encode/FORMAT.md, section "shap", "Planes".

// What a cell with a surface holds.
enum class Depth : std::uint8_t { kSurface, kBack };
inline constexpr std::array<Depth, 2> kDepths = {Depth::kSurface, Depth::kBack};

inline std::size_t surface_plane_bytes(std::size_t cells) {
    return (cells + 7) / 8;
}

// Cells that have a surface; a residual plane has one byte for each.
std::size_t surfaces_of(const ShapeMap& shape);

std::vector<std::uint8_t> surface_plane(const ShapeMap& shape);
std::vector<std::uint8_t> residual_plane(const ShapeMap& shape, Depth depth);

// The reverse, into shape.cells, which has its size and is zero before: first the surfaces, then their depths, then the
// backs. `plane` must be surface_plane_bytes(shape.cells.size()) or surfaces_of() long. Until its back is put, a cell
// with a surface has the back 1.
Status put_surfaces(std::span<const std::uint8_t> plane, ShapeMap& shape);
void put_residuals(std::span<const std::uint8_t> plane, Depth depth, ShapeMap& shape);

inline constexpr std::uint64_t kMaxShapeCells = std::uint64_t{1} << 27;
inline constexpr int kMaxGapLines = 1024;

// The shape map must be there and valid. The same map gives the same bytes, with the same version of libzstd.
Payload shape_payload(const Ring& ring);

// What parse_shape_head() leaves for parse_shape_cells(): the sizes were compared with each other and with the payload,
// which must live on.
struct CodedShapeCells {
    bool says_who_shows = true;               // else both pictures show all surfaces
    std::uint64_t cells = 0;                  // at most kMaxShapeCells
    std::uint64_t surfaces = 0;               // cells that have one
    std::span<const std::byte> surface_bits;  // compressed planes
    std::array<std::span<const std::byte>, kDepths.size()> depths;
};

// In two steps, so that the caller can refuse the memory that the cells take (`cells` * sizeof(ShapeCell)) in between.
// `ring` has its planes and views from RING. The first step reads all of ring.shape but the cells.
Result<CodedShapeCells> parse_shape_head(std::span<const std::byte> payload, Ring& ring);
Status parse_shape_cells(const CodedShapeCells& coded, ShapeMap& shape);

}  // namespace rs::object_chunks
