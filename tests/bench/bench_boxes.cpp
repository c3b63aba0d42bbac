// Instant radiosity against path tracing in the four Cornell boxes of the McGuire archive.
//
//     bench_boxes FOLDER [--size PX] [--passes N] [--paths N] [--only NAME]
//
// FOLDER holds CornellBox-Original.obj, -Sphere, -Glossy and -Mirror. Prints for each box the mean
// luminance of both images, their ratio, and the RMS difference relative to the mean. The same numbers for a second
// path-traced image of as many samples show the noise: twice the variance of the reference.

#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/scene/mesh_file.hpp"
#include "rayspace/light/directions.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

namespace rs::capture {
namespace {

struct Arguments {
    std::filesystem::path folder;
    std::string only;
    int side_px = 64;
    int passes = 4096;
    int paths = 16384;
};

struct Difference {
    double ratio, relative_rmse;
};

Difference compare(const Image<RgbaF>& found, const Image<RgbaF>& reference) {
    double sum = 0, reference_sum = 0, squares = 0;
    for (int y = 0; y < reference.height(); ++y) {
        for (int x = 0; x < reference.width(); ++x) {
            const RgbaF &p = found(x, y), &r = reference(x, y);
            const double a = static_cast<double>(luminance({p.r, p.g, p.b}) * p.a);
            const double b = static_cast<double>(luminance({r.r, r.g, r.b}) * r.a);
            sum += a;
            reference_sum += b;
            squares += (a - b) * (a - b);
        }
    }
    const double pixels = static_cast<double>(reference.width()) * reference.height();
    return {sum / reference_sum, std::sqrt(squares / pixels) / (reference_sum / pixels)};
}

Status run(const Arguments& arguments) {
    ProgressBar progress(false);
    for (const char* name : {"Original", "Sphere", "Glossy", "Mirror"}) {
        if (!arguments.only.empty() && arguments.only != name) continue;
        Result<Scene> scene = read_mesh_file(arguments.folder / (std::string("CornellBox-") + name + ".obj"));
        if (!scene) return scene.error();
        const auto tracer = Tracer::create(std::move(*scene));
        if (!tracer) return tracer.error();
        const Camera camera = look_at_camera({0, 1, 3.4}, {0, 1, 0}, radians(39), arguments.side_px, arguments.side_px);
        RenderOptions options;
        options.samples_per_pixel = arguments.paths;
        const auto image = [&](const char* what) {
            progress.start(what, Tracer::step_count(camera));
            Image<RgbaF> found = tracer->render(camera, options, &progress).image;
            progress.finish();
            return found;
        };
        const Image<RgbaF> reference = image("paths");
        options.seed = 2;
        const Difference noise = compare(image("paths again"), reference);
        options.method = RenderMethod::kRadiosity;
        options.samples_per_pixel = arguments.passes;
        const Difference radiosity = compare(image("radiosity"), reference);
        std::printf("%-10s means %7.4f  relative RMSE %6.3f %%   (paths again: %7.4f, %6.3f %%)\n", name,
                    radiosity.ratio, 100 * radiosity.relative_rmse, noise.ratio, 100 * noise.relative_rmse);
        std::fflush(stdout);
    }
    return {};
}

}  // namespace
}  // namespace rs::capture

int main(int argc, char** argv) {
    CLI::App app("Instant radiosity against path tracing in Cornell boxes", "bench_boxes");
    rs::capture::Arguments arguments;
    app.add_option("folder", arguments.folder, "folder of the boxes")->required();
    app.add_option("--only", arguments.only, "one box: Original, Sphere, Glossy or Mirror");
    app.add_option("--size", arguments.side_px, "width and height of the images, px")->capture_default_str();
    app.add_option("--passes", arguments.passes, "passes of radiosity")->capture_default_str();
    app.add_option("--paths", arguments.paths, "paths per pixel")->capture_default_str();
    std::function<rs::Status()> action;
    app.callback([&] { action = [&] { return rs::capture::run(arguments); }; });
    return rs::tool_main(app, argc, argv, action);
}
