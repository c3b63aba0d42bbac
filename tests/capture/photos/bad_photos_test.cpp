// Photos that are not a turn, or hardly: errors state the problem and the remedy, and no partial output remains.

#include "capture/photos/import.hpp"
#include "rayspace/geometry/rig.hpp"
#include "tests/capture/photos/drum_photos.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::HasSubstr;

class BadPhotos : public test::DrumPhotos {};

TEST_F(BadPhotos, BlurredImagesGetARemedy) {
    test::Drum soft;
    soft.grain = 0.4;  // no detail left
    for (std::size_t i = 0; i < test::kViews; ++i) write(i, test::drawn_drum(soft, test::drum_model(), i));
    options_.calibration = CalibrationChoice::kTracks;
    expect_error(AllOf(HasSubstr("points of the object can be tracked"), HasSubstr("rs-capture board")));
}

TEST_F(BadPhotos, ARigOfOtherPhotographsIsRefused) {
    write_spotted();
    options_.known = truth();
    options_.known.images[7] = "images/other.png";
    expect_error(AllOf(HasSubstr("07.png"), HasSubstr("give its rig")));
    options_.known = truth();
    options_.known.images.clear();
    options_.known.known.angles_rad->pop_back();
    expect_error(AllOf(HasSubstr("17 views"), HasSubstr("18 photos")));
}

TEST_F(BadPhotos, ALastImageThatClosesTheTurnIsLeftOut) {
    write_spotted();
    // Half a degree beyond the first image, so that it is not detected as a repeat by its pixels.
    TurntableModel model = test::drum_model();
    model.angles_rad.push_back(-radians(360.5));
    write(test::kViews, test::drawn_drum({}, model, test::kViews));
    options_.calibration = CalibrationChoice::kTracks;
    options_.degrees_per_view.reset();
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->views, test::kViews);
    if (report->dropped_repeat.empty()) {
        EXPECT_THAT(report->left_out, testing::ElementsAre("18.png"));
    }
    EXPECT_THAT(report->notes, Contains(HasSubstr("18.png repeats")));
}

TEST_F(BadPhotos, MovedTripodsAndMixedCamerasAreNamed) {
    for (std::size_t i = 0; i < test::kViews; ++i) {
        TurntableModel model = test::drum_model();
        if (i >= 9) {
            model.pose.tilt_rad += radians(6);
            model.pose.roll_rad += radians(8);
            model.lens.cy += 30;
        }
        write(i, test::drawn_drum({}, model, i));
    }
    options_.calibration = CalibrationChoice::kTracks;
    expect_error(ContainsRegex("tripod moved at about (0[89]|10).png\\? Take the turn again"));
    options_.calibration = CalibrationChoice::kAuto;  // falls back to less, with a note
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_THAT(report->notes, Contains(AllOf(HasSubstr("no calibration from points"), HasSubstr("tripod moved"))));
    std::filesystem::remove_all(options_.output);

    options_.calibration = CalibrationChoice::kTracks;
    for (std::size_t i = 1; i < test::kViews; i += 2) {
        TurntableModel model = test::drum_model();
        model.lens.f_px *= 1.25;
        model.pose.roll_rad += radians(5);
        write(i, test::drawn_drum({}, model, i));
        write(i - 1, test::spotted()[i - 1]);
    }
    expect_error(HasSubstr("one camera, one zoom"));
}

TEST_F(BadPhotos, TooFewOrEmptyImagesAreRefused) {
    for (std::size_t i = 0; i < 3; ++i) write(i, test::spotted()[i]);
    options_.calibration = CalibrationChoice::kTracks;
    expect_error(HasSubstr("take at least 5, better 36"));
    options_.calibration = CalibrationChoice::kAuto;
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->method, CalibrationMethod::kNominal);
    EXPECT_THAT(report->notes, Contains(HasSubstr("take at least 5")));
    std::filesystem::remove_all(options_.output);

    for (std::size_t i = 0; i < 8; ++i) write(i, Image<Rgba8>(320, 256, Rgba8{255, 255, 255, 255}));
    expect_error(AllOf(HasSubstr(".png"), ContainsRegex("object|backdrop")));
}

}  // namespace
}  // namespace rs::capture
