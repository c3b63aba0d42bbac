// Latency of traced images: after switching to a tracing renderer, and after camera moves.
//
//     bench_refine SCENE --eye X,Y,Z --at X,Y,Z [--fov DEG] [--size WxH] [--lights L.json] [--exposure EV]
//                  [--moves N] [--still S]
//
// Prints the construction time of the tracer and, for each method, the milliseconds from the request of a view to its
// first image: for the very first view, after moves with pauses of S seconds, and while the camera moves continuously.
// Also prints the number of cells along a row of the first images, and the time to draw one into the frame. Wall-clock
// times: nothing else should run on the machine.

#include "compositor/gl/context.hpp"
#include "compositor/traced/refinement.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/base/median.hpp"
#include "tests/bench/lit_scene.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

namespace rs::compositor {
namespace {

struct Arguments {
    LitSceneArguments lit{"1280x720"};
    int moves = 12;
    double still_s = 2;
};

using WallClock = std::chrono::steady_clock;
double ms_since(WallClock::time_point begin) {
    return std::chrono::duration<double, std::milli>(WallClock::now() - begin).count();
}

// Number of cells along a row, from colour changes between neighbours. The row with the most changes counts, since
// adjacent cells may have equal colours.
int cells_of(const Image<Rgba8>& image) {
    int most = 0;
    for (int y = 0; y < image.height(); ++y) {
        int cells = 1;
        for (int x = 1; x < image.width(); ++x) cells += image(x, y) != image(x - 1, y);
        most = std::max(most, cells);
    }
    return most;
}

struct First {
    double ms;
    int cells;
    std::shared_ptr<const Image<Rgba8>> image;
};

// First image of the view requested at `begin`.
First wait_for_first(Refinement& refinement, const Camera& camera, WallClock::time_point begin) {
    for (;;) {
        const auto step = refinement.take();
        if (step && step->camera.world_from_camera == camera.world_from_camera) {
            return {ms_since(begin), cells_of(*step->image), step->image};
        }
        if (refinement.failure()) return {-1, 0, nullptr};
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

void print(const char* name, const char* what, std::vector<double> ms, const std::vector<double>& cells) {
    std::printf("%-10s %-22s median %7.1f ms, most %7.1f ms, %4.0f cells along\n", name, what, median(ms),
                *std::ranges::max_element(ms), median(cells));
    std::fflush(stdout);
}

Status run(const Arguments& arguments) {
    const Result<LitScene> lit = read_lit_scene(arguments.lit);
    if (!lit) return lit.error();
    const Result<gl::Context> context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    auto frames = FrameCompositor::create(lit->scene, std::vector<PlacedObject>(),
                                          {.width = lit->camera.width, .height = lit->camera.height});
    if (!frames) return frames.error();
    if (Status drawn = frames->draw(lit->camera); !drawn) return drawn;

    int moves = 0;
    const auto moved = [&] {
        Camera camera = lit->camera;
        camera.world_from_camera[3] += 0.01 * ++moves * camera.world_from_camera[0];
        return camera;
    };
    for (const NamedMethod& named : kTracedMethods) {
        std::vector<double> ms, cells, draw_ms;
        auto begin = WallClock::now();
        double made_ms = 0;
        Refinement refinement([&] {
            auto made = TracedRenderer::create(lit->scene, {}, {.exposure_ev = arguments.lit.exposure_ev});
            made_ms = ms_since(begin);
            return made;
        });
        refinement.begin(lit->camera, named.method);
        const First first = wait_for_first(refinement, lit->camera, begin);
        if (!first.image) return *refinement.failure();
        std::printf("%-10s tracer created in %.0f ms, first image after %.0f ms\n", named.name, made_ms, first.ms);
        const auto keep = [&](const First& next) {
            ms.push_back(next.ms);
            cells.push_back(next.cells);
        };
        for (int i = 0; i < arguments.moves; ++i) {
            std::this_thread::sleep_for(std::chrono::duration<double>(arguments.still_s));
            const Camera camera = moved();
            begin = WallClock::now();
            refinement.begin(camera, named.method);
            const First next = wait_for_first(refinement, camera, begin);
            keep(next);
            begin = WallClock::now();
            frames->set_traced(next.image);
            if (Status drawn = frames->draw(camera); !drawn) return drawn;
            (void)frames->image();
            draw_ms.push_back(ms_since(begin));
        }
        print(named.name, "after a pause", ms, cells);
        ms.clear();
        cells.clear();
        for (int i = 0; i < 4 * arguments.moves; ++i) {
            const Camera camera = moved();
            begin = WallClock::now();
            refinement.begin(camera, named.method);
            keep(wait_for_first(refinement, camera, begin));
        }
        print(named.name, "while moving", ms, cells);
        std::printf("%-10s %-22s median %7.1f ms\n", named.name, "drawn into the frame", median(draw_ms));
    }
    return {};
}

}  // namespace
}  // namespace rs::compositor

int main(int argc, char** argv) {
    using namespace rs::compositor;
    CLI::App app("Latency of traced images", "bench_refine");
    Arguments arguments;
    arguments.lit.add_to(app);
    app.add_option("--moves", arguments.moves, "moves of each kind")->check(CLI::Range(1, 1000))->capture_default_str();
    app.add_option("--still", arguments.still_s, "seconds between moves")->capture_default_str();
    std::function<rs::Status()> action;
    app.callback([&] { action = [&] { return run(arguments); }; });
    return rs::tool_main(app, argc, argv, action);
}
