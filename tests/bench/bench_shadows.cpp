// Cost of shadows: a walk of a few steps at viewpoints of a scene. Each frame is drawn alternately without and with
// shadows, so that other load on the machine affects both alike. Times include reading back the image.
//
//     bench_shadows showroom.wrl --viewpoint shop --viewpoint museum
//
// "cpu" is the CPU time per frame, summed over all threads: divided by the number of cores, a lower bound of the frame
// time on an idle machine. "first" is the frame that draws the maps.

#include "compositor/gl/context.hpp"
#include "compositor/scene/light/lights_file.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace rs::bench {
namespace {

struct Options {
    std::string scene;
    std::vector<std::string> viewpoints;
    std::string lights;
    int frames = 40;
    int samples = 1;
    std::string size = "1280x720";
};

struct Times {
    std::vector<double> frame_ms;
    std::vector<double> cpu_ms;
    double first_ms = 0;
};

Status draw(compositor::FrameCompositor& frames, const Camera& camera, int number, Times& times) {
    const Stopwatch watch;
    if (const Status status = frames.draw(camera); !status) return status;
    if (frames.image().empty()) return Error{"an empty image was read back"};
    const double frame_ms = watch.wall_ms();
    if (number == 0) times.first_ms = frame_ms;
    if (number < 3) return {};  // to warm up
    times.frame_ms.push_back(frame_ms);
    times.cpu_ms.push_back(watch.cpu_ms());
    return {};
}

Status run_at(const compositor::Scene& scene, compositor::Showroom& showroom, const compositor::Viewpoint& viewpoint,
              PixelSize size, const Options& options) {
    std::vector<compositor::FrameCompositor> both;
    for (const bool shadows : {false, true}) {
        auto frames = compositor::FrameCompositor::create(scene, showroom.engine(), showroom.nodes(),
                                                          {.width = size.width,
                                                           .height = size.height,
                                                           .samples = options.samples,
                                                           .shadows = shadows,
                                                           .upright_images = true});
        if (!frames) return frames.error();
        both.push_back(std::move(*frames));
    }
    std::array<Times, 2> times;
    for (int n = 0; n < options.frames + 3; ++n) {
        Camera camera = camera_at(viewpoint, size.width, size.height);
        camera.world_from_camera[3] += glm::dvec4(0.05 * std::sin(0.4 * n) * camera.right(), 0);
        for (std::size_t i = 0; i < 2; ++i) {
            if (const Status status = draw(both[i], camera, n, times[i]); !status) return status;
        }
    }
    const double off = median(times[0].cpu_ms);
    const double on = median(times[1].cpu_ms);
    const double processors = std::max(std::thread::hardware_concurrency(), 1U);
    std::printf("%-12s %8.1f %8.1f %8.1f %8.1f %6.2f %10.1f %9.0f\n", viewpoint.description.c_str(),
                median(times[0].frame_ms), median(times[1].frame_ms), off, on, on / off, 1e3 * processors / on,
                times[1].first_ms);
    return {};
}

Status run(const Options& options) {
    const Result<PixelSize> size = parse_size(options.size);
    if (!size) return size.error();
    auto scene = compositor::read_scene(options.scene);
    if (!scene) return scene.error();
    if (!options.lights.empty()) {
        auto list = compositor::read_light_list(options.lights);
        if (!list) return list.error();
        if (list->replace) {
            scene->lights.clear();
            for (compositor::GeometryNode& node : scene->geometry) node.lights.clear();
        }
        scene->lights.insert(scene->lights.end(), list->lights.begin(), list->lights.end());
    }
    auto context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    compositor::Showroom showroom(*scene, {.waits = true});
    if (const Status status = showroom.wait_for_all({0, 0, 0}); !status) return status.error();
    std::printf("%s, %s, %d samples a pixel, medians of %d frames in ms\n", context->device_name().c_str(),
                options.size.c_str(), options.samples, options.frames);
    std::printf("viewpoint         off       on  off cpu   on cpu  ratio  on at best     first\n");
    for (const compositor::Viewpoint& viewpoint : scene->viewpoints) {
        const bool asked = options.viewpoints.empty() ||
                           std::ranges::find(options.viewpoints, viewpoint.description) != options.viewpoints.end();
        if (!asked) continue;
        if (const Status status = run_at(*scene, showroom, viewpoint, *size, options); !status) return status;
    }
    return {};
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    rs::bench::Options options;
    CLI::App app("Cost of shadows in a scene: frames alternately without and with them.", "bench_shadows");
    app.add_option("SCENE", options.scene, "scene, as for rs-view")->required();
    app.add_option("--viewpoint", options.viewpoints, "descriptions of viewpoints (default: all)");
    app.add_option("--lights", options.lights, "list of lights, as for rs-view");
    app.add_option("--frames", options.frames, "frames per viewpoint")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    app.add_option("--samples", options.samples, "samples per pixel")->capture_default_str()->check(CLI::Range(1, 16));
    app.add_option("--size", options.size, "frame size, WxH")->capture_default_str();
    app.footer("Example:\n  bench_shadows showroom.wrl --viewpoint shop --viewpoint museum");
    std::function<rs::Status()> run = [&] { return rs::bench::run(options); };
    return rs::tool_main(app, argc, argv, run);
}
