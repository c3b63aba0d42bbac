#include "tests/bench/rd/anchors/yuv_frames.hpp"

#include "rayspace/object/yuv.hpp"

#include <algorithm>

namespace rs::bench {
namespace {

void append(std::vector<std::byte>& frame, const Image<std::uint8_t>& plane) {
    const auto bytes = std::as_bytes(plane.pixels());
    frame.insert(frame.end(), bytes.begin(), bytes.end());
}

}  // namespace

std::size_t FrameFormat::chroma_bytes() const {
    const auto luma = static_cast<std::size_t>(frame_width()) * static_cast<std::size_t>(frame_height());
    return full_chroma ? luma : luma / 4;
}

std::size_t FrameFormat::frame_bytes() const {
    return static_cast<std::size_t>(frame_width()) * static_cast<std::size_t>(frame_height()) + 2 * chroma_bytes();
}

std::vector<std::byte> frame_from_image(ConstImageView<Rgba8> image, const FrameFormat& format) {
    // For 4:4:4, pixels are doubled to 2x2, so that subsampled chroma is that of the pixel.
    const int scale = format.full_chroma ? 2 : 1;
    Image<Rgba8> frame(scale * format.frame_width(), scale * format.frame_height());
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
            frame(x, y) = image(std::min(x / scale, format.width - 1), std::min(y / scale, format.height - 1));
        }
    }
    PlanarImage planar = planar_from_rgba(frame);
    if (format.full_chroma) {
        Image<std::uint8_t> luma(format.frame_width(), format.frame_height());
        for (int y = 0; y < luma.height(); ++y) {
            for (int x = 0; x < luma.width(); ++x) luma(x, y) = planar.y(2 * x, 2 * y);
        }
        planar.y = std::move(luma);
    }
    std::vector<std::byte> bytes;
    bytes.reserve(format.frame_bytes());
    append(bytes, planar.y);
    append(bytes, planar.u);
    append(bytes, planar.v);
    return bytes;
}

Image<Rgba8> image_from_frame(std::span<const std::byte> frame, const FrameFormat& format) {
    RS_CHECK(frame.size() == format.frame_bytes());
    const int chroma_step = format.full_chroma ? 1 : 2;
    const auto stride = static_cast<std::size_t>(format.frame_width());
    const auto u_plane = stride * static_cast<std::size_t>(format.frame_height());
    const auto v_plane = u_plane + format.chroma_bytes();
    Image<Rgba8> image(format.width, format.height);
    for (int y = 0; y < format.height; ++y) {
        for (int x = 0; x < format.width; ++x) {
            const auto luma = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
            const auto chroma =
                static_cast<std::size_t>(y / chroma_step) * (stride / static_cast<std::size_t>(chroma_step)) +
                static_cast<std::size_t>(x / chroma_step);
            image(x, y) =
                rgba_from_yuva(std::to_integer<int>(frame[luma]), std::to_integer<int>(frame[u_plane + chroma]),
                               std::to_integer<int>(frame[v_plane + chroma]), 255);
        }
    }
    return image;
}

}  // namespace rs::bench
