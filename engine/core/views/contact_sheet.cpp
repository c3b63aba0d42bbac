#include "engine/core/views/contact_sheet.hpp"

#include <algorithm>

namespace rs::engine {
Image<Rgba8> contact_sheet(const std::vector<Image<Rgba8>>& pictures, int columns, Rgba8 backdrop) {
    RS_CHECK(!pictures.empty() && columns > 0);
    const int count = static_cast<int>(pictures.size());
    columns = std::min(columns, count);
    const int width = pictures.front().width();
    const int height = pictures.front().height();
    Image<Rgba8> sheet(columns * width, (count + columns - 1) / columns * height, backdrop);
    for (int n = 0; n < count; ++n) {
        const Image<Rgba8>& picture = pictures[static_cast<std::size_t>(n)];
        RS_CHECK(picture.width() == width && picture.height() == height);
        const int left = n % columns * width;
        const int top = n / columns * height;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) sheet(left + x, top + y) = over(picture(x, y), backdrop);
        }
    }
    return sheet;
}

}  // namespace rs::engine
