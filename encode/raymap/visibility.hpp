#pragma once
// Visibility of a shape map's cells: which of the two photos on either side of a line of rays show a cell's surface,
// and which do not because another surface occludes it.
//
// A point is occluded in a photo whose depth map has a nearer surface there. Where depth is noise (glass, lacquer,
// plain leather, metal) such decisions would flip from cell to cell and leave hard-edged patches, so that only reliable
// depths count: those of textured pixels that a neighboring photo confirms.

#include "encode/raymap/line_grid.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/api/types/shape_map.hpp"
#include "rayspace/image/image.hpp"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>

namespace rs::encode {

/// The photos on either side of a line of rays, and the line's viewpoint (x and z, object radii).
struct ViewPair {
    const DepthView& first;
    const DepthView& second;
    glm::dvec2 viewpoint;
};

/// Finds the pixels whose depths are reliable enough to occlude points of other surfaces.
/// \param texture    of the photo's view, by measure_texture().
/// \param neighbors  photos that may confirm a depth, each with its own depths.
/// \return 1 where the texture is at least 6 codes and one of the neighbors has the pixel's point in its depth map
///     (within 0.05 object radii), else 0; transposed as WorkView::columns is. Thread-safe. Cost: two projections per
///     textured pixel.
Image<std::uint8_t> find_occluders(const DepthView& photo, const Image<std::uint8_t>& texture,
                                   std::span<const DepthView* const> neighbors);

/// Moves each surface that is covered in a photo by a pixel of another layer (a pixel that has no depth in this one)
/// along the line's ray to the nearest depth where it is covered in neither, since both photos are blended there.
/// Removes the surface where there is no such depth.
/// \param cells  the grid.bands cells of column p_cell; changed in place.
void avoid_foreground(const LineGrid& grid, const ViewPair& photos, int p_cell, ShapeCell* cells);

/// Sets ShapeCell::shown of each surface to the photo in which it is not occluded; to both photos where it is occluded
/// in both (then a depth is wrong) or in none. A point is occluded where at least 7 of the 3x3 pixels around it are
/// occluders (DepthView::occluders) that lie kClearlyInFront or more in front of it.
/// \param cells  the grid.bands cells of column p_cell; changed in place.
void classify_visibility(const LineGrid& grid, const ViewPair& photos, int p_cell, ShapeCell* cells);

}  // namespace rs::encode
