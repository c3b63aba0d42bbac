// Rendering from coded images, decoded on demand, equals rendering the unpacked object bit for bit.

#include "encode/codec/dense_encoder.hpp"
#include "engine/core/definition/shape_pixel.hpp"
#include "engine/core/fast/coded_texels.hpp"
#include "engine/core/fast/renderer.hpp"
#include "engine/core/fast/shape_walk.hpp"
#include "engine/core/views/compare.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/random.hpp"
#include "tests/support/random_shape.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>
#include <thread>

namespace rs::engine {
namespace {

using test::Random;

constexpr std::int64_t kTinyBudget = 1;
constexpr std::int64_t kPlenty = std::int64_t{1} << 30;

// Colour waves that move slightly from view to view, so that images are predicted from one another, with an uneven
// silhouette and a soft alpha matte. Some tiles are empty; with `fills` the silhouette touches the frame.
Image<Rgba8> waves(int width, int height, int view, bool fills) {
    Image<Rgba8> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double across = (x + 1.3 * view) * 0.21;
            const double down = y * 0.17;
            const auto byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
            const double from_middle = std::hypot((x + 0.5) / width - 0.45, (y + 0.5) / height - 0.55);
            const double rim = fills ? 3.0 + std::sin(view + down) : 0.3 + 0.04 * std::sin(across + down);
            image(x, y) = {byte(128 + 90 * std::sin(across)), byte(128 + 90 * std::cos(down + 0.1 * view)),
                           byte(128 + 90 * std::sin(across - down)), byte(255 * (rim - from_middle) * 12)};
        }
    }
    return image;
}

// Object with coded images only, and the same object unpacked.
struct CodedObject {
    RaySpaceObject coded;
    RaySpaceObject unpacked;
};

void unpack(CodedObject& object) {
    object.unpacked = object.coded;
    codec::decode_images(object.unpacked);
}

CodedObject coded_object(Random& random, bool with_shape) {
    test::RingObjectOptions options;
    options.views = random.whole(1, 20);
    options.width = random.whole(20, 110);
    options.height = random.whole(20, 90);
    options.distance = random.real(1.5, 8);
    options.fl_px = options.width * options.distance * random.real(0.3, 0.8);
    options.planes = random.whole(3, 14);
    options.camera_height = random.real(-0.5, 0.5);
    CodedObject object;
    object.coded = test::ring_object(options);
    const bool fills = random.whole(0, 2) == 0;
    const encode::DenseSettings settings{.step = 40,
                                         .alpha_bits = random.whole(1, 4),
                                         .tile_width_log2 = random.whole(4, 6),
                                         .tile_height_log2 = random.whole(4, 6),
                                         .effort = encode::kMinEffort};
    object.coded.coded = std::make_shared<const codec::CodedImages>(encode::encode_dense(
        object.coded, [&](int view) { return waves(options.width, options.height, view, fills); }, settings));
    for (PlanarImage& image : object.coded.images) image = {};
    if (with_shape) object.coded.rings[0].shape = test::random_shape(object.coded, 0, random.engine, 0.3);
    unpack(object);
    return object;
}

Camera coded_camera(Random& random, bool upright) {
    const double angle = random.real(0, 2 * kPi), distance = random.real(0.8, 9);
    const glm::dvec3 eye(distance * std::sin(angle), random.real(-1, 1), distance * std::cos(angle));
    const glm::dvec3 at(random.real(-0.4, 0.4), upright ? eye.y : random.real(-1, 1), random.real(-0.4, 0.4));
    const Camera camera =
        look_at_camera(eye, at, radians(random.real(5, 90)), random.whole(1, 150), random.whole(1, 100));
    return upright ? upright_camera(camera) : camera;
}

struct Rendered {
    Image<Rgba8> colour;
    Image<std::int32_t> lambda;
    bool operator==(const Rendered&) const = default;
};

Rendered render(const Renderer& renderer, const ViewRegisters& registers) {
    Rendered view{Image<Rgba8>(registers.width, registers.height),
                  Image<std::int32_t>(registers.width, registers.height)};
    renderer.render(registers, view.colour, view.lambda);
    return view;
}

std::int64_t shown(const Rendered& view) {
    return std::count_if(view.colour.pixels().begin(), view.colour.pixels().end(),
                         [](const Rgba8& p) { return p.a != 0; });
}

void expect_equal_views(bool with_shape, bool upright, std::uint64_t first_seed) {
    constexpr int kObjects = 8;
    constexpr int kViews = 12;
    std::int64_t shown_pixels = 0;
    for (std::uint64_t seed = first_seed; seed < first_seed + kObjects; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const CodedObject object = coded_object(random, with_shape);
        const Result<Renderer> whole = Renderer::create(object.unpacked);
        ASSERT_TRUE(whole.ok());
        for (const auto& [threads, budget] :
             {std::pair{1, kPlenty}, std::pair{4, kPlenty}, std::pair{4, kTinyBudget}}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
            const Result<Renderer> renderer = Renderer::create(object.coded, {.decoded_budget_bytes = budget});
            ASSERT_TRUE(renderer.ok());
            for (int v = 0; v < kViews; ++v) {
                const Camera camera = coded_camera(random, upright);
                const Result<ViewRegisters> registers = prepare_view(object.coded, camera);
                if (!registers) continue;
                ASSERT_EQ(registers->upright(), upright);
                const Rendered expected = render(*whole, *registers);
                ASSERT_EQ(render(*renderer, *registers), expected) << "view " << v << ", " << threads << " threads";
                shown_pixels += shown(expected);
            }
        }
    }
    EXPECT_GT(shown_pixels, kObjects * kViews * 3 * 100);
}

TEST(CodedRendererProperty, PlaneMapsUpright) {
    expect_equal_views(false, true, 100);
}
TEST(CodedRendererProperty, PlaneMapsTilted) {
    expect_equal_views(false, false, 200);
}
TEST(CodedRendererProperty, ShapeMapsUpright) {
    expect_equal_views(true, true, 300);
}
TEST(CodedRendererProperty, ShapeMapsTilted) {
    expect_equal_views(true, false, 400);
}

TEST(CodedRenderer, RendersFromSeveralThreadsAtOnce) {
    Random random(7);
    for (const bool with_shape : {false, true}) {
        const CodedObject object = coded_object(random, with_shape);
        const Result<Renderer> whole = Renderer::create(object.unpacked);
        ASSERT_TRUE(whole.ok());
        std::vector<ViewRegisters> views;
        std::vector<Rendered> expected;
        while (views.size() < 24) {
            const Result<ViewRegisters> registers = prepare_view(object.coded, coded_camera(random, views.size() < 20));
            if (!registers) continue;
            views.push_back(*registers);
            expected.push_back(render(*whole, *registers));
        }
        for (int repetition = 0; repetition < 10; ++repetition) {
            const Result<Renderer> renderer = Renderer::create(object.coded, {.decoded_budget_bytes = kTinyBudget});
            ASSERT_TRUE(renderer.ok());
            std::atomic<int> different = 0;
            std::vector<std::thread> threads;
            for (std::size_t t = 0; t < 4; ++t) {
                threads.emplace_back([&, t] {
                    for (std::size_t v = 0; v < views.size(); ++v) {
                        const std::size_t n = (v + t / 2) % views.size();
                        different += !(render(*renderer, views[n]) == expected[n]);
                    }
                });
            }
            for (std::thread& thread : threads) thread.join();
            ASSERT_EQ(different, 0);
        }
    }
}

TEST(CodedTexels, EqualThoseOfTheUnpackedImagesWithTheirBorders) {
    bool has_details = false;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const CodedObject object = coded_object(random, false);
        const Result<TexelStore> coded = TexelStore::create(object.coded, kPlenty);
        const Result<TexelStore> whole = TexelStore::create(object.unpacked, kPlenty);
        ASSERT_TRUE(coded.ok() && whole.ok());
        ASSERT_TRUE(coded->is_coded() && !whole->is_coded());
        const TexelStore::Reading reading = coded->read();
        std::vector<std::pair<int, int>> places;  // image, column
        for (int p = 0; p < static_cast<int>(object.coded.views.size()); ++p) {
            for (int column = 0; column < object.coded.width; ++column) places.emplace_back(p, column);
        }
        std::shuffle(places.begin(), places.end(), random.engine);
        for (const auto& [p, column] : places) {
            coded->ensure(p, column, column);
            ASSERT_EQ(coded->occupied(p, column).begin, whole->occupied(p, column).begin);
            ASSERT_EQ(coded->occupied(p, column).end, whole->occupied(p, column).end);
            const int first = column == 0 ? -1 : column;
            const int last = column == object.coded.width - 1 ? column + 1 : column;
            for (int x = first; x <= last; ++x) {
                const Rgba8* const a = coded->texels() + coded->column_start(p, x);
                const Rgba8* const b = whole->texels() + whole->column_start(p, x);
                const std::int8_t* const a_details = coded->details() + coded->column_start(p, x);
                const std::int8_t* const b_details = whole->details() + whole->column_start(p, x);
                for (int row = -1; row <= object.coded.height; ++row) {
                    ASSERT_EQ(a[row], b[row]) << p << ": " << x << ", " << row;
                    ASSERT_EQ(a_details[row], b_details[row]) << p << ": " << x << ", " << row;
                    has_details = has_details || a_details[row] != 0;
                }
            }
        }
    }
    EXPECT_TRUE(has_details);
}

TEST(CodedTexels, DecodeOnDemandAndStayWithinTheBudget) {
    Random random(3);
    CodedObject object = coded_object(random, false);
    while (object.coded.views.size() < 8 || object.coded.coded->tile_columns() < 3) {
        object = coded_object(random, false);
    }
    const std::shared_ptr<const codec::CodedImages> coded = object.coded.coded;
    const auto all_bytes = [&] {
        std::unique_ptr<CodedTexels> texels = std::move(*CodedTexels::create(coded, "all", kPlenty));
        texels->begin_view();
        for (int p = 0; p < static_cast<int>(coded->images.size()); ++p) texels->ensure(p, 0, coded->width - 1);
        texels->end_view();
        texels->begin_view();
        texels->end_view();
        return texels->decoded_bytes();
    }();
    const std::int64_t budget = all_bytes / 2;
    const std::unique_ptr<CodedTexels> texels = std::move(*CodedTexels::create(coded, "some", budget));
    texels->begin_view();
    EXPECT_EQ(texels->decoded_bytes(), 0);
    texels->ensure(0, 0, 0);
    EXPECT_GT(texels->decoded_bytes(), 0);
    EXPECT_LT(texels->decoded_bytes(), all_bytes / static_cast<std::int64_t>(coded->images.size()));
    texels->end_view();
    for (int p = 0; p < static_cast<int>(coded->images.size()); ++p) {
        texels->begin_view();
        EXPECT_LE(texels->decoded_bytes(), budget);
        texels->ensure(p, 0, coded->width - 1);
        const std::int64_t held = texels->decoded_bytes();
        texels->begin_view();  // images of an active view are not freed
        EXPECT_EQ(texels->decoded_bytes(), held);
        texels->end_view();
        texels->end_view();
    }
}

struct ColumnCounts {
    std::int64_t reads = 0;
    std::int64_t ranges = 0;
    std::int64_t narrow_ranges = 0;
};

void expect_columns_cover(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j,
                          ColumnCounts& counts) {
    const ShapeSetup setup = set_up_shape(object, registers, i, j);
    if (!setup.has_ray) return;
    const auto covers = [&](const ShapeImage& image, int view, int column) {
        if (image.view != view) return false;
        const ColumnRange range = sampled_columns(object, image);
        return range.first <= column && column <= range.last;
    };
    const auto read = [&](int view, int column, int) {
        EXPECT_TRUE(covers(setup.first, view, column) || covers(setup.second, view, column))
            << "pixel " << i << ", " << j << " reads column " << column << " of " << view;
        ++counts.reads;
        return Rgba8{1, 2, 3, static_cast<std::uint8_t>(column % 2)};
    };
    struct Texels {
        decltype(read)& color;
        int detail(int view, int column, int row) const { return color(view, column, row).r; }
    };
    shape_pixel(object, registers, setup, registers.rise_q24(i, j), Texels{read});
    const ColumnRange range = sampled_columns(object, setup.first);
    ++counts.ranges;
    counts.narrow_ranges += range.last - range.first + 1 < object.width / 3;
}

TEST(ShapeColumns, CoverEveryTexelRead) {
    ColumnCounts counts;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        RaySpaceObject object = test::ring_object({.views = random.whole(1, 16),
                                                   .width = random.whole(1, 300),
                                                   .height = 20,
                                                   .distance = random.real(1.2, 8),
                                                   .fl_px = random.real(20, 900),
                                                   .planes = random.whole(3, 14)});
        object.rings[0].shape = test::random_shape(object, 0, random.engine, 0.2);
        for (int v = 0; v < 12; ++v) {
            const Camera camera = coded_camera(random, random.whole(0, 1) == 0);
            const Result<ViewRegisters> registers = prepare_view(object, camera);
            if (!registers) continue;
            for (int i = 0; i < camera.width; ++i) {
                for (int j = v % 10; j < camera.height; j += 10) expect_columns_cover(object, *registers, i, j, counts);
            }
        }
    }
    EXPECT_GT(counts.reads, 50000);
    EXPECT_GT(counts.narrow_ranges, counts.ranges / 3);  // ranges must be useful
}

TEST(CodedRenderer, ReplacesMissingImagesByNeighbours) {
    Random random(11);
    CodedObject object = coded_object(random, true);
    while (object.coded.views.size() < 8) object = coded_object(random, true);
    codec::CodedImages some = *object.coded.coded;
    for (std::size_t v = 0; v < some.images.size(); ++v) {
        if (some.levels[v] > 1) some.images[v] = {};
    }
    object.coded.coded = std::make_shared<const codec::CodedImages>(some);
    unpack(object);
    const Result<Renderer> renderer = Renderer::create(object.coded);
    const Result<Renderer> whole = Renderer::create(object.unpacked);
    ASSERT_TRUE(renderer.ok() && whole.ok());
    EXPECT_TRUE(renderer->object().rings[0].shape.empty());
    for (int v = 0; v < 20; ++v) {
        const Result<ViewRegisters> registers = prepare_view(object.coded, coded_camera(random, v % 2 == 0));
        if (!registers) continue;
        EXPECT_EQ(render(*renderer, *registers), render(*whole, *registers));
    }

    // Level 1 is predicted from level 0, which is removed.
    for (std::size_t v = 0; v < some.images.size(); ++v) {
        if (some.levels[v] == 0) some.images[v] = {};
    }
    object.coded.coded = std::make_shared<const codec::CodedImages>(some);
    EXPECT_FALSE(Renderer::create(object.coded).ok());
}

TEST(CodedRenderer, ConformsToTheScalarDefinition) {
    Random random(5);
    const Result<ConformanceReport> report = check_conformance(coded_object(random, true).coded, 12, 1);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->different_pixels, 0);
    EXPECT_GT(report->object_pixels, 1000);
}

}  // namespace
}  // namespace rs::engine
