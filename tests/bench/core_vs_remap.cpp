// The core's speed beside cv::remap (8UC4) at the same output size, in one run, on two threads: by reference planes
// beside nearest, with a shape map beside linear.
//
//     bench_core --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
//
// Both write 1024x1024 pixels of four bytes from 512x512 pictures. The core renders an orbit around a 90-view object,
// so that every frame reads other pictures; cv::remap reads one picture through a fixed-point map of the same scale,
// its fastest form. core_shape orbits at the captured distance, between the captured views; core_shape_near goes
// nearer, where every ray passes many bands of the map. Compare items_per_second (pixels).

#include "engine/core/reconstruct.hpp"
#include "engine/core/renderer.hpp"
#include "rayspace/conventions.hpp"
#include "tests/support/ring_object.hpp"
#include "tests/support/small_shape.hpp"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <vector>

namespace rs {
namespace {

constexpr int kSide = 1024;
constexpr int kThreads = 2;

const test::RingObjectOptions kRing{
    .views = 90, .width = 512, .height = 512, .fl_px = 1.4 * 512, .x_cells = 512, .u_cells = 512};

const RaySpaceObject& object() {
    static const RaySpaceObject kObject = test::ring_object(kRing);
    return kObject;
}

// Two balls that fill half of the picture. As in the encoder's maps of real objects, two of three cells have two
// layers.
const RaySpaceObject& object_with_shape() {
    static const RaySpaceObject kObject = [] {
        RaySpaceObject with_shape = object();
        ShapeMap& shape = with_shape.rings[0].shape;
        shape = test::small_shape(with_shape, 0, {.p_cells = 64, .bands = 96, .lines = {2}});
        for (std::size_t i = 0; i < shape.cells.size(); ++i) {
            ShapeCell& cell = shape.cells[i];
            if (cell.rays == 0 || cell.depth[1] != 0 || i % 3 == 0) continue;
            cell.depth[1] = static_cast<std::uint8_t>(std::min(cell.depth[0] + 8, 255));
            cell.rays |= kFirstSeesLayer1 | kSecondSeesLayer1;
        }
        return with_shape;
    }();
    return kObject;
}

std::vector<engine::ViewRegisters> orbit(double distance = 3.5) {
    std::vector<engine::ViewRegisters> views;
    const Rig rig = make_ring(
        {.count = 61, .distance = distance, .fl_px = 1.4 * kSide, .width = kSide, .height = kSide, .first_rad = 0.01});
    for (const RigView& view : rig.views) views.push_back(*engine::prepare_view(object(), view.camera));
    return views;
}

void render_orbit(benchmark::State& state, const RaySpaceObject& shown, double distance) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
    const engine::Renderer renderer = *engine::Renderer::create(shown);
    const std::vector<engine::ViewRegisters> views = orbit(distance);
    Image<Rgba8> out(kSide, kSide);
    std::size_t next = 0;
    for (auto _ : state) {
        renderer.render(views[next++ % views.size()], out);
        benchmark::DoNotOptimize(out.data());
    }
    state.SetItemsProcessed(state.iterations() * kSide * kSide);
}

void core(benchmark::State& state) {
    render_orbit(state, object(), 3.5);
}
BENCHMARK(core)->UseRealTime()->MinTime(1);

void core_shape(benchmark::State& state) {
    render_orbit(state, object_with_shape(), 3.5);
}
BENCHMARK(core_shape)->UseRealTime()->MinTime(1);

void core_shape_near(benchmark::State& state) {
    render_orbit(state, object_with_shape(), 3);
}
BENCHMARK(core_shape_near)->UseRealTime()->MinTime(1);

void scalar_definition(benchmark::State& state) {
    const std::vector<engine::ViewRegisters> views = orbit();
    Image<Rgba8> out(kSide, kSide);
    std::size_t next = 0;
    for (auto _ : state) engine::reconstruct_scalar(object(), views[next++ % views.size()], out);
    state.SetItemsProcessed(state.iterations() * kSide * kSide);
}
BENCHMARK(scalar_definition)->UseRealTime();

void remap(benchmark::State& state, bool linear) {
    cv::setNumThreads(kThreads);
    cv::Mat source(512, 512, CV_8UC4);
    cv::randu(source, 0, 255);
    cv::Mat x(kSide, kSide, CV_32F), y(kSide, kSide, CV_32F), fixed, fraction;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            x.at<float>(j, i) = static_cast<float>(i) * 0.5F;
            y.at<float>(j, i) = static_cast<float>(j) * 0.5F;
        }
    }
    cv::convertMaps(x, y, fixed, fraction, CV_16SC2, !linear);
    cv::Mat out(kSide, kSide, CV_8UC4);
    for (auto _ : state) {
        cv::remap(source, out, fixed, linear ? fraction : cv::Mat(), linear ? cv::INTER_LINEAR : cv::INTER_NEAREST);
        benchmark::DoNotOptimize(out.data);
    }
    state.SetItemsProcessed(state.iterations() * kSide * kSide);
}

void cv_remap(benchmark::State& state) {
    remap(state, false);
}
BENCHMARK(cv_remap)->UseRealTime()->MinTime(1);

void cv_remap_linear(benchmark::State& state) {
    remap(state, true);
}
BENCHMARK(cv_remap_linear)->UseRealTime()->MinTime(1);

}  // namespace
}  // namespace rs

BENCHMARK_MAIN();
