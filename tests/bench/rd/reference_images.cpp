#include "tests/bench/rd/reference_images.hpp"

#include "encode/set/capture_set.hpp"
#include "rayspace/base/parallel.hpp"

#include <xxhash.h>

#include <utility>

namespace rs::bench {
namespace {

Image<std::uint8_t> touched_blocks_of(const Image<Rgba8>& image) {
    Image<std::uint8_t> touched((image.width() + kBlock_px - 1) / kBlock_px,
                                (image.height() + kBlock_px - 1) / kBlock_px);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if (image(x, y).a > 0) touched(x / kBlock_px, y / kBlock_px) = 1;
        }
    }
    return touched;
}

}  // namespace

Result<ReferenceImages> read_reference_images(const std::filesystem::path& folder, Progress* progress) {
    const Result<encode::CaptureSet> set = encode::open_capture_set(folder, progress);
    if (!set) return set.error();
    ReferenceImages images;
    images.folder = std::filesystem::absolute(folder).lexically_normal();
    if (!images.folder.has_filename()) images.folder = images.folder.parent_path();
    images.name = images.folder.filename().string();
    images.width = set->width;
    images.height = set->height;
    const auto count = set->upright.views.size();
    images.views.resize(count);
    images.touched.resize(count);
    const auto read = [&](int view) -> Status {
        Result<Image<Rgba8>> image = encode::read_upright_image(*set, view);
        if (!image) return image.error();
        const auto n = static_cast<std::size_t>(view);
        images.touched[n] = touched_blocks_of(*image);
        images.views[n] = std::move(*image);
        return {};
    };
    const std::string label = "reading " + images.name;
    if (Status status = for_each_in_parallel(static_cast<int>(count), label, progress, read); !status) {
        return status.error();
    }
    images.hash = XXH64(&images.width, sizeof images.width, 0);
    for (std::size_t n = 0; n < count; ++n) {
        for (const std::uint8_t touched : images.touched[n].pixels()) images.touched_blocks += touched;
        const auto pixels = images.views[n].pixels();
        images.hash = XXH64(pixels.data(), pixels.size_bytes(), images.hash);
    }
    if (images.touched_blocks == 0) {
        return Error{folder.string() + ": all images are empty (alpha is 0 everywhere); segment the object first"};
    }
    return images;
}

}  // namespace rs::bench
