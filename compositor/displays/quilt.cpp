#include "compositor/displays/quilt.hpp"

#include "compositor/displays/stereo_image.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace rs::compositor {

Result<QuiltLayout> parse_quilt(const std::string& text, int tile_width, int tile_height, const std::string& option) {
    QuiltLayout layout{0, 0, tile_width, tile_height};
    const char* const end = text.data() + text.size();
    const auto columns = std::from_chars(text.data(), end, layout.columns);
    const bool has_x = columns.ec == std::errc{} && columns.ptr != end && *columns.ptr == 'x';
    const auto rows = has_x ? std::from_chars(columns.ptr + 1, end, layout.rows) : columns;
    if (!has_x || rows.ec != std::errc{} || rows.ptr != end || layout.columns < 1 || layout.rows < 1) {
        return Error{option + " '" + printable(text) + "': must be COLUMNSxROWS, such as 5x9"};
    }
    constexpr int kMaxTileCount = kMaxImageSide_px;
    if (layout.columns > kMaxTileCount / tile_width || layout.rows > kMaxTileCount / tile_height) {
        return Error{option + " " + text + ": tiles of " + std::to_string(tile_width) + "x" +
                     std::to_string(tile_height) + " make an image of more than " + std::to_string(kMaxImageSide_px) +
                     " pixels across; take fewer or smaller ones"};
    }
    if (layout.views() < 2) return Error{option + " " + text + ": a quilt has two views at least"};
    return layout;
}

std::vector<Camera> quilt_cameras(const Camera& middle, const QuiltLayout& layout, double cone_rad, double focus) {
    RS_CHECK(cone_rad > 0 && cone_rad < kPi && focus > 0 && layout.views() > 1);
    std::vector<Camera> cameras;
    for (int view = 0; view < layout.views(); ++view) {
        const double share = static_cast<double>(view) / (layout.views() - 1) - 0.5;
        const double aside = focus * std::tan(share * cone_rad);
        Camera camera = middle;
        camera.world_from_camera[3] += aside * middle.world_from_camera[0];
        // A point at depth `focus` moves to the left by aside * fl_x / focus; the principal point compensates.
        camera.cx += aside * middle.fl_x / focus;
        cameras.push_back(camera);
    }
    return cameras;
}

void place_tile(const QuiltLayout& layout, int view, const Image<Rgba8>& tile, Image<Rgba8>& quilt) {
    RS_CHECK(view >= 0 && view < layout.views());
    RS_CHECK(tile.width() == layout.tile_width && tile.height() == layout.tile_height);
    const int row_from_below = view / layout.columns;
    paste(tile, quilt, (view % layout.columns) * layout.tile_width,
          (layout.rows - 1 - row_from_below) * layout.tile_height);
}

std::filesystem::path quilt_path(const std::filesystem::path& path, const QuiltLayout& layout) {
    char suffix[64];
    std::snprintf(suffix, sizeof suffix, "_qs%dx%da%.4g", layout.columns, layout.rows,
                  static_cast<double>(layout.tile_width) / layout.tile_height);
    const std::string stem = path.stem().string();
    if (stem.ends_with(suffix)) return path;
    std::filesystem::path named = path;
    named.replace_filename(stem + suffix + path.extension().string());
    return named;
}

}  // namespace rs::compositor
