#include "capture/calibration/silhouettes/turn_diagnosis.hpp"

#include "capture/calibration/points/model_covariance.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/point_turns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Runs the checks of calibrate_with_tracks() on a turn.
struct Judged {
    Status accepted;
    std::vector<std::string> warnings;
};

Judged judge(const std::vector<Track>& tracks, const TurntableModel& start, std::vector<int> features = {}) {
    BundleOptions options;
    Bundle bundle = make_robust_bundle(start, tracks, 12);
    for (const double limit_px : {6.0, 3.0}) {
        EXPECT_TRUE(adjust(bundle, options).has_value());
        bundle = make_robust_bundle(bundle.model, tracks, limit_px);
    }
    EXPECT_TRUE(adjust(bundle, options).has_value());
    const std::size_t views = start.angles_rad.size();
    const std::vector<int> candidates = observations_per_view(tracks, views);
    if (features.empty()) features.assign(views, 500);
    const ModelDeviations deviations = bundle_standard_deviations(bundle, options, 400);
    const std::vector<std::string> names = test::photograph_names(views);
    std::vector<std::string> warnings = step_warnings(bundle.model.angles_rad, deviations, names);
    for (std::string& line : image_warnings(bundle, candidates, features, names)) warnings.push_back(std::move(line));
    return {check_plausibility(bundle, deviations, candidates, names), std::move(warnings)};
}

Judged judge(const TurntableModel& truth, const TurntableModel& start) {
    return judge(test::tracks_of(truth, test::surface_points(250, 31), 0.2, 31), start);
}

TEST(TurnDiagnosis, AGoodTurnIsTakenWithoutAWord) {
    for (const double step_deg : {10.0, -10.0}) {
        const TurntableModel truth = test::turn_model(36, radians(step_deg));
        const Judged judged = judge(truth, truth);
        EXPECT_TRUE(judged.accepted.ok()) << judged.accepted.error().message;
        EXPECT_THAT(judged.warnings, IsEmpty());
    }
}

TEST(TurnDiagnosis, NamesTheViewThatStandsWrong) {
    for (const double sense : {1.0, -1.0}) {
        for (const double off_deg : {1.8, -1.8}) {
            const TurntableModel equal = test::turn_model(36, sense * radians(10));
            TurntableModel truth = equal;
            truth.angles_rad[7] += sense * radians(off_deg);
            const Judged judged = judge(truth, equal);
            EXPECT_TRUE(judged.accepted.ok()) << judged.accepted.error().message;
            EXPECT_THAT(judged.warnings, ElementsAre(HasSubstr("007.jpg is 1.8 degrees off")));
            EXPECT_THAT(judged.warnings[0], HasSubstr(off_deg > 0 ? "too far" : "not far enough"));
        }
    }
}

TEST(TurnDiagnosis, NamesAStepGapAndImageTakenTwice) {
    const TurntableModel equal = test::turn_model(30, -radians(10));
    TurntableModel truth = equal;
    for (std::size_t i = 12; i < 30; ++i) truth.angles_rad[i] -= radians(10);  // one image is missing
    EXPECT_THAT(judge(truth, truth).warnings, Contains(HasSubstr("gap of 20.0 degrees between 011.jpg and 012.jpg")));

    truth = equal;
    for (std::size_t i = 5; i < 30; ++i) truth.angles_rad[i] += radians(10);  // the turntable had not turned
    EXPECT_THAT(judge(truth, truth).warnings, Contains(HasSubstr("005.jpg is at the angle of 004.jpg")));
    EXPECT_THAT(repeated_views(truth.angles_rad), ElementsAre(5));

    truth = equal;
    for (std::size_t i = 9; i < 30; ++i) truth.angles_rad[i] -= radians(2);
    EXPECT_THAT(judge(truth, truth).warnings, Contains(HasSubstr("from 008.jpg to 009.jpg is 12.0 degrees")));
}

// As with every n-th frame of a video.
TEST(TurnDiagnosis, ManyUnevenStepsAreOneLine) {
    TurntableModel truth = test::turn_model(36, radians(10));
    for (std::size_t i = 1; i < truth.angles_rad.size(); i += 2) truth.angles_rad[i] += radians(2);
    const Judged judged = judge(truth, truth);
    EXPECT_TRUE(judged.accepted.ok()) << judged.accepted.error().message;
    ASSERT_EQ(judged.warnings.size(), 1U);
    EXPECT_THAT(judged.warnings[0], HasSubstr("17 of 35 steps are 8.0 degrees where others are 12.0"));
}

TEST(TurnDiagnosis, TheLastViewMayRepeatTheFirst) {
    for (const double sense : {1.0, -1.0}) {
        TurntableModel truth = test::turn_model(37, sense * radians(10));
        const Judged judged = judge(truth, truth);
        EXPECT_TRUE(judged.accepted.ok()) << judged.accepted.error().message;
        EXPECT_THAT(repeated_views(truth.angles_rad), ElementsAre(36));
        truth.angles_rad.back() += radians(0.4);  // nearly
        EXPECT_THAT(repeated_views(truth.angles_rad), ElementsAre(36));
        truth.angles_rad.back() -= sense * radians(3);
        EXPECT_THAT(repeated_views(truth.angles_rad), IsEmpty());
        EXPECT_THAT(repeated_views(test::turn_model(36, sense * radians(10)).angles_rad), IsEmpty());
    }
    EXPECT_THAT(repeated_views(std::vector<double>{0.0}), IsEmpty());
    EXPECT_THAT(repeated_views(std::vector<double>{}), IsEmpty());
}

TEST(TurnDiagnosis, SaysWhereTheTurnDoesNotClose) {
    const TurntableModel truth = test::turn_model(33, radians(10));
    EXPECT_THAT(judge(truth, truth).warnings,
                ElementsAre(AllOf(HasSubstr("does not close: 40.0 degrees"), HasSubstr("032.jpg and 000.jpg"))));
}

TEST(TurnDiagnosis, AsksWhetherAViewWithFewFeaturesIsBlurred) {
    const TurntableModel truth = test::turn_model(36, radians(10));
    std::vector<int> features(36, 500);
    features[11] = 90;
    const auto tracks = test::tracks_of(truth, test::surface_points(250, 31), 0.2, 31);
    EXPECT_THAT(judge(tracks, truth, features).warnings,
                ElementsAre(AllOf(HasSubstr("011.jpg shows 90 features"), HasSubstr("blurred"))));
}

TEST(TurnDiagnosis, NamesAViewWhoseObjectWasMoved) {
    const TurntableModel truth = test::turn_model(36, radians(10));
    test::ModelOfView models(36, truth);
    models[20].pose.tilt_rad += radians(3);
    const Judged judged = judge(test::tracks_of(models, test::surface_points(250, 32), 0.2, 32), truth);
    EXPECT_TRUE(judged.accepted.ok()) << judged.accepted.error().message;
    EXPECT_THAT(judged.warnings, Contains(AllOf(HasSubstr("020.jpg does not fit"), HasSubstr("leave it out"))));
}

// The camera is moved from view `from` on.
Judged with_moved_tripod(std::size_t from) {
    const TurntableModel truth = test::turn_model(36, radians(10));
    test::ModelOfView models(36, truth);
    for (std::size_t i = from; i < 36; ++i) {
        models[i].pose.pan_rad += radians(3);
        models[i].pose.tilt_rad += radians(4);
        models[i].pose.roll_rad += radians(5);
    }
    return judge(test::tracks_of(models, test::surface_points(250, 33), 0.2, 33), truth);
}

TEST(TurnDiagnosis, AMovedTripodIsAnErrorThatNamesTheImage) {
    for (const std::size_t from : {14U, 18U, 22U}) {
        const Judged judged = with_moved_tripod(from);
        ASSERT_FALSE(judged.accepted.ok());
        const std::string& message = judged.accepted.error().message;
        EXPECT_THAT(message, HasSubstr("tripod moved at about 0" + std::to_string(from) + ".jpg")) << from;
    }
}

TEST(TurnDiagnosis, TwoCamerasAreAnErrorThatSaysSo) {
    const TurntableModel truth = test::turn_model(36, radians(10));
    test::ModelOfView models(36, truth);
    for (std::size_t i = 1; i < 36; i += 2) {
        models[i].lens.f_px *= 1.3;
        models[i].pose.tilt_rad += radians(2);
    }
    const Judged judged = judge(test::tracks_of(models, test::surface_points(250, 34), 0.2, 34), truth);
    ASSERT_FALSE(judged.accepted.ok());
    EXPECT_THAT(judged.accepted.error().message, HasSubstr("one camera, one zoom"));
    EXPECT_THAT(judged.accepted.error().message, Not(HasSubstr("tripod")));
}

TEST(TurnDiagnosis, ImagesOutOfOrderAreAnError) {
    TurntableModel shuffled = test::turn_model(36, radians(10));
    for (std::size_t i = 1; i + 1 < 36; i += 3) std::swap(shuffled.angles_rad[i], shuffled.angles_rad[i + 1]);
    const Judged judged = judge(shuffled, shuffled);
    ASSERT_FALSE(judged.accepted.ok());
    EXPECT_THAT(judged.accepted.error().message, HasSubstr("in the order they were taken"));
}

TEST(TurnDiagnosis, PhotosOfTwoTurnsAreAnError) {
    TurntableModel two = test::turn_model(36, radians(10));
    for (std::size_t i = 18; i < 36; ++i) two.angles_rad[i] = two.angles_rad[i - 18] + radians(60);
    const Judged judged = judge(two, two);
    ASSERT_FALSE(judged.accepted.ok());
    EXPECT_THAT(judged.accepted.error().message, HasSubstr("start again at " + test::photograph_names(36)[18]));
}

TEST(TurnDiagnosis, TooShortATurnIsAnError) {
    const TurntableModel part = test::turn_model(10, radians(1));
    const Judged judged = judge(part, part);
    ASSERT_FALSE(judged.accepted.ok());
    EXPECT_THAT(judged.accepted.error().message, HasSubstr("degrees of turn; 15 to 400"));
}

TEST(TurnDiagnosis, WarnsWhereTextureAndSilhouettesDisagreeAboutTheAxis) {
    const auto warning = axis_warning({300, 102.1, 0.2}, {300, 100, 0.2}, 1);
    ASSERT_TRUE(warning);
    EXPECT_NE(warning->find("2.1 px"), std::string::npos) << *warning;
    EXPECT_FALSE(axis_warning({300, 102.1, 0.2}, {300, 100, 1}, 1));
    EXPECT_FALSE(axis_warning({300, 100.4, 0.05}, {300, 100, 0.05}, 1));
    EXPECT_FALSE(axis_warning({300, 100.8, 0.05}, {300, 100, 0.05}, 2));
}

}  // namespace
}  // namespace rs::capture
