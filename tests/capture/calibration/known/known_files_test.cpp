#include "capture/calibration/known/known_files.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>

namespace rs::capture {
namespace {

TurntableModel turn_model() {
    TurntableModel model;
    model.lens = {640, 480, 900, 331.5, 228.25, 0, 0};
    model.pose = {radians(-1.5), radians(17), radians(2.5)};
    for (int i = 0; i < 16; ++i) model.angles_rad.push_back(radians(-9.0 * i - (i % 4)));
    return model;
}

// In another world frame: rotated, shifted and scaled.
glm::dmat4 elsewhere(const glm::dmat4& world_from_camera) {
    const glm::dmat4 moved = look_at_camera({1, 2, 3}, {-4, 1, 0.5}, 1, 10, 10).world_from_camera;
    glm::dmat4 scaled = world_from_camera;
    scaled[3] = glm::dvec4(glm::dvec3(world_from_camera[3]) * 0.37, 1);
    return moved * scaled;
}

// Text as in the Middlebury sets; every camera is rotated by about `noise_rad`, view 5 is farther away by `step` times
// its distance.
std::string middlebury_text(const TurntableModel& model, double noise_rad = 0, double step = 0) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1);
    std::ostringstream text;
    text << std::setprecision(17) << model.angles_rad.size() << "\n";
    for (std::size_t i = 0; i < model.angles_rad.size(); ++i) {
        const Lens& lens = model.lens;
        TurntableModel shaken = model;
        shaken.pose.tilt_rad += noise_rad * normal(random);
        shaken.pose.roll_rad += noise_rad * normal(random);
        glm::dmat4 in_object = object_camera(shaken, i).world_from_camera;
        if (i == 5) in_object[3] += step * in_object[2];
        const glm::dmat4 m = elsewhere(in_object);
        const glm::dvec3 rows[3] = {glm::dvec3(m[0]), -glm::dvec3(m[1]), -glm::dvec3(m[2])};
        text << "view" << i << ".png " << lens.f_px << " 0 " << lens.cx - 0.5 << " 0 " << lens.f_px << ' '
             << lens.cy - 0.5 << " 0 0 1";
        for (const glm::dvec3& row : rows) text << ' ' << row.x << ' ' << row.y << ' ' << row.z;
        for (const glm::dvec3& row : rows) text << ' ' << -glm::dot(row, glm::dvec3(m[3]));
        text << "\n";
    }
    return text.str();
}

std::string opencv_yaml(const std::string& more = "", const std::string& coefficients = "-0.12, 0.03, 0., 0., 0.") {
    return "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 900., 0., "
           "320., 0., 902., 240., 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   "
           "dt: d\n   data: [ " +
           coefficients + " ]\n" + more;
}

std::string opencv_message(const std::string& text, ImagePixels images = {}) {
    const auto file = opencv_intrinsics_from(text, "x.yml", images);
    return file.ok() ? "accepted" : file.error().message;
}

std::string middlebury_message(const std::string& text) {
    const auto file = middlebury_parameters_from(text, "x_par.txt");
    return file.ok() ? "accepted" : file.error().message;
}

void expect_turn(const KnownInputs& known, const TurntableModel& model, double tolerance) {
    ASSERT_TRUE(known.pose && known.angles_rad && known.f_px && known.principal_point && known.distortion);
    EXPECT_NEAR(known.pose->pan_rad, model.pose.pan_rad, tolerance);
    EXPECT_NEAR(known.pose->tilt_rad, model.pose.tilt_rad, tolerance);
    EXPECT_NEAR(known.pose->roll_rad, model.pose.roll_rad, tolerance);
    ASSERT_EQ(known.angles_rad->size(), model.angles_rad.size());
    for (std::size_t i = 0; i < model.angles_rad.size(); ++i)
        EXPECT_NEAR((*known.angles_rad)[i], model.angles_rad[i], tolerance) << i;
    EXPECT_EQ(known.counter_clockwise, false);
    EXPECT_NEAR(*known.f_px, model.lens.f_px, 1e-9);
    EXPECT_NEAR(known.principal_point->x, model.lens.cx, 1e-9);
    EXPECT_NEAR(known.principal_point->y, model.lens.cy, 1e-9);
}

TEST(OpencvIntrinsics, AreReadAsFileStorageWritesThem) {
    const cv::Mat1d matrix = (cv::Mat1d(3, 3) << 900, 0, 320, 0, 902, 240, 0, 0, 1);
    const cv::Mat1d coefficients = (cv::Mat1d(5, 1) << -0.12, 0.03, 0, 0, 0);
    for (const char* ending : {".yml", ".xml", ".json"}) {
        cv::FileStorage file(ending, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
        file << "image_width" << 640 << "image_height" << 480 << "cameraMatrix" << matrix << "distCoeffs"
             << coefficients;
        const std::string text = file.releaseAndGetString();
        const auto read = opencv_intrinsics_from(text, "x", {640, 480});
        ASSERT_TRUE(read.ok()) << ending << read.error().message;
        EXPECT_EQ(read->known.f_px, 901);
        EXPECT_EQ(read->known.principal_point, glm::dvec2(320.5, 240.5));
        EXPECT_EQ(read->known.distortion, glm::dvec2(-0.12, 0.03));
        EXPECT_FALSE(read->known.pose.has_value());
        EXPECT_NE(opencv_message(text, {641, 480}).find("640 x 480"), std::string::npos) << ending;
    }
    EXPECT_EQ(opencv_message(opencv_yaml()), "accepted");
}

TEST(OpencvIntrinsics, RefuseWhatTheModelDoesNotHave) {
    EXPECT_NE(opencv_message(opencv_yaml("", "-0.1, 0., 0.001, 0., 0.")).find("p1"), std::string::npos);
    EXPECT_NE(opencv_message(opencv_yaml("", "-0.1, 0., 0., 0., 0.2")).find("k3"), std::string::npos);
    std::string text = opencv_yaml();
    text.replace(text.find("902."), 4, "990.");
    EXPECT_NE(opencv_message(text).find("square"), std::string::npos);
    text = opencv_yaml();
    text.replace(text.find("902."), 4, ".Nan");
    EXPECT_NE(opencv_message(text).find("not finite"), std::string::npos);
}

TEST(OpencvIntrinsics, SurviveHostileFiles) {
    const std::string yaml = "%YAML:1.0\n---\n";
    const auto repeated = [](const std::string& part, int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += part;
        return text;
    };
    for (const std::string& text :
         {std::string(), std::string("nonsense"), std::string("%YAML:1.0"), yaml + "camera_matrix: 3\n",
          yaml + "camera_matrix: [1, 2]\n", yaml + "a: " + repeated("[", 400000), yaml + "a: " + repeated("- ", 400000),
          yaml + repeated("- ", 400000), "<?xml version=\"1.0\"?><opencv_storage>" + repeated("<a>", 300000),
          "{\"a\":" + repeated("[", 400000), std::string(std::size_t{2} << 20, ' '), yaml + std::string(10, '\0'),
          yaml + "camera_matrix: !!opencv-matrix\n   rows: 100000\n   cols: 100000\n   dt: d\n   data: [ 1. ]\n",
          yaml + "camera_matrix: !!opencv-matrix\n   rows: -3\n   cols: -3\n   dt: \"9d\"\n   data: [ 1. ]\n",
          yaml + "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ [ 1. ] ]\n"}) {
        const std::string message = opencv_message(text);
        EXPECT_EQ(message.rfind("x.yml: ", 0), 0U) << text.substr(0, 40) << " -> " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
    // Every truncation, and random byte changes.
    const std::string good = opencv_yaml("image_width: 640\nimage_height: 480\n");
    for (std::size_t length = 0; length < good.size(); ++length) (void)opencv_message(good.substr(0, length));
    std::mt19937 random(5);
    for (int trial = 0; trial < 3000; ++trial) {
        std::string text = good;
        for (int i = 0; i < 3; ++i) text[random() % text.size()] = static_cast<char>(random() % 128);
        (void)opencv_message(text);
    }
}

TEST(MiddleburyParameters, GiveTheTurnThatTheyWereMadeFrom) {
    const TurntableModel model = turn_model();
    const auto file = middlebury_parameters_from(middlebury_text(model), "x_par.txt");
    ASSERT_TRUE(file.ok()) << file.error().message;
    expect_turn(file->known, model, 1e-9);
    ASSERT_EQ(file->images.size(), 16U);
    EXPECT_EQ(file->images[3], "view3.png");
    // Small errors of a per-view calibration are averaged.
    const auto noisy = middlebury_parameters_from(middlebury_text(model, radians(0.1)), "x_par.txt");
    ASSERT_TRUE(noisy.ok()) << noisy.error().message;
    expect_turn(noisy->known, model, radians(0.25));
}

TEST(MiddleburyParameters, AnAxisThatLiesSidewaysIsFound) {
    TurntableModel model = turn_model();
    model.pose.roll_rad = radians(80);
    const auto file = middlebury_parameters_from(middlebury_text(model), "x_par.txt");
    ASSERT_TRUE(file.ok()) << file.error().message;
    expect_turn(file->known, model, 1e-9);
}

TEST(MiddleburyParameters, RefuseWhatIsNotATurntable) {
    const TurntableModel model = turn_model();
    const std::string shaken = middlebury_message(middlebury_text(model, radians(3)));
    EXPECT_NE(shaken.find("directions are off"), std::string::npos) << shaken;
    const std::string moved = middlebury_message(middlebury_text(model, 0, 0.1));
    EXPECT_NE(moved.find("positions are off"), std::string::npos) << moved;
    TurntableModel still = model;
    for (double& angle : still.angles_rad) angle = 0;
    EXPECT_NE(middlebury_message(middlebury_text(still)).find("no rotation relative"), std::string::npos);
    still.angles_rad.resize(2);
    EXPECT_NE(middlebury_message(middlebury_text(still)).find("at least 3"), std::string::npos);
}

TEST(MiddleburyParameters, ErrorsNameTheLine) {
    const std::string good = middlebury_text(turn_model());
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return middlebury_message(text.replace(text.find(from), from.size(), to));
    };
    EXPECT_NE(middlebury_message("").find("line 1"), std::string::npos);
    EXPECT_NE(with("16\n", "100000\n").find("line 1"), std::string::npos);
    EXPECT_NE(with("16\n", "2.5\n").find("line 1"), std::string::npos);
    EXPECT_NE(with("16\n", "17\n").find("line 18 is empty"), std::string::npos);
    EXPECT_NE(with("16\n", "15\n").find("more lines"), std::string::npos);
    EXPECT_NE(with("view2.png 900", "view2.png nan").find("line 4: number 1 is not a finite"), std::string::npos);
    EXPECT_NE(with("view2.png 900", "view2.png 1e300").find("line 4"), std::string::npos);
    EXPECT_NE(with("view2.png 900", "view2.png 950").find("line 4: K differs"), std::string::npos);
    EXPECT_NE(with("view2.png 900", "view2.png 9 900").find("line 4"), std::string::npos);
    EXPECT_NE(with(" 0 0 1", " 0 0 2").find("K"), std::string::npos);
    EXPECT_NE(with(" 0 0 1 ", " 0 0 1 1").find("not a rotation"), std::string::npos);
}

TEST(KnownRig, GivesTheTurnOfATransformsJson) {
    const test::TemporaryFolder folder;
    const TurntableModel model = turn_model();
    Rig rig;
    for (std::size_t i = 0; i < model.angles_rad.size(); ++i) {
        RigView view;
        view.file_path = "images/" + std::to_string(i) + ".png";
        view.camera = object_camera(model, i);
        view.camera.world_from_camera = elsewhere(view.camera.world_from_camera);
        rig.views.push_back(view);
    }
    rig.extras["k1"] = -0.05;
    const auto path = folder.path() / "transforms.json";
    ASSERT_TRUE(write_rig(path, rig).ok());
    const auto file = read_known_rig(path, {640, 480});
    ASSERT_TRUE(file.ok()) << file.error().message;
    expect_turn(file->known, model, 1e-9);
    EXPECT_EQ(file->known.distortion, glm::dvec2(-0.05, 0));
    EXPECT_EQ(file->images[2], "images/2.png");
    const auto other_size = read_known_rig(path, {320, 240});
    ASSERT_FALSE(other_size.ok());
    EXPECT_NE(other_size.error().message.find("640 x 480"), std::string::npos);

    rig.extras["p1"] = 0.01;
    ASSERT_TRUE(write_rig(path, rig).ok());
    const auto tangential = read_known_rig(path);
    ASSERT_FALSE(tangential.ok());
    EXPECT_NE(tangential.error().message.find("p1"), std::string::npos);
    rig.extras.erase("p1");
    for (const char* const camera_model : {"OPENCV_FISHEYE", "EQUIRECTANGULAR"}) {
        rig.extras["camera_model"] = camera_model;
        ASSERT_TRUE(write_rig(path, rig).ok());
        const auto other_lens = read_known_rig(path);
        ASSERT_FALSE(other_lens.ok()) << camera_model;
        EXPECT_NE(other_lens.error().message.find(camera_model), std::string::npos);
    }
    rig.extras["camera_model"] = "SIMPLE_RADIAL";
    rig.extras.erase("k1");
    rig.extras["k"] = 0.02;
    ASSERT_TRUE(write_rig(path, rig).ok());
    EXPECT_EQ(read_known_rig(path)->known.distortion, glm::dvec2(0.02, 0));
    rig.views[7].camera.fl_x *= 1.1;
    rig.views[7].camera.fl_y *= 1.1;
    ASSERT_TRUE(write_rig(path, rig).ok());
    const auto zoomed = read_known_rig(path);
    ASSERT_FALSE(zoomed.ok());
    EXPECT_NE(zoomed.error().message.find("view 8"), std::string::npos);
}

TEST(KnownFiles, AreLimitedInSizeAndNamedInErrors) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "big.yml";
    std::ofstream(path) << std::string((std::size_t{1} << 20) + 1, '#');
    const auto big = read_opencv_intrinsics(path);
    ASSERT_FALSE(big.ok());
    EXPECT_NE(big.error().message.find("big.yml"), std::string::npos);
    EXPECT_FALSE(read_middlebury_parameters(folder.path() / "absent_par.txt").ok());
    EXPECT_FALSE(read_known_rig(folder.path()).ok());
    const auto good = folder.path() / "good_par.txt";
    std::ofstream(good) << middlebury_text(turn_model());
    EXPECT_TRUE(read_middlebury_parameters(good).ok());
    std::ofstream(folder.path() / "good.yml") << opencv_yaml();
    EXPECT_TRUE(read_opencv_intrinsics(folder.path() / "good.yml").ok());
}

}  // namespace
}  // namespace rs::capture
