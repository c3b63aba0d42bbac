// Frame times of displays: three upright walls of 3 m for two eyes, and a quilt compared with the same views drawn
// separately. Drawn without a window; times include reading back each image.
//
//     bench_walls demo-out/showroom/showroom.wrl --viewpoint shop
//     bench_walls --object demo-out/vase.rso
//
// "cpu" is the CPU time per frame, summed over all threads: divided by the number of cores, a lower bound of the frame
// time on an idle machine.

#include "compositor/displays/quilt.hpp"
#include "compositor/displays/walls_file.hpp"
#include "compositor/gl/context.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace rs::bench {
namespace {

using namespace compositor;

struct Options {
    std::string scene;
    std::string object;
    std::string viewpoint;
    int side = 512;
    int frames = 10;
    int samples = 4;
};

Result<FrameCompositor> create_compositor(const Scene& scene, Showroom& showroom, int width, int height, int samples) {
    return FrameCompositor::create(scene, showroom.engine(), showroom.nodes(),
                                   {.width = width, .height = height, .samples = samples});
}

Status bench_walls(const Scene& scene, Showroom& showroom, const Camera& visitor, const Options& options) {
    WallDisplay cave = *preset_display("cave");
    RS_TRY(select_walls(cave, "left,front,right"));
    for (Wall& wall : cave.walls) wall.width = wall.height = options.side;
    const RoomPose place = place_of(visitor, cave.head, 1);
    RS_ASSIGN_OR_RETURN(auto frames, create_compositor(scene, showroom, options.side, options.side, options.samples));
    std::vector<double> wall_ms, cpu_ms;
    for (int frame = 0; frame <= options.frames; ++frame) {
        const Stopwatch watch;
        Head head = cave.head;
        head.position.x += 0.01 * frame;
        for (const Wall& wall : cave.walls) {
            for (const double offset : {-0.0325, 0.0325}) {
                RS_ASSIGN_OR_RETURN(const Camera camera, wall_camera(wall, head.eye(offset), place));
                RS_TRY(frames.compose(camera));
            }
        }
        if (frame == 0) continue;  // the first one warms up
        wall_ms.push_back(watch.wall_ms());
        cpu_ms.push_back(watch.cpu_ms());
    }
    std::printf("three walls x two eyes, %dx%d: %.0f ms per frame (%.1f frames/s), cpu %.0f ms\n", options.side,
                options.side, median(wall_ms), 1e3 / median(wall_ms), median(cpu_ms));
    return {};
}

Status bench_quilt(const Scene& scene, Showroom& showroom, const Camera& middle, double focus, const Options& options) {
    const QuiltLayout layout{5, 9, middle.width, middle.height};
    const std::vector<Camera> cameras = quilt_cameras(middle, layout, radians(40), focus);
    RS_ASSIGN_OR_RETURN(auto frames, create_compositor(scene, showroom, middle.width, middle.height, options.samples));
    RS_TRY(frames.compose(middle));
    std::vector<Image<Rgba8>> alone;
    double single_ms = 0, quilt_ms = 0, single_cpu = 0, quilt_cpu = 0;
    bool equal = true;
    for (int round = 0; round < 3; ++round) {
        alone.clear();
        const Stopwatch alone_watch;
        for (const Camera& camera : cameras) {
            RS_ASSIGN_OR_RETURN(auto image, frames.compose(camera));
            alone.push_back(std::move(image));
        }
        single_ms += alone_watch.wall_ms();
        single_cpu += alone_watch.cpu_ms();
        const Stopwatch quilt_watch;
        Image<Rgba8> quilt(layout.width(), layout.height());
        for (int view = 0; view < layout.views(); ++view) {
            RS_ASSIGN_OR_RETURN(auto image, frames.compose(cameras[static_cast<std::size_t>(view)]));
            place_tile(layout, view, image, quilt);
        }
        quilt_ms += quilt_watch.wall_ms();
        quilt_cpu += quilt_watch.cpu_ms();
        for (int view = 0; view < layout.views(); ++view) {
            const Image<Rgba8>& one = alone[static_cast<std::size_t>(view)];
            const auto tile =
                quilt.view().crop(view % layout.columns * one.width(),
                                  (layout.rows - 1 - view / layout.columns) * one.height(), one.width(), one.height());
            for (int y = 0; y < one.height(); ++y) {
                for (int x = 0; x < one.width(); ++x) equal = equal && one(x, y) == tile(x, y);
            }
        }
    }
    std::printf(
        "quilt of 45 views of %dx%d: %.2f times the time of 45 separate views (cpu %.2f), %.0f ms per view; %s\n",
        middle.width, middle.height, quilt_ms / single_ms, quilt_cpu / single_cpu, single_ms / 3 / 45,
        equal ? "all equal" : "NOT EQUAL");
    return {};
}

Status run(const Options& options) {
    Scene scene;
    scene.floor = Floor{};
    if (!options.scene.empty()) {
        RS_ASSIGN_OR_RETURN(scene, read_scene(options.scene));
    }
    if (!options.object.empty()) {
        RS_ASSIGN_OR_RETURN(RaySpaceNode node, parse_object_argument(options.object, {0, 0, 0}));
        scene.objects.push_back(std::move(node));
    }
    Showroom showroom(scene, {.waits = true});
    RS_TRY(showroom.wait_for_all({0, 0, 0}));
    constexpr int kTileWidth = 420, kTileHeight = 560;
    CameraPose pose = framing_pose(showroom.placed(), radians(50), static_cast<double>(kTileWidth) / kTileHeight);
    Camera visitor = look_at_camera(pose.eye, pose.at, radians(50), kTileWidth, kTileHeight);
    for (const Viewpoint& viewpoint : scene.viewpoints) {
        if (viewpoint.description == options.viewpoint) visitor = camera_at(viewpoint, kTileWidth, kTileHeight);
    }
    RS_TRY(showroom.update(visitor.centre(), 0));
    RS_ASSIGN_OR_RETURN(const gl::Context context, gl::Context::create_surfaceless());
    RS_TRY(bench_walls(scene, showroom, visitor, options));
    const double focus =
        std::max(glm::dot(bounds_from(scene, 0, 0).middle() - visitor.centre(), visitor.forward()), 1.0);
    return bench_quilt(scene, showroom, visitor, focus, options);
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    CLI::App app("Frame times of walls and quilts.", "bench_walls");
    rs::bench::Options options;
    app.add_option("SCENE", options.scene, "scene; without it, a floor");
    app.add_option("--object", options.object, "FILE.rso to place in the scene");
    app.add_option("--viewpoint", options.viewpoint, "viewpoint of the scene");
    app.add_option("--side", options.side, "width and height of a wall, px")->check(CLI::Range(16, 4096));
    app.add_option("--frames", options.frames, "frames whose median is printed")->check(CLI::Range(1, 1000));
    app.add_option("--samples", options.samples, "samples per pixel")->check(CLI::Range(1, 16));
    std::function<rs::Status()> run;
    app.callback([&] { run = [&] { return rs::bench::run(options); }; });
    return rs::tool_main(app, argc, argv, run);
}
