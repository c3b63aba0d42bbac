#include "compositor/tools/wall_views.hpp"

#include "compositor/displays/head_datagram.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <algorithm>
#include <filesystem>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;

constexpr double kFirstHead_s = 10;

// Offsets to the right of the middle of the head, one or two.
std::vector<double> eye_offsets_m(const WallViews& views) {
    if (!views.stereo) return {0};
    const double half = views.display.eye_distance_m / 2;
    return {-half, half};
}

Result<WallDisplay> requested_display(const WallOptions& options) {
    Result<WallDisplay> display = [&]() -> Result<WallDisplay> {
        if (auto preset = preset_display(options.display)) return std::move(*preset);
        if (!options.display.ends_with(".json")) {
            return Error{"--display " + options.display +
                         ": is neither a preset (cave, power-wall, tabletop) nor a .json file of walls"};
        }
        return read_walls(options.display);
    }();
    if (!display) return display;
    if (options.walls) {
        if (const Status status = select_walls(*display, *options.walls); !status) {
            return Error{options.display + ": " + status.error().message};
        }
    }
    if (options.eye_distance_m) display->eye_distance_m = *options.eye_distance_m;
    if (options.size) {
        RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(*options.size));
        for (Wall& wall : display->walls) {
            wall.width = size.width;
            wall.height = size.height;
        }
    }
    return display;
}

Head in_room(const WallViews& views, const Head& tracked) {
    return head_in_room(tracked, views.display.tracker.value_or(views.display.head));
}

// Starts to receive heads. Images of all frames use the first head; windows read the newest one for each frame.
Status add_tracked_head(const WallOptions& options, WallViews& views) {
    RS_ASSIGN_OR_RETURN(const UdpEndpoint place, parse_udp_endpoint(*options.heads));
    RS_ASSIGN_OR_RETURN(HeadReceiver tracker, HeadReceiver::listen(place));
    views.tracker = std::make_shared<HeadReceiver>(std::move(tracker));
    if (!options.output) return {};
    const std::optional<Head> head = views.tracker->wait_for_newest(kFirstHead_s);
    if (head) {
        views.heads = {in_room(views, *head)};
        return {};
    }
    const std::string& fault = views.tracker->first_error();
    return Error{place.text() + ": no head has come in " + std::to_string(static_cast<int>(kFirstHead_s)) +
                 (fault.empty() ? " s; start the tracker, and let it send to this address and port"
                                : " s, but a datagram that " + fault)};
}

std::string numbered(const std::string& name, std::size_t frame, std::size_t frames) {
    return frames == 1 ? name + ".png" : name + "/" + numbered_image_name(frame);
}

}  // namespace

std::optional<Head> newest_head(const WallViews& views) {
    const std::optional<Head> tracked = views.tracker ? views.tracker->newest() : std::nullopt;
    if (!tracked) return std::nullopt;
    return in_room(views, *tracked);
}

Result<std::vector<Camera>> wall_cameras(const WallViews& views) {
    std::vector<Camera> cameras;
    for (std::size_t frame = 0; frame < views.frames(); ++frame) {
        for (const Wall& wall : views.display.walls) {
            for (const double offset : eye_offsets_m(views)) {
                Result<Camera> camera = wall_camera(wall, views.head(frame).eye(offset), views.place(frame));
                if (!camera) {
                    const std::string at = views.heads.size() > 1 ? "head " + std::to_string(frame) + ": " : "";
                    return Error{at + camera.error().message};
                }
                cameras.push_back(*camera);
            }
        }
    }
    return cameras;
}

Result<WallViews> requested_walls(const WallOptions& options, const Scene& scene, const std::vector<Camera>& visitor) {
    RS_ASSIGN_OR_RETURN(WallDisplay display, requested_display(options));
    WallViews views;
    views.display = std::move(display);
    for (const NamedStereoForm& named : kStereoForms) {
        if (options.stereo == named.name) views.stereo = named.form;
    }
    views.heads = {views.display.head};
    if (options.heads && is_udp_endpoint(*options.heads)) {
        RS_TRY(add_tracked_head(options, views));
    } else if (options.heads) {
        RS_ASSIGN_OR_RETURN(std::vector<Head> heads, read_heads(*options.heads));
        views.heads = std::move(heads);
    }
    if (views.display.fits_scene) {
        const BoundingBox box = bounds_from(scene, 0, 0);
        if (box.empty())
            return Error{options.display + ": the scene is empty, so that it cannot be fitted to the table"};
        views.places = {fit_scene_to_wall(views.display.walls.front(), box)};
    } else if (views.display.place) {
        views.places = {*views.display.place};
    } else {
        // The room is placed so that the display's head is at the visitor's eye; heads then move within the room.
        for (const Camera& camera : visitor) {
            views.places.push_back(place_of(camera, views.display.head, views.display.units_per_metre));
        }
    }
    if (views.heads.size() > 1 && views.places.size() > 1 && views.heads.size() != views.places.size()) {
        return Error{*options.heads + ": has " + std::to_string(views.heads.size()) +
                     " heads, and the way through the scene " + std::to_string(views.places.size()) +
                     " frames; give as many, or one of them"};
    }
    if (const auto cameras = wall_cameras(views); !cameras) {
        return Error{options.heads.value_or(options.display) + ": " + cameras.error().message};
    }
    return views;
}

Status write_walls(const WallViews& views, const std::string& output, bool force, const RenderView& render,
                   Progress& progress) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "images of walls", force));
    RS_ASSIGN_OR_RETURN(const auto cameras, wall_cameras(views));
    const bool apart = !views.stereo || *views.stereo == StereoForm::kFolders;
    const std::size_t eyes = views.stereo ? 2 : 1;
    Rig rig;
    const auto write = [&](const std::string& name, const Image<Rgba8>& image) -> Status {
        const fs::path path = staged.temporary_path() / name;
        std::error_code failed;
        fs::create_directories(path.parent_path(), failed);
        if (failed) return Error{path.parent_path().string() + ": cannot be made: " + failed.message()};
        return write_png(path, image);
    };
    for (std::size_t at = 0; at < cameras.size();) {
        const std::size_t wall = at / eyes % views.display.walls.size();
        const std::size_t frame = at / eyes / views.display.walls.size();
        const std::string name = numbered(views.display.walls[wall].name, frame, views.frames());
        std::vector<Image<Rgba8>> images;
        for (std::size_t eye = 0; eye < eyes; ++eye, ++at) {
            RS_ASSIGN_OR_RETURN(Image<Rgba8> image, render(cameras[at]));
            progress.advance();
            if (!apart) {
                images.push_back(std::move(image));
                continue;
            }
            RigView view;
            view.file_path = eyes == 1 ? name : (eye == 0 ? "left/" : "right/") + name;
            view.camera = cameras[at];
            RS_TRY(write(view.file_path, image));
            rig.views.push_back(std::move(view));
        }
        if (apart) continue;
        RS_TRY(write(name, stereo_image(*views.stereo, images[0], images[1])));
    }
    if (apart) {
        RS_TRY(write_rig(staged.temporary_path() / kRigFileName, rig));
    }
    return staged.commit();
}

}  // namespace rs::compositor
