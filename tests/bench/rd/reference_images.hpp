#pragma once
// Input of all codecs and reference of their errors: the upright images of a capture set, as read by the encoder, and
// the 8x8 blocks that contain the object.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::bench {

inline constexpr int kBlock_px = 8;

struct ReferenceImages {
    std::string name;  // the set's folder
    std::filesystem::path folder;
    int width = 0;  // px, of every image
    int height = 0;
    std::vector<Image<Rgba8>> views;  // straight alpha, ring order
    // [view], one pixel per 8x8 block counted from the top left (the last ones may exceed the image): 1 if any pixel of
    // the block has alpha > 0.
    std::vector<Image<std::uint8_t>> touched;
    std::int64_t touched_blocks = 0;  // in all views
    std::uint64_t hash = 0;           // over sizes and pixels

    /// Bits per pixel of the touched blocks, each of which counts as 64 pixels.
    [[nodiscard]] double bits_per_pixel(std::uint64_t bytes) const {
        return 8.0 * static_cast<double>(bytes) /
               (static_cast<double>(kBlock_px * kBlock_px) * static_cast<double>(touched_blocks));
    }
};

/// Fails like encode::open_capture_set and read_upright_image, and if no pixel of the set is visible.
Result<ReferenceImages> read_reference_images(const std::filesystem::path& folder, Progress* progress);

}  // namespace rs::bench
