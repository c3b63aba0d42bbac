#pragma once
// Small grey copies of the frames of a film. A selection of frames (frame_selection.hpp) keeps one per frame and
// nothing else, so that its memory does not depend on the size of the frames.

#include "rayspace/image/image.hpp"

#include <cstdint>
#include <vector>

namespace rs::capture {

/// Longer side of FrameCopy::luma in px.
inline constexpr int kCopySide_px = 192;
/// Pixels of `luma` along a side of one cell of FrameCopy::detail.
inline constexpr int kDetailCell_px = 4;

struct FrameCopy {
    Image<std::uint8_t> luma;  // BT.601 luma codes, at most kCopySide_px a side
    Image<float> detail;       // per cell: mean square of the Laplacian of the frame's own luma, codes^2
};

/// \param frame  Any size; alpha is ignored. Cost: one pass over the frame.
FrameCopy make_frame_copy(ConstImageView<Rgba8> frame);

/// Removes differences of exposure: multiplies the codes of every copy by the median ratio of the temporal median image
/// to it, limited to 0.5..2. Pixels that are dark or clipped in either are ignored; a copy with few others is
/// unchanged. \param copies  All of one size.
void normalize_exposure(std::vector<FrameCopy>& copies);

/// Pixels that the turning object covers or uncovers, or on which it changes (255), and static ones (0): by the range
/// of the luma over the film between its 5th and its 95th percentile. \param copies  At least one, all of one size,
/// normalize_exposure() applied.
Image<std::uint8_t> moving_region(const std::vector<FrameCopy>& copies);

}  // namespace rs::capture
