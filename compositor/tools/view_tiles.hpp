#pragma once
// A traced image in pieces, each made by a process of its own: as workflow/Snakefile does. Tiles are the traced
// image's own pixels, before objects and what is blended are drawn over and under it.

#include "compositor/tools/view_options.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rs::compositor {

// Of a frame, in its pixels.
struct TileRequest {
    std::size_t frame = 0;
    capture::PixelRectangle place;
};

// "3:256,0,128x64": of frame 3 the 128x64 pixels whose first is (256, 0). It must lie within the frames.
Result<TileRequest> parse_tile(const std::string& text, const std::vector<Camera>& cameras);
// Of a tile in a folder of them: "3-256-0.png".
std::string tile_name(const TileRequest& tile);

// {"frames": 4, "width": 1280, "height": 720, "traced": true}: what the arguments would draw.
Status write_plan(const ViewArguments& arguments, const std::vector<Camera>& cameras);

// The tile's traced image, which has had its passes, as arguments.output.
Status write_tile(const ViewArguments& arguments, const TileRequest& tile, const Image<Rgba8>& traced);

// A frame's traced image from the tiles of arguments.tiles; they must cover it, each pixel once.
Result<Image<Rgba8>> read_tiles(const ViewArguments& arguments, std::size_t frame, const Camera& camera);

}  // namespace rs::compositor
