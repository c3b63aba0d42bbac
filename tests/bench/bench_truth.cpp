// Compares the viewer's frames of the showroom with ground truth, traced with the objects' meshes in the same rooms
// (tests/compositor/truth_image.hpp).
//
//     bench_truth --objects FOLDER [--size 960x540] [--samples 16] [-o IMAGES]
//
// Objects that are missing in FOLDER are captured and encoded first, as with rs-capture and rs-encode (15 minutes on
// two cores). Prints a row per viewpoint. With -o, frame, truth and difference times 8 are written side by side.

#include "compositor/gl/context.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"
#include "tests/compositor/truth_comparison.hpp"
#include "tests/compositor/truth_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace rs::test {
namespace {

struct Arguments {
    std::string objects;
    std::string output;
    std::string size = "960x540";
    TruthOptions truth;
    compositor::FrameOptions frame;
    std::vector<int> only;
};

// Frame, truth, and their difference around mid-grey.
Image<Rgba8> side_by_side(const TruthDifference& difference) {
    const Image<Rgba8>& frame = difference.frame;
    const Image<Rgba8>& truth = difference.truth.image;
    Image<Rgba8> sheet(frame.width() * 3, frame.height());
    const auto amplified = [](int a, int b) {
        return static_cast<std::uint8_t>(std::clamp(128 + 8 * (a - b), 0, 255));
    };
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
            const Rgba8 a = frame(x, y);
            const Rgba8 b = truth(x, y);
            sheet(x, y) = a;
            sheet(x + frame.width(), y) = b;
            sheet(x + 2 * frame.width(), y) = {amplified(a.r, b.r), amplified(a.g, b.g), amplified(a.b, b.b), 255};
        }
    }
    return sheet;
}

// Mean frame times of the walk.
Status print_costs(const compositor::Scene& scene, const std::vector<compositor::PlacedObject>& placed,
                   PixelSize size) {
    struct Way {
        const char* name;
        compositor::ObjectDepth depth;
        int samples;
    };
    std::printf("\n%-28s %9s %9s %9s %12s\n", "ms per frame", "whole", "engine", "upload", "pixels");
    for (const Way& way : {Way{"plane, one sample", compositor::ObjectDepth::kPlane, 1},
                           {"plane", compositor::ObjectDepth::kPlane, compositor::kDefaultSamplesAcross},
                           {"pixel", compositor::ObjectDepth::kPixel, compositor::kDefaultSamplesAcross}}) {
        auto frames = compositor::FrameCompositor::create(scene, placed,
                                                          {.width = size.width,
                                                           .height = size.height,
                                                           .object_depth = way.depth,
                                                           .object_samples = way.samples,
                                                           .time_parts = true});
        if (!frames) return frames.error();
        constexpr int kTimes = 3;
        double whole_s = 0;
        double engine_s = 0;
        double upload_s = 0;
        std::int64_t pixels = 0;
        int count = 0;
        for (int i = -1; i < kTimes; ++i) {
            for (const TruthViewpoint& viewpoint : truth_walk(size.width, size.height)) {
                const bench::Stopwatch watch;
                if (Status drawn = frames->draw(viewpoint.camera); !drawn) return drawn;
                if (i < 0) continue;  // the first walk fills caches
                whole_s += watch.wall_s();
                engine_s += frames->statistics().engine_s;
                upload_s += frames->statistics().upload_s;
                pixels += frames->statistics().pixels_rendered;
                ++count;
            }
        }
        std::printf("%-28s %9.2f %9.2f %9.2f %12lld\n", way.name, 1e3 * whole_s / count, 1e3 * engine_s / count,
                    1e3 * upload_s / count, static_cast<long long>(pixels / count));
    }
    return {};
}

Status run_bench(Arguments arguments) {
    const Result<PixelSize> size = parse_size(arguments.size);
    if (!size) return size.error();
    const Result<gl::Context> context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    const std::filesystem::path folder = arguments.objects;
    std::filesystem::create_directories(folder);
    for (const std::string& name : truth_object_names()) {
        if (std::filesystem::exists(folder / (name + ".rso"))) continue;
        Result<capture::SceneFile> object = object_of_recipe(name);
        if (!object) return object.error();
        ProgressBar bar(false);
        if (Status made = write_captured_object(name, std::move(*object), {}, folder, &bar); !made) return made.error();
    }
    Result<compositor::Scene> scene = write_truth_room(folder);
    if (!scene) return scene.error();
    const auto placed = read_placed_objects(*scene);
    if (!placed) return placed.error();
    for (const std::string& warning : scene->warnings) std::fprintf(stderr, "%s\n", warning.c_str());
    std::vector<TracedNode> traced;
    for (std::size_t i = 0; i < placed->size(); ++i) {
        Result<capture::SceneFile> recipe = object_of_recipe(scene->objects[i].file.stem().string());
        if (!recipe) return recipe.error();
        auto object = traced_object(std::move(*recipe));
        if (!object) return object.error();
        const double foot = static_cast<double>((*object)->rays().lower().y) / (*object)->object_radius();
        std::fprintf(stderr, "%s: foot %.3f radii below its centre, estimated as %.3f\n",
                     scene->objects[i].file.stem().c_str(), -foot, -(*placed)[i].object->extent.bottom);
        traced.push_back({std::move(*object), (*placed)[i].world_from_object});
    }
    arguments.frame.width = size->width;
    arguments.frame.height = size->height;
    auto comparison = TruthComparison::create(*scene, *placed, traced, arguments.frame);
    if (!comparison) return comparison.error();

    std::printf("%-20s %8s %10s %8s %9s %6s %8s %8s %8s %7s\n", "viewpoint", "objects", "elsewhere", "alone", "share",
                "cuts", "mean px", "99% px", "most px", "s");
    int number = 0;
    for (const TruthViewpoint& viewpoint : truth_walk(size->width, size->height)) {
        ++number;
        if (!arguments.only.empty() &&
            std::find(arguments.only.begin(), arguments.only.end(), number) == arguments.only.end()) {
            continue;
        }
        const bench::Stopwatch watch;
        const Result<TruthDifference> difference = comparison->compare(viewpoint.camera, arguments.truth);
        if (!difference) return difference.error();
        const EdgeDistances& cuts = difference->cuts;
        std::printf("%-20s %8.2f %10.2f %8.2f %8.1f%% %6d %8.2f %8.2f %8.2f %7.1f\n", viewpoint.what.c_str(),
                    difference->objects_db, difference->elsewhere_db, difference->alone_db,
                    100 * difference->object_share, cuts.places, cuts.mean_px, cuts.within_px, cuts.largest_px,
                    watch.wall_s());
        std::fflush(stdout);
        if (arguments.output.empty()) continue;
        std::filesystem::create_directories(arguments.output);
        const auto file = std::filesystem::path(arguments.output) / ("view" + std::to_string(number) + ".png");
        if (Status written = write_png(file, side_by_side(*difference)); !written) return written;
    }
    return print_costs(*scene, *placed, *size);
}

}  // namespace
}  // namespace rs::test

int main(int argc, char** argv) {
    CLI::App app("Composited frames against the same scene traced with the objects' meshes", "bench_truth");
    rs::test::Arguments arguments;
    app.add_option("--objects", arguments.objects, "folder of the objects; missing ones are captured first")
        ->required();
    app.add_option("-o,--output", arguments.output, "folder for frame, truth and difference of every viewpoint");
    app.add_option("--size", arguments.size, "frame size, WxH")->capture_default_str();
    app.add_flag_callback(
        "--pixel-depth", [&] { arguments.frame.object_depth = rs::compositor::ObjectDepth::kPixel; },
        "draw objects with per-pixel depth");
    app.add_option("--object-samples", arguments.frame.object_samples,
                   "maximum samples across a pixel for distant objects")
        ->capture_default_str();
    app.add_flag("--upright", arguments.frame.upright_images, "render objects with upright cameras");
    app.add_option("--samples", arguments.truth.samples, "samples per pixel of the truth")->capture_default_str();
    app.add_option("--paths", arguments.truth.paths_per_sample, "paths per sample that hits an object")
        ->capture_default_str();
    app.add_option("--only", arguments.only, "numbers of viewpoints, from 1");
    app.footer("Example: bench_truth --objects objects -o images");
    std::function<rs::Status()> run;
    app.callback([&] { run = [&] { return rs::test::run_bench(arguments); }; });
    return rs::tool_main(app, argc, argv, run);
}
