// Folders of capture sets.

#include "capture/tracer/session/capture_set.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/tracer/test_shapes.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

namespace rs::capture::test {
namespace {

class CountingProgress final : public Progress {
public:
    void start(const std::string&, std::int64_t total) override { total_ = total; }
    void advance(std::int64_t steps) override { done_ += steps; }
    void finish() override { finished_ = true; }
    std::int64_t total_ = 0;
    std::atomic<std::int64_t> done_ = 0;
    bool finished_ = false;
};

Rig small_ring(double first_deg = 0) {
    RingOptions ring;
    ring.count = 3;
    ring.width = 40;
    ring.height = 36;
    ring.fl_px = 1.4 * 36;
    ring.first_rad = radians(first_deg);
    Rig rig = make_ring(ring);
    rig.object_radius = 1.0;
    return rig;
}

Result<Tracer> ball() {
    Scene scene = scene_of(make_sphere(4), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    scene.environment = constant_environment(1.0F);
    return Tracer::create(std::move(scene));
}

CaptureSetOptions options_of(ImageFormat format, bool depth) {
    CaptureSetOptions options;
    options.format = format;
    options.render.samples_per_pixel = 16;
    options.render.depth = depth;
    return options;
}

// The ball encloses the origin; the floor belongs to the surroundings.
TEST(CaptureSet, IrradianceIsThatWithoutTheObject) {
    Scene scene = scene_of(make_sphere(4), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    scene.environment = constant_environment(1.0F);
    const auto open = capture_irradiance(scene);
    ASSERT_TRUE(open);
    EXPECT_NEAR(open->at({0, -1, 0}).g, 1, 1e-3F);
    scene.first_surrounding_material = static_cast<int>(scene.materials.size());
    Mesh floor = make_quad({-9, -1, 9}, {18, 0, 0}, {0, 0, -18});
    floor.material = scene.first_surrounding_material;
    scene.meshes.push_back(std::move(floor));
    scene.materials.push_back(material_of(SurfaceKind::diffuse, glm::vec3(0)));
    const auto on_floor = capture_irradiance(scene);
    ASSERT_TRUE(on_floor);
    EXPECT_LT(on_floor->at({0, -1, 0}).g, 0.2F);
    EXPECT_GT(on_floor->at({0, 1, 0}).g, 0.9F);
}

TEST(CaptureSet, WritesImagesDepthAndRig) {
    const rs::test::TemporaryFolder folder;
    const Result<Tracer> tracer = ball();
    ASSERT_TRUE(tracer);
    CountingProgress progress;
    const auto summary =
        write_capture_set(*tracer, small_ring(), options_of(ImageFormat::png, true), folder / "set", &progress);
    ASSERT_TRUE(summary) << summary.error().message;
    EXPECT_EQ(summary->views, 3);
    EXPECT_EQ(summary->clipped_views, 0);
    EXPECT_GT(summary->mean_coverage, 0.3);
    EXPECT_EQ(progress.done_, progress.total_);
    EXPECT_TRUE(progress.finished_);

    const Result<Rig> rig = read_rig(folder / "set");
    ASSERT_TRUE(rig) << rig.error().message;
    ASSERT_EQ(rig->views.size(), 3U);
    EXPECT_EQ(rig->object_radius, 1.0);
    for (const RigView& view : rig->views) {
        const Result<Image<Rgba8>> image = read_image(image_path(folder / "set", view));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width(), 40);
        EXPECT_EQ(image->height(), 36);
        double sum = 0;
        for (int x = 12; x < 28; ++x) {
            EXPECT_EQ((*image)(x, 18).a, 255);
            sum += (*image)(x, 18).g;
        }
        EXPECT_NEAR(sum / 16, 188, 2.5);  // half the light of the furnace, in sRGB
        EXPECT_EQ((*image)(0, 0), (Rgba8{0, 0, 0, 0}));
        const Result<Image<float>> depth = read_channel(folder / "set" / view.depth_file_path);
        ASSERT_TRUE(depth) << depth.error().message;
        EXPECT_NEAR((*depth)(20, 18), 2.5F, 0.01F);
        EXPECT_EQ((*depth)(0, 0), 0.0F);
    }
}

TEST(CaptureSet, ExrKeepsLinearLight) {
    const rs::test::TemporaryFolder folder;
    const Result<Tracer> tracer = ball();
    ASSERT_TRUE(tracer);
    const auto summary = write_capture_set(*tracer, small_ring(), options_of(ImageFormat::exr, false), folder / "set");
    ASSERT_TRUE(summary) << summary.error().message;
    const Result<Rig> rig = read_rig(folder / "set");
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->views[2].file_path, "002.exr");
    EXPECT_EQ(rig->views[2].depth_file_path, "");
    const Result<Image<RgbaF>> image = read_image_linear(folder / "set" / rig->views[2].file_path);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_NEAR(mean_radiance(*image).g, 0.5, 0.005);
}

TEST(CaptureSet, ReplacesOnlyCaptureSets) {
    const rs::test::TemporaryFolder folder;
    const Result<Tracer> tracer = ball();
    ASSERT_TRUE(tracer);
    const CaptureSetOptions options = options_of(ImageFormat::png, false);
    ASSERT_TRUE(write_capture_set(*tracer, small_ring(), options, folder / "set"));
    ASSERT_TRUE(write_capture_set(*tracer, small_ring(), options, folder / "set"));
    std::filesystem::create_directories(folder / "holiday");
    std::ofstream(folder / "holiday" / "beach.txt") << "precious";
    const auto refused = write_capture_set(*tracer, small_ring(), options, folder / "holiday");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("holiday"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "holiday" / "beach.txt"));
}

TEST(CaptureSet, IsRefusedWhereNoViewShowsAnything) {
    const rs::test::TemporaryFolder folder;
    const Result<Tracer> tracer = ball();
    ASSERT_TRUE(tracer);
    Rig rig = small_ring();
    for (RigView& view : rig.views) {
        for (int axis : {0, 2}) view.camera.world_from_camera[axis] *= -1.0;  // about-turn
    }
    const auto refused = write_capture_set(*tracer, rig, options_of(ImageFormat::png, false), folder / "set");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("set: no view shows the object; check the poses or the mesh"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "set"));
    // One view is enough.
    rig.views[1] = small_ring().views[1];
    EXPECT_TRUE(write_capture_set(*tracer, rig, options_of(ImageFormat::png, false), folder / "set"));
}

TEST(CaptureSet, SaysWhenTheObjectIsCutOff) {
    const rs::test::TemporaryFolder folder;
    const Result<Tracer> tracer = ball();
    ASSERT_TRUE(tracer);
    Rig rig = small_ring();
    for (RigView& view : rig.views) view.camera.fl_x = view.camera.fl_y = 200;
    const auto summary = write_capture_set(*tracer, rig, options_of(ImageFormat::png, false), folder / "set");
    ASSERT_TRUE(summary) << summary.error().message;
    EXPECT_EQ(summary->clipped_views, 3);
}

}  // namespace
}  // namespace rs::capture::test
