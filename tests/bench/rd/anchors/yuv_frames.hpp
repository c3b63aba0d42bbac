#pragma once
// Raw planar frames of video encoders: Y, U and V planes, frame after frame. The colour conversion is Rayspace's own
// (rayspace/object/yuv.hpp), so that it favours no codec.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rs::bench {

struct FrameFormat {
    int width = 0;  // px, of the images; odd sizes are padded by one in frames
    int height = 0;
    bool full_chroma = false;  // 4:4:4, else 4:2:0

    [[nodiscard]] int frame_width() const { return width + width % 2; }
    [[nodiscard]] int frame_height() const { return height + height % 2; }
    [[nodiscard]] std::size_t chroma_bytes() const;  // of U, and of V
    [[nodiscard]] std::size_t frame_bytes() const;
};

/// \param image opaque
std::vector<std::byte> frame_from_image(ConstImageView<Rgba8> image, const FrameFormat& format);
/// \param frame of size format.frame_bytes()
/// \return opaque image
Image<Rgba8> image_from_frame(std::span<const std::byte> frame, const FrameFormat& format);

}  // namespace rs::bench
