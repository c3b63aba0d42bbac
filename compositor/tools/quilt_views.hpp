#pragma once
// What `rs-view --quilt` draws: the cameras of the tiles, and the one image that they make.

#include "compositor/displays/quilt.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/tools/view_options.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <vector>

namespace rs::compositor {

struct QuiltViews {
    QuiltLayout layout;
    std::vector<std::vector<Camera>> frames;  // [frame][view]

    [[nodiscard]] std::vector<Camera> cameras() const;  // of all frames
};

// The size of one tile: --tile-size.
Result<PixelSize> requested_tile(const ViewArguments& arguments);

// `middle`: a camera of the tile's size for each frame.
Result<QuiltViews> requested_quilt(const ViewArguments& arguments, const Scene& scene,
                                   const std::vector<Camera>& middle);

// Into arguments.output with the layout in its name; of several frames into a folder of such images. `progress` is
// advanced for each view.
Status write_quilts(const QuiltViews& views, const ViewArguments& arguments, const RenderView& render,
                    Progress& progress);

}  // namespace rs::compositor
