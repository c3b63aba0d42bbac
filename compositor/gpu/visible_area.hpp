#pragma once
// Parts of a view that can show an object, computed from the set-ups of its pixels (view_setup.hpp): everything else is
// transparent and need not be drawn. Independent of OpenGL.
//
// A pixel whose ray is between captured rays is transparent if no band at which section 6 of engine/RECONSTRUCTION.md
// looks for surfaces lies between the bands of the surfaces around the ray. These bands are linear in the pixel's row.

#include "compositor/gpu/shader/view_setup.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/api/types/shape_map.hpp"

#include <span>
#include <vector>

namespace rs::compositor {

/// Pixels [left, left + width) x [top, top + height).
struct PixelRect {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
    bool operator==(const PixelRect&) const = default;
};

/// Rectangles, without overlap, outside of which a block of a view is transparent.
/// \param setups  set_up_rows() from row first_row on; one row for an upright view
/// \param block   pixels whose set-ups these are
std::vector<PixelRect> visible_rectangles(std::span<const SetupTexel> setups, int first_row,
                                          const engine::ViewRegisters& registers, const ShapeMap& shape,
                                          const PixelRect& block);

}  // namespace rs::compositor
