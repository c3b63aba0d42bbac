// Speed of the software core compared with cv::remap (8UC4) at the same output size, in one run, on two threads:
// reference planes against nearest, a shape map against linear interpolation.
//
//     bench_core --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
//
// Both write 1024x1024 pixels of four bytes from 512x512 images. The core renders an orbit around a 90-view object, so
// that every frame reads different images; cv::remap reads one image through a fixed-point map of the same scale, its
// fastest form. core_shape orbits at the captured distance, between the captured views; core_shape_near is closer,
// where every ray passes many bands of the map. Their images have fractional alpha everywhere; core_shape_opaque has
// only 0 and 255. Compare items_per_second (pixels).
//
// coded_*/PROFILE: the same from a coded object (a textured ball on the same ring), decoded on demand. Orbits advance
// by 1 degree, so that consecutive frames share tiles. `warm` caches everything; `evicting` caches ten images, so that
// every frame decodes some tiles; `cold_frame` decodes everything that a frame needs. coded_random_pixel decodes one
// tile and the tiles that it is predicted from, on one thread with an empty cache: items are pixels, `bytes` the bytes
// read per pixel.
//
// astc_decode/BLOCK (astc_decode.cpp): decoding speed of the command astcenc on a whole image of that ball.

#include "encode/codec/board/board_encoder.hpp"
#include "encode/codec/dense_encoder.hpp"
#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/fast/renderer.hpp"
#include "engine/core/fast/sample_store.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/bench/ball_image.hpp"
#include "tests/bench/stopwatch.hpp"
#include "tests/support/ring_object.hpp"
#include "tests/support/small_shape.hpp"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <map>
#include <random>
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

// Two balls that fill half of the image; one map line per gap of 4 degrees, as in the encoder's maps.
const RaySpaceObject& object_with_shape() {
    static const RaySpaceObject kObject = [] {
        RaySpaceObject with_shape = object();
        with_shape.rings[0].shape = test::small_shape(with_shape, 0, {.p_cells = 160, .bands = 168, .lines = {1}});
        return with_shape;
    }();
    return kObject;
}

// The same with binary alpha, as in the images of most objects.
const RaySpaceObject& opaque_object_with_shape() {
    static const RaySpaceObject kObject = [] {
        RaySpaceObject opaque = object_with_shape();
        for (PlanarImage& image : opaque.images) {
            for (int x = 0; x < image.a.width(); ++x) {
                bool shows = false;
                for (int y = 0; y < image.a.height(); ++y) shows = shows || image.a(x, y) > 0;
                for (int y = 2; shows && y < image.a.height() - 3; ++y) image.a(x, y) = 255;
            }
        }
        return opaque;
    }();
    return kObject;
}

std::vector<engine::ViewRegisters> orbit(double distance = 3.5, int count = 61,
                                         engine::TexelFilter filter = engine::TexelFilter::kBilinear) {
    std::vector<engine::ViewRegisters> views;
    const Rig rig = make_ring({.count = count,
                               .distance = distance,
                               .fl_px = 1.4 * kSide,
                               .width = kSide,
                               .height = kSide,
                               .first_rad = 0.01});
    for (const RigView& view : rig.views) {
        views.push_back(*engine::prepare_view(object(), view.camera));
        views.back().filter = filter;
    }
    return views;
}

void render_orbit(benchmark::State& state, const RaySpaceObject& shown, double distance,
                  engine::TexelFilter filter = engine::TexelFilter::kBilinear) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
    const engine::Renderer renderer = *engine::Renderer::create(shown);
    const std::vector<engine::ViewRegisters> views = orbit(distance, 61, filter);
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

void core_shape_sharp(benchmark::State& state) {
    render_orbit(state, object_with_shape(), 3.5, engine::TexelFilter::kSharp);
}
BENCHMARK(core_shape_sharp)->UseRealTime()->MinTime(1);

void core_shape_near(benchmark::State& state) {
    render_orbit(state, object_with_shape(), 3);
}
BENCHMARK(core_shape_near)->UseRealTime()->MinTime(1);

void core_shape_near_sharp(benchmark::State& state) {
    render_orbit(state, object_with_shape(), 3, engine::TexelFilter::kSharp);
}
BENCHMARK(core_shape_near_sharp)->UseRealTime()->MinTime(1);

void core_shape_opaque(benchmark::State& state) {
    render_orbit(state, opaque_object_with_shape(), 3.5);
}
BENCHMARK(core_shape_opaque)->UseRealTime()->MinTime(1);

void core_shape_opaque_sharp(benchmark::State& state) {
    render_orbit(state, opaque_object_with_shape(), 3.5, engine::TexelFilter::kSharp);
}
BENCHMARK(core_shape_opaque_sharp)->UseRealTime()->MinTime(1);

void core_shape_opaque_near(benchmark::State& state) {
    render_orbit(state, opaque_object_with_shape(), 3);
}
BENCHMARK(core_shape_opaque_near)->UseRealTime()->MinTime(1);

void core_shape_opaque_near_sharp(benchmark::State& state) {
    render_orbit(state, opaque_object_with_shape(), 3, engine::TexelFilter::kSharp);
}
BENCHMARK(core_shape_opaque_near_sharp)->UseRealTime()->MinTime(1);

const RaySpaceObject& coded_object(codec::Profile profile) {
    static std::map<codec::Profile, RaySpaceObject> objects;
    const auto found = objects.find(profile);
    if (found != objects.end()) return found->second;
    RaySpaceObject coded = object();
    const Rig rig = test::ring_rig(kRing);
    std::vector<encode::SourceImage> sources;
    for (const RigView& view : rig.views) sources.push_back(encode::source_image(bench::ball_image(view.camera), 2));
    coded.coded = std::make_shared<const codec::CodedImages>(profile == codec::Profile::kBoard
                                                                 ? encode::encode_board(coded, sources, {}).coded
                                                                 : encode::encode_dense(coded, sources, {}).coded);
    for (PlanarImage& unpacked : coded.images) unpacked = {};
    return objects.emplace(profile, std::move(coded)).first->second;
}

constexpr std::int64_t kDecodedImage = std::int64_t{9} * 512 * 512;

void coded_orbit(benchmark::State& state, const RaySpaceObject& shown, std::int64_t budget_bytes, bool warm) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
    const engine::Renderer renderer = *engine::Renderer::create(shown, {.decoded_budget_bytes = budget_bytes});
    const std::vector<engine::ViewRegisters> views = orbit(3.5, 360);
    Image<Rgba8> out(kSide, kSide);
    for (std::size_t v = 0; warm && v < views.size(); ++v) renderer.render(views[v], out);
    std::size_t next = 0;
    for (auto _ : state) {
        renderer.render(views[next++ % views.size()], out);
        benchmark::DoNotOptimize(out.data());
    }
    state.SetItemsProcessed(state.iterations() * kSide * kSide);
}

void coded_warm(benchmark::State& state, codec::Profile profile) {
    coded_orbit(state, coded_object(profile), 100 * kDecodedImage, true);
}
BENCHMARK_CAPTURE(coded_warm, dense, codec::Profile::kDense)->UseRealTime()->MinTime(1);
BENCHMARK_CAPTURE(coded_warm, board, codec::Profile::kBoard)->UseRealTime()->MinTime(1);

void coded_evicting(benchmark::State& state, codec::Profile profile) {
    coded_orbit(state, coded_object(profile), 10 * kDecodedImage, false);
}
BENCHMARK_CAPTURE(coded_evicting, dense, codec::Profile::kDense)->UseRealTime()->MinTime(1);
BENCHMARK_CAPTURE(coded_evicting, board, codec::Profile::kBoard)->UseRealTime()->MinTime(1);

void coded_shape(benchmark::State& state, codec::Profile profile, std::int64_t images, bool warm) {
    RaySpaceObject shown = coded_object(profile);
    shown.rings[0].shape = object_with_shape().rings[0].shape;
    coded_orbit(state, shown, images * kDecodedImage, warm);
}

void coded_shape_warm(benchmark::State& state, codec::Profile profile) {
    coded_shape(state, profile, 100, true);
}
BENCHMARK_CAPTURE(coded_shape_warm, dense, codec::Profile::kDense)->UseRealTime()->MinTime(1);
BENCHMARK_CAPTURE(coded_shape_warm, board, codec::Profile::kBoard)->UseRealTime()->MinTime(1);

void coded_shape_evicting(benchmark::State& state, codec::Profile profile) {
    coded_shape(state, profile, 10, false);
}
BENCHMARK_CAPTURE(coded_shape_evicting, dense, codec::Profile::kDense)->UseRealTime()->MinTime(1);
BENCHMARK_CAPTURE(coded_shape_evicting, board, codec::Profile::kBoard)->UseRealTime()->MinTime(1);

void coded_cold_frame(benchmark::State& state, codec::Profile profile) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
    const std::vector<engine::ViewRegisters> views = orbit(3.5, 360);
    // With a cache of 0 bytes, every frame is cold.
    const engine::Renderer renderer = *engine::Renderer::create(coded_object(profile), {.decoded_budget_bytes = 0});
    Image<Rgba8> out(kSide, kSide);
    std::size_t next = 0;
    for (auto _ : state) renderer.render(views[(next += 37) % views.size()], out);
    state.SetItemsProcessed(state.iterations() * kSide * kSide);
}
BENCHMARK_CAPTURE(coded_cold_frame, dense, codec::Profile::kDense)->UseRealTime()->MinTime(1);
BENCHMARK_CAPTURE(coded_cold_frame, board, codec::Profile::kBoard)->UseRealTime()->MinTime(1);

void coded_random_pixel(benchmark::State& state, codec::Profile profile) {
    const codec::CodedImages& coded = *coded_object(profile).coded;
    const std::unique_ptr<engine::SampleStore> samples =
        std::move(*engine::SampleStore::create(coded_object(profile).coded, "bench"));
    const auto views = static_cast<int>(coded.images.size());
    const int tiles = coded.tile_columns() * coded.tile_rows();
    std::mt19937 random(1);
    double bytes_read = 0;
    double worst = 0;
    for (auto _ : state) {
        int view = 0;
        int tile = 0;
        do {
            view = static_cast<int>(random() % static_cast<unsigned>(views));
            tile = static_cast<int>(random() % static_cast<unsigned>(tiles));
        } while (!coded.images[static_cast<std::size_t>(view)].tiles[static_cast<std::size_t>(tile)].present);
        const bench::Stopwatch watch;
        samples->need_tile(view, tile);
        state.SetIterationTime(watch.wall_s());
        double bytes = 0;
        for (int v = 0; v < views; ++v) {
            if (samples->decoded_bytes(v) == 0) continue;
            for (int t = 0; t < tiles; ++t) {
                if (!samples->decoded(v, t)) continue;
                bytes += coded.images[static_cast<std::size_t>(v)].tiles[static_cast<std::size_t>(t)].size;
            }
            samples->forget(v);
        }
        bytes_read += bytes;
        worst = std::max(worst, bytes);
    }
    state.SetItemsProcessed(state.iterations());
    state.counters["bytes"] = bytes_read / static_cast<double>(state.iterations());
    state.counters["worst_bytes"] = worst;
}
BENCHMARK_CAPTURE(coded_random_pixel, dense, codec::Profile::kDense)->UseManualTime()->MinTime(0.5);
BENCHMARK_CAPTURE(coded_random_pixel, board, codec::Profile::kBoard)->UseManualTime()->MinTime(0.5);

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
