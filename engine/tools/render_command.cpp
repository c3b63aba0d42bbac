#include "engine/tools/commands.hpp"

#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/renderer.hpp"
#include "engine/tools/requested_views.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::engine {
namespace {

// Arranges views in a grid on one image.
Image<Rgba8> contact_sheet(const std::vector<Image<Rgba8>>& images, int columns, Rgba8 backdrop) {
    RS_CHECK(!images.empty() && columns > 0);
    const int count = static_cast<int>(images.size());
    columns = std::min(columns, count);
    const int width = images.front().width();
    const int height = images.front().height();
    Image<Rgba8> sheet(columns * width, (count + columns - 1) / columns * height, backdrop);
    for (int n = 0; n < count; ++n) {
        const Image<Rgba8>& image = images[static_cast<std::size_t>(n)];
        RS_CHECK(image.width() == width && image.height() == height);
        const int left = n % columns * width;
        const int top = n / columns * height;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) sheet(left + x, top + y) = over(image(x, y), backdrop);
        }
    }
    return sheet;
}

struct RenderArguments {
    std::string object;
    std::string output;
    RequestedViews views;
    int sheet_columns = 0;
    double frames_per_second = 30;
    int level = kProgressiveLevels - 1;
    bool depth = false;
    std::optional<TexelFilter> filter;  // default: by the scale of the views
    bool force = false;
    bool quiet = false;
};

Result<Renderer> open_renderer(const std::string& path, int level) {
    RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(path, {.max_level = level, .decode = false}));
    return Renderer::create(std::move(object));
}

// Counts views without any visible pixel. Thread-safe.
class EmptyViews {
public:
    void add(const Image<Rgba8>& image) {
        ++views_;
        if (std::ranges::all_of(image.pixels(), [](const Rgba8& p) { return p.a == 0; })) ++empty_;
    }
    void warn() const {
        if (empty_ == 0) return;
        const std::string subject =
            views_ == 1 ? "the view shows" : std::to_string(empty_) + " of " + std::to_string(views_) + " views show";
        std::fprintf(
            stderr,
            "rs-engine: warning: %s nothing of the object; the camera may be inside the object, directly above it, or "
            "point past it; move the camera\n",
            subject.c_str());
    }

private:
    std::atomic<int> views_{0};
    std::atomic<int> empty_{0};
};

Result<Image<Rgba8>> render_camera(const Renderer& renderer, const Camera& camera, std::optional<TexelFilter> filter,
                                   EmptyViews& empty) {
    RS_ASSIGN_OR_RETURN(const MixedView view, prepare_mixed_view(renderer.object(), camera, filter));
    Image<Rgba8> image(camera.width, camera.height);
    renderer.render(view, image);
    empty.add(image);
    return image;
}

// "vase.depth.exr" for "vase.png".
std::filesystem::path depth_name(std::filesystem::path image) {
    return image.replace_extension(".depth.exr");
}

// Writes the view as PNG and its depth to depth_name(path).
Status write_view_with_depth(const Renderer& renderer, const Camera& camera, std::optional<TexelFilter> filter,
                             const std::filesystem::path& path, EmptyViews& empty) {
    RS_ASSIGN_OR_RETURN(const MixedView view, prepare_mixed_view(renderer.object(), camera, filter));
    Image<Rgba8> image(camera.width, camera.height);
    Image<std::int32_t> lambda_q20(camera.width, camera.height);
    renderer.render(view, image, lambda_q20);
    empty.add(image);
    RS_TRY(write_png(path, image));
    return write_exr_channel(depth_name(path), depth_image(renderer.object(), camera, lambda_q20));
}

Status write_folder(const Renderer& renderer, const std::vector<Camera>& cameras, const RenderArguments& arguments,
                    EmptyViews& empty, Progress& progress) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(arguments.output, "rendered views", arguments.force));
    Rig rig = make_rig_of_views(cameras);
    rig.object_radius = renderer.object().units_per_radius;
    for (RigView& view : rig.views) {
        if (arguments.depth) view.depth_file_path = depth_name(view.file_path).string();
    }
    const int count = static_cast<int>(cameras.size());
    RS_TRY(for_each_in_parallel(count, "rendering", &progress, [&](int i) -> Status {
        const auto n = static_cast<std::size_t>(i);
        const std::filesystem::path path = staged.temporary_path() / rig.views[n].file_path;
        if (arguments.depth) return write_view_with_depth(renderer, cameras[n], arguments.filter, path, empty);
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, render_camera(renderer, cameras[n], arguments.filter, empty));
        return write_png(path, image);
    }));
    RS_TRY(write_rig(staged.temporary_path() / kRigFileName, rig));
    return staged.commit();
}

// Reduces views so that a sheet of them has at most 4096 pixels a side.
void fit_on_sheet(std::vector<Camera>& cameras, std::size_t columns) {
    constexpr double kSheetSide_px = 4096;
    columns = std::min(columns, cameras.size());
    const std::size_t rows = (cameras.size() + columns - 1) / columns;
    double scale = 1;
    for (const Camera& camera : cameras) {
        scale = std::min({scale, kSheetSide_px / (static_cast<double>(columns) * camera.width),
                          kSheetSide_px / (static_cast<double>(rows) * camera.height)});
    }
    if (scale == 1) return;
    const auto scaled = [&](int side) { return std::max(1, static_cast<int>(side * scale)); };
    for (Camera& camera : cameras) camera = resized(camera, scaled(camera.width), scaled(camera.height));
}

// Checks before rendering that the views can be written as one image.
Status check_one_image(const std::vector<Camera>& cameras, const RenderArguments& arguments) {
    if (arguments.sheet_columns == 0) {
        if (cameras.size() == 1) return {};
        return Error{arguments.output + ": " + std::to_string(cameras.size()) +
                     " views do not fit in one image; use --sheet COLUMNS, or give a folder or an .mp4 to -o"};
    }
    const auto columns = std::min(static_cast<std::size_t>(arguments.sheet_columns), cameras.size());
    const std::size_t rows = (cameras.size() + columns - 1) / columns;
    const std::size_t width = columns * static_cast<std::size_t>(cameras.front().width);
    const std::size_t height = rows * static_cast<std::size_t>(cameras.front().height);
    if (width > kMaxImageSide_px || height > kMaxImageSide_px) {
        return Error{arguments.output + ": a sheet of " + std::to_string(width) + "x" + std::to_string(height) +
                     " pixels is larger than " + std::to_string(kMaxImageSide_px) + " a side; give a smaller --size"};
    }
    for (const Camera& camera : cameras) {
        if (camera.width != cameras.front().width || camera.height != cameras.front().height) {
            return Error{arguments.output + ": a sheet needs views of the same size; use --size"};
        }
    }
    return {};
}

Status write_image(const Renderer& renderer, const std::vector<Camera>& cameras, const RenderArguments& arguments,
                   EmptyViews& empty) {
    RS_TRY(check_one_image(cameras, arguments));
    if (arguments.depth)
        return write_view_with_depth(renderer, cameras.front(), arguments.filter, arguments.output, empty);
    std::vector<Image<Rgba8>> images;
    for (const Camera& camera : cameras) {
        RS_ASSIGN_OR_RETURN(Image<Rgba8> image, render_camera(renderer, camera, arguments.filter, empty));
        images.push_back(std::move(image));
    }
    if (arguments.sheet_columns == 0) return write_png(arguments.output, images.front());
    constexpr Rgba8 kBackdrop{96, 98, 102, 255};
    return write_png(arguments.output, contact_sheet(images, arguments.sheet_columns, kBackdrop));
}

Status write_views(OutputKind kind, const Renderer& renderer, const std::vector<Camera>& cameras,
                   const RenderArguments& arguments, EmptyViews& empty, Progress& progress) {
    switch (kind) {
        case OutputKind::image:
            return write_image(renderer, cameras, arguments, empty);
        case OutputKind::video:
            progress.start("rendering", static_cast<std::int64_t>(cameras.size()));
            return write_view_video(
                arguments.output, arguments.frames_per_second, cameras,
                [&](const Camera& camera) { return render_camera(renderer, camera, arguments.filter, empty); },
                progress);
        case OutputKind::folder:
            break;
    }
    return write_folder(renderer, cameras, arguments, empty, progress);
}

Status run_render(const RenderArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const OutputKind kind, output_kind(arguments.output));
    if (arguments.sheet_columns > 0 && kind != OutputKind::image) {
        return Error{arguments.output + ": --sheet writes one image; give a name that ends in .png to -o"};
    }
    if (arguments.depth && (kind == OutputKind::video || arguments.sheet_columns > 0)) {
        return Error{arguments.output +
                     ": --depth cannot be written with a video or a sheet; give a folder or one view's FILE.png to -o, "
                     "or leave out --depth"};
    }
    RS_TRY(refuse_overwriting_inputs(arguments.output, {arguments.object, arguments.views.poses}));
    RS_ASSIGN_OR_RETURN(const Renderer renderer, open_renderer(arguments.object, arguments.level));
    RS_ASSIGN_OR_RETURN(std::vector<Camera> cameras, requested_cameras(renderer.object(), arguments.views));
    if (arguments.sheet_columns > 0 && arguments.views.size.empty()) {
        fit_on_sheet(cameras, static_cast<std::size_t>(arguments.sheet_columns));
    }

    ProgressBar progress(arguments.quiet);
    EmptyViews empty;
    Status status = write_views(kind, renderer, cameras, arguments, empty, progress);
    progress.finish();
    if (status) empty.warn();
    return status;
}

}  // namespace

void add_render_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "Render views of an object: PNG with straight alpha, or a video");
    command->add_option("OBJECT", arguments->object, "ray-space object, .rso")->required();
    command->add_option("-o,--output", arguments->output, "output: a folder, FILE.png or FILE.mp4")->required();
    add_view_options(*command, arguments->views);
    command->add_option("--fps", arguments->frames_per_second, "frames per second of an .mp4")
        ->check(CLI::Range(1.0, 240.0))
        ->capture_default_str();
    command
        ->add_option(
            "--sheet", arguments->sheet_columns,
            "with FILE.png: write all views as one contact sheet with this many columns; at most 4096 pixels a "
            "side unless --size is given")
        ->check(CLI::Range(1, 100));
    command->add_option("--level", arguments->level, "load only every 8th (0), 4th (1), 2nd (2) photo, or all (3)")
        ->check(CLI::Range(0, kProgressiveLevels - 1))
        ->capture_default_str();
    command->add_flag("--depth", arguments->depth,
                      "also write NAME.depth.exr for each image: axial depth in the units of the object's rig, 0 where "
                      "alpha is 0");
    static const std::map<std::string, std::optional<TexelFilter>> kFilters = {
        {"auto", std::nullopt},
        {"bilinear", TexelFilter::kBilinear},
        {"sharp", TexelFilter::kSharp},
        {"smooth", TexelFilter::kSmooth},
    };
    command
        ->add_option_function<std::string>(
            "--filter", [arguments](const std::string& name) { arguments->filter = kFilters.at(name); },
            "sampling of the photos of an object with a shape map: sharp, smooth (for views smaller than the photos), "
            "bilinear (as the boards do), or auto (by the scale of the view)")
        ->check(CLI::IsMember(kFilters))
        ->default_str("auto");
    command->add_flag("--force", arguments->force, kForceHelp);
    command->add_flag("-q,--quiet", arguments->quiet, "no progress bar");
    command->footer(
        "Examples:\n  rs-engine render vase.rso --orbit 120 -o vase.mp4\n"
        "  rs-engine render vase.rso --orbit 12 --sheet 4 --size 256x256 -o sheet.png\n"
        "  rs-engine render vase.rso --eye 3,0.5,2 --size 800x800 -o view.png\n"
        "  rs-engine render vase.rso --poses held-out/transforms.json -o rendered");
    command->callback([arguments, &run] { run = [arguments] { return run_render(*arguments); }; });
}

}  // namespace rs::engine
