#include "compositor/displays/stereo_image.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>

namespace rs::compositor {

void paste(const Image<Rgba8>& tile, Image<Rgba8>& whole, int x, int y) {
    const ImageView<Rgba8> into = whole.view().crop(x, y, tile.width(), tile.height());
    for (int row = 0; row < tile.height(); ++row) std::copy_n(tile.row(row), tile.width(), into.row(row));
}

Image<Rgba8> stereo_image(StereoForm form, const Image<Rgba8>& left, const Image<Rgba8>& right) {
    RS_CHECK(left.width() == right.width() && left.height() == right.height() && form != StereoForm::kFolders);
    if (form == StereoForm::kAnaglyph) {
        Image<Rgba8> both = right;
        for (int y = 0; y < both.height(); ++y) {
            for (int x = 0; x < both.width(); ++x) both(x, y).r = left(x, y).r;
        }
        return both;
    }
    const bool beside = form == StereoForm::kSideBySide;
    Image<Rgba8> both(left.width() * (beside ? 2 : 1), left.height() * (beside ? 1 : 2));
    paste(left, both, 0, 0);
    paste(right, both, beside ? left.width() : 0, beside ? 0 : left.height());
    return both;
}

}  // namespace rs::compositor
