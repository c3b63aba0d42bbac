#pragma once
// Quilts: rows and columns of views of one scene in one image, the input of displays with horizontal parallax. The
// eyes stand on a line to the right of each other, their frusta are sheared and share the plane of focus, which the
// display shows at its own depth. Pure; thread-safe.
//
// Order and name are those of Looking Glass displays: view 0, the leftmost eye, is the lower left tile, the next one is
// to its right, the last is the upper right tile; "NAME_qs5x9a0.75.png" has 5 columns, 9 rows and tiles whose width
// over height is 0.75.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::compositor {

struct QuiltLayout {
    int columns = 0;  // >= 1
    int rows = 0;
    int tile_width = 0;  // px
    int tile_height = 0;

    [[nodiscard]] int views() const { return columns * rows; }
    [[nodiscard]] int width() const { return columns * tile_width; }
    [[nodiscard]] int height() const { return rows * tile_height; }
};

// "5x9". Refuses quilts of less than two views, and of sides beyond kMaxImageSide_px; `option` names it in errors.
Result<QuiltLayout> parse_quilt(const std::string& text, int tile_width, int tile_height, const std::string& option);

// One camera for each view. The middle one's image has the size of a tile. The eyes spread over `cone_rad` (0..pi
// without its ends) as seen from the point at the axial depth `focus` > 0 straight ahead of the middle one, and at that
// depth every point has the same pixel in all views.
std::vector<Camera> quilt_cameras(const Camera& middle, const QuiltLayout& layout, double cone_rad, double focus);

// Puts view number `view` where it belongs; the quilt is of the layout's size.
void place_tile(const QuiltLayout& layout, int view, const Image<Rgba8>& tile, Image<Rgba8>& quilt);

// With the layout in the name, where it is not there already: "shop.png" -> "shop_qs5x9a0.75.png".
std::filesystem::path quilt_path(const std::filesystem::path& path, const QuiltLayout& layout);

}  // namespace rs::compositor
