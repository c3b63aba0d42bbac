#include "capture/photos/segmentation/foreground_cache.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/file/file_output.hpp"

#include <zstd.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kFastestLevel = 1;  // zstd

std::uint64_t size_bytes(int width, int height) {
    return std::uint64_t{sizeof(Rgba8)} * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

}  // namespace

ForegroundCache::ForegroundCache(std::filesystem::path folder, int width, int height)
    : folder_(std::move(folder)), width_(width), height_(height) {}

std::filesystem::path ForegroundCache::path_of(std::size_t view) const {
    return folder_ / (std::to_string(view) + ".rgba.zst");
}

Status ForegroundCache::put(std::size_t view, ConstImageView<Rgba8> image) const {
    RS_CHECK(image.width() == width_ && image.height() == height_);
    std::vector<std::uint8_t> bytes(size_bytes(width_, height_));
    const std::size_t row_bytes = sizeof(Rgba8) * static_cast<std::size_t>(width_);
    for (int y = 0; y < height_; ++y) {
        std::memcpy(bytes.data() + static_cast<std::size_t>(y) * row_bytes, image.row(y), row_bytes);
    }
    std::vector<char> frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kFastestLevel);
    RS_CHECK(!ZSTD_isError(size));  // the bound always suffices
    return write_file(path_of(view), std::as_bytes(std::span(frame).first(size)));
}

Result<Image<Rgba8>> ForegroundCache::get(std::size_t view) const {
    const std::filesystem::path path = path_of(view);
    const std::uint64_t size = size_bytes(width_, height_);
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> frame, read_file(path, 2 * size + 1024));
    Image<Rgba8> image(width_, height_);
    if (ZSTD_decompress(image.data(), size, frame.data(), frame.size()) != size) {
        return Error{path.string() + ": cannot be read back; check the disk, and import again"};
    }
    return image;
}

}  // namespace rs::capture
