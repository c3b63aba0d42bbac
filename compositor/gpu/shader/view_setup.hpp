#pragma once
// Set-ups of the pixels of a view, as the shader reads them (reconstruction_shader.hpp): sections 2, 3 and 5 of
// engine/RECONSTRUCTION.md, computed on the CPU by the code of the definition. One set-up serves a column of an upright
// view; other views have one per pixel.
//
// A set-up is kSetupTexels texels of four numbers, one below the other:
//
//     texel  kPlane                                   kNoShape, kShape
//     0      kind | ..., row_0 q16, step q16, lambda  kind | ..., lambda_foot, inv_r, inv_rho
//     1      layer, column, first row, end of rows    lambda0, lambda1, layers of both photos, depths of the cells
//     2                                               cells of columns (0, 0), (0, 1), step to (1, n), bands of the
//     cells 3, 4                                            of the first photo: L0, L1, Q0, Q1; cx, cy, fl_y, height 5,
//     6                                            of the second photo
//
// The first number is kind | weight << 2 | p_part << 11 | line_part << 14 | foot_d << 17. Layers are first | second <<
// 16, depths nearest | deepest << 8, bands first | last << 16: surfaces of the cells around the ray lie between these,
// so that the shader skips steps of the march that meet none.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::compositor {

using SetupTexel = std::array<std::int32_t, 4>;

/// Bounds of the surfaces in a column of cells; without surfaces, first_band is above last_band.
struct ColumnBounds {
    std::uint8_t nearest = 255;
    std::uint8_t deepest = 0;
    std::uint16_t first_band = 0xFFFF;
    std::uint16_t last_band = 0;
};

/// Bounds of all columns of a shape map: [line * p_cells + pi].
std::vector<ColumnBounds> column_bounds(const ShapeMap& shape);

/// Computes the set-ups of view rows first_row .. first_row + rows - 1, on the threads of the calling tbb arena. For an
/// upright view, one row serves all.
/// \param registers  valid for `object`
/// \param bounds     column_bounds() of the ring's shape map
/// \return           [(row * kSetupTexels + texel) * registers.width + column]
std::vector<SetupTexel> set_up_rows(const RaySpaceObject& object, const engine::ViewRegisters& registers,
                                    std::span<const ColumnBounds> bounds, int first_row, int rows);

/// Numbers of the photos that a set-up refers to, -1: none. \param head, view  its texels 0 and 1
struct PhotosOfSetup {
    int first = -1;
    int second = -1;
};
PhotosOfSetup photos_of(const SetupTexel& head, const SetupTexel& view);

/// Numbers of the photos that set-ups refer to, ascending.
/// \param setups  of set_up_rows(), `width` texels wide
std::vector<int> photos_of(std::span<const SetupTexel> setups, int width);

}  // namespace rs::compositor
