// Synthetic photos against their ground truth: marks are at their projected positions, lights are static, alpha matches
// the matte from two backdrops, the same seed yields the same bytes.

#include "capture/tracer/session/photo_session.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/tracer/test_shapes.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture::test {
namespace {

namespace fs = std::filesystem;

Mesh small_sphere(const glm::vec3& middle, float radius) {
    Mesh mesh = make_sphere(4);
    for (glm::vec3& p : mesh.positions) p = middle + radius * p;
    return mesh;
}

Material glowing() {
    Material material = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
    material.emission = glm::vec3(0.6F);
    return material;
}

// Without noise, drift and other camera errors.
PhotoOptions clean_options() {
    PhotoOptions options;
    options.session.views = 4;
    options.session.width = 320;
    options.session.height = 256;
    options.session.exposure_drift = 0;
    options.samples_per_pixel = 64;
    options.noise_codes = 0;
    options.jpeg_quality = 0;
    options.disc = DiscSurface::none;
    return options;
}

double brightness(const Rgba8& p) {
    return static_cast<double>(linear_from_srgb8(p.g));
}

glm::dvec2 centroid(const Image<Rgba8>& image) {
    glm::dvec2 sum(0);
    double weight = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            sum += brightness(image(x, y)) * glm::dvec2(x + 0.5, y + 0.5);
            weight += brightness(image(x, y));
        }
    }
    EXPECT_GT(weight, 3.0) << "no mark in the image";
    return sum / weight;
}

// Independent reader of the ground-truth file.
struct Truth {
    Rig rig;
    TurntableModel model;
    double distance = 0;
    double camera_height = 0;

    // Position of an object point in the photo of a view.
    [[nodiscard]] glm::dvec2 photo_position(const glm::dvec3& p_in_object, std::size_t view) const {
        const glm::dvec3 in_room = turned(p_in_object, model.angles_rad[view]) - glm::dvec3(0, camera_height, 0);
        return project(model.lens, model.pose, in_room / distance).value_or(glm::dvec2(-1e9));
    }
};

Truth read_truth(const fs::path& folder) {
    Truth truth;
    const Result<Rig> rig = read_rig(folder / "truth");
    if (!rig) {
        ADD_FAILURE() << rig.error().message;
        return truth;
    }
    truth.rig = *rig;
    const nlohmann::json& json = truth.rig.extras.at("turntable");
    const Camera& camera = truth.rig.views.front().camera;
    truth.model.lens = {camera.width,  camera.height, json.at("f_px"), json.at("cx"),
                        json.at("cy"), json.at("k1"), json.at("k2")};
    truth.model.pose = {json.at("pan_rad"), json.at("tilt_rad"), json.at("roll_rad")};
    truth.model.angles_rad = json.at("angles_rad").get<std::vector<double>>();
    truth.distance = json.at("distance");
    truth.camera_height = json.at("camera_height");
    return truth;
}

Image<Rgba8> image_in(const fs::path& path) {
    const Result<Image<Rgba8>> image = read_image(path);
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return Image<Rgba8>(1, 1);
    }
    return *image;
}

std::string view_file(std::size_t view) {
    return "00" + std::to_string(view) + ".png";
}

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class PhotoSession : public testing::Test {
protected:
    void SetUp() override {
        for (const auto& [name, code] : {std::pair("black.png", 0), std::pair("white.png", 255)}) {
            const auto c = static_cast<std::uint8_t>(code);
            ASSERT_TRUE(write_png(folder_ / name, Image<Rgba8>(4, 4, {c, c, c, 255}).view()).ok());
        }
    }
    [[nodiscard]] fs::path photograph(const std::string& name, const Scene& scene, double radius,
                                      const PhotoOptions& options) const {
        const auto done = write_photo_session(scene, radius, options, folder_ / name);
        EXPECT_TRUE(done.ok()) << done.error().message;
        return folder_ / name;
    }
    [[nodiscard]] std::string backdrop(const std::string& name) const { return (folder_ / (name + ".png")).string(); }

    rs::test::TemporaryFolder folder_;
};

TEST_F(PhotoSession, MarksOfTheObjectAppearWhereTheTruthProjectsThem) {
    const glm::vec3 mark(0.45F, 0.25F, 0.2F);
    PhotoOptions options = clean_options();
    options.session.k1 = -0.12;
    options.session.k2 = 0.05;
    options.session.step_error_deg = 2;
    options.backdrop = backdrop("black");
    for (const bool counter_clockwise : {false, true}) {
        options.session.counter_clockwise = counter_clockwise;
        const fs::path set =
            photograph(counter_clockwise ? "ccw" : "cw", scene_of(small_sphere(mark, 0.012F), glowing()), 0.5, options);
        const Truth truth = read_truth(set);
        ASSERT_EQ(truth.rig.views.size(), 4U);
        EXPECT_EQ(truth.model.angles_rad[1] > 0, counter_clockwise);
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec2 seen = centroid(image_in(set / "photos" / view_file(i)));
            const glm::dvec2 expected = truth.photo_position(mark, i);
            EXPECT_NEAR(seen.x, expected.x, 0.05) << "view " << i;
            EXPECT_NEAR(seen.y, expected.y, 0.05) << "view " << i;
            // Agrees with the pinhole camera of transforms.json plus lens distortion.
            const Camera& camera = truth.rig.views[i].camera;
            const glm::dvec3 pinhole = camera.project(glm::dvec3(mark));
            const auto straight = undistorted(truth.model.lens, expected);
            ASSERT_TRUE(straight.has_value());
            EXPECT_NEAR(pinhole.x, camera.cx + camera.fl_x * straight->x, 1e-3);
            EXPECT_NEAR(pinhole.y, camera.cy + camera.fl_y * straight->y, 1e-3);
            EXPECT_GT(glm::length(glm::dvec2(pinhole) - expected), i == 0 ? 0.0 : 0.05) << "no distortion to see";
        }
    }
}

TEST_F(PhotoSession, MarksOfTheBoardAppearWhereItsCornersSay) {
    Image<Rgba8> board(120, 80, {0, 0, 0, 255});
    for (int y = 8; y < 11; ++y) {
        for (int x = 90; x < 93; ++x) board(x, y) = {230, 230, 230, 255};
    }
    ASSERT_TRUE(write_png(folder_ / "board.png", board.view()).ok());
    Scene scene = scene_of(small_sphere({0, 0, 0}, 0.02F), material_of(SurfaceKind::diffuse, glm::vec3(0.0F)));
    scene.environment = constant_environment(0.8F);
    PhotoOptions options = clean_options();
    options.session.k1 = -0.12;
    options.session.elevation_deg = 40;
    options.backdrop = backdrop("black");
    options.board = folder_ / "board.png";
    options.board_width = 20;
    const fs::path set = photograph("set", scene, 0.02, options);
    const Truth truth = read_truth(set);
    const nlohmann::json corners = truth.rig.extras.at("turntable").at("board").at("corners");
    const auto corner = [&](std::size_t i) { return glm::dvec3(corners[i][0], corners[i][1], corners[i][2]); };
    const glm::dvec3 mark = corner(0) + (corner(1) - corner(0)) * (91.5 / 120) + (corner(3) - corner(0)) * (9.5 / 80);
    EXPECT_GT(std::abs(corner(0).x + corner(2).x), 1e-3) << "the board's middle is on the axis";
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 seen = centroid(image_in(set / "photos" / view_file(i)));
        const glm::dvec2 expected = truth.photo_position(mark, i);
        EXPECT_NEAR(seen.x, expected.x, 0.05) << "view " << i;
        EXPECT_NEAR(seen.y, expected.y, 0.05) << "view " << i;
    }
}

TEST_F(PhotoSession, LightsStandStillInTheRoom) {
    // A ball on the axis has the same appearance at every angle if and only if the lights are static.
    const auto lit_by = [&](const std::string& name, const std::function<void(Scene&)>& add_light) {
        Scene scene = scene_of(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(0.7F)));
        add_light(scene);
        PhotoOptions options = clean_options();
        options.session.views = 3;
        options.session.width = 80;
        options.session.height = 64;
        options.backdrop = backdrop("black");
        const fs::path set = photograph(name, scene, 1, options);
        const Image<Rgba8> first = image_in(set / "photos" / view_file(0));
        // Compares means of blocks of 8x8 pixels, to suppress the noise of the tracer.
        const auto difference = [&](const Image<Rgba8>& other) {
            double sum = 0;
            for (int block = 0; block < 10 * 8; ++block) {
                int signed_sum = 0;
                for (int i = 0; i < 64; ++i) {
                    const int x = block % 10 * 8 + i % 8, y = block / 10 * 8 + i / 8;
                    signed_sum += first(x, y).g - other(x, y).g;
                }
                sum += std::abs(signed_sum) / 64.0;
            }
            return sum / 80;
        };
        Image<Rgba8> mirrored(first.width(), first.height());
        for (int y = 0; y < first.height(); ++y) {
            for (int x = 0; x < first.width(); ++x) mirrored(x, y) = first(first.width() - 1 - x, y);
        }
        EXPECT_GT(difference(mirrored), 5) << name << " does not come from the side";
        for (std::size_t i = 1; i < 3; ++i) {
            EXPECT_LT(difference(image_in(set / "photos" / view_file(i))), 1.0) << name << ", view " << i;
        }
    };
    lit_by("directional", [](Scene& s) { s.lights = {directional_light({-1, -0.5, -0.5}, glm::vec3(2))}; });
    lit_by("point", [](Scene& s) { s.lights = {point_light({3, 1, 2}, glm::vec3(12))}; });
    lit_by("rectangle", [](Scene& s) {
        s.lights = {rectangle_light({3, 0, 2}, {-1, 0, 1}, {0, 1, 0}, glm::vec3(10))};
    });
    lit_by("environment", [](Scene& s) {
        s.environment.pixels = Image<RgbaF>(8, 1, {0.02F, 0.02F, 0.02F, 1});
        s.environment.pixels(5, 0) = {3, 3, 3, 1};
        s.environment.turn_rad = 0.3F;
    });
}

TEST_F(PhotoSession, AlphaIsWhatABlackAndAWhiteBackdropTell) {
    Scene scene = scene_of(make_sphere(1, false), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    scene.environment = constant_environment(0.5F);
    PhotoOptions options = clean_options();
    options.session.views = 2;
    options.session.width = 80;
    options.session.height = 64;
    options.session.k1 = -0.1;
    options.session.distance = 5;
    options.samples_per_pixel = 256;
    options.backdrop = backdrop("black");
    const fs::path on_black = photograph("on-black", scene, 1, options);
    options.backdrop = backdrop("white");
    const fs::path on_white = photograph("on-white", scene, 1, options);
    double truth_sum = 0, told_sum = 0;
    int edges = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const Image<Rgba8> black = image_in(on_black / "photos" / view_file(i));
        const Image<Rgba8> white = image_in(on_white / "photos" / view_file(i));
        const Image<Rgba8> alpha = image_in(on_black / "truth" / "alpha" / view_file(i));
        for (std::size_t p = 0; p < alpha.pixels().size(); ++p) {
            const double truth = alpha.pixels()[p].g / 255.0;
            const double told = 1 - (brightness(white.pixels()[p]) - brightness(black.pixels()[p]));
            EXPECT_NEAR(told, truth, 0.05);
            truth_sum += truth;
            told_sum += told;
            edges += truth > 0.1 && truth < 0.9 ? 1 : 0;
        }
    }
    EXPECT_GT(edges, 100);
    EXPECT_NEAR(told_sum / truth_sum, 1, 0.003);

    // A disc under the object changes the photo, not the object's alpha.
    options.disc = DiscSurface::speckled;
    const fs::path on_disc = photograph("on-disc", scene, 1, options);
    EXPECT_EQ(image_in(on_disc / "truth" / "alpha" / "000.png"), image_in(on_white / "truth" / "alpha" / "000.png"));
    EXPECT_NE(image_in(on_disc / "photos" / "000.png"), image_in(on_white / "photos" / "000.png"));
}

TEST_F(PhotoSession, TheObjectThrowsAShadowOnTheDiscItTouches) {
    Scene scene = scene_of(make_sphere(4), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    scene.environment = constant_environment(0.8F);
    PhotoOptions options = clean_options();
    options.session.views = 1;
    options.session.aim_error_deg = 0;
    options.session.elevation_deg = 30;
    options.disc = DiscSurface::plain;
    const fs::path set = photograph("set", scene, 1, options);
    const Truth truth = read_truth(set);
    const Image<Rgba8> photo = image_in(set / "photos" / "000.png");
    const double top = truth.rig.extras.at("turntable").at("plate").at("top");
    EXPECT_NEAR(top, -1, 1e-3) << "the lowest point of the ball";
    const auto disc_at = [&](double distance) {
        const glm::dvec2 p = truth.photo_position({0, top, distance}, 0);
        return brightness(photo(static_cast<int>(p.x), static_cast<int>(p.y)));
    };
    EXPECT_LT(disc_at(0.55), 0.75 * disc_at(1.1));  // near the visible contact, and at the rim
    EXPECT_GT(disc_at(1.1), 0.2);
}

TEST_F(PhotoSession, TheSameSeedGivesTheSameBytesWhateverTheThreads) {
    Scene scene = scene_of(make_sphere(2), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    scene.environment = constant_environment(0.5F);
    PhotoOptions options;
    options.session.views = 2;
    options.session.width = 64;
    options.session.height = 48;
    options.samples_per_pixel = 4;
    options.threads = 1;
    const fs::path a = photograph("a", scene, 1, options);
    options.threads = 3;
    const fs::path b = photograph("b", scene, 1, options);
    options.session.seed = 2;
    const fs::path c = photograph("c", scene, 1, options);
    for (const char* name : {"photos/000.jpg", "photos/001.jpg", "truth/alpha/001.png", "truth/transforms.json"}) {
        EXPECT_FALSE(bytes_of(a / name).empty()) << name;
        EXPECT_EQ(bytes_of(a / name), bytes_of(b / name)) << name;
        EXPECT_NE(bytes_of(a / name), bytes_of(c / name)) << name;
    }
}

TEST_F(PhotoSession, ReportsWhatCannotBePhotographedAndLeavesNothing) {
    const Scene scene = scene_of(make_sphere(1), material_of(SurfaceKind::diffuse));
    PhotoOptions options = clean_options();
    options.board = folder_ / "gone.png";
    auto done = write_photo_session(scene, 1, options, folder_ / "set");
    ASSERT_FALSE(done.ok());
    EXPECT_NE(done.error().message.find("gone.png"), std::string::npos);
    options = clean_options();
    options.session.k1 = -1;
    options.session.focal_widths = 0.5;
    done = write_photo_session(scene, 1, options, folder_ / "set");
    ASSERT_FALSE(done.ok());
    EXPECT_NE(done.error().message.find("k1"), std::string::npos) << done.error().message;
    EXPECT_FALSE(fs::exists(folder_ / "set"));
}

}  // namespace
}  // namespace rs::capture::test
