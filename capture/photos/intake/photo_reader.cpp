#include "capture/photos/intake/photo_reader.hpp"

#include "capture/photos/intake/reduction.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <utility>

namespace rs::capture {

Image<Rgba8> apply_orientation(Image<Rgba8> stored, int orientation) {
    RS_CHECK(orientation >= 1 && orientation <= 8);
    if (orientation == 1) return stored;
    // TIFF 6.0, tag Orientation: position of the stored first row and column in the upright image.
    const bool swapped = orientation >= 5;
    const bool right_to_left = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool bottom_up = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    const int width = swapped ? stored.height() : stored.width();
    const int height = swapped ? stored.width() : stored.height();
    Image<Rgba8> upright(width, height);
    for (int y = 0; y < stored.height(); ++y) {
        for (int x = 0; x < stored.width(); ++x) {
            const int column = swapped ? y : x;
            const int row = swapped ? x : y;
            upright(right_to_left ? width - 1 - column : column, bottom_up ? height - 1 - row : row) = stored(x, y);
        }
    }
    return upright;
}

Image<Rgba8> to_working_size(Image<Rgba8> upright, const PhotoFolder& folder) {
    RS_CHECK(upright.width() == folder.shown_width && upright.height() == folder.shown_height);
    return folder.reduction > 1 ? reduced_in_linear_light(upright, folder.width, folder.height, folder.reduction)
                                : std::move(upright);
}

Result<Image<Rgba8>> read_photo(const PhotoFolder& folder, std::size_t i) {
    Result<Image<Rgba8>> stored = read_image(folder.photos[i], kMaxPhotoSide_px);
    if (!stored) return stored;
    Image<Rgba8> upright = apply_orientation(std::move(*stored), folder.orientation_of(i));
    if (upright.width() != folder.shown_width || upright.height() != folder.shown_height) {
        return Error{folder.photos[i].string() + ": changed while it was imported; import again"};
    }
    return to_working_size(std::move(upright), folder);
}

}  // namespace rs::capture
