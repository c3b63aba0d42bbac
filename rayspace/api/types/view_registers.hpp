#pragma once
/// \file
/// Integers of one view, computed from a camera: the input of the normative arithmetic (engine/RECONSTRUCTION.md,
/// section 1), which a driver writes into the registers of a board. rs::api::Renderer computes them for its executor.

#include <cstdint>
#include <vector>

namespace rs::engine {

/// Quantity that is linear over the view: at pixel (i, j) it is at_origin + i * per_column + j * per_row, all q32.
struct LinearForm {
    std::int64_t at_origin = 0;   ///< at the centre of pixel (0, 0)
    std::int64_t per_column = 0;  ///< change from a column to the next
    std::int64_t per_row = 0;     ///< change from a row to the next
    /// Value at pixel (i, j).
    [[nodiscard]] std::int64_t at(int i, int j) const { return at_origin + i * per_column + j * per_row; }
};

/// Registers of one reference plane. Lengths are in object radii.
struct PlaneRegisters {
    std::int32_t a_q20 = 0;    ///< position of the viewpoint along the plane's tangent
    std::int32_t c_q20 = 0;    ///< position of the viewpoint along the plane's normal
    LinearForm along_normal;   ///< direction . normal
    LinearForm along_tangent;  ///< direction . tangent
};

/// Sampling of the photos by a ring with a shape map (engine/RECONSTRUCTION.md, section 7). Rings without one fetch the
/// nearest pixel.
enum class TexelFilter : std::uint8_t {
    kBilinear = 0,  ///< mean of four pixels
    kSharp = 1,     ///< bilinear plus luma detail: close to bicubic
    kSmooth = 2,    ///< bilinear minus luma detail: a low-pass filter for views smaller than the photos
};

/// Registers of a view.
struct ViewRegisters {
    int width = 0;                                ///< px, 1..8192
    int height = 0;                               ///< px, 1..8192
    int ring = 0;                                 ///< index of the ring that renders the view
    TexelFilter filter = TexelFilter::kBilinear;  ///< ignored by rings without a shape map
    std::int32_t b_q20 = 0;                       ///< Y of the viewpoint
    LinearForm rise;                              ///< direction . Y
    std::vector<PlaneRegisters> planes;           ///< [k], as many as the ring has

    /// `rise` of pixel (i, j), q24, as the arithmetic of shape maps takes it.
    [[nodiscard]] std::int32_t rise_q24(int i, int j) const { return static_cast<std::int32_t>(rise.at(i, j) >> 8); }

    /// True if every column of the view is a vertical plane of rays, so that one set-up serves a column.
    [[nodiscard]] bool upright() const;
};

}  // namespace rs::engine
