// Cost of shadows: a walk of a few steps at viewpoints of a scene. Each frame is drawn alternately without and with
// shadows, so that other load on the machine affects both alike. Times include reading back the image.
//
//     bench_shadows showroom.wrl --viewpoint shop --viewpoint museum
//
// "cpu" is the CPU time per frame, summed over all threads: divided by the number of cores, a lower bound of the frame
// time on an idle machine. "first" is the frame that draws the maps.
//
//     bench_shadows street.obj --agreement --lights lights.json --eye=-19,1.9,6 --at=5,2,-2
//
// Share of pixels in which raster and traced (Whitted) shadows of the brightest directional light agree. Geometry
// alone, matte, without other light; pixels within 1.5 pixels of an edge of the traced shadow or of a lit surface are
// skipped.

#include "compositor/gl/context.hpp"
#include "compositor/scene/light/lights_file.hpp"
#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"
#include "tests/compositor/viewer/shadows/shadow_scene.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
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
    bool agreement = false;
    std::vector<double> eye;
    std::vector<double> at;
    double fov_deg = 65;
};

struct Times {
    std::vector<double> frame_ms;
    std::vector<double> cpu_ms;
    double first_ms = 0;
};

Status draw(compositor::FrameCompositor& frames, const Camera& camera, int number, Times& times) {
    const Stopwatch watch;
    RS_TRY(frames.draw(camera));
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
        RS_ASSIGN_OR_RETURN(auto frames, compositor::FrameCompositor::create(scene, showroom.engine(), showroom.nodes(),
                                                                             {.width = size.width,
                                                                              .height = size.height,
                                                                              .samples = options.samples,
                                                                              .shadows = shadows,
                                                                              .upright_images = true}));
        both.push_back(std::move(frames));
    }
    std::array<Times, 2> times;
    for (int n = 0; n < options.frames + 3; ++n) {
        Camera camera = camera_at(viewpoint, size.width, size.height);
        camera.world_from_camera[3] += glm::dvec4(0.05 * std::sin(0.4 * n) * camera.right(), 0);
        for (std::size_t i = 0; i < 2; ++i) {
            RS_TRY(draw(both[i], camera, n, times[i]));
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

// The directional lights with shadows; of those without scope only the brightest. No node has two.
std::vector<std::uint32_t> key_lights(const compositor::Scene& scene) {
    const std::vector<bool> casts = compositor::lights_with_shadows(scene);
    std::vector<std::uint32_t> keys;
    std::optional<std::uint32_t> brightest;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.kind != LightKind::kDirectional || !casts[i]) continue;
        if (!light.everywhere) {
            keys.push_back(i);
        } else if (!brightest || luminance(light.colour) > luminance(scene.lights[*brightest].colour)) {
            brightest = i;
        }
    }
    if (brightest) keys.push_back(*brightest);
    return keys;
}

compositor::Material matte(const compositor::Material& material) {
    compositor::Material matte;
    matte.diffuse = glm::vec3(0.9F);
    matte.ambient = 0;
    if (material.texture && compositor::alpha_use(*material.texture) == compositor::AlphaUse::kMask) {
        matte.texture = material.texture;
        matte.texture_transform = material.texture_transform;
    }
    return matte;
}

// The scene's opaque geometry, matte, under this light alone.
compositor::Scene scene_of_light(const compositor::Scene& scene, std::uint32_t light) {
    compositor::Scene reduced;
    reduced.navigation = scene.navigation;
    reduced.navigation.headlight = false;
    reduced.lights = {directional_light(scene.lights[light].towards, glm::vec3(2))};
    reduced.lights[0].everywhere = scene.lights[light].everywhere;
    for (compositor::GeometryNode node : scene.geometry) {
        if (!compositor::casts_shadows(node)) continue;
        const bool lit = std::ranges::find(node.lights, light) != node.lights.end();
        node.lights = lit ? std::vector<std::uint32_t>{0} : std::vector<std::uint32_t>{};
        node.material = matte(node.material);
        reduced.geometry.push_back(std::move(node));
    }
    return reduced;
}

Status compare_at(const compositor::Scene& scene, const compositor::Viewpoint& viewpoint, PixelSize size) {
    test::ShadowAgreement all;
    for (const std::uint32_t light : key_lights(scene)) {
        const test::ShadowAgreement found =
            test::shadow_agreement(scene_of_light(scene, light), {}, camera_at(viewpoint, size.width, size.height));
        all.compared += found.compared;
        all.alike += found.alike;
        all.shaded += found.shaded;
    }
    if (all.compared == 0) return Error{viewpoint.description + ": no directional light reaches a surface in view"};
    std::printf("%-12s %8.2f %% of %d pixels agree, %.1f %% of them in shadow\n", viewpoint.description.c_str(),
                100 * all.share(), all.compared, 100.0 * all.shaded / all.compared);
    return {};
}

// Those selected by options.
std::vector<compositor::Viewpoint> selected_viewpoints(const compositor::Scene& scene, PixelSize size,
                                                       const Options& options) {
    std::vector<compositor::Viewpoint> selected;
    for (const compositor::Viewpoint& viewpoint : scene.viewpoints) {
        if (std::ranges::find(options.viewpoints, viewpoint.description) != options.viewpoints.end() ||
            (options.viewpoints.empty() && options.eye.empty())) {
            selected.push_back(viewpoint);
        }
    }
    if (options.eye.empty()) return selected;
    const glm::dvec3 eye(options.eye[0], options.eye[1], options.eye[2]);
    const glm::dvec3 at(options.at[0], options.at[1], options.at[2]);
    selected.push_back(
        compositor::viewpoint_of(look_at_camera(eye, at, radians(options.fov_deg), size.width, size.height)));
    selected.back().description = "eye";
    return selected;
}

Status run(const Options& options) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(auto scene, compositor::read_scene(options.scene));
    if (!options.lights.empty()) {
        RS_ASSIGN_OR_RETURN(auto list, compositor::read_light_list(options.lights));
        if (list.replace) {
            scene.lights.clear();
            for (compositor::GeometryNode& node : scene.geometry) node.lights.clear();
        }
        scene.lights.insert(scene.lights.end(), list.lights.begin(), list.lights.end());
    }
    RS_ASSIGN_OR_RETURN(auto context, gl::Context::create_surfaceless());
    const std::vector<compositor::Viewpoint> viewpoints = selected_viewpoints(scene, size, options);
    if (options.agreement) {
        for (const compositor::Viewpoint& viewpoint : viewpoints) RS_TRY(compare_at(scene, viewpoint, size));
        return {};
    }
    compositor::Showroom showroom(scene, {.waits = true});
    RS_TRY(showroom.wait_for_all({0, 0, 0}));
    std::printf("%s, %s, %d samples a pixel, medians of %d frames in ms\n", context.device_name().c_str(),
                options.size.c_str(), options.samples, options.frames);
    std::printf("viewpoint         off       on  off cpu   on cpu  ratio  on at best     first\n");
    for (const compositor::Viewpoint& viewpoint : viewpoints) {
        RS_TRY(run_at(scene, showroom, viewpoint, size, options));
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
    app.add_flag("--agreement", options.agreement, "share of pixels that agree with traced shadows, in place of times");
    auto* eye =
        app.add_option("--eye", options.eye, "X,Y,Z: a viewpoint besides the scene's")->delimiter(',')->expected(3);
    auto* at = app.add_option("--at", options.at, "X,Y,Z: point that it looks at")->delimiter(',')->expected(3);
    eye->needs(at);
    at->needs(eye);
    app.add_option("--fov", options.fov_deg, "its horizontal field of view, degrees")
        ->capture_default_str()
        ->check(CLI::Range(1, 150));
    app.footer("Example:\n  bench_shadows showroom.wrl --viewpoint shop --viewpoint museum");
    std::function<rs::Status()> run = [&] { return rs::bench::run(options); };
    return rs::tool_main(app, argc, argv, run);
}
