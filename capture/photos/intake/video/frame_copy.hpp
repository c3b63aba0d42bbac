#pragma once
// Small greyscale copies of video frames. Frame selection (frame_selection.hpp) keeps only these, so that its memory
// does not depend on the frame size.

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

/// Removes exposure differences: multiplies each copy by the median ratio of the temporal median image to the copy,
/// limited to 0.5..2. Ignores pixels that are dark or clipped in either; a copy with too few other pixels is unchanged.
/// \param copies  All of one size.
void normalize_exposure(std::vector<FrameCopy>& copies);

/// Mask of pixels whose luma changes during the video (255) and static ones (0), from the range between the 5th and the
/// 95th percentile of luma over time.
/// \param copies  At least one, all of one size, normalize_exposure() applied.
Image<std::uint8_t> moving_region(const std::vector<FrameCopy>& copies);

}  // namespace rs::capture
