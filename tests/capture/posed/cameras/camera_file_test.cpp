#include "capture/posed/cameras/camera_file.hpp"

#include "capture/posed/cameras/colmap_model.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/capture/posed/posed_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

json frame(const std::string& name, double x = 0) {
    return {{"file_path", name}, {"transform_matrix", {{1, 0, 0, x}, {0, 1, 0, 0}, {0, 0, 1, 4}, {0, 0, 0, 1}}}};
}

class CameraFile : public testing::Test {
protected:
    void write(const std::string& name, const json& content) const {
        ASSERT_TRUE(write_file(folder_ / name, content.dump()).ok());
    }
    [[nodiscard]] json set() const {
        return {{"w", 640.0}, {"h", 480.0}, {"fl_x", 600}, {"frames", {frame("images\\a.png"), frame("./b", 1)}}};
    }
    [[nodiscard]] std::string error_of(const std::string& name) const {
        const auto model = read_camera_file(folder_ / name);
        return model ? "accepted" : model.error().message;
    }
    test::TemporaryFolder folder_;
};

TEST_F(CameraFile, TransformsHaveLensesPerFrame) {
    json content = set();
    content["camera_model"] = "OPENCV";
    content["k1"] = -0.1;
    content["p2"] = 0.01;
    content["frames"][1]["k1"] = 0.2;
    content["frames"][1]["w"] = 480;
    content["frames"][1]["h"] = 640;
    content["frames"][1]["mask_path"] = "masks/b.png";
    write("transforms.json", content);
    const auto model = read_camera_file(folder_.path());
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_TRUE(model->has_uncertain_axes);
    ASSERT_EQ(model->cameras.size(), 2U);
    EXPECT_EQ(model->cameras[0].photo, "images/a.png");
    EXPECT_EQ(model->cameras[0].distortion.coefficients, (std::array<double, 8>{-0.1, 0, 0, 0.01}));
    EXPECT_EQ(model->cameras[1].distortion.coefficients, (std::array<double, 8>{0.2, 0, 0, 0.01}));
    EXPECT_EQ(model->cameras[1].camera.height, 640);
    EXPECT_EQ(model->cameras[1].mask_path, "masks/b.png");
}

TEST_F(CameraFile, LensesOfOtherKindsAreRefusedByName) {
    const auto lens = [](const json& keys) { return lens_distortion_of(keys, json::object(), "t.json"); };
    EXPECT_EQ(lens({{"camera_model", "OPENCV_FISHEYE"}, {"k4", 0.5}})->coefficients[3], 0.5);
    EXPECT_EQ(lens({{"is_fisheye", true}})->model, LensDistortion::Model::kFisheye);
    EXPECT_EQ(lens({{"camera_model", "SIMPLE_RADIAL"}, {"k", 0.5}})->coefficients[0], 0.5);
    EXPECT_TRUE(lens(json::object())->is_pinhole());
    EXPECT_THAT(lens({{"camera_model", "EQUIRECTANGULAR"}}).error().message, HasSubstr("EQUIRECTANGULAR"));
    EXPECT_THAT(lens({{"latlong", true}}).error().message, HasSubstr("latlong"));
    EXPECT_THAT(lens({{"ftheta_p0", 1}}).error().message, HasSubstr("ftheta_p0"));
    EXPECT_THAT(lens({{"k1", "much"}}).error().message, HasSubstr("k1 must be a number"));
}

TEST_F(CameraFile, SplitsOfNerfDataAreOneModel) {
    json train = set(), test = set();
    test["frames"] = {frame("./test/r_0", 2)};
    write("transforms_train.json", train);
    write("transforms_test.json", test);
    const auto model = read_camera_file(folder_.path());
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_EQ(model->cameras.size(), 3U);
}

TEST_F(CameraFile, FaultyFramesAreRefused) {
    json content = set();
    content["frames"].push_back(frame("./b", 1));
    write("transforms.json", content);
    EXPECT_EQ(read_camera_file(folder_.path())->cameras.size(), 2U) << "a repeated frame counts once";
    content["frames"][2] = frame("./b", 3);
    write("transforms.json", content);
    EXPECT_THAT(error_of("transforms.json"), HasSubstr("frame 2 has the image of an earlier one"));
    content["frames"][2] = frame("c");
    content["frames"][2]["transform_matrix"][0][0] = -1;
    write("transforms.json", content);
    EXPECT_THAT(error_of("transforms.json"), HasSubstr("mirrors"));
    content["frames"][2]["transform_matrix"] = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}};
    write("transforms.json", content);
    EXPECT_THAT(error_of("transforms.json"), HasSubstr("remove the scale"));
    EXPECT_THAT(error_of("cameras.yml"), HasSubstr("unknown file type"));
    content = set();
    content["cx"] = content["cy"] = 0.5;
    write("transforms.json", content);
    EXPECT_THAT(error_of("transforms.json"), HasSubstr("give cx and cy in pixels"));
    content = set();
    content["fl_x"] = 0.9;
    write("transforms.json", content);
    EXPECT_THAT(error_of("transforms.json"), HasSubstr("frame 0: its focal length is below 5 %"));
}

TEST_F(CameraFile, FindsColmapModelsAndMiddleburyFiles) {
    fs::create_directories(folder_ / "sparse" / "0");
    const ColmapText text = colmap_text_of(test::posed_cameras(4, 64, 48));
    ASSERT_TRUE(write_file(folder_ / "sparse/0/cameras.txt", text.cameras).ok());
    ASSERT_TRUE(write_file(folder_ / "sparse/0/images.txt", text.images).ok());
    for (const char* const name : {"", "sparse", "sparse/0", "sparse/0/images.txt"}) {
        const auto model = read_camera_file(folder_ / name);
        ASSERT_TRUE(model.ok()) << model.error().message;
        EXPECT_EQ(model->cameras.size(), 4U);
        EXPECT_TRUE(model->notes.empty());
    }
    fs::copy(folder_ / "sparse/0", folder_ / "sparse/1");
    EXPECT_THAT(read_camera_file(folder_.path())->notes, ElementsAre(HasSubstr("sparse/0 is read, of several models")));
    fs::create_directories(folder_ / "temple");
    EXPECT_THAT(error_of("temple"), HasSubstr("has no cameras"));
    ASSERT_TRUE(
        write_file(folder_ / "temple/t_par.txt", "1\na.png 900 0 320 0 903 240 0 0 1 1 0 0 0 1 0 0 0 1 0 0 2\n").ok());
    const auto model = read_camera_file(folder_ / "temple");
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_EQ(model->cameras[0].camera.fl_y, 903);
    EXPECT_EQ(model->cameras[0].camera.cx, 320.5);
    EXPECT_EQ(model->cameras[0].camera.width, 0) << "the file has no sizes";
    EXPECT_EQ(model->cameras[0].camera.centre(), glm::dvec3(0, 0, -2));
}

}  // namespace
}  // namespace rs::capture
