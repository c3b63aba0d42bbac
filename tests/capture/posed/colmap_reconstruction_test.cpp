#include "capture/posed/colmap_reconstruction.hpp"

#include "capture/posed/cameras/colmap_model.hpp"
#include "rayspace/file/child_process.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/posed/posed_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// Counts the steps of all stages.
class StepCounter final : public Progress {
public:
    void start(const std::string&, std::int64_t total) override { total_ += total; }
    void advance(std::int64_t steps) override { done_ += steps; }
    void finish() override {}
    std::int64_t total_ = 0;
    std::int64_t done_ = 0;
};

// A program in place of COLMAP: records its arguments, and copies prepared models in the place of the mapper's.
class ColmapReconstructionTest : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "photos");
        cameras_ = test::posed_cameras(12, 60, 40);
        for (const PosedCamera& camera : cameras_) {
            ASSERT_TRUE(write_png(folder_ / "photos" / camera.photo, test::posed_photo(camera)).ok());
        }
        request_.photos = folder_ / "photos";
        request_.program = (folder_ / "colmap.sh").string();
        write_program("");
    }
    // `special`: shell commands at the start of the program; $out is the mapper's folder.
    void write_program(const std::string& special) const {
        std::ofstream(folder_ / "colmap.sh")
            << "#!/bin/sh\ncd '" << folder_.path().string() << "'\necho \"$@\" >>log\n"
            << "for a; do [ \"$last\" = --output_path ] && out=$a; last=$a; done\n"
            << special
            << "\ncase $1 in\n"
               "feature_extractor) for i in 1 2 3 4 5 6 7 8 9 10 11 12; do echo \"Processed file [$i/12]\"; done;;\n"
               "exhaustive_matcher) for i in 1 2 3 4; do echo \"Matching block [$i] in 0.1s\"; done;;\n"
               "mapper) for i in 1 2 3; do echo \"Registering image #$i (3)\"; done; cp -r models/* \"$out\";;\nesac\n";
        fs::permissions(folder_ / "colmap.sh", fs::perms::owner_all);
    }
    void write_model(const std::string& name, std::size_t first, std::size_t count) const {
        const ColmapText text = colmap_text_of(std::span(cameras_).subspan(first, count));
        const fs::path model = folder_ / name;
        fs::create_directories(model);
        ASSERT_TRUE(write_file(model / "cameras.txt", text.cameras).ok());
        ASSERT_TRUE(write_file(model / "images.txt", text.images).ok());
    }
    [[nodiscard]] std::string log() const {
        std::ifstream file(folder_ / "log");
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void expect_error(const std::string& part) const {
        const auto found = reconstruct_with_colmap(request_, nullptr);
        ASSERT_FALSE(found.ok());
        EXPECT_THAT(found.error().message, HasSubstr(part));
    }
    test::TemporaryFolder folder_;
    std::vector<PosedCamera> cameras_;
    ColmapRequest request_;
};

TEST_F(ColmapReconstructionTest, FindsTheModel) {
    write_model("models/0", 0, 12);
    StepCounter steps;
    fs::path temporary;
    {
        const auto found = reconstruct_with_colmap(request_, &steps);
        ASSERT_TRUE(found.ok()) << found.error().message;
        const auto model = read_colmap_model(found->model);
        ASSERT_TRUE(model.ok()) << model.error().message;
        EXPECT_EQ(model->cameras.size(), 12U);
        EXPECT_TRUE(found->notes.empty());
        temporary = found->folder.temporary_path();
        EXPECT_TRUE(fs::exists(temporary));
    }
    EXPECT_FALSE(fs::exists(temporary));
    EXPECT_EQ(steps.total_, 12 + 4 + 12);
    EXPECT_EQ(steps.done_, 12 + 4 + 3);
    EXPECT_THAT(log(), HasSubstr("--ImageReader.single_camera 1"));
    EXPECT_THAT(log(), Not(HasSubstr("masked")));
}

TEST_F(ColmapReconstructionTest, PhotosOfSeveralSizesHaveALensEach) {
    write_model("models/0", 0, 12);
    ASSERT_TRUE(write_png(folder_ / "photos" / cameras_[3].photo, Image<Rgba8>(40, 60)).ok());
    ASSERT_TRUE(reconstruct_with_colmap(request_, nullptr).ok());
    EXPECT_THAT(log(), HasSubstr("--ImageReader.single_camera 0"));
}

TEST_F(ColmapReconstructionTest, LargestOfSeveralModels) {
    write_model("models/0", 0, 3);
    write_model("models/1", 3, 8);
    const auto found = reconstruct_with_colmap(request_, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->model.filename(), "1");
    ASSERT_EQ(found->notes.size(), 1U);
    EXPECT_THAT(found->notes[0], HasSubstr("2 models that share too few photos, of 8, 3 photos"));
}

TEST_F(ColmapReconstructionTest, Errors) {
    expect_error("found the cameras of none of the photos");
    write_model("models/0", 0, 7);
    expect_error("cameras of 7 of 12 photos, not those of 07.png, 08.png, 09.png, 10.png, 11.png;");
    write_program("[ $1 = exhaustive_matcher ] && echo the disk is full && exit 1");
    expect_error("exhaustive_matcher ended with 1 (the disk is full)");
    request_.program = "no-such-colmap";
    expect_error("install the Debian package colmap");
}

TEST_F(ColmapReconstructionTest, ObjectAloneIfTheWholePhotosFail) {
    write_model("models/0", 0, 9);
    fs::create_directories(folder_ / "masks");
    for (const PosedCamera& camera : cameras_) {
        Image<Rgba8> mask(60, 40, Rgba8{0, 0, 0, 255});
        for (int x = 20; x < 40; ++x) mask(x, 20) = {255, 255, 255, 255};
        ASSERT_TRUE(write_png(folder_ / "masks" / camera.photo, mask).ok());
    }
    request_.masks = folder_ / "masks";
    ASSERT_TRUE(reconstruct_with_colmap(request_, nullptr).ok());
    EXPECT_THAT(log(), Not(HasSubstr("mask_path"))) << "the whole photos are sufficient";

    write_program(
        "for a; do [ \"$last\" = --ImageReader.mask_path ] && cp -r $a seen; last=$a; done\n"
        "case \"$*\" in *whole/database.db*mapper*|mapper*whole*) exit 1;; esac");
    const auto found = reconstruct_with_colmap(request_, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_THAT(found->notes.at(0), HasSubstr("relative to the object"));
    const auto mask = read_image(folder_ / "seen/00.png.png");
    ASSERT_TRUE(mask.ok()) << mask.error().message;
    EXPECT_EQ((*mask)(30, 20).r, 255);
    EXPECT_EQ((*mask)(30, 22).r, 0);
}

// Pattern with detail of three sizes, in 0..1.
double noise(const glm::dvec3& p) {
    double sum = 0;
    for (const double cells : {4.0, 11.0, 29.0}) {
        const glm::dvec3 at = p * cells, cell = glm::floor(at), part = at - cell;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
            const double hash = std::sin(glm::dot(cell + step, {127.1, 311.7, 74.7}) + cells) * 43758.5453;
            const glm::dvec3 weight = glm::abs(glm::dvec3(1) - step - part);
            sum += (hash - std::floor(hash)) * weight.x * weight.y * weight.z / 3;
        }
    }
    return sum;
}

// Photo of the object of posed_scene.hpp on a floor, both with texture.
Image<Rgba8> textured_photo(const Camera& camera) {
    constexpr int kSub = 2;
    Image<Rgba8> photo(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            double light = 0;
            for (int s = 0; s < kSub * kSub; ++s) {
                const double u = (x + (s % kSub + 0.5) / kSub - camera.cx) / camera.fl_x;
                const double v = (y + (s / kSub + 0.5) / kSub - camera.cy) / camera.fl_y;
                const glm::dvec3 ray = camera.forward() + camera.right() * u - camera.up() * v;
                glm::dvec3 p(0);
                if (!test::hit_object(camera.centre(), ray, p)) {
                    if (ray.y >= -0.05) continue;
                    p = camera.centre() + ray * ((-1.3 - camera.centre().y) / ray.y);
                }
                light += noise(p) / (kSub * kSub);
            }
            const auto code = static_cast<std::uint8_t>(255 * light);
            photo(x, y) = {code, code, code, 255};
        }
    }
    return photo;
}

TEST(Colmap, CamerasOfTheInstalledProgram) {
    const Result<int> installed = run_program({"colmap", "help"}, [](std::string_view) {});
    if (!installed.ok() || *installed != 0) GTEST_SKIP() << "COLMAP is not installed (Debian: colmap)";
    test::TemporaryFolder folder;
    fs::create_directories(folder / "photos");
    constexpr int kPhotos = 8;
    std::vector<Camera> truth;
    for (int i = 0; i < kPhotos; ++i) {
        const double turn = radians(9.0 * i), rise = radians(35 + 5.0 * (i % 3)), distance = 5 + 0.3 * (i % 2);
        const glm::dvec3 eye =
            distance * glm::dvec3(std::cos(rise) * std::sin(turn), std::sin(rise), std::cos(rise) * std::cos(turn));
        truth.push_back(look_at_camera(eye, {0, -0.3, 0}, radians(48), 240, 180));
        const std::string name = "p" + std::to_string(i) + ".png";
        ASSERT_TRUE(write_png(folder / "photos" / name, textured_photo(truth.back())).ok());
    }
    const auto found = reconstruct_with_colmap({folder / "photos", {}}, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    const auto model = read_colmap_model(found->model);
    ASSERT_TRUE(model.ok()) << model.error().message;
    ASSERT_EQ(model->cameras.size(), std::size_t{kPhotos});
    // Angles between the viewing directions do not depend on the frame.
    for (const PosedCamera& a : model->cameras) {
        for (const PosedCamera& b : model->cameras) {
            const auto index = [](const PosedCamera& camera) {
                return static_cast<std::size_t>(camera.photo[1] - '0');
            };
            const double expected = glm::dot(truth[index(a)].forward(), truth[index(b)].forward());
            const double angle = glm::dot(a.camera.forward(), b.camera.forward());
            EXPECT_NEAR(degrees(std::acos(std::min(1.0, angle))), degrees(std::acos(std::min(1.0, expected))), 0.5);
        }
    }
}

}  // namespace
}  // namespace rs::capture
