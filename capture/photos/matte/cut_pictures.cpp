#include "capture/photos/matte/cut_pictures.hpp"

#include "rayspace/base/check.hpp"
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

constexpr int kQuickest = 1;  // of zstd's levels

std::uint64_t bytes_of(int width, int height) {
    return std::uint64_t{sizeof(Rgba8)} * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

}  // namespace

CutPictures::CutPictures(std::filesystem::path folder, int width, int height)
    : folder_(std::move(folder)), width_(width), height_(height) {}

std::filesystem::path CutPictures::file_of(std::size_t view) const {
    return folder_ / (std::to_string(view) + ".rgba.zst");
}

Status CutPictures::put(std::size_t view, ConstImageView<Rgba8> picture) const {
    RS_CHECK(picture.width() == width_ && picture.height() == height_);
    std::vector<std::uint8_t> bytes(bytes_of(width_, height_));
    const std::size_t row_bytes = sizeof(Rgba8) * static_cast<std::size_t>(width_);
    for (int y = 0; y < height_; ++y) {
        std::memcpy(bytes.data() + static_cast<std::size_t>(y) * row_bytes, picture.row(y), row_bytes);
    }
    std::vector<char> frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kQuickest);
    RS_CHECK(!ZSTD_isError(size));  // it cannot lack room
    return write_file(file_of(view), std::as_bytes(std::span(frame).first(size)));
}

Result<Image<Rgba8>> CutPictures::get(std::size_t view) const {
    const std::filesystem::path path = file_of(view);
    const std::uint64_t size = bytes_of(width_, height_);
    const Result<std::vector<std::byte>> frame = read_file(path, 2 * size + 1024);
    if (!frame) return frame.error();
    Image<Rgba8> picture(width_, height_);
    if (ZSTD_decompress(picture.data(), size, frame->data(), frame->size()) != size) {
        return Error{path.string() + ": cannot be read back; check the disk, and import again"};
    }
    return picture;
}

}  // namespace rs::capture
