#include "tests/bench/rd/reference_pictures.hpp"

#include "encode/set/capture_set.hpp"
#include "rayspace/base/parallel.hpp"

#include <xxhash.h>

#include <utility>

namespace rs::bench {
namespace {

Image<std::uint8_t> touched_blocks_of(const Image<Rgba8>& picture) {
    Image<std::uint8_t> touched((picture.width() + kBlock_px - 1) / kBlock_px,
                                (picture.height() + kBlock_px - 1) / kBlock_px);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            if (picture(x, y).a > 0) touched(x / kBlock_px, y / kBlock_px) = 1;
        }
    }
    return touched;
}

}  // namespace

Result<ReferencePictures> read_reference_pictures(const std::filesystem::path& folder, Progress* progress) {
    const Result<encode::CaptureSet> set = encode::open_capture_set(folder, progress);
    if (!set) return set.error();
    ReferencePictures pictures;
    pictures.folder = std::filesystem::absolute(folder).lexically_normal();
    if (!pictures.folder.has_filename()) pictures.folder = pictures.folder.parent_path();
    pictures.name = pictures.folder.filename().string();
    pictures.width = set->width;
    pictures.height = set->height;
    const auto count = set->upright.views.size();
    pictures.views.resize(count);
    pictures.touched.resize(count);
    const auto read = [&](int view) -> Status {
        Result<Image<Rgba8>> picture = encode::read_upright_picture(*set, view);
        if (!picture) return picture.error();
        const auto n = static_cast<std::size_t>(view);
        pictures.touched[n] = touched_blocks_of(*picture);
        pictures.views[n] = std::move(*picture);
        return {};
    };
    const std::string label = "reading " + pictures.name;
    if (Status status = for_each_in_parallel(static_cast<int>(count), label, progress, read); !status) {
        return status.error();
    }
    pictures.hash = XXH64(&pictures.width, sizeof pictures.width, 0);
    for (std::size_t n = 0; n < count; ++n) {
        for (const std::uint8_t touched : pictures.touched[n].pixels()) pictures.touched_blocks += touched;
        const auto pixels = pictures.views[n].pixels();
        pictures.hash = XXH64(pixels.data(), pixels.size_bytes(), pictures.hash);
    }
    if (pictures.touched_blocks == 0) {
        return Error{folder.string() + ": no picture shows anything (alpha is 0 everywhere); cut the object out first"};
    }
    return pictures;
}

}  // namespace rs::bench
