#include "rayspace/api/image.hpp"

#include "rayspace/image/image_metrics.hpp"
#include "rayspace/image_io/image_io.hpp"

namespace rs::api {
namespace {

template <class T>
Status check_size(const std::filesystem::path& path, const ConstImageView<T>& image) {
    if (!image.empty() && image.width() <= kMaxImageSide_px && image.height() <= kMaxImageSide_px) return {};
    return Error{path.string() + ": an image of " + std::to_string(image.width()) + "x" +
                 std::to_string(image.height()) + " is outside 1.." + std::to_string(kMaxImageSide_px) +
                 " pixels a side"};
}

}  // namespace

Result<Image<Rgba8>> read_image(const std::filesystem::path& path) {
    return rs::read_image(path);
}

Status write_png(const std::filesystem::path& path, ConstImageView<Rgba8> image) {
    RS_TRY(check_size(path, image));
    return rs::write_png(path, image);
}

Status write_depth_exr(const std::filesystem::path& path, ConstImageView<float> depth) {
    RS_TRY(check_size(path, depth));
    return write_exr_channel(path, depth);
}

Result<ImageScore> compare_images(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b) {
    if (a.width() != b.width() || a.height() != b.height()) {
        return Error{"images of " + std::to_string(a.width()) + "x" + std::to_string(a.height()) + " and " +
                     std::to_string(b.width()) + "x" + std::to_string(b.height()) +
                     " cannot be compared; give images of one size"};
    }
    const ImageDifference difference = rs::compare_images(a, b);
    return ImageScore{difference.psnr_db(), difference.ssim};
}

}  // namespace rs::api
