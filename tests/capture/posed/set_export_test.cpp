#include "capture/posed/set_export.hpp"

#include "capture/posed/cameras/camera_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/posed/posed_scene.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SetExport : public testing::Test {
protected:
    void SetUp() override {
        cameras_ = test::posed_cameras(6, 80, 60);
        cameras_[2] = test::posed_cameras(6, 60, 80)[2];
        fs::create_directories(folder_ / "set" / "images");
        for (const PosedCamera& posed : cameras_) {
            RigView view;
            view.file_path = "images/" + posed.photo;
            view.camera = posed.camera;
            rig_.views.push_back(view);
            ASSERT_TRUE(write_png(folder_ / "set" / view.file_path, test::posed_photo(posed)).ok());
        }
        ASSERT_TRUE(write_rig(folder_ / "set" / kRigFileName, rig_).ok());
    }
    [[nodiscard]] Result<std::size_t> run(ExportFormat format, std::optional<Rgba8> background = {}) const {
        return export_set({folder_ / "set", folder_ / "out", format, background, true}, nullptr);
    }
    void expect_same_cameras() const {
        const auto model = read_camera_file(folder_ / "out");
        ASSERT_TRUE(model.ok()) << model.error().message;
        ASSERT_EQ(model->cameras.size(), cameras_.size());
        for (std::size_t i = 0; i < cameras_.size(); ++i) {
            const Camera &a = cameras_[i].camera, &b = model->cameras[i].camera;
            EXPECT_EQ(fs::path(model->cameras[i].photo).filename(), cameras_[i].photo);
            EXPECT_TRUE(model->cameras[i].distortion.is_pinhole());
            EXPECT_TRUE(a.width == b.width && a.height == b.height && a.fl_x == b.fl_x && a.cy == b.cy);
            for (int c = 0; c < 4; ++c) {
                EXPECT_LT(glm::length(a.world_from_camera[c] - b.world_from_camera[c]), 1e-9);
            }
        }
    }
    test::TemporaryFolder folder_;
    std::vector<PosedCamera> cameras_;
    Rig rig_;
};

TEST_F(SetExport, ColmapModelReadsBack) {
    const auto views = run(ExportFormat::kColmap, Rgba8{255, 255, 255, 255});
    ASSERT_TRUE(views.ok()) << views.error().message;
    EXPECT_EQ(*views, 6U);
    expect_same_cameras();
    const auto image = read_image(folder_ / "out/images/00.png"), mask = read_image(folder_ / "out/masks/00.png.png");
    ASSERT_TRUE(image.ok() && mask.ok());
    const Image<Rgba8> photo = test::posed_photo(cameras_[0]);
    for (std::size_t i = 0; i < photo.pixels().size(); ++i) {
        EXPECT_EQ(image->pixels()[i], over(photo.pixels()[i], {255, 255, 255, 255}));
        EXPECT_EQ(mask->pixels()[i].g, photo.pixels()[i].a >= 128 ? 255 : 0);
    }
}

TEST_F(SetExport, ColmapAcceptsTheModel) {
    if (std::system("command -v colmap >/dev/null") != 0) GTEST_SKIP() << "colmap is not installed";
    ASSERT_TRUE(run(ExportFormat::kColmap).ok());
    const test::ToolRun tool =
        test::run_program(folder_.path(), "colmap", {"model_analyzer", "--path", (folder_ / "out/sparse/0").string()});
    EXPECT_EQ(tool.exit_code, 0) << tool.err;
    EXPECT_THAT(tool.out + tool.err, HasSubstr("Registered images: 6"));
    EXPECT_THAT(tool.out + tool.err, HasSubstr("Cameras: 2"));
}

TEST_F(SetExport, NerfstudioReadsBack) {
    const auto views = run(ExportFormat::kNerfstudio);
    ASSERT_TRUE(views.ok()) << views.error().message;
    expect_same_cameras();
    const auto model = read_camera_file(folder_ / "out");
    ASSERT_TRUE(model.ok());
    EXPECT_TRUE(fs::exists(folder_ / "out" / model->cameras[3].mask_path));
    EXPECT_EQ(*read_image(folder_ / "out/images/03.png"), *read_image(folder_ / "set/images/03.png"));
}

TEST_F(SetExport, FaultySetsAreRefused) {
    const auto error = [&] {
        const auto views = export_set({folder_ / "set", folder_ / "new", ExportFormat::kColmap, {}, false}, nullptr);
        EXPECT_FALSE(fs::exists(folder_ / "new"));
        return views ? std::string("exported") : views.error().message;
    };
    rig_.extras["k1"] = 0.1;
    ASSERT_TRUE(write_rig(folder_ / "set" / kRigFileName, rig_).ok());
    EXPECT_THAT(error(), HasSubstr("lens distortion; undistort the photos by rs-capture import"));
    rig_.extras.erase("k1");
    rig_.views[1].camera.width = 90;
    ASSERT_TRUE(write_rig(folder_ / "set" / kRigFileName, rig_).ok());
    EXPECT_THAT(error(), HasSubstr("has another size than its camera"));
    fs::remove(folder_ / "set/images/01.png");
    EXPECT_THAT(error(), HasSubstr("01.png"));
}

}  // namespace
}  // namespace rs::capture
