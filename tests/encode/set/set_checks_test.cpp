// Capture sets as other tools write them.

#include "encode/set/set_checks.hpp"

#include "encode/set/capture_set.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace rs::encode {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Rig ring() {
    return make_ring({.count = 6, .distance = 3.5, .fl_px = 180, .width = 16, .height = 12});
}

// A set of grey images with a central object, in alpha if `alpha`.
class ForeignSet : public ::testing::Test {
protected:
    void write(const Rig& rig, bool alpha) {
        std::filesystem::create_directories(folder_ / "images");
        Image<Rgba8> image(16, 12, Rgba8{90, 90, 90, 255});
        if (alpha) {
            for (int y = 0; y < 12; ++y) image(0, y).a = 0;
        }
        for (const RigView& view : rig.views) {
            std::string name = view.file_path;
            std::ranges::replace(name, '\\', '/');
            const Status written = alpha ? write_png(folder_ / name, image.view()) : write_opaque(folder_ / name);
            ASSERT_TRUE(written.ok());
        }
        ASSERT_TRUE(write_rig(folder_ / kRigFileName, rig).ok());
    }
    // A PPM: three channels.
    static Status write_opaque(const std::filesystem::path& path) {
        std::ofstream(path, std::ios::binary) << "P6 16 12 255\n" << std::string(16 * 12 * 3, 'Z');
        return {};
    }
    test::TemporaryFolder folder_;
};

TEST_F(ForeignSet, ImagesWithoutAlphaNeedMasks) {
    Rig rig = ring();
    for (RigView& view : rig.views) view.file_path = view.file_path.substr(0, 11) + ".ppm";
    write(rig, false);
    const auto opaque = open_capture_set(folder_.path());
    ASSERT_FALSE(opaque);
    EXPECT_THAT(opaque.error().message, HasSubstr("no alpha channel"));
    Image<Rgba8> mask(16, 12, Rgba8{0, 0, 0, 255});
    mask(5, 5) = {255, 255, 255, 255};
    ASSERT_TRUE(write_png(folder_ / "mask.png", mask.view()));
    for (RigView& view : rig.views) view.extras["mask_path"] = "mask.png";
    write(rig, false);
    const auto masked = open_capture_set(folder_.path());
    ASSERT_TRUE(masked) << masked.error().message;
    const auto image = read_upright_image(*masked, 0);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ((*image)(5, 5).a, 255);
    EXPECT_EQ((*image)(6, 5).a, 0);
}

TEST_F(ForeignSet, BackslashesAndOtherLetterCasesFindTheImages) {
    Rig rig = ring();
    write(rig, true);
    for (RigView& view : rig.views) view.file_path = "IMAGES\\" + view.file_path.substr(7);
    ASSERT_TRUE(write_rig(folder_ / kRigFileName, rig).ok());
    const auto set = open_capture_set(folder_.path());
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_TRUE(read_upright_image(*set, 5));
}

TEST(SetChecks, LensesThatAreNotPinholesAreRefusedByName) {
    const auto fault = [](const char* key, const nlohmann::json& value, bool per_frame) {
        Rig rig = ring();
        (per_frame ? rig.views[2].extras : rig.extras)[key] = value;
        const Status checked = check_views(rig, "set/cameras.json");
        return checked ? std::string() : checked.error().message;
    };
    EXPECT_THAT(fault("is_fisheye", true, false), HasSubstr("set/cameras.json: is_fisheye"));
    EXPECT_THAT(fault("camera_model", "OPENCV_FISHEYE", false), HasSubstr("OPENCV_FISHEYE"));
    EXPECT_THAT(fault("camera_model", "EQUIRECTANGULAR", true), HasSubstr("frame 2: camera_model"));
    EXPECT_THAT(fault("ftheta_p0", 0.1, false), HasSubstr("ftheta_p0"));
    EXPECT_THAT(fault("k", -0.1, false), HasSubstr("k is not 0"));
    EXPECT_THAT(fault("k1", -0.3, true), HasSubstr("frame 2: lens distortion: k1"));
    EXPECT_THAT(fault("k1", 0.0, false), IsEmpty());
    EXPECT_THAT(fault("is_fisheye", false, false), IsEmpty());
    EXPECT_THAT(fault("camera_model", "OPENCV", false), IsEmpty());
}

TEST(SetChecks, RepeatedFramesAreLeftOutAndSharedImagesReported) {
    Rig rig = ring();
    rig.views.push_back(rig.views[1]);
    rig.views[4].file_path = rig.views[0].file_path;
    std::vector<std::string> warnings;
    remove_repeated_frames(rig, "transforms.json", warnings);
    EXPECT_THAT(rig.views, SizeIs(6));
    EXPECT_THAT(warnings,
                ElementsAre("transforms.json: 1 frame has the image of an earlier frame and its camera; left out: "
                            "frame 6 (images/0001.png)",
                            "transforms.json: 1 frame has the image of an earlier frame and another camera; correct "
                            "one of them: frame 4 (images/0000.png)"));
    for (RigView& view : rig.views) view.file_path = "one.png";
    warnings.clear();
    remove_repeated_frames(rig, "transforms.json", warnings);
    EXPECT_THAT(warnings,
                ElementsAre("transforms.json: 5 frames have the image of an earlier frame and another camera; "
                            "correct one of them: frame 1 (one.png), frame 2 (one.png), frame 3 (one.png) "
                            "and 2 more"));
}

TEST_F(ForeignSet, ATurnAboutAnotherAxisIsOpenedAsRings) {
    Rig rig = ring();
    write(rig, true);
    const auto upright = open_capture_set(folder_.path());
    ASSERT_TRUE(upright) << upright.error().message;
    EXPECT_THAT(upright->warnings, IsEmpty());
    for (RigView& view : rig.views) {  // Blender's frame, Z up, and the turntable 40 beside the origin
        glm::dmat4& m = view.camera.world_from_camera;
        for (int column = 0; column < 4; ++column) m[column] = {m[column].x, -m[column].z, m[column].y, m[column].w};
        m[3].x += 40;
    }
    write(rig, true);
    const auto set = open_capture_set(folder_.path());
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_FALSE(set->posed);
    EXPECT_THAT(set->warnings, ElementsAre(HasSubstr("one turn about another axis than Y")));
    EXPECT_NEAR(set->upright.object_radius, upright->upright.object_radius, 1e-6);
}

}  // namespace
}  // namespace rs::encode
