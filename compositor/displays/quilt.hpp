#pragma once
// Quilts: a grid of views of one scene in one image, the input of displays with horizontal parallax. The eyes are on a
// horizontal line; their frusta are sheared and share the focal plane, which the display shows at its own depth. Pure;
// thread-safe.
//
// Tile order and file names follow Looking Glass displays: view 0, the leftmost eye, is the lower left tile, then rows
// to the right and upwards; "NAME_qs5x9a0.75.png" has 5 columns, 9 rows and tiles of aspect ratio 0.75.

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

/// Parses "5x9". Fails for less than two views and for sides beyond kMaxImageSide_px.
/// \param option option name for errors.
Result<QuiltLayout> parse_quilt(const std::string& text, int tile_width, int tile_height, const std::string& option);

/// One camera per view. At depth `focus` every point has the same pixel in all views.
/// \param middle camera of the middle view, with the tile's image size.
/// \param cone_rad angle between the outer eyes as seen from the focal point, 0 .. pi exclusive.
/// \param focus axial depth of the focal plane, > 0.
std::vector<Camera> quilt_cameras(const Camera& middle, const QuiltLayout& layout, double cone_rad, double focus);

/// Copies the tile of a view to its place; the quilt has the layout's size.
void place_tile(const QuiltLayout& layout, int view, const Image<Rgba8>& tile, Image<Rgba8>& quilt);

/// Appends the layout to the file name unless present: "shop.png" -> "shop_qs5x9a0.75.png".
std::filesystem::path quilt_path(const std::filesystem::path& path, const QuiltLayout& layout);

}  // namespace rs::compositor
