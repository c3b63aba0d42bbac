// rs-view: a scene with ray-space objects -> composited frames.

#include "compositor/gl/context.hpp"
#include "compositor/scene/object_argument.hpp"
#include "compositor/scene/scene_file.hpp"
#include "compositor/viewer/frame_compositor.hpp"
#include "compositor/viewer/frame_times.hpp"
#include "compositor/viewer/framing.hpp"
#include "compositor/window/visit.hpp"
#include "rayspace/file_output.hpp"
#include "rayspace/picture_io.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/rig.hpp"
#include "rayspace/tool_main.hpp"
#include "rayspace/view_output.hpp"
#include "rayspace/write_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace rs::compositor {
namespace {

constexpr double kRowSpacing = 2.2;  // between objects without a place of their own, object radii

struct ViewArguments {
    std::string scene;
    std::vector<std::string> objects;
    std::string output;
    std::string eye;
    std::string at;
    std::string size = "1280x720";
    double fov_deg = 0;
    double frames_per_second = 30;
    int orbit = 0;
    int samples = FrameOptions{}.samples;
    std::string viewpoint;
    std::string stats;
    std::string path;
    bool wire_frame = false;
    bool quiet = false;
};

Result<Scene> asked_scene(const ViewArguments& arguments) {
    Scene scene;
    if (arguments.scene.empty()) {
        scene.floor = Floor{};
    } else {
        Result<Scene> read = read_scene(arguments.scene);
        if (!read) return read.error();
        scene = std::move(*read);
    }
    if (!arguments.path.empty()) {
        const Result<Scene> walk = read_scene(arguments.path);
        if (!walk) return walk.error();
        if (!walk->camera)
            return Error{arguments.path + ": has no camera path (compositor/README.md, JSON, \"camera\")"};
        scene.camera = walk->camera;
    }
    const auto count = static_cast<double>(arguments.objects.size());
    for (std::size_t i = 0; i < arguments.objects.size(); ++i) {
        const double row_place = (static_cast<double>(i) - (count - 1) / 2) * kRowSpacing;
        Result<RaySpaceNode> node = parse_object_argument(arguments.objects[i], {row_place, 0, 0});
        if (!node) return node.error();
        scene.objects.push_back(std::move(*node));
    }
    return scene;
}

// The viewpoint that the command line names, or the first.
Result<const Viewpoint*> asked_viewpoint(const ViewArguments& arguments, const Scene& scene) {
    if (arguments.viewpoint.empty()) return scene.viewpoints.empty() ? nullptr : &scene.viewpoints.front();
    std::string known;
    for (const Viewpoint& viewpoint : scene.viewpoints) {
        if (viewpoint.description == arguments.viewpoint) return &viewpoint;
        known += (known.empty() ? "" : ", ") + ("'" + viewpoint.description + "'");
    }
    return Error{"--viewpoint " + arguments.viewpoint + ": the scene has no viewpoint of this description; it has " +
                 (known.empty() ? "none" : known)};
}

CameraPose pose_that_shows_all(const Scene& scene, const std::vector<PlacedObject>& objects, double fov_x_rad,
                               double aspect) {
    const BoundingBox bounds = bounds_of(scene);
    if (!objects.empty() || bounds.empty()) return framing_pose(objects, fov_x_rad, aspect);
    return framing_pose(bounds, fov_x_rad, aspect);
}

// What the command line says about the camera outranks the scene's path, that its viewpoint, and that the framing of
// all that there is.
Result<std::vector<Camera>> asked_cameras(const ViewArguments& arguments, const Scene& scene,
                                          const std::vector<PlacedObject>& objects, PixelSize size) {
    const Result<const Viewpoint*> viewpoint = asked_viewpoint(arguments, scene);
    if (!viewpoint) return viewpoint.error();
    const bool looks_elsewhere = !arguments.eye.empty() || !arguments.at.empty();
    const bool at_viewpoint = *viewpoint != nullptr && (!scene.camera || !arguments.viewpoint.empty());
    if (at_viewpoint && !looks_elsewhere && arguments.orbit == 0) {
        Viewpoint here = **viewpoint;
        if (arguments.fov_deg > 0) {
            const double half_x = std::tan(radians(arguments.fov_deg) / 2);
            here.field_of_view_rad = 2 * std::atan(half_x * std::min(size.width, size.height) / size.width);
        }
        return std::vector<Camera>{camera_at(here, size.width, size.height)};
    }
    CameraPath path = at_viewpoint ? CameraPath{} : scene.camera.value_or(CameraPath{});
    if (arguments.fov_deg > 0) path.fov_x_rad = radians(arguments.fov_deg);
    if (at_viewpoint) path.keys = {pose_at(**viewpoint, bounds_of(scene))};
    if (path.keys.empty()) {
        const double aspect = static_cast<double>(size.width) / size.height;
        path.keys = {pose_that_shows_all(scene, objects, path.fov_x_rad, aspect)};
    }
    if (looks_elsewhere) {
        CameraPose pose = path.keys.front();
        for (const auto& [text, option, point] :
             {std::tuple{&arguments.eye, "--eye", &pose.eye}, std::tuple{&arguments.at, "--at", &pose.at}}) {
            if (text->empty()) continue;
            const Result<Triple> given = parse_triple(*text, option);
            if (!given) return given.error();
            *point = {given->x, given->y, given->z};
        }
        path.keys = {pose};
        path.frames = 1;
    }
    const std::vector<CameraPose> poses =
        arguments.orbit > 0 ? poses_around(path.keys.front(), arguments.orbit) : poses_along(path);
    std::vector<Camera> cameras;
    for (const CameraPose& pose : poses) {
        if (glm::distance(pose.eye, pose.at) < 1e-6) {
            return Error{"the eye and the point looked at are the same; move --eye or --at"};
        }
        cameras.push_back(look_at_camera(pose.eye, pose.at, path.fov_x_rad, size.width, size.height));
    }
    return cameras;
}

// The frames with the cameras that saw them, as a set of pictures that other tools can open.
Status write_folder(const std::function<Result<Image<Rgba8>>(const Camera&)>& compose,
                    const std::vector<Camera>& cameras, const ViewArguments& arguments, Progress& progress) {
    Result<StagedFolder> staged = StagedFolder::create(arguments.output);
    if (!staged) return staged.error();
    const Rig rig = rig_of_views(cameras);
    for (const RigView& view : rig.views) {
        const Result<Image<Rgba8>> frame = compose(view.camera);
        if (!frame) return frame.error();
        if (Status status = write_png(staged->temporary_path() / view.file_path, *frame); !status) return status;
        progress.advance();
    }
    if (Status status = write_rig(staged->temporary_path() / kRigFileName, rig); !status) return status;
    return staged->commit();
}

// In a window: beginning where the first camera is, then at the scene's viewpoints.
Status run_visit(const ViewArguments& arguments, const Scene& scene, const std::vector<PlacedObject>& objects,
                 const Camera& first, PixelSize size) {
    VisitOptions options;
    options.window.title = arguments.scene.empty() ? "rs-view" : arguments.scene;
    options.window.width = size.width;
    options.window.height = size.height;
    options.wire_frame = arguments.wire_frame;
    options.samples = arguments.samples;
    Viewpoint begin;
    begin.world_from_camera = first.world_from_camera;
    begin.field_of_view_rad = 2 * std::atan(0.5 * std::min(first.width, first.height) / first.fl_y);
    options.viewpoints.push_back(begin);
    options.viewpoints.insert(options.viewpoints.end(), scene.viewpoints.begin(), scene.viewpoints.end());
    return visit(scene, objects, options);
}

Status write_frames(const ViewArguments& arguments, OutputKind kind, const std::vector<Camera>& cameras,
                    const std::function<Result<Image<Rgba8>>(const Camera&)>& compose, Progress& progress) {
    if (kind == OutputKind::video) {
        return write_view_video(arguments.output, arguments.frames_per_second, cameras, compose, progress);
    }
    if (kind == OutputKind::folder) return write_folder(compose, cameras, arguments, progress);
    const Result<Image<Rgba8>> frame = compose(cameras.front());
    if (!frame) return frame.error();
    return write_png(arguments.output, *frame);
}

Status run_view(const ViewArguments& arguments) {
    const bool in_window = arguments.output.empty();
    const Result<OutputKind> kind = in_window ? OutputKind::picture : output_kind(arguments.output);
    if (!kind) return kind.error();
    const Result<PixelSize> size = parse_size(arguments.size);
    if (!size) return size.error();
    Result<Scene> scene = asked_scene(arguments);
    if (!scene) return scene.error();
    ProgressBar progress(arguments.quiet);
    const Result<std::vector<PlacedObject>> objects = load_objects(*scene, &progress);
    if (!objects) return objects.error();
    for (const std::string& warning : scene->warnings) {
        std::fprintf(stderr, "rs-view: warning: %s\n", warning.c_str());
    }
    const Result<std::vector<Camera>> cameras = asked_cameras(arguments, *scene, *objects, *size);
    if (!cameras) return cameras.error();
    if (in_window) return run_visit(arguments, *scene, *objects, cameras->front(), *size);
    if (*kind == OutputKind::picture && cameras->size() != 1) {
        return Error{arguments.output + ": " + std::to_string(cameras->size()) +
                     " frames do not fit one picture; give a folder or an .mp4 to -o"};
    }

    Result<gl::Context> context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    Result<FrameCompositor> compositor = FrameCompositor::create(*scene, *objects,
                                                                 {.width = size->width,
                                                                  .height = size->height,
                                                                  .samples = arguments.samples,
                                                                  .wire_frame = arguments.wire_frame,
                                                                  .time_parts = !arguments.stats.empty()});
    if (!compositor) return compositor.error();
    FrameTimes times;
    const auto compose = [&](const Camera& camera) -> Result<Image<Rgba8>> {
        if (Status status = times.draw(*compositor, camera); !status) return status.error();
        return compositor->picture();
    };
    progress.start("compositing", static_cast<std::int64_t>(cameras->size()));
    if (Status status = write_frames(arguments, *kind, *cameras, compose, progress); !status) return status;
    return arguments.stats.empty() ? Status() : write_file(arguments.stats, times.to_json());
}

}  // namespace
}  // namespace rs::compositor

int main(int argc, char** argv) {
    using namespace rs::compositor;
    CLI::App app("Composites ray-space objects and geometry: in a window to walk through, or into pictures or a video.",
                 "rs-view");
    ViewArguments arguments;
    bool headless = false;
    app.add_option("SCENE", arguments.scene,
                   "scene: .wrl, .wrl.gz (VRML97), .gltf, .glb, .obj or .json (compositor/README.md)");
    app.add_option("--object", arguments.objects,
                   "FILE.rso[@X,Y,Z[,TURN_DEG[,SCALE]]]: an object whose foot stands at X,Y,Z, turned about Y; may be "
                   "repeated. Objects without a place stand in a row. Without SCENE they get a floor")
        ->type_name("OBJECT")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("-o,--output", arguments.output, "FILE.png, FILE.mp4 or a folder; without it, a window opens");
    app.add_flag("--headless", headless, "draw without a window or a display; implied by -o");
    app.add_option("--eye", arguments.eye, "viewpoint X,Y,Z; of the scene, or where all is in view")
        ->type_name("X,Y,Z");
    app.add_option("--at", arguments.at, "point looked at")->type_name("X,Y,Z");
    app.add_option("--fov", arguments.fov_deg, "horizontal field of view in degrees (50, or of the scene)")
        ->check(CLI::Range(1.0, 150.0));
    app.add_option("--viewpoint", arguments.viewpoint, "description of one of the scene's viewpoints (the first)")
        ->type_name("NAME");
    app.add_option("--path", arguments.path, "walk along the camera path of a JSON scene file, in place of the scene's")
        ->type_name("FILE.json");
    app.add_flag("--wire-frame", arguments.wire_frame, "only the edges of the geometry's triangles");
    app.add_option("--size", arguments.size, "size of the frames, WxH")->capture_default_str();
    app.add_option("--orbit", arguments.orbit, "N frames once around the point looked at")
        ->check(CLI::Range(1, 100000));
    app.add_option("--fps", arguments.frames_per_second, "frames per second of an .mp4")
        ->check(CLI::Range(1.0, 240.0))
        ->capture_default_str();
    app.add_option("--samples", arguments.samples, "per pixel, for the edges of geometry")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    app.add_option("--stats", arguments.stats, "with -o: also write the frames' times, by part, as JSON")
        ->type_name("FILE.json");
    app.add_flag("-q,--quiet", arguments.quiet, "no progress bar");
    app.footer(
        "Lengths are in the scene's units; an object of scale 1 has radius 1. Y is up.\n"
        "Examples:\n"
        "  rs-view museum.wrl\n"
        "  rs-view --object vase.rso -o shot.png\n"
        "  rs-view --object vase.rso@-1.2,0,0 --object lamp.rso@1.2,0,0,45,0.8 --orbit 120 -o turn.mp4\n"
        "  rs-view world.wrl -o world.png\n"
        "  rs-view room.json --eye 0,1.2,6 --at 0,0.8,0 --fov 45 --size 1920x1080 -o room.png");
    std::function<rs::Status()> run;
    app.callback([&] {
        if (arguments.scene.empty() && arguments.objects.empty()) {
            throw CLI::ValidationError("nothing to show; give a scene file or --object FILE.rso");
        }
        if (headless && arguments.output.empty()) {
            throw CLI::ValidationError("--headless needs -o: the picture, video or folder to write");
        }
        run = [&] { return run_view(arguments); };
    });
    return rs::tool_main(app, argc, argv, run);
}
