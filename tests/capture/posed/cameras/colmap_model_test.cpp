#include "capture/posed/cameras/colmap_model.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "tests/capture/posed/posed_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

namespace rs::capture {
namespace {

using testing::HasSubstr;

constexpr const char* kOneImage = "1 1 0 0 0 0 0 2 1 a.png\n\n";

std::string text_error(const std::string& cameras, const std::string& images = kOneImage) {
    const auto model = colmap_model_from_text(cameras, images, "sparse/0");
    return model ? "accepted" : model.error().message;
}

TEST(ColmapModel, TextOfCamerasReadsBackExactly) {
    std::vector<PosedCamera> cameras = test::posed_cameras(12, 640, 480);
    cameras[5].camera.fl_x *= 1.25;
    const ColmapText text = colmap_text_of(cameras);
    const auto model = colmap_model_from_text(text.cameras, text.images, "sparse/0");
    ASSERT_TRUE(model.ok()) << model.error().message;
    ASSERT_EQ(model->cameras.size(), cameras.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Camera &a = cameras[i].camera, &b = model->cameras[i].camera;
        EXPECT_EQ(model->cameras[i].photo, cameras[i].photo);
        EXPECT_TRUE(a.width == b.width && a.height == b.height && a.fl_x == b.fl_x && a.fl_y == b.fl_y);
        EXPECT_TRUE(a.cx == b.cx && a.cy == b.cy);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                EXPECT_NEAR(a.world_from_camera[column][row], b.world_from_camera[column][row], 1e-12);
            }
        }
    }
    EXPECT_FALSE(model->has_uncertain_axes);
}

TEST(ColmapModel, TextWithCommentsNamesWithBlanksAndPoints) {
    const auto model = colmap_model_from_text("# head\r\n\r\n7 SIMPLE_RADIAL 720 1280 1105 360 640 0.05\r\n",
                                              "# head\n3 1 0 0 0 0.5 0 2 7 day 1/a b.jpg\n10 20 -1 30 40 5\n"
                                              "4 0 0 1 0 0 0 2 7 c.jpg\n\n",
                                              "m");
    ASSERT_TRUE(model.ok()) << model.error().message;
    ASSERT_EQ(model->cameras.size(), 2U);
    EXPECT_EQ(model->cameras[0].photo, "day 1/a b.jpg");
    EXPECT_EQ(model->cameras[0].distortion.coefficients[0], 0.05);
    EXPECT_EQ(model->cameras[0].camera.fl_y, 1105);
    // The camera looks along the world's +Z from (-0.5, 0, -2), with Y down.
    EXPECT_EQ(model->cameras[0].camera.centre(), glm::dvec3(-0.5, 0, -2));
    EXPECT_EQ(model->cameras[0].camera.forward(), glm::dvec3(0, 0, 1));
    EXPECT_EQ(model->cameras[0].camera.up(), glm::dvec3(0, -1, 0));
}

TEST(ColmapModel, CameraModelsSetOpenCvsCoefficients) {
    struct Case {
        const char* line;
        LensDistortion::Model model;
        std::array<double, 8> coefficients;
    };
    using enum LensDistortion::Model;
    const Case cases[] = {
        {"SIMPLE_PINHOLE 64 48 50 32 24", kRadialTangential, {}},
        {"PINHOLE 64 48 50 51 32 24", kRadialTangential, {}},
        {"RADIAL 64 48 50 32 24 .1 .2", kRadialTangential, {.1, .2}},
        {"OPENCV 64 48 50 51 32 24 .1 .2 .3 .4", kRadialTangential, {.1, .2, .3, .4}},
        {"FULL_OPENCV 64 48 50 51 32 24 .1 .2 .3 .4 .5 .6 .7 .8", kRadialTangential, {.1, .2, .3, .4, .5, .6, .7, .8}},
        {"SIMPLE_RADIAL_FISHEYE 64 48 50 32 24 .1", kFisheye, {.1}},
        {"RADIAL_FISHEYE 64 48 50 32 24 .1 .2", kFisheye, {.1, .2}},
        {"OPENCV_FISHEYE 64 48 50 51 32 24 .1 .2 .3 .4", kFisheye, {.1, .2, .3, .4}}};
    for (const Case& c : cases) {
        const auto model = colmap_model_from_text("1 " + std::string(c.line) + "\n", kOneImage, "m");
        ASSERT_TRUE(model.ok()) << model.error().message;
        EXPECT_EQ(model->cameras[0].distortion.model, c.model) << c.line;
        EXPECT_EQ(model->cameras[0].distortion.coefficients, c.coefficients) << c.line;
        EXPECT_EQ(model->cameras[0].camera.cx, 32) << c.line;
        EXPECT_EQ(model->cameras[0].camera.cy, 24) << c.line;
    }
}

TEST(ColmapModel, FaultyTextIsRefusedWithItsPlace) {
    const std::string pinhole = "1 SIMPLE_PINHOLE 64 48 50 32 24\n";
    EXPECT_THAT(text_error("1 FOV 64 48 50 50 32 24 0.9\n"), HasSubstr("cameras.txt:1: camera model FOV is not supp"));
    EXPECT_THAT(text_error("# c\n1 PINHOLE 64 48 50 32 24\n"), HasSubstr("cameras.txt:2: a camera of model PINHOLE"));
    EXPECT_THAT(text_error("1 SIMPLE_PINHOLE 64 48 nan 32 24\n"), HasSubstr("focal length"));
    EXPECT_THAT(text_error("1 SIMPLE_PINHOLE 99999999999 48 50 32 24\n"), HasSubstr("image size"));
    EXPECT_THAT(text_error(pinhole + pinhole), HasSubstr("camera 1 is there twice"));
    EXPECT_THAT(text_error(pinhole, "1 1 0 0 0 0 0 2 9 a.png\n\n"), HasSubstr("images.txt:1: camera 9 does not exist"));
    EXPECT_THAT(text_error(pinhole, "1 0 0 0 0 0 0 2 1 a.png\n\n"), HasSubstr("quaternion"));
    EXPECT_THAT(text_error(pinhole, "1 1 0 0 0 0 0 2 1\n\n"), HasSubstr("name is empty"));
    EXPECT_THAT(text_error(pinhole, "# none\n"), HasSubstr("has no images"));
    // Without the lines of points every other image would be skipped.
    const std::string image = "1 1 0 0 0 0 0 2 1 a.png\n";
    EXPECT_THAT(text_error(pinhole, image + "2" + image.substr(1)),
                HasSubstr("images.txt:2: X Y POINT3D_ID of the image's points are expected; each image has a second"));
    EXPECT_THAT(text_error(pinhole, image + "1 2 -1 3 4\n"), HasSubstr("images.txt:2: X Y POINT3D_ID"));
    EXPECT_TRUE(colmap_model_from_text("\xef\xbb\xbf" + pinhole, "\xef\xbb\xbf" + image, "m").ok());
}

struct BinaryModel {
    ByteWriter cameras, images;
    explicit BinaryModel(int model = 2) {
        cameras.put(std::uint64_t{1});
        cameras.put(std::uint32_t{4});
        cameras.put(std::int32_t{model});
        cameras.put(std::uint64_t{720});
        cameras.put(std::uint64_t{1280});
        for (const double number : {1105.0, 360.0, 640.0, 0.05}) cameras.put(number);
        images.put(std::uint64_t{1});
        images.put(std::uint32_t{8});
        for (const double number : {0.0, 0.0, 1.0, 0.0, 0.5, 0.0, 2.0}) images.put(number);
        images.put(std::uint32_t{4});
        images.put(std::string("a/b.jpg"));
        images.put(std::uint8_t{0});
        images.put(std::uint64_t{2});
        images.put_zeros(48);
    }
};

TEST(ColmapModel, BinaryEqualsText) {
    const BinaryModel binary;
    const auto model = colmap_model_from_binary(binary.cameras.bytes(), binary.images.bytes(), "m");
    const auto text =
        colmap_model_from_text("4 SIMPLE_RADIAL 720 1280 1105 360 640 0.05\n", "8 0 0 1 0 0.5 0 2 4 a/b.jpg\n\n", "m");
    ASSERT_TRUE(model.ok()) << model.error().message;
    ASSERT_TRUE(text.ok());
    EXPECT_EQ(model->cameras[0].photo, text->cameras[0].photo);
    EXPECT_EQ(model->cameras[0].camera.world_from_camera, text->cameras[0].camera.world_from_camera);
    EXPECT_EQ(model->cameras[0].camera.height, 1280);
    EXPECT_EQ(model->cameras[0].distortion.coefficients, text->cameras[0].distortion.coefficients);
}

TEST(ColmapModel, FaultyBinaryIsRefused) {
    const auto error = [](std::span<const std::byte> cameras, std::span<const std::byte> images) {
        const auto model = colmap_model_from_binary(cameras, images, "m");
        return model ? std::string("accepted") : model.error().message;
    };
    const BinaryModel whole, fov(7);
    EXPECT_THAT(error(fov.cameras.bytes(), fov.images.bytes()), HasSubstr("camera model FOV"));
    const std::span<const std::byte> cameras = whole.cameras.bytes(), images = whole.images.bytes();
    EXPECT_THAT(error(cameras.first(40), images), HasSubstr("cut short"));
    for (std::size_t size = 0; size < images.size(); size += 7) {
        EXPECT_NE(error(cameras, images.first(size)), "accepted") << size;
    }
    BinaryModel many;  // states 2^60 points
    std::vector<std::byte> bytes(images.begin(), images.end());
    bytes[bytes.size() - 48 - 1] = std::byte{0x10};
    EXPECT_THAT(error(cameras, bytes), HasSubstr("cut short"));
}

}  // namespace
}  // namespace rs::capture
