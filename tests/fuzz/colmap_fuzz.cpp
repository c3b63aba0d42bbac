#include "capture/posed/cameras/colmap_model.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/fuzz/entries.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

namespace rs::fuzz {

// Input: 'b' (binary) or another letter (text), the size of the file of cameras as two bytes in little-endian order,
// that file, the file of images.
int fuzz_colmap(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kHead_bytes = 3;
    if (size < kHead_bytes) return 0;
    const std::size_t stated = data[1] + 256U * data[2];
    const auto bytes = std::as_bytes(std::span(data, size)).subspan(kHead_bytes);
    const auto cameras = bytes.first(std::min(stated, bytes.size()));
    const auto images = bytes.subspan(cameras.size());
    const auto text = [](std::span<const std::byte> part) {
        return std::string_view(reinterpret_cast<const char*>(part.data()), part.size());
    };
    const auto model = data[0] == 'b' ? capture::colmap_model_from_binary(cameras, images, "input")
                                      : capture::colmap_model_from_text(text(cameras), text(images), "input");
    if (!model) {
        RS_CHECK(model.error().message.find('\n') == std::string::npos);
        return 0;
    }
    // Accepted models are finite, and each camera has a lens and a rotation.
    RS_CHECK(!model->cameras.empty() && model->cameras.size() <= kMaxViews);
    for (const capture::PosedCamera& posed : model->cameras) {
        RS_CHECK(capture::check_lens(posed, "input").ok());
        RS_CHECK(!posed.photo.empty());
        RS_CHECK(rotation_error(posed.camera) < 1e-9);
        RS_CHECK(std::isfinite(glm::length(posed.camera.centre())));
    }
    return 0;
}

}  // namespace rs::fuzz
