// Choice of the rig by import: the most accurate method that succeeds, and notes on those that failed.

#include "capture/photos/import.hpp"
#include "capture/photos/report/import_report.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/calibration/board_photos.hpp"
#include "tests/capture/calibration/drawn_figure.hpp"
#include "tests/capture/photos/drum_photos.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class PhotoCalibrationTest : public test::DrumPhotos {};

TEST_F(PhotoCalibrationTest, PointsAreTakenFirstWhereNothingElseIsGiven) {
    write_spotted();
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->method, CalibrationMethod::kTracks);
    EXPECT_THAT(report->notes, IsEmpty());
    EXPECT_EQ(report->views, test::kViews);
    EXPECT_NEAR(report->step_deg, 20, 0.1);
    EXPECT_EQ(report->turning, Turning::kClockwise);
    const Result<Rig> rig = read_rig(options_.output);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    ASSERT_EQ(rig->views.size(), static_cast<std::size_t>(test::kViews));
    const auto& made = rig->extras["photo_import"];
    EXPECT_EQ(made["calibration"], "tracks");
    EXPECT_NEAR(made["photograph_camera"]["tilt_deg"].get<double>(), 20, 0.5);
    EXPECT_NEAR(made["angles_deg"][9].get<double>(), -180, 0.3);
    EXPECT_EQ(made["standard_deviations"]["f_px"], 0) << "it was given";
    EXPECT_EQ(rig->views[3].extras["source_file"], "03.png");

    // The page has the images and the tables.
    const Result<std::string> page = import_page(options_.photos, *report);
    ASSERT_TRUE(page.ok()) << page.error().message;
    for (const char* part : {"<table", "focal length, px", "620.0", "fixed", "median step", "Alpha mattes over magenta",
                             "The axis and the points", "data:image/", "<svg", "No warnings"}) {
        EXPECT_THAT(*page, HasSubstr(part));
    }
}

TEST_F(PhotoCalibrationTest, WhatIsGivenWholeIsTakenAsItIs) {
    write_plain();  // nothing could be estimated
    options_.known = truth();
    options_.turning.reset();
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->method, CalibrationMethod::kGiven);
    ASSERT_TRUE(report->calibration.calibration.has_value());
    const TurntableModel& model = report->calibration.calibration->model;
    EXPECT_EQ(model.lens.f_px, 620);
    EXPECT_EQ(model.pose.tilt_rad, test::drum_model().pose.tilt_rad);
    EXPECT_EQ(model.angles_rad, test::drum_model().angles_rad);
    EXPECT_NEAR(report->step_deg, 20, 1e-9);
    EXPECT_EQ(report->turning, Turning::kClockwise);
    EXPECT_EQ(read_rig(options_.output)->views.size(), static_cast<std::size_t>(test::kViews));
}

TEST_F(PhotoCalibrationTest, ABoardThatIsNotThereIsSaidAndTheNextIsTaken) {
    write_plain();
    options_.known = truth();
    options_.board = BoardDesign{};
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->method, CalibrationMethod::kGiven);
    EXPECT_THAT(report->notes, Contains(HasSubstr("no calibration from the board: ")));

    options_.calibration = CalibrationChoice::kBoard;
    std::filesystem::remove_all(options_.output);
    expect_error(HasSubstr("board"));
    options_.board.reset();
    expect_error(HasSubstr("--board default"));
}

TEST_F(PhotoCalibrationTest, WithoutPointsTheOutlinesAndThenAssumptionsAreTaken) {
    write_plain();
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_THAT(report->notes, Contains(AllOf(HasSubstr("no calibration from points"), HasSubstr("board"))));
    EXPECT_EQ(report->method,
              report->calibration.calibration ? CalibrationMethod::kSilhouettes : CalibrationMethod::kNominal);
    EXPECT_NEAR(report->step_deg, 20, 0.1);

    options_.calibration = CalibrationChoice::kTracks;
    std::filesystem::remove_all(options_.output);
    expect_error(AllOf(HasSubstr("points of the object can be tracked"), HasSubstr("rs-capture board")));
}

TEST_F(PhotoCalibrationTest, AChoiceIsTakenOrFails) {
    write_spotted();
    options_.calibration = CalibrationChoice::kSilhouettes;
    const Result<ImportReport> outlines = import_photos(options_, nullptr);
    ASSERT_TRUE(outlines.ok()) << outlines.error().message;
    EXPECT_EQ(outlines->method, CalibrationMethod::kSilhouettes);
    ASSERT_TRUE(outlines->calibration.calibration.has_value());
    const Calibration& found = *outlines->calibration.calibration;
    const TurntableModel model = test::drum_model();
    EXPECT_NEAR(*axis_column(found.model.lens, found.model.pose, 128), *axis_column(model.lens, model.pose, 128), 0.5);
    EXPECT_TRUE(std::isinf(found.deviations.angles_rad[3]));
    const auto page = import_page(options_.photos, *outlines);
    ASSERT_TRUE(page.ok()) << page.error().message;
    EXPECT_THAT(*page, HasSubstr("the silhouettes of the object alone"));

    options_.calibration = CalibrationChoice::kNominal;
    const Result<ImportReport> nominal = import_photos(options_, nullptr);
    ASSERT_TRUE(nominal.ok()) << nominal.error().message;
    EXPECT_EQ(nominal->method, CalibrationMethod::kNominal);
    EXPECT_FALSE(nominal->calibration.calibration.has_value());
    EXPECT_THAT(nominal->notes, Contains(HasSubstr("ignores the values given by --known")));
    const auto plain_page = import_page(options_.photos, *nominal);
    ASSERT_TRUE(plain_page.ok()) << plain_page.error().message;
    EXPECT_THAT(*plain_page, AllOf(HasSubstr("Based on assumptions"), Not(HasSubstr("Estimates"))));
}

Image<Rgba8> grey_where(const Image<std::uint8_t>& mask) {
    Image<Rgba8> image(mask.width(), mask.height());
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) image.pixels()[i] = {120, 120, 120, mask.pixels()[i]};
    return image;
}

// One image is duplicated, and the last of the turn is missing.
TEST_F(PhotoCalibrationTest, OutlinesMayRepeatAndLackAView) {
    constexpr std::size_t kFigureViews = 24;
    constexpr std::size_t kTwice = 9;
    const TurntableModel truth = turn_of_figure(kFigureViews);
    const auto masks = drawn(figure(), truth);
    for (std::size_t i = 0; i < kFigureViews; ++i) write(i, grey_where(masks[i > kTwice ? i - 1 : i]));
    options_.calibration = CalibrationChoice::kSilhouettes;
    options_.known = {};
    options_.turning = Turning::kCounterClockwise;
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->views, 23);
    EXPECT_EQ(report->left_out, std::vector<std::string>{"10.png"});
    EXPECT_NEAR(report->step_deg, 15, 0.1);
    EXPECT_LT(report->calibration.calibration->rms_px, 0.3);
}

// Without texture the direction of turning follows only from silhouettes that are inconsistent with the other.
TEST_F(PhotoCalibrationTest, OutlinesTellTheSenseOfTurning) {
    constexpr int kFigureViews = 16;
    const TurntableModel truth = turn_of_figure(kFigureViews);
    const auto masks = drawn(figure(), truth);
    for (std::size_t i = 0; i < masks.size(); ++i) write(i, grey_where(masks[i]));
    options_.calibration = CalibrationChoice::kSilhouettes;
    options_.known = {};
    options_.turning.reset();
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->nominal.turning, Turning::kClockwise);
    EXPECT_EQ(report->turning, Turning::kCounterClockwise);
    EXPECT_THAT(report->notes, Contains(HasSubstr("silhouettes fit this direction better")));
    const TurntableModel& found = report->calibration.calibration->model;
    EXPECT_NEAR(degrees(found.pose.tilt_rad), degrees(truth.pose.tilt_rad), 1);
}

// 347 x 1081 px are halved to 173 x 540, with a slightly different aspect ratio.
TEST_F(PhotoCalibrationTest, OutlinesMayBeOfAnyShape) {
    TurntableModel model = test::drum_turn(12, -radians(30));
    model.lens = {347, 1081, 900, 170, 500, 0, 0};
    test::Drum drum;
    drum.is_spotted = false;
    for (std::size_t i = 0; i < 12; ++i) write(i, test::drawn_drum(drum, model, i));
    options_.calibration = CalibrationChoice::kSilhouettes;
    options_.known.known.f_px = 900;
    options_.known.known.principal_point = {170, 500};
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    const TurntableModel& found = report->calibration.calibration->model;
    EXPECT_EQ(found.lens.width, 347);
    EXPECT_EQ(found.lens.height, 1081);
    EXPECT_NEAR(*axis_column(found.lens, found.pose, 500), *axis_column(model.lens, model.pose, 500), 0.5);
}

// The drum is on a printed board before a paper-like backdrop; only the mask separates the object.
TEST_F(PhotoCalibrationTest, ABoardIsTakenBeforeAllElse) {
    const test::BoardPhotos photos;
    std::filesystem::create_directory(folder_ / "photos" / "masks");
    options_.segmentation.masks = folder_ / "photos" / "masks";
    for (std::size_t i = 0; i < photos.model.angles_rad.size(); ++i) {
        const test::BoardPhotos::Photo photo = photos.taken(i);
        write(i, photo.image);
        ASSERT_TRUE(write_png(options_.segmentation.masks / test::file_name(i), photo.mask).ok());
    }
    options_.known = {};
    options_.turning.reset();
    options_.board = photos.design;
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->method, CalibrationMethod::kBoard);
    EXPECT_TRUE(report->calibration.board.has_value());
    const TurntableModel& found = report->calibration.calibration->model;
    EXPECT_NEAR(found.lens.f_px, photos.model.lens.f_px, 0.01 * photos.model.lens.f_px);
    EXPECT_NEAR(degrees(found.pose.tilt_rad), degrees(photos.model.pose.tilt_rad), 0.3);
    for (std::size_t i = 0; i < photos.model.angles_rad.size(); ++i) {
        EXPECT_NEAR(degrees(found.angles_rad[i]), degrees(photos.model.angles_rad[i]), 0.1) << i;
    }
    EXPECT_EQ(report->turning, Turning::kCounterClockwise);
    const auto page = import_page(options_.photos, *report);
    ASSERT_TRUE(page.ok()) << page.error().message;
    EXPECT_THAT(*page, HasSubstr("the printed board on the turntable"));

    // One wrong parameter of the board, so that no board is detected.
    options_.board->dictionary = "5x5_50";
    options_.calibration = CalibrationChoice::kBoard;
    std::filesystem::remove_all(options_.output);
    expect_error(HasSubstr("board"));
}

TEST_F(PhotoCalibrationTest, MasksTellTheObject) {
    std::filesystem::create_directory(folder_ / "masks");
    for (std::size_t i = 0; i < test::kViews; ++i) {
        Image<Rgba8> mask(320, 256), photo = test::spotted()[i];
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 320; ++x) {
                const std::uint8_t a = photo(x, y).a;
                mask(x, y) = {a, a, a, 255};
                // A backdrop that cannot be segmented by colour.
                if (a < 255) photo(x, y) = {static_cast<std::uint8_t>(60 + (x * 7 + y * 3) % 120), 90, 80, 255};
            }
        }
        write(i, photo);
        ASSERT_TRUE(write_png(folder_ / "masks" / test::file_name(i), mask).ok());
    }
    options_.segmentation.masks = folder_ / "masks";
    options_.calibration = CalibrationChoice::kTracks;
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->segmenter, SegmenterKind::kMasks);
    EXPECT_NEAR(degrees(report->calibration.calibration->model.pose.tilt_rad), 20, 0.5);
    EXPECT_EQ(read_rig(options_.output)->extras["photo_import"]["backdrop"], "masks");

    std::filesystem::remove_all(options_.output);
    std::filesystem::rename(folder_ / "masks", folder_ / "photos" / "masks");
    options_.segmentation.masks = folder_ / "photos" / "masks";
    std::filesystem::remove(options_.segmentation.masks / "05.png");
    expect_error(HasSubstr("05.png"));
}

}  // namespace
}  // namespace rs::capture
