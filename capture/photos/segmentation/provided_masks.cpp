#include "capture/photos/segmentation/provided_masks.hpp"

#include <algorithm>
#include <utility>

namespace rs::capture {

Result<Segmentation> AlphaSegmenter::segment(const TurnPhoto& photo) const {
    Segmentation result{Image<std::uint8_t>(photo.image.width(), photo.image.height()), true};
    for (int y = 0; y < photo.image.height(); ++y) {
        std::transform(photo.image.row(y), photo.image.row(y) + photo.image.width(), result.mask.row(y),
                       [](const Rgba8& pixel) { return pixel.a; });
    }
    return result;
}

Result<Segmentation> MaskFolderSegmenter::segment(const TurnPhoto& photo) const {
    RS_ASSIGN_OR_RETURN(Image<std::uint8_t> mask, masks_.read(photo.index));
    const bool is_alpha = masks_.kind() == MaskKind::kAlpha;
    if (photos_.reduction > 1) {
        Image<Rgba8> shown(mask.width(), mask.height());
        std::ranges::transform(mask.pixels(), shown.pixels().begin(), [](std::uint8_t code) {
            return Rgba8{0, 0, 0, code};
        });
        const Image<Rgba8> reduced = to_working_size(std::move(shown), photos_);
        mask = Image<std::uint8_t>(reduced.width(), reduced.height());
        std::ranges::transform(reduced.pixels(), mask.pixels().begin(), [&](const Rgba8& pixel) {
            return is_alpha ? pixel.a : static_cast<std::uint8_t>(pixel.a >= 128 ? 255 : 0);
        });
    }
    return Segmentation{std::move(mask), is_alpha};
}

}  // namespace rs::capture
