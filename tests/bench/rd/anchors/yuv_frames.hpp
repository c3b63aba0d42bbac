#pragma once
// Images as the raw planar frames that video encoders read and write: all of Y, then U, then V, frame after frame.
// Colours are converted as Rayspace itself does (rayspace/object/yuv.hpp), so that the conversion favours nobody.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rs::bench {

struct FrameFormat {
    int width = 0;  // px, of the images; frames are one larger where that is odd
    int height = 0;
    bool full_chroma = false;  // 4:4:4, else 4:2:0

    [[nodiscard]] int frame_width() const { return width + width % 2; }
    [[nodiscard]] int frame_height() const { return height + height % 2; }
    [[nodiscard]] std::size_t chroma_bytes() const;  // of U, and as many of V
    [[nodiscard]] std::size_t frame_bytes() const;
};

// The image's alpha must be 255 throughout.
std::vector<std::byte> frame_from_image(ConstImageView<Rgba8> image, const FrameFormat& format);
// Opaque. frame.size() is format.frame_bytes().
Image<Rgba8> image_from_frame(std::span<const std::byte> frame, const FrameFormat& format);

}  // namespace rs::bench
