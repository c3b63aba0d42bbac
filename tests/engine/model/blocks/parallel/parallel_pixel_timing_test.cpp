// Latency and throughput of the pixel blocks of a parallel board: results appear exactly on time, not a cycle early.

#include "engine/model/blocks/parallel/patch_store.hpp"
#include "engine/model/blocks/parallel/pixel_rays.hpp"
#include "engine/model/blocks/texels/sample_place.hpp"
#include "engine/model/blocks/texels/surface_blend.hpp"
#include "engine/model/blocks/texels/texel_cache.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "tests/engine/model/blocks/block_bench.hpp"
#include "tests/engine/model/blocks/pixel_registers.hpp"

namespace rs::engine::model {
namespace {

using test::Bench;
using test::column_of;
using test::pixel_of;
using test::PixelRegisters;
using test::put;

TEST(ParallelPixelTiming, PixelScanGivesAPixelPerCycleOfFourPatches) {
    const PixelRegisters r;
    Fifo<ViewJob> jobs("jobs", 4, 1);
    Fifo<Done> patch_free("free", 4, 1);
    Fifo<Done> view_done("done", 2, 1);
    Fifo<PatchJob> patches("patches", 64, 1);
    Fifo<ScannedPixel> out("out", 2048, 1);
    PixelScan block(
        r.file, {},
        {.jobs = jobs, .patch_free = patch_free, .view_done = view_done, .patches = patches, .pixels = out});
    Bench bench({&jobs, &patch_free, &view_done, &patches, &out});
    put(jobs, {0});
    EXPECT_EQ(bench.cycles_until(block, out), 2);
    for (int n = 1; n < 16 * 30; ++n) EXPECT_EQ(bench.cycles_until(block, out), 1) << n;
    EXPECT_EQ(patches.count(), 4);  // 8 + 8 + 8 + 6 rows
    EXPECT_EQ(bench.cycles_until(block, out, 20), -1);
    put(patch_free, {});
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    for (int n = 0; n < 17; ++n) {
        out.pop();
        out.commit();
    }
    EXPECT_EQ(out.front().id, 17);  // the second row of the first patch
    EXPECT_EQ(out.front().row, 1);
    const BoardView& view = r.file.banks[0].views[0];
    EXPECT_EQ(out.front().rise_q24, static_cast<std::int32_t>((view.s0_q32 + view.sy_q32) >> 8));
}

TEST(ParallelPixelTiming, PixelScanHasTwoViewsInFlight) {
    const PixelRegisters r;
    RegisterFile file = r.file;
    file.banks[0].views.resize(3, file.banks[0].views[0]);
    for (BoardView& view : file.banks[0].views) view.width = view.height = 1;
    Fifo<ViewJob> jobs("jobs", 4, 1);
    Fifo<Done> patch_free("free", 4, 1);
    Fifo<Done> view_done("done", 2, 1);
    Fifo<PatchJob> patches("patches", 64, 1);
    Fifo<ScannedPixel> out("out", 64, 1);
    PixelScan block(
        file, {}, {.jobs = jobs, .patch_free = patch_free, .view_done = view_done, .patches = patches, .pixels = out});
    Bench bench({&jobs, &patch_free, &view_done, &patches, &out});
    for (int v = 0; v < 3; ++v) {
        put(jobs, {v});
    }
    EXPECT_EQ(bench.cycles_until(block, out), 2);
    EXPECT_EQ(bench.cycles_until(block, out), 2);
    EXPECT_EQ(bench.cycles_until(block, out, 20), -1);
    put(view_done, {});
    EXPECT_EQ(bench.cycles_until(block, out), 2);
    EXPECT_TRUE(patches.front().ends_view);
}

TEST(ParallelPixelTiming, RayRiseWaitsForItsColumnThenGivesAPixelPerCycle) {
    const PixelRegisters r;
    Fifo<ColumnSetup> columns("columns", 2, 1);
    Fifo<ScannedPixel> in("in", 8, 1);
    Fifo<PixelBandRay> out("out", 8, 1);
    RayRise block(r.file, {.columns = columns, .in = in, .out = out});
    Bench bench({&columns, &in, &out});
    for (const int id : {0, 16, 1}) {
        put(in, pixel_of(id));
    }
    EXPECT_EQ(bench.cycles_until(block, out, 60), -1);
    put(columns, column_of(RayKind::shape, 0));
    EXPECT_EQ(bench.cycles_until(block, out), 1 + RayRise::kStages + 1);
    EXPECT_EQ(RayRise::kStages, 25);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out, 60), -1);  // column 1 is missing
}

TEST(ParallelPixelTiming, SamplePlaceGivesASamplePerCycleOfLatency53) {
    const PixelRegisters r;
    Fifo<ColumnSetup> columns("columns", 2, 1);
    Fifo<SurfaceHit> in("in", 4, 1);
    Fifo<PlacedSample> out("out", 16, 1);
    SamplePlace block(r.file, {.columns = columns, .in = in, .out = out});
    Bench bench({&columns, &in, &out});
    put(columns, column_of(RayKind::shape, 0));
    ColumnSetup behind_eye = column_of(RayKind::shape, 1);
    behind_eye.lambda0_q20 = 0;
    put(columns, behind_eye);
    for (int n = 0; n < 2; ++n) bench.step(block);
    SurfaceHit met;
    met.pixel = pixel_of(0);
    put(in, met);
    met.pixel = pixel_of(1);
    put(in, met);
    EXPECT_EQ(bench.cycles_until(block, out), SamplePlace::kStages + 1);
    EXPECT_EQ(SamplePlace::kStages + 1, 53);
    for (int n = 1; n < 3; ++n) EXPECT_EQ(bench.cycles_until(block, out), 1);
    for (int n = 0; n < 2; ++n) {
        const PlacedSample sample = out.pop();
        out.commit();
        EXPECT_EQ(sample.head.second, n == 1);
        EXPECT_EQ(sample.head.last, n == 1);
        EXPECT_TRUE(sample.inside);
        EXPECT_EQ(sample.left, 19);
        EXPECT_EQ(sample.fx, 4);
    }
    EXPECT_FALSE(out.front().head.is_there);
    EXPECT_TRUE(out.front().head.last);
}

TEST(ParallelPixelTiming, FilterAndBlendArePipelines) {
    Fifo<TexelQuad> quads("quads", 4, 1);
    Fifo<FilteredSample> filtered("filtered", 8, 1);
    TexelFilter filter({.in = quads, .out = filtered});
    Bench filter_bench({&quads, &filtered});
    for (int n = 0; n < 2; ++n) {
        TexelQuad quad;
        quad.inside = quad.head.is_there = true;
        quad.head.second = n == 1;
        quad.head.last = n == 1;
        quad.head.weight = 64;
        quad.fx = 8 - 4 * (1 + n);
        quad.rgba = {0xFF000000U + 100U * static_cast<unsigned>(n + 1), 0, 0xFF000000U, 0};
        put(quads, quad);
    }
    EXPECT_EQ(filter_bench.cycles_until(filter, filtered), 7);
    EXPECT_EQ(filter_bench.cycles_until(filter, filtered), 1);
    EXPECT_EQ(filtered.front().r, 32 * 255 * 100);

    Fifo<FinishedPixel> resolved("resolved", 4, 1);
    Fifo<ReturnedPixel> again("again", 4, 1);
    SurfaceBlend blend({.in = filtered, .out = resolved, .again = again});
    Bench blend_bench({&filtered, &resolved, &again});
    EXPECT_EQ(SurfaceBlend::kStages, 16);
    EXPECT_EQ(blend_bench.cycles_until(blend, resolved), 1 + SurfaceBlend::kStages + 1);  // behind the second sample
    EXPECT_EQ(resolved.pop().rgba, 0xFF000058U);  // (50 * 192 + 200 * 64) / 256, rounded
    resolved.commit();
    FilteredSample none;
    none.head.last = true;
    none.head.next.begin = 77;
    put(filtered, none);
    EXPECT_EQ(blend_bench.cycles_until(blend, again), 17);
    EXPECT_EQ(again.pop().state.begin, 77);
    again.commit();
    none.head.final = true;
    put(filtered, none);
    EXPECT_EQ(blend_bench.cycles_until(blend, resolved), 17);
    EXPECT_EQ(resolved.pop().rgba, 0U);
    resolved.commit();
}

// If the point is outside of one image's frame, only the other image is used; a transparent sample rules out the
// surface.
TEST(ParallelPixelTiming, SurfaceBlendTakesTheImageWhoseFrameHasThePoint) {
    const auto outcome = [](bool second_inside, std::int32_t second_a) {
        Fifo<FilteredSample> in("in", 4, 1);
        Fifo<FinishedPixel> out("out", 4, 1);
        Fifo<ReturnedPixel> again("again", 4, 1);
        SurfaceBlend block({.in = in, .out = out, .again = again});
        Bench bench({&in, &out, &again});
        FilteredSample sample;
        sample.head.is_there = sample.inside = true;
        sample.head.weight = 128;
        sample.a = 64 * 255;
        sample.r = 64 * 255 * 40;
        put(in, sample);
        sample.head.second = sample.head.last = true;
        sample.inside = second_inside;
        sample.a = second_a;
        sample.r = second_a * 80;
        put(in, sample);
        for (int n = 0; n < 40; ++n) bench.step(block);
        return out.can_pop() ? out.front().rgba : 0U;
    };
    EXPECT_EQ(outcome(true, 64 * 255), 0xFF00003CU);
    EXPECT_EQ(outcome(false, 0), 0xFF000028U);
    EXPECT_EQ(outcome(true, 0), 0U);
}

// A pixel that its last surface does not cover is stored until the surface behind it arrives, and composited over that.
TEST(ParallelPixelTiming, SurfaceBlendStoresAPartlyCoveredPixel) {
    Fifo<FilteredSample> in("in", 4, 1);
    Fifo<FinishedPixel> out("out", 4, 1);
    Fifo<ReturnedPixel> again("again", 4, 1);
    SurfaceBlend block({.in = in, .out = out, .again = again});
    Bench bench({&in, &out, &again});
    const auto sample = [](int id, std::int32_t alpha, std::int32_t grey, bool final, int next) {
        FilteredSample one;
        one.head.id = id;
        one.head.is_there = one.inside = one.head.last = true;
        one.head.final = final;
        one.head.next.begin = next;
        one.a = 64 * alpha;
        one.r = 64 * alpha * grey;
        return one;
    };
    const auto expect = [&](std::uint32_t rgba) {
        EXPECT_EQ(bench.cycles_until(block, out), 17);
        EXPECT_EQ(out.pop().rgba, rgba);
        out.commit();
    };
    put(in, sample(7, 230, 10, false, MarchState::kBehind));
    expect(0xE600000AU);
    put(in, sample(7, 229, 10, false, MarchState::kFoot));  // hit before the foot: unknown surfaces behind it
    expect(0xE500000AU);
    const struct {
        int nearer;
        int farther;
        std::uint32_t rgba;
    } cases[] = {{229, 229, 0xE500000AU}, {229, 230, 0xFC00000BU}, {64, 255, 0xFF000012U}, {0, 100, 0x64000014U}};
    for (const auto& depths : cases) {
        SCOPED_TRACE(depths.farther);
        put(in, sample(7, depths.nearer, 10, false, MarchState::kBehind));
        EXPECT_EQ(bench.cycles_until(block, again), 17);
        EXPECT_EQ(again.pop().id, 7);
        again.commit();
        put(in, sample(8, 40, 30, true, MarchState::kBehind));  // another pixel passes
        expect(0x2800001EU);
        put(in, sample(7, depths.farther, 20, true, MarchState::kBehind));
        expect(depths.rgba);
    }
    put(in, sample(7, 40, 30, true, MarchState::kBehind));  // a new pixel in its place
    expect(0x2800001EU);
    // It returns twice; a surface that does not cover it in between is not stored.
    for (const auto& [alpha, next] : {std::pair{64, MarchState::kBehind}, {229, MarchState::kFarthest}}) {
        put(in, sample(7, alpha, 10, false, next));
        EXPECT_EQ(bench.cycles_until(block, again), 17);
        again.pop();
        again.commit();
    }
    put(in, sample(7, 255, 20, true, MarchState::kFarthest));
    expect(0xFF000012U);
}

TEST(ParallelPixelTiming, PatchStoreWritesAPatchWhenItsLastPixelIsThere) {
    const PixelRegisters r;
    Fifo<PatchJob> patches("patches", 4, 1);
    Fifo<FinishedPixel> pixels("pixels", 8, 1);
    Fifo<FinishedPixel> empty("empty", 8, 1);
    Fifo<MemoryWrite> writes("writes", 8, 1);
    Fifo<Done> patch_free("patch_free", 4, 1);
    Fifo<Done> stripe_free("stripe_free", 2, 1);
    Fifo<Done> done_scan("done_scan", 2, 1);
    Fifo<Done> done_books("done_books", 2, 1);
    PatchStore block(r.file, {.patches = patches,
                              .pixels = pixels,
                              .empty = empty,
                              .image_writes = writes,
                              .patch_free = patch_free,
                              .stripe_free = stripe_free,
                              .view_done_scan = done_scan,
                              .view_done_books = done_books});
    Bench bench({&patches, &pixels, &empty, &writes, &patch_free, &stripe_free, &done_scan, &done_books});
    put(patches, {0, 0, 32, 24, 2, 3, true, true});  // two columns of three rows
    for (const int id : {17, 0, 33, 1}) {
        put(pixels, {id, 1000U + static_cast<unsigned>(id)});
    }
    put(empty, {32, 0});
    EXPECT_EQ(bench.cycles_until(block, writes, 40), -1);
    EXPECT_EQ(pixels.count() + empty.count(), 0);
    put(pixels, {16, 1016});
    EXPECT_EQ(bench.cycles_until(block, writes), 2);  // one cycle to take it
    for (int n = 1; n < 4; ++n) EXPECT_EQ(bench.cycles_until(block, writes), 1);
    EXPECT_EQ(writes.front().address, r.file.image(0, 0) + 32U * 15U + 12U);
    EXPECT_EQ(writes.pop().data, 1000U | std::uint64_t{1016} << 32U);
    writes.commit();
    EXPECT_EQ(writes.pop().data, 0U);  // a row below the view, and an empty pixel
    writes.commit();
    EXPECT_EQ(writes.pop().data, 1001U | std::uint64_t{1017} << 32U);
    writes.commit();
    EXPECT_TRUE(writes.front().last);
    for (const Fifo<Done>* done : {&patch_free, &stripe_free, &done_scan, &done_books}) EXPECT_EQ(done->count(), 1);
}

}  // namespace
}  // namespace rs::engine::model
