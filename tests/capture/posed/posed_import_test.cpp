#include "capture/posed/posed_import.hpp"

#include "capture/posed/cameras/colmap_model.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/posed/posed_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

json rows_of(const glm::dmat4& m) {
    json rows = json::array();
    for (int row = 0; row < 4; ++row) rows.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
    return rows;
}

class PosedImport : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "photos");
        cameras_ = test::posed_cameras(14, 160, 120);
    }
    void write_photos() const {
        for (const PosedCamera& camera : cameras_) {
            ASSERT_TRUE(write_png(folder_ / "photos" / camera.photo, test::posed_photo(camera)).ok());
        }
    }
    // Lenses and poses in the world's frame, in OpenGL's axes or OpenCV's.
    void write_transforms(bool opencv = false) const {
        json content = {{"frames", json::array()}};
        for (const PosedCamera& posed : cameras_) {
            const Camera& camera = posed.camera;
            glm::dmat4 pose = world_.pose(camera.world_from_camera);
            if (opencv) pose[1] = -pose[1];
            if (opencv) pose[2] = -pose[2];
            const auto& k = posed.distortion.coefficients;
            json frame = {{"file_path", "./images\\" + fs::path(posed.photo).stem().string()},
                          {"w", camera.width},
                          {"h", camera.height},
                          {"fl_x", camera.fl_x},
                          {"fl_y", camera.fl_y},
                          {"cx", camera.cx},
                          {"cy", camera.cy},
                          {"k1", k[0]},
                          {"k2", k[1]},
                          {"p1", k[2]},
                          {"p2", k[3]},
                          {"transform_matrix", rows_of(pose)}};
            content["frames"].push_back(frame);
        }
        ASSERT_TRUE(write_file(folder_ / "transforms.json", content.dump()).ok());
    }
    [[nodiscard]] Result<PosedImportReport> import() const {
        PosedImportOptions options = options_;
        options.photos = folder_ / "photos";
        options.cameras = folder_ / "transforms.json";
        options.output = folder_ / "set";
        return import_posed_photos(options, nullptr);
    }
    [[nodiscard]] std::string error() const {
        const auto report = import();
        EXPECT_FALSE(fs::exists(folder_ / "set")) << "nothing is written";
        return report ? "imported" : report.error().message;
    }
    [[nodiscard]] Rig set() const {
        auto rig = read_rig(folder_ / "set");
        EXPECT_TRUE(rig.ok());
        return rig ? *rig : Rig{};
    }
    // The cameras of the set are those of the photos, up to one similarity.
    void expect_exact_cameras(const Rig& rig, double radius) const {
        ASSERT_EQ(rig.views.size(), cameras_.size());
        const Camera &a = rig.views[0].camera, &truth = cameras_[0].camera;
        const glm::dmat3 turn = glm::dmat3(a.world_from_camera) * glm::transpose(glm::dmat3(truth.world_from_camera));
        const double scale = world_.scale / radius;
        for (std::size_t i = 1; i < rig.views.size(); ++i) {
            const glm::dmat4 &b = rig.views[i].camera.world_from_camera, &from = cameras_[i].camera.world_from_camera;
            const glm::dmat3 turned = turn * glm::dmat3(from);
            const glm::dvec3 moved = a.centre() + turn * (glm::dvec3(from[3]) - truth.centre()) * scale;
            for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(turned[c] - glm::dvec3(b[c])), 1e-9);
            EXPECT_LT(glm::length(moved - glm::dvec3(b[3])), 1e-9);
        }
    }
    // The images are those of pinhole cameras.
    void expect_straight_images(const Rig& rig) const {
        for (std::size_t i = 0; i < rig.views.size(); ++i) {
            PosedCamera pinhole{"", "", rig.views[i].camera, {}};
            pinhole.camera.world_from_camera = cameras_[i].camera.world_from_camera;
            const Image<Rgba8> truth = test::posed_photo(pinhole);
            const auto image = read_image(folder_ / "set" / rig.views[i].file_path);
            ASSERT_TRUE(image.ok());
            ASSERT_TRUE(image->width() == truth.width() && image->height() == truth.height());
            double sum = 0, count = 0;
            for (std::size_t p = 0; p < truth.pixels().size(); ++p) {
                const Rgba8 &a = truth.pixels()[p], &b = image->pixels()[p];
                EXPECT_LT(std::abs(a.a - b.a), 140);
                if (a.a < 255 || b.a < 255) continue;
                sum += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
                count += 3;
            }
            EXPECT_LT(sum / count, 2) << i;
        }
    }

    test::TemporaryFolder folder_;
    test::PosedWorld world_ = test::z_up_world();
    std::vector<PosedCamera> cameras_;
    PosedImportOptions options_;
};

TEST_F(PosedImport, DistortedPhotosOfAZUpWorld) {
    for (PosedCamera& camera : cameras_) camera.distortion.coefficients = {-0.2, 0.05, 0.004, -0.006};
    write_photos();
    write_transforms();
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->undistorted, cameras_.size());
    EXPECT_EQ(report->segmenter, SegmenterKind::kAlpha);
    EXPECT_GT(report->up.direction.z, 1 - 1e-9);
    // The ellipsoid with the ball beside it: x from -1 to 1.3, y from -1.3 to 1.3.
    const glm::dvec3 truth = world_.rotation * glm::dvec3(0.15, 0, 0) * world_.scale + world_.shift;
    EXPECT_LT(glm::length(report->origin - truth), 0.15 * world_.scale);
    EXPECT_NEAR(report->radius / world_.scale, 1.15, 0.08);
    const Rig rig = set();
    EXPECT_EQ(rig.object_radius, 1);
    EXPECT_EQ(rig.extras.at("posed"), true);
    expect_exact_cameras(rig, report->radius);
    expect_straight_images(rig);
    // The object's Y is up, the first camera is above +Z.
    EXPECT_NEAR(rig.views[0].camera.centre().x, 0, 1e-9);
    EXPECT_GT(rig.views[0].camera.centre().z, 2);
    for (const RigView& view : rig.views) EXPECT_NEAR(view.camera.right().y, 0, 1e-9);
    for (const char* const key : {"k1", "k2", "p1", "p2", "camera_model"}) EXPECT_FALSE(rig.extras.contains(key));
}

TEST_F(PosedImport, PortraitAndLandscape) {
    const std::vector<PosedCamera> portrait = test::posed_cameras(14, 120, 160);
    for (std::size_t i = 0; i < cameras_.size(); i += 3) cameras_[i] = portrait[i];
    write_photos();
    write_transforms(true);
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_THAT(report->sizes, testing::UnorderedElementsAre("160x120", "120x160"));
    EXPECT_THAT(report->notes, ElementsAre(HasSubstr("OpenCV's (Y down)")));
    const Rig rig = set();
    expect_exact_cameras(rig, report->radius);
    EXPECT_EQ(rig.views[3].camera.height, 160);
    EXPECT_EQ(rig.views[3].camera.cx, cameras_[3].camera.cx);
    options_.axes = CameraAxes::kOpenGl;
    fs::remove_all(folder_ / "set");
    EXPECT_THAT(error(), HasSubstr("look away from the object"));
}

TEST_F(PosedImport, ReducesLargePhotos) {
    options_.max_side_px = 80;
    write_photos();
    write_transforms();
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    const Rig rig = set();
    EXPECT_EQ(rig.views[0].camera.width, 80);
    EXPECT_NEAR(rig.views[0].camera.fl_x, cameras_[0].camera.fl_x / 2, 1e-9);
    EXPECT_NEAR(rig.views[0].camera.cx, 40 + 2.25 / 2, 1e-9);
    expect_exact_cameras(rig, report->radius);
}

TEST_F(PosedImport, MasksOfTheFramesComeFirst) {
    write_photos();
    write_transforms();
    fs::create_directories(folder_ / "masks");
    auto content =
        json::parse(std::string(reinterpret_cast<const char*>(read_file(folder_ / "transforms.json", 1 << 20)->data()),
                                fs::file_size(folder_ / "transforms.json")));
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
        Image<Rgba8> mask(160, 120, {0, 0, 0, 255});  // the photo's alpha, without its right half
        const Image<Rgba8> photo = test::posed_photo(cameras_[i]);
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 100; ++x) {
                if (photo(x, y).a >= 128) mask(x, y) = {255, 255, 255, 255};
            }
        }
        const std::string name = "masks/m" + std::to_string(i) + ".png";
        ASSERT_TRUE(write_png(folder_ / name, mask).ok());
        content["frames"][i]["mask_path"] = name;
    }
    ASSERT_TRUE(write_file(folder_ / "transforms.json", content.dump()).ok());
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->segmenter, SegmenterKind::kMasks);
    const auto image = read_image(folder_ / "set/images/0003.png");
    ASSERT_TRUE(image.ok());
    EXPECT_EQ((*image)(110, 60).a, 0);
    content["frames"][2].erase("mask_path");
    ASSERT_TRUE(write_file(folder_ / "transforms.json", content.dump()).ok());
    fs::remove_all(folder_ / "set");
    EXPECT_THAT(error(), HasSubstr("1 of 14 frames have no mask_path, the first is 02.png"));
}

TEST_F(PosedImport, ReportsPhotosAndCamerasWithoutTheOther) {
    write_photos();
    write_transforms();
    fs::rename(folder_ / "photos/04.png", folder_ / "photos/IMG_4.png");
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_THAT(report->without_camera, ElementsAre("IMG_4.png"));
    EXPECT_THAT(report->without_photo, ElementsAre("./images/04"));
    EXPECT_EQ(report->views, 13U);
    EXPECT_THAT(report->notes, ElementsAre(HasSubstr("1 photo without a camera, left out: IMG_4.png"),
                                           HasSubstr("1 photo of the cameras' file not found")));
}

TEST_F(PosedImport, PhotosWithoutTheObjectAreLeftOut) {
    write_photos();
    write_transforms();
    ASSERT_TRUE(write_png(folder_ / "photos/02.png", Image<Rgba8>(160, 120)).ok());
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_THAT(report->without_object, ElementsAre("02.png"));
    const Rig rig = set();
    ASSERT_EQ(rig.views.size(), 13U);
    EXPECT_EQ(rig.views[2].file_path, "images/0002.png");
    EXPECT_EQ(rig.views[2].extras.at("source_file"), "03.png");
    EXPECT_TRUE(fs::exists(folder_ / "set/images/0012.png"));
    EXPECT_FALSE(fs::exists(folder_ / "set/images/0013.png"));
}

TEST_F(PosedImport, FaultyInputIsRefusedWithTheRemedy) {
    write_photos();
    for (PosedCamera& camera : cameras_) camera.camera.width = 200;
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("00.png: is 160x120, its camera in"));
    for (PosedCamera& camera : cameras_) camera.camera.width = 160;

    std::vector<PosedCamera> whole = cameras_;
    for (PosedCamera& camera : cameras_) camera.photo = "other" + camera.photo;
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("has none of the 14 photos"));

    cameras_ = whole;  // poses of other photos
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
        Camera& camera = cameras_[i].camera;
        const glm::dvec3 aside = (i % 2 == 0 ? 4.0 : -4.0) * camera.right();
        camera.world_from_camera[3] += glm::dvec4(aside, 0);
    }
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("no common volume"));

    cameras_ = whole;  // one camera in the object
    cameras_[5].camera.world_from_camera[3] = glm::dvec4(0.9 * cameras_[5].camera.world_from_camera[2]) * 0.5;
    cameras_[5].camera.world_from_camera[3].w = 1;
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("05.png is inside the object's bounding cylinder"));

    cameras_ = whole;  // one camera looks away
    glm::dmat4& turned = cameras_[5].camera.world_from_camera;
    turned[0] = -turned[0];
    turned[2] = -turned[2];
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("05.png looks away from the object"));

    cameras_ = {whole[0], whole[1]};
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("2 photos have a camera and show the object; at least 3"));
}

TEST_F(PosedImport, MasksThatDoNotAgreeAreRefused) {
    write_photos();
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
        Camera& camera = cameras_[i].camera;
        camera.world_from_camera[3] += glm::dvec4((i % 2 == 0 ? 0.5 : -0.5) * camera.right(), 0);
    }
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("check that each photo has its own camera"));
    options_.force = true;
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_THAT(report->notes, testing::Contains(HasSubstr("is background by the other photos")));
}

TEST_F(PosedImport, OpacityOfMasksNeedsMasks) {
    write_photos();
    write_transforms();
    options_.segmentation.masks_are_alpha = true;
    EXPECT_THAT(error(), HasSubstr("--masks-alpha: needs a folder of masks"));
}

TEST_F(PosedImport, OpaquePhotosAreSegmentedByAllViews) {
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
        Image<Rgba8> photo = test::posed_photo(cameras_[i]);
        for (int y = 0; y < photo.height(); ++y) {
            for (int x = 0; x < photo.width(); ++x) {
                const bool is_wall = y < 30 + 3 * static_cast<int>(i);
                const int tone = (is_wall ? 200 : 235) - static_cast<int>(i);
                photo(x, y) = over(photo(x, y), {static_cast<std::uint8_t>(tone), static_cast<std::uint8_t>(tone - 5),
                                                 static_cast<std::uint8_t>(tone - 20), 255});
            }
        }
        ASSERT_TRUE(write_png(folder_ / "photos" / cameras_[i].photo, photo).ok());
    }
    write_transforms();
    const auto report = import();
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->views, cameras_.size());
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
        const Image<Rgba8> truth = test::posed_photo(cameras_[i]);
        const auto image = read_image(
            folder_ / "set/images" / (i < 10 ? "000" + std::to_string(i) + ".png" : "00" + std::to_string(i) + ".png"));
        ASSERT_TRUE(image.ok());
        double object = 0, wrong = 0;
        for (std::size_t pixel = 0; pixel < truth.pixels().size(); ++pixel) {
            object += truth.pixels()[pixel].a;
            wrong += std::abs(truth.pixels()[pixel].a - image->pixels()[pixel].a);
        }
        EXPECT_LT(wrong, 0.06 * object) << i;
    }
}

TEST_F(PosedImport, FramesFullOfBackgroundAreRefused) {
    std::mt19937 generator(7);
    for (const PosedCamera& camera : cameras_) {  // blocks of random colours around the object
        Image<Rgba8> photo = test::posed_photo(camera);
        for (int top = 0; top < 120; top += 8) {
            for (int left = 0; left < 160; left += 8) {
                const auto tone = [&] { return static_cast<std::uint8_t>(generator() % 256); };
                const Rgba8 block{tone(), tone(), tone(), 255};
                for (int y = top; y < top + 8; ++y) {
                    for (int x = left; x < left + 8; ++x) photo(x, y) = over(photo(x, y), block);
                }
            }
        }
        ASSERT_TRUE(write_png(folder_ / "photos" / camera.photo, photo).ok());
    }
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("the object fills the frame in"));
}

TEST_F(PosedImport, OpaquePhotosOfAMovingCameraNeedMasks) {
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
        Image<Rgba8> photo = test::posed_photo(cameras_[i]);
        for (int y = 0; y < photo.height(); ++y) {
            for (int x = 0; x < photo.width(); ++x) {
                const auto wave = [&](double f) { return static_cast<std::uint8_t>(128 + 100 * std::sin(f)); };
                const double phase = 0.1 * x * (1 + 0.1 * double(i)) + 0.2 * y * std::cos(double(i));
                photo(x, y) = over(photo(x, y), {wave(phase), wave(1.3 * phase), wave(0.7 * phase + 1), 255});
            }
        }
        ASSERT_TRUE(write_png(folder_ / "photos" / cameras_[i].photo, photo).ok());
    }
    write_transforms();
    EXPECT_THAT(error(), HasSubstr("--masks"));
}

}  // namespace
}  // namespace rs::capture
