#include "engine/tools/render_command.hpp"

#include "engine/core/contact_sheet.hpp"
#include "engine/core/orbit.hpp"
#include "engine/core/renderer.hpp"
#include "rayspace/conventions.hpp"
#include "rayspace/file_output.hpp"
#include "rayspace/object_file.hpp"
#include "rayspace/picture_io.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/rig.hpp"
#include "rayspace/tool_main.hpp"

#include <tbb/parallel_for.h>

#include <cstdio>
#include <memory>
#include <optional>

namespace rs::engine {
namespace {

struct RenderArguments {
    std::string object;
    std::string output;
    std::string poses;
    std::string eye;
    std::string at = "0,0,0";
    std::string size;
    int orbit = 0;
    int sheet_columns = 0;
    double fov_deg = 0;
    double frames_per_second = 30;
    int level = kProgressiveLevels - 1;
    bool quiet = false;
};

Result<Renderer> open_renderer(const std::string& path, int level) {
    Result<RaySpaceObject> object = read_object(path, {.max_level = level});
    if (!object) return object.error();
    return Renderer::create(std::move(*object));
}

Result<ViewShape> view_shape(const RenderArguments& arguments) {
    ViewShape shape;
    if (!arguments.size.empty()) {
        const Result<PixelSize> size = parse_size(arguments.size);
        if (!size) return size.error();
        shape.width = size->width;
        shape.height = size->height;
    }
    if (arguments.fov_deg != 0) {
        if (!(arguments.fov_deg > 0 && arguments.fov_deg < 160)) {
            return Error{"--fov " + std::to_string(arguments.fov_deg) + ": must be above 0 and below 160 degrees"};
        }
        shape.fov_x_rad = radians(arguments.fov_deg);
    }
    return shape;
}

Result<std::vector<Camera>> cameras_of_rig(const std::string& path, const ViewShape& shape) {
    const Result<Rig> rig = read_rig(path);
    if (!rig) return rig.error();
    if (rig->views.empty()) return Error{path + ": holds no frames to render"};
    std::vector<Camera> cameras;
    for (const RigView& view : rig->views) {
        Camera camera = view.camera;
        if (shape.width > 0) {
            camera.cx *= static_cast<double>(shape.width) / camera.width;
            camera.fl_x *= static_cast<double>(shape.width) / camera.width;
            camera.cy *= static_cast<double>(shape.height) / camera.height;
            camera.fl_y *= static_cast<double>(shape.height) / camera.height;
            camera.width = shape.width;
            camera.height = shape.height;
        }
        cameras.push_back(camera);
    }
    return cameras;
}

Result<std::vector<Camera>> asked_cameras(const RaySpaceObject& object, const RenderArguments& arguments) {
    const Result<ViewShape> shape = view_shape(arguments);
    if (!shape) return shape.error();
    if (!arguments.poses.empty()) return cameras_of_rig(arguments.poses, *shape);
    if (arguments.orbit > 0) return orbit_cameras(object, arguments.orbit, *shape);
    const Result<Triple> eye = parse_triple(arguments.eye, "--eye");
    if (!eye) return eye.error();
    const Result<Triple> at = parse_triple(arguments.at, "--at");
    if (!at) return at.error();
    const Result<Camera> camera = camera_from_eye(object, {eye->x, eye->y, eye->z}, {at->x, at->y, at->z}, *shape);
    if (!camera) return camera.error();
    return std::vector<Camera>{*camera};
}

Result<Image<Rgba8>> render_camera(const Renderer& renderer, const Camera& camera) {
    const Result<ViewRegisters> registers = prepare_view(renderer.object(), camera);
    if (!registers) return registers.error();
    Image<Rgba8> picture(camera.width, camera.height);
    renderer.render(*registers, picture);
    return picture;
}

Status write_video(const Renderer& renderer, const std::vector<Camera>& cameras, const RenderArguments& arguments,
                   Progress& progress) {
    // H.264 at 4:2:0 wants even sizes: the last odd row or column is dropped.
    const int width = cameras.front().width & ~1;
    const int height = cameras.front().height & ~1;
    Result<VideoWriter> video = VideoWriter::open(arguments.output, width, height, arguments.frames_per_second);
    if (!video) return video.error();
    progress.start("rendering", static_cast<std::int64_t>(cameras.size()));
    for (const Camera& camera : cameras) {
        const Result<Image<Rgba8>> picture = render_camera(renderer, camera);
        if (!picture) return picture.error();
        if ((picture->width() & ~1) != width || (picture->height() & ~1) != height) {
            return Error{arguments.output + ": a video needs views of one size; give --size"};
        }
        if (const Status status = video->add(picture->view().crop(0, 0, width, height)); !status) return status;
        progress.advance();
    }
    progress.finish();
    return video->finish();
}

Status write_folder(const Renderer& renderer, const std::vector<Camera>& cameras, const RenderArguments& arguments,
                    Progress& progress) {
    Result<StagedFolder> staged = StagedFolder::create(arguments.output, kRigFileName);
    if (!staged) return staged.error();
    Rig rig;
    rig.object_radius = renderer.object().units_per_radius;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "%04zu.png", i);
        RigView view;
        view.file_path = name;
        view.camera = cameras[i];
        rig.views.push_back(view);
    }
    std::vector<std::optional<Error>> errors(cameras.size());
    progress.start("rendering", static_cast<std::int64_t>(cameras.size()));
    tbb::parallel_for(std::size_t{0}, cameras.size(), [&](std::size_t i) {
        const Result<Image<Rgba8>> picture = render_camera(renderer, cameras[i]);
        const Status status =
            picture ? write_png(staged->temporary_path() / rig.views[i].file_path, *picture) : Status(picture.error());
        if (!status) errors[i] = status.error();
        progress.advance();
    });
    progress.finish();
    for (const auto& error : errors) {
        if (error) return *error;
    }
    if (const Status status = write_rig(staged->temporary_path() / kRigFileName, rig); !status) return status;
    return staged->commit();
}

Status write_picture(const Renderer& renderer, const std::vector<Camera>& cameras, const RenderArguments& arguments) {
    if (cameras.size() > 1 && arguments.sheet_columns == 0) {
        return Error{arguments.output + ": " + std::to_string(cameras.size()) +
                     " views do not fit one picture; give --sheet COLUMNS, or a folder or an .mp4 to -o"};
    }
    std::vector<Image<Rgba8>> pictures;
    for (const Camera& camera : cameras) {
        Result<Image<Rgba8>> picture = render_camera(renderer, camera);
        if (!picture) return picture.error();
        pictures.push_back(std::move(*picture));
    }
    if (arguments.sheet_columns == 0) return write_png(arguments.output, pictures.front());
    constexpr Rgba8 kBackdrop{96, 98, 102, 255};
    return write_png(arguments.output, contact_sheet(pictures, arguments.sheet_columns, kBackdrop));
}

Status run_render(const RenderArguments& arguments) {
    const int ways = (arguments.orbit > 0) + !arguments.poses.empty() + !arguments.eye.empty();
    if (ways != 1) return Error{"say what to render: one of --orbit N, --poses transforms.json or --eye X,Y,Z"};
    const Result<Renderer> renderer = open_renderer(arguments.object, arguments.level);
    if (!renderer) return renderer.error();
    const Result<std::vector<Camera>> cameras = asked_cameras(renderer->object(), arguments);
    if (!cameras) return cameras.error();

    ProgressBar progress(arguments.quiet);
    const std::string extension = std::filesystem::path(arguments.output).extension().string();
    if (extension == ".mp4") return write_video(*renderer, *cameras, arguments, progress);
    if (extension != ".png") return write_folder(*renderer, *cameras, arguments, progress);
    return write_picture(*renderer, *cameras, arguments);
}

}  // namespace

void add_render_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "Render views of an object: PNG with straight alpha, or a video");
    command->add_option("OBJECT", arguments->object, "ray-space object, .rso")->required();
    command->add_option("-o,--output", arguments->output, "a folder, FILE.png or FILE.mp4")->required();
    command->add_option("--orbit", arguments->orbit, "N views once around, as captured")->check(CLI::Range(1, 100000));
    command->add_option("--poses", arguments->poses, "the cameras of a transforms.json");
    command->add_option("--eye", arguments->eye, "one view from X,Y,Z, in object radii; Y is the turntable's axis");
    command->add_option("--at", arguments->at, "with --eye: the point looked at, in object radii")
        ->capture_default_str();
    command->add_option("--size", arguments->size, "size of the views, WxH; as captured where not given");
    command->add_option("--fov", arguments->fov_deg,
                        "horizontal field of view in degrees; as captured where not given");
    command->add_option("--fps", arguments->frames_per_second, "frames per second of an .mp4")
        ->check(CLI::Range(1.0, 240.0))
        ->capture_default_str();
    command->add_option("--sheet", arguments->sheet_columns, "with FILE.png: all views on one sheet, so many in a row")
        ->check(CLI::Range(1, 100));
    command->add_option("--level", arguments->level, "load only every 8th (0), 4th (1), 2nd (2) picture or all (3)")
        ->check(CLI::Range(0, kProgressiveLevels - 1))
        ->capture_default_str();
    command->add_flag("-q,--quiet", arguments->quiet, "no progress bar");
    command->footer(
        "Examples:\n  rs-engine render vase.rso --orbit 120 -o vase.mp4\n"
        "  rs-engine render vase.rso --orbit 12 --sheet 4 --size 256x256 -o sheet.png\n"
        "  rs-engine render vase.rso --eye 3,0.5,2 --size 800x800 -o view.png\n"
        "  rs-engine render vase.rso --poses held-out/transforms.json -o rendered");
    command->callback([arguments, &run] { run = [arguments] { return run_render(*arguments); }; });
}

}  // namespace rs::engine
