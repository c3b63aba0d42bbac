// The images of the reconstruction shader equal those of the scalar definition bit for bit, for random objects, sizes
// and poses, in both dialects of the shader.

#include "compositor/gpu/gpu_renderer.hpp"

#include "compositor/gpu/shader/texture_layout.hpp"
#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "tests/compositor/gl_test.hpp"
#include "tests/support/random_ring_object.hpp"

#include <cstdint>

namespace rs::compositor {
namespace {

using test::Pose;
using test::Random;

class GpuRendererTest : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!context_) return;
        Result<GpuRenderer> made = GpuRenderer::create();
        ASSERT_TRUE(made.ok()) << made.error().message;
        renderer_.emplace(std::move(*made));
    }
    void TearDown() override {
        renderer_.reset();
        GlTest::TearDown();
    }

    // Renders `views` views of an object, each with another filter, and counts their opaque pixels.
    void expect_equal(const RaySpaceObject& object, const test::RingObjectOptions& options, Pose pose, Random& random,
                      int views) {
        const auto uploaded = GpuObject::create(object);
        ASSERT_TRUE(uploaded.ok()) << uploaded.error().message;
        for (int v = 0; v < views; ++v) {
            SCOPED_TRACE(v);
            const Camera camera = test::shape_camera(random, options, pose);
            const auto registers = engine::prepare_view(object, camera, static_cast<engine::TexelFilter>(v % 3));
            if (!registers) continue;
            Image<Rgba8> colours(camera.width, camera.height);
            Image<std::int32_t> depths(camera.width, camera.height);
            engine::reconstruct_scalar(object, *registers, colours, depths);
            const auto rendered = renderer_->render(*uploaded, *registers, true);
            ASSERT_TRUE(rendered.ok()) << rendered.error().message;
            ASSERT_EQ(rendered->image, colours);
            ASSERT_EQ(rendered->depth_q20, depths);
            pixels_ += colours.width() * colours.height();
            for (int j = 0; j < colours.height(); ++j) {
                for (int i = 0; i < colours.width(); ++i) opaque_ += colours(i, j).a > 0 ? 1 : 0;
            }
        }
    }

    // Random objects; every fourth has no shape map.
    void expect_equal_objects(Pose pose, std::uint64_t first_seed, int objects, int views) {
        for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(objects); ++seed) {
            SCOPED_TRACE(seed);
            Random random(seed);
            const test::RingObjectOptions options = test::random_options(random);
            RaySpaceObject object = test::random_object(random, options);
            if (seed % 4 == 3) object.rings[0].shape = {};
            expect_equal(object, options, pose, random, views);
            if (HasFatalFailure()) return;
        }
        EXPECT_GT(opaque_ * 20, pixels_);  // the views show enough of the objects
    }

    std::optional<GpuRenderer> renderer_;
    std::int64_t pixels_ = 0;
    std::int64_t opaque_ = 0;
};

TEST_F(GpuRendererTest, EqualsTheDefinitionOnTheRing) {
    expect_equal_objects(Pose::on_ring, 100, 75, 6);
}

TEST_F(GpuRendererTest, EqualsTheDefinitionAtCapturedViews) {
    expect_equal_objects(Pose::at_captured_view, 1100, 50, 6);
}

TEST_F(GpuRendererTest, EqualsTheDefinitionNearerFartherAndHigher) {
    expect_equal_objects(Pose::upright, 2100, 100, 6);
}

TEST_F(GpuRendererTest, EqualsTheDefinitionOnTiltedViews) {
    expect_equal_objects(Pose::tilted, 3100, 75, 6);
}

TEST_F(GpuRendererTest, EmbeddedDialectGivesTheSameBytes) {
    Result<GpuRenderer> made = GpuRenderer::create({.dialect = ShaderDialect::kEmbedded});
    ASSERT_TRUE(made.ok()) << made.error().message;
    renderer_.emplace(std::move(*made));
    expect_equal_objects(Pose::upright, 4100, 20, 6);
    expect_equal_objects(Pose::tilted, 5100, 10, 6);
}

// Set-ups of a tilted view are uploaded in parts.
TEST_F(GpuRendererTest, TiltedViewsMayBeLarge) {
    Random random(7);
    const test::RingObjectOptions options{.views = 12, .width = 50, .height = 50};
    const RaySpaceObject object = test::random_object(random, options);
    const auto uploaded = GpuObject::create(object);
    ASSERT_TRUE(uploaded.ok());
    const Camera camera = look_at_camera({0.3, 1, 3.5}, {0, 0, 0}, radians(40), 700, 500);
    const auto registers = engine::prepare_view(object, camera);
    ASSERT_TRUE(registers.ok());
    Image<Rgba8> colours(700, 500);
    engine::reconstruct_scalar(object, *registers, colours);
    const auto rendered = renderer_->render(*uploaded, *registers, false);
    ASSERT_TRUE(rendered.ok());
    EXPECT_EQ(rendered->image, colours);
    EXPECT_TRUE(rendered->depth_q20.empty());
}

TEST_F(GpuRendererTest, ViewsOfMorePhotosThanFitAreDrawnInParts) {
    for (const int photos : {2, 3, 5}) {
        SCOPED_TRACE(photos);
        const RaySpaceObject small = test::ring_object({.views = 12});
        Result<GpuRenderer> made = GpuRenderer::create({.memory_bytes = gpu_bytes(small, photos)});
        ASSERT_TRUE(made.ok()) << made.error().message;
        renderer_.emplace(std::move(*made));
        for (const Pose pose : {Pose::upright, Pose::tilted}) {
            Random random(static_cast<std::uint64_t>(photos));
            const test::RingObjectOptions options{.views = 12, .width = 40, .height = 40};
            expect_equal(test::random_object(random, options), options, pose, random, 6);
        }
    }
}

// Equality to the definition shows that nothing is missing outside of the rectangles.
TEST_F(GpuRendererTest, TransparentPartsAreNotDrawn) {
    const RaySpaceObject object = test::ring_object({.views = 12});
    const auto prepared = GpuObject::create(object);
    ASSERT_TRUE(prepared.ok());
    Result<gl::IntegerTarget> target = gl::IntegerTarget::create(200, 200);
    ASSERT_TRUE(target.ok());
    for (const double height : {0.0, 1.0}) {  // upright, tilted
        SCOPED_TRACE(height);
        const Camera camera = look_at_camera({0.3, height, 6}, {0, 0, 0}, radians(60), 200, 200);
        const auto registers = engine::prepare_view(object, camera);
        ASSERT_TRUE(registers.ok());
        const auto visible = renderer_->draw(*prepared, *registers, *target);
        ASSERT_TRUE(visible.ok());
        int pixels = 0;
        for (const PixelRect& rect : *visible) pixels += rect.width * rect.height;
        EXPECT_GT(pixels, 0);
        EXPECT_LT(pixels, 200 * 200 / 2);
    }
}

TEST_F(GpuRendererTest, TheLeastRecentlyUsedPhotosAreReplaced) {
    const RaySpaceObject object = test::ring_object({.views = 12});
    const auto prepared = GpuObject::create(object);
    ASSERT_TRUE(prepared.ok());
    Result<ObjectTextures> textures = ObjectTextures::create(**prepared, 3);
    ASSERT_TRUE(textures.ok());
    textures->load(**prepared, std::vector{0, 1});
    EXPECT_TRUE(textures->have_room_for(std::vector{0, 5}));
    EXPECT_FALSE(textures->have_room_for(std::vector{4, 5}));
    const int of_second = textures->layer_of(1);
    textures->load(**prepared, std::vector{1, 2});
    textures->load(**prepared, std::vector{7});  // in place of 0
    EXPECT_EQ(textures->layer_of(0), -1);
    EXPECT_EQ(textures->layer_of(1), of_second);
    EXPECT_GE(textures->layer_of(2), 0);
}

TEST_F(GpuRendererTest, TexturesStayWithinTheirMemory) {
    const RaySpaceObject object = test::ring_object({.views = 12});
    const std::int64_t limit = 2 * gpu_bytes(object, 6);
    Result<GpuRenderer> made = GpuRenderer::create({.memory_bytes = limit});
    ASSERT_TRUE(made.ok());
    const auto registers = engine::prepare_view(object, look_at_camera({0, 0, 3.5}, {0, 0, 0}, radians(40), 40, 40));
    ASSERT_TRUE(registers.ok());
    std::vector<std::shared_ptr<const GpuObject>> objects;
    for (int n = 0; n < 4; ++n) {
        auto prepared = GpuObject::create(object);
        ASSERT_TRUE(prepared.ok());
        objects.push_back(*prepared);
        ASSERT_TRUE(made->render(objects.back(), *registers, false).ok());
        EXPECT_LE(made->memory_bytes(), limit);
        EXPECT_GT(made->memory_bytes(), 0);
    }
    objects.resize(1);
    ASSERT_TRUE(made->render(objects.front(), *registers, false).ok());
    EXPECT_LE(made->memory_bytes(), gpu_bytes(object, 12));  // of one object
}

TEST_F(GpuRendererTest, ObjectsBeyondTheLimitsAreRefusedByName) {
    const RaySpaceObject object = test::ring_object({.views = 12});
    EXPECT_TRUE(check_texture_limits(object, 12, 4096, 12).ok());
    const Status layers = check_texture_limits(object, 12, 4096, 11);
    ASSERT_FALSE(layers.ok());
    EXPECT_NE(layers.error().message.find("ring: the number of photos 12"), std::string::npos);
    EXPECT_FALSE(check_texture_limits(object, 12, 47, 12).ok());
}

}  // namespace
}  // namespace rs::compositor
