#include "capture/photos/intake/photograph.hpp"

#include "capture/photos/intake/reduction.hpp"
#include "rayspace/base/check.hpp"
#include "rayspace/pictures/photograph_size.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <utility>

namespace rs::capture {

Image<Rgba8> shown_upright(Image<Rgba8> stored, int orientation) {
    RS_CHECK(orientation >= 1 && orientation <= 8);
    if (orientation == 1) return stored;
    // TIFF 6.0, Orientation: what the stored rows and columns are in what is shown.
    const bool swapped = orientation >= 5;
    const bool right_to_left = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool bottom_up = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    const int width = swapped ? stored.height() : stored.width();
    const int height = swapped ? stored.width() : stored.height();
    Image<Rgba8> shown(width, height);
    for (int y = 0; y < stored.height(); ++y) {
        for (int x = 0; x < stored.width(); ++x) {
            const int column = swapped ? y : x;
            const int row = swapped ? x : y;
            shown(right_to_left ? width - 1 - column : column, bottom_up ? height - 1 - row : row) = stored(x, y);
        }
    }
    return shown;
}

Image<Rgba8> in_working_size(Image<Rgba8> shown, const PhotoFolder& folder) {
    RS_CHECK(shown.width() == folder.shown_width && shown.height() == folder.shown_height);
    return folder.reduction > 1 ? averaged_light(shown, folder.width, folder.height, folder.reduction)
                                : std::move(shown);
}

Result<Image<Rgba8>> read_photograph(const PhotoFolder& folder, std::size_t i) {
    Result<Image<Rgba8>> stored = read_picture(folder.photos[i], kMaxPhotographSide_px);
    if (!stored) return stored;
    Image<Rgba8> shown = shown_upright(std::move(*stored), folder.orientation_of(i));
    if (shown.width() != folder.shown_width || shown.height() != folder.shown_height) {
        return Error{folder.photos[i].string() + ": changed while it was imported; import again"};
    }
    return in_working_size(std::move(shown), folder);
}

}  // namespace rs::capture
