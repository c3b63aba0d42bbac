#pragma once
// The cameras of `rs-view walls`, and the files that their images are written to.

#include "compositor/displays/head_receiver.hpp"
#include "compositor/displays/stereo_image.hpp"
#include "compositor/displays/walls_file.hpp"
#include "compositor/scene/scene.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/output/view_output.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct WallOptions {
    std::string display;                   // a preset, or FILE.json
    std::optional<std::string> walls;      // only these, NAME,NAME
    std::optional<std::string> stereo;     // name of a StereoForm; mono if not given
    std::optional<double> eye_distance_m;  // by default that of the display
    std::optional<std::string> heads;      // FILE.json, or udp:[ADDRESS:]PORT
    std::optional<std::string> size;       // of all walls, WxH; by default that of each wall
    std::optional<std::string> output;     // folder; windows if not given
};

struct WallViews {
    WallDisplay display;
    std::vector<Head> heads;       // one for all frames, or one per frame
    std::vector<RoomPose> places;  // likewise
    std::optional<StereoForm> stereo;
    std::shared_ptr<HeadReceiver> tracker;  // null without a tracker

    [[nodiscard]] std::size_t frames() const { return std::max(heads.size(), places.size()); }
    [[nodiscard]] const Head& head(std::size_t frame) const { return heads[heads.size() == 1 ? 0 : frame]; }
    [[nodiscard]] const RoomPose& place(std::size_t frame) const { return places[places.size() == 1 ? 0 : frame]; }
};

/// Reads the display and the heads. Fails if an eye of any frame is behind a wall. With an output, waits up to 10 s for
/// the first head of a tracker.
/// \param visitor cameras of a visitor without a display (camera_options.hpp): they place the room in the scene, unless
///     the display does
Result<WallViews> requested_walls(const WallOptions& options, const Scene& scene, const std::vector<Camera>& visitor);

/// Position of the head in the room, if the tracker has reported one since the last call.
std::optional<Head> newest_head(const WallViews& views);

/// The cameras frame by frame, wall by wall, the left eye before the right one.
Result<std::vector<Camera>> wall_cameras(const WallViews& views);

/// Writes WALL.png, or WALL/0000.png, ... for several frames, into the folder `output`; with StereoForm::kFolders below
/// left/ and right/. If each image is that of one eye, transforms.json holds the cameras.
/// \param render called for the cameras of wall_cameras() in order
/// \param progress advanced for each camera
Status write_walls(const WallViews& views, const std::string& output, bool force, const RenderView& render,
                   Progress& progress);

}  // namespace rs::compositor
