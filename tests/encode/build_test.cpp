// Builds objects from capture sets on disk: stored content, rejected sets, and upright resampling.

#include "encode/build.hpp"
#include "encode/set/upright_resampling.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "rayspace/light/capture_irradiance.hpp"
#include "rayspace/object/yuv.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fstream>

namespace rs::encode {
namespace {

std::string error_of_set(const std::filesystem::path& folder) {
    const Result<CaptureSet> set = open_capture_set(folder);
    if (!set) return set.error().message;
    const Result<BuiltObject> built = build_object(*set, {});
    return built ? "" : built.error().message;
}

TEST(Build, UprightImagesAreStoredAsTheyAreAndComeBackFromTheFile) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", test::drawn_ring(8));
    const Result<CaptureSet> set = open_capture_set(folder / "set");
    ASSERT_TRUE(set.ok()) << set.error().message;
    EXPECT_FALSE(set->resampled);
    const Result<BuiltObject> built = build_object(*set, {.map = {}, .name = "balls"});
    ASSERT_TRUE(built.ok()) << built.error().message;
    EXPECT_TRUE(built->warnings.empty());
    for (std::size_t i = 0; i < 8; ++i) {
        const Image<Rgba8> truth = test::draw_image(set->captured.views[i].camera);
        EXPECT_EQ(built->object.images[i], planar_from_rgba(truth));
    }
    ASSERT_TRUE(write_object(folder / "balls.rso", built->object).ok());
    const Result<RaySpaceObject> read = read_object(folder / "balls.rso");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->views, built->object.views);
    EXPECT_EQ(read->rings, built->object.rings);
    EXPECT_EQ(read->images, built->object.images);

    // Extract the stored images as a capture set that can be built again.
    ASSERT_TRUE(extract_images(*read, folder / "extracted").ok());
    const Result<CaptureSet> again = open_capture_set(folder / "extracted");
    ASSERT_TRUE(again.ok()) << again.error().message;
    const Result<Image<Rgba8>> image = read_upright_image(*again, 3);
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(*image, rgba_from_planar(built->object.images[3]));
}

TEST(Build, TheFootIsStoredWhereTheRigTellsIt) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(8, 20);  // pitched cameras, resampled to upright ones about the same axis
    rig.foot_height = -0.45;
    rig.object_radius = 0.9;
    test::write_drawn_set(folder / "set", rig);
    rig.foot_height.reset();
    test::write_drawn_set(folder / "silent", rig);
    const auto foot_of = [](const std::filesystem::path& path) {
        const Result<CaptureSet> set = open_capture_set(path);
        EXPECT_TRUE(set.ok());
        return build_object(*set, {})->object.foot_q20;
    };
    EXPECT_EQ(foot_of(folder / "set"), -(1 << 19));
    EXPECT_EQ(foot_of(folder / "silent"), std::nullopt);
}

TEST(Build, OneFrameIsNoObject) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(8);
    rig.views.resize(2);
    test::write_drawn_set(folder / "two", rig);
    EXPECT_EQ(error_of_set(folder / "two"), "");
    rig.views.resize(1);
    test::write_drawn_set(folder / "one", rig);
    EXPECT_NE(error_of_set(folder / "one").find("one: has one frame; an object needs"), std::string::npos);
}

TEST(Build, TheLightOfTheCaptureIsKeptWithTheRig) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(8, 20);
    IrradianceHarmonics light;
    light.add_direction({0, 1, 0}, {1, 2, 3});
    rig.extras[kCaptureIrradianceKey] = irradiance_to_json(light);
    test::write_drawn_set(folder / "set", rig);
    const auto built = build_object(open_capture_set(folder / "set").value(), {});
    ASSERT_TRUE(built.ok());
    const Rig kept = rig_from_json(built->object.rig_json, "rig").value();
    const auto found = irradiance_from_json(kept.extras.at(kCaptureIrradianceKey), "light");
    ASSERT_TRUE(found.ok());
    EXPECT_NEAR(found->at({0, 1, 0}).b, light.at({0, 1, 0}).b, 1e-6);
    rig.extras[kCaptureIrradianceKey] = "bright";
    test::write_drawn_set(folder / "wrong", rig);
    EXPECT_NE(error_of_set(folder / "wrong").find("capture_irradiance: must be"), std::string::npos);
}

TEST(Build, TheRadiusComesFromTheSilhouettesWhereTheRigDoesNotSay) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(36);
    rig.object_radius = 0;
    test::write_drawn_set(folder / "set", rig);
    const Result<CaptureSet> set = open_capture_set(folder / "set");
    ASSERT_TRUE(set.ok()) << set.error().message;
    // The outermost ball reaches hypot(0.6, 0.1) + 0.25 from the axis; a pixel is 3.5 / 130 = 0.027 there.
    EXPECT_NEAR(set->upright.object_radius, std::hypot(0.6, 0.1) + 0.25, 0.03);
}

TEST(Build, CamerasThatLookDownAreMadeUpright) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", test::drawn_ring(8, 20));
    const Result<CaptureSet> set = open_capture_set(folder / "set");
    ASSERT_TRUE(set.ok()) << set.error().message;
    EXPECT_TRUE(set->resampled);
    EXPECT_EQ(set->width % 2, 0);
    double worst = 99;
    for (int i = 0; i < 8; ++i) {
        const Camera& camera = set->upright.views[static_cast<std::size_t>(i)].camera;
        EXPECT_TRUE(is_upright(camera));
        const Result<Image<Rgba8>> image = read_upright_image(*set, i);
        ASSERT_TRUE(image.ok());
        ASSERT_EQ(image->width(), set->width);
        worst = std::min(worst, compare_images_psnr(*image, test::draw_image(camera)).psnr_db());
    }
    EXPECT_GT(worst, 26);  // resampling softens edges; a wrong homography gives below 15
}

TEST(Build, TheRadiusIsThatOfTheSilhouetteAlsoFromSteeplyAbove) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(12, 45);
    rig.object_radius = 0;
    test::write_drawn_set(folder / "set", rig);
    const Result<CaptureSet> set = open_capture_set(folder / "set");
    ASSERT_TRUE(set.ok()) << set.error().message;
    EXPECT_NEAR(set->upright.object_radius, std::hypot(0.6, 0.1) + 0.25, 0.06);
}

TEST(BuildErrors, AImageThatShowsWhatIsStraightBelowIsRefused) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(3, 58);
    for (RigView& view : rig.views) {
        view.camera.height = 600;
        view.camera.cy = 300;
    }
    test::write_drawn_set(folder / "set", rig);
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(
            write_png(folder / "set" / (std::to_string(i) + ".png"), Image<Rgba8>(96, 600, {9, 9, 9, 255})).ok());
    }
    EXPECT_NE(error_of_set(folder / "set").find("straight up or down"), std::string::npos);
}

TEST(UprightResampling, TheSameCameraGivesTheSameImage) {
    const Camera camera = test::drawn_ring(8).views[1].camera;
    const Image<Rgba8> image = test::draw_image(camera);
    EXPECT_GT(compare_images_psnr(resample_image(camera, camera, image), image).psnr_db(), 55);
}

TEST(UprightResampling, OccupiedBoxIsTight) {
    Image<Rgba8> image(10, 8);
    EXPECT_TRUE(find_occupied_box(image).empty());
    image(3, 2).a = 1;
    image(6, 5).a = 255;
    const PixelBox box = find_occupied_box(image);
    EXPECT_EQ(box.x0, 3);
    EXPECT_EQ(box.y0, 2);
    EXPECT_EQ(box.x1, 7);
    EXPECT_EQ(box.y1, 6);
}

TEST(BuildErrors, NameTheImageAndTheRemedy) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", test::drawn_ring(8));
    EXPECT_EQ(error_of_set(folder / "set"), "");

    std::filesystem::rename(folder / "set" / "3.png", folder / "away.png");
    EXPECT_NE(error_of_set(folder / "set").find("3.png"), std::string::npos);

    std::filesystem::copy_file(folder / "away.png", folder / "set" / "3.png");
    std::filesystem::resize_file(folder / "set" / "3.png", std::filesystem::file_size(folder / "away.png") / 2);
    EXPECT_NE(error_of_set(folder / "set").find("3.png"), std::string::npos);

    ASSERT_TRUE(write_png(folder / "set" / "3.png", Image<Rgba8>(90, 80)).ok());
    const std::string other_size = error_of_set(folder / "set");
    EXPECT_NE(other_size.find("3.png"), std::string::npos);
    EXPECT_NE(other_size.find("90x80"), std::string::npos);
    EXPECT_EQ(other_size.find('\n'), std::string::npos);

    EXPECT_NE(error_of_set(folder / "nowhere").find("nowhere"), std::string::npos);
}

TEST(BuildErrors, ASetThatIsAllTransparentHasNoRadius) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(3);
    rig.object_radius = 0;
    test::write_drawn_set(folder / "set", rig);
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(write_png(folder / "set" / (std::to_string(i) + ".png"), Image<Rgba8>(96, 80)).ok());
    }
    EXPECT_NE(error_of_set(folder / "set").find("transparent"), std::string::npos);
}

TEST(BuildErrors, ACameraInsideOfTheObjectIsRefused) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(3);
    rig.object_radius = 3.4;
    test::write_drawn_set(folder / "set", rig);
    EXPECT_NE(error_of_set(folder / "set").find("object_radius"), std::string::npos);
}

TEST(BuildErrors, DistortedImagesAreRefused) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(3);
    rig.extras["k1"] = 0.0;
    test::write_drawn_set(folder / "straight", rig);
    EXPECT_EQ(error_of_set(folder / "straight"), "");
    rig.extras["k1"] = -0.1;
    test::write_drawn_set(folder / "bent", rig);
    EXPECT_NE(error_of_set(folder / "bent").find("k1"), std::string::npos);
}

TEST(BuildErrors, OptionsOutOfRangeAreNamed) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", test::drawn_ring(3));
    const Result<CaptureSet> set = open_capture_set(folder / "set");
    ASSERT_TRUE(set.ok());
    for (const PlaneMapOptions map : {PlaneMapOptions{.planes = 2}, PlaneMapOptions{.planes = 65},
                                      PlaneMapOptions{.x_cells = 0}, PlaneMapOptions{.u_cells = 5000}}) {
        const Result<BuiltObject> built = build_object(*set, {.map = map, .name = "set"});
        ASSERT_FALSE(built.ok());
        EXPECT_EQ(built.error().message.rfind("--", 0), 0U) << built.error().message;
    }
}

TEST(CaptureSetMemory, IsBoundedBeforehand) {
    CaptureSet set;
    set.file = "hemisphere/transforms.json";
    set.resampled = true;
    set.width = 886;
    set.height = 5814;
    set.captured.views.resize(250);
    for (RigView& view : set.captured.views) view.camera.width = view.camera.height = 800;
    set.upright = set.captured;
    const std::int64_t needed = kEncodingBytesPerPixel * 886 * 5814 * 250;
    EXPECT_TRUE(check_memory(set, needed).ok());
    const Status refused = check_memory(set, needed - 1);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().message,
              "hemisphere/transforms.json: 250 images of 886x5814 (enlarged from 800x800 to be upright) take "
              "about 20.6 GB of memory, and this machine has 20.6; leave out the steepest views, or make the images "
              "smaller");
}

}  // namespace
}  // namespace rs::encode
