#pragma once
// What `rs-view --walls` draws: which cameras, and how their images become files.

#include "compositor/displays/head_receiver.hpp"
#include "compositor/displays/stereo_image.hpp"
#include "compositor/displays/walls_file.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/tools/view_options.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/output/view_output.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct WallViews {
    WallDisplay display;
    std::vector<Head> heads;        // one for all frames, or one for each
    std::vector<RoomPlace> places;  // likewise
    std::optional<StereoForm> stereo;
    std::shared_ptr<HeadReceiver> tracker;  // moves the head; null without

    [[nodiscard]] std::size_t frames() const { return std::max(heads.size(), places.size()); }
    [[nodiscard]] const Head& head(std::size_t frame) const { return heads[heads.size() == 1 ? 0 : frame]; }
    [[nodiscard]] const RoomPlace& place(std::size_t frame) const { return places[places.size() == 1 ? 0 : frame]; }
};

// `visitor`: the cameras of a visitor without a display (requested_cameras.hpp), which show where the room stands where
// the walls' file does not. Every eye of every frame is checked: fails where one is behind a wall, naming it. Images
// of a head that is tracked wait for it, and fail where none comes.
Result<WallViews> requested_walls(const ViewArguments& arguments, const Scene& scene,
                                  const std::vector<Camera>& visitor);

// Where the head is in the room, if the tracker has reported it since the last call.
std::optional<Head> newest_head(const WallViews& views);

// Frame by frame, wall by wall, the left eye before the right one.
Result<std::vector<Camera>> wall_cameras(const WallViews& views);

// Into the folder arguments.output: WALL.png, or WALL/0000.png, ... of several frames; of stereo in two folders
// left/... and right/.... Where each image is that of one eye, transforms.json has their cameras. `render` is called
// for the cameras of wall_cameras() in their order; `progress` is advanced for each.
Status write_walls(const WallViews& views, const ViewArguments& arguments, const RenderView& render,
                   Progress& progress);

}  // namespace rs::compositor
