// Hold-out selection, subsets of a set, and the kept view nearest to a held-out view.

#include "encode/hold_out.hpp"
#include "encode/build.hpp"
#include "encode/evaluation/evaluation.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <mutex>
#include <set>

namespace rs::encode {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(HoldOut, OfEachRunTheMiddleViewIsHeldOut) {
    const Result<HoldOut> second = choose_hold_out(test::drawn_ring(7), 2, "set");
    ASSERT_TRUE(second.ok()) << second.error().message;
    EXPECT_THAT(second->held, ElementsAre(1, 3, 5));
    EXPECT_THAT(second->kept, ElementsAre(0, 2, 4, 6));
    // The last run of three has two views, including index 1.
    const Result<HoldOut> third = choose_hold_out(test::drawn_ring(8), 3, "set");
    ASSERT_TRUE(third.ok());
    EXPECT_THAT(third->held, ElementsAre(1, 4, 7));
    const Result<HoldOut> fourth = choose_hold_out(test::drawn_ring(6), 4, "set");
    ASSERT_TRUE(fourth.ok());
    EXPECT_THAT(fourth->held, ElementsAre(2));
}

TEST(HoldOut, RunsFollowTheTurnAndEachRingHasItsOwn) {
    Rig rig = test::drawn_ring(4);
    // File order differs from turning order: 0, 2, 1, 3.
    std::swap(rig.views[1], rig.views[2]);
    const Rig above = test::drawn_ring(3, 20);
    rig.views.insert(rig.views.end(), above.views.begin(), above.views.end());
    const Result<HoldOut> hold_out = choose_hold_out(rig, 2, "set");
    ASSERT_TRUE(hold_out.ok());
    EXPECT_THAT(hold_out->held, ElementsAre(2, 3, 5));
    EXPECT_THAT(hold_out->kept, ElementsAre(0, 1, 4, 6));
}

TEST(HoldOut, TooFewViewsAreAnErrorThatSaysSo) {
    for (const auto& [views, every] : {std::pair{2, 2}, {1, 2}, {3, 8}}) {
        const Result<HoldOut> hold_out = choose_hold_out(test::drawn_ring(views), every, "the-set");
        ASSERT_FALSE(hold_out.ok()) << views << " views, every " << every;
        EXPECT_THAT(hold_out.error().message, HasSubstr("the-set"));
        EXPECT_THAT(hold_out.error().message, HasSubstr("too few"));
    }
    EXPECT_TRUE(choose_hold_out(test::drawn_ring(3), 2, "set").ok());
}

TEST(HoldOut, AWholeTurnIsHeldOut) {
    Rig rig = test::drawn_ring(5);
    for (std::size_t i = 0; i < 5; ++i) rig.views[i].extras["turn"] = i < 2 ? 0 : 1;
    const Result<HoldOutRule> rule = parse_hold_out("turn=1");
    ASSERT_TRUE(rule.ok());
    const Result<HoldOut> hold_out = choose_hold_out(rig, *rule, "set");
    ASSERT_TRUE(hold_out.ok());
    EXPECT_THAT(hold_out->held, ElementsAre(2, 3, 4));
    EXPECT_THAT(hold_out->kept, ElementsAre(0, 1));
    const Result<HoldOut> missing = hold_out_turn(rig, 2, "the-set");
    ASSERT_FALSE(missing.ok());
    EXPECT_THAT(missing.error().message, HasSubstr("the-set: no frame has \"turn\": 2"));
    rig.views[0].extras["turn"] = 1;
    EXPECT_FALSE(hold_out_turn(rig, 1, "set").ok());  // one view is left
}

TEST(HoldOut, OrdinalsAreRead) {
    for (const auto& [text, every] :
         {std::pair{"every-2nd", 2}, {"every-3rd", 3}, {"every-21st", 21}, {"every-8th", 8}}) {
        const Result<HoldOutRule> parsed = parse_hold_out(text);
        ASSERT_TRUE(parsed.ok()) << text;
        EXPECT_EQ(parsed->kind, HoldOutKind::kEveryNth);
        EXPECT_EQ(parsed->number, every);
    }
    for (const char* text : {"", "every-", "every-2", "every-1st", "every-0th", "every--2nd", "second", "every-2nd ",
                             "every-99999999999th", "turn=", "turn=-1", "turn=1st", "turn-1"}) {
        const Result<HoldOutRule> parsed = parse_hold_out(text);
        ASSERT_FALSE(parsed.ok()) << text;
        EXPECT_THAT(parsed.error().message, HasSubstr("every-3rd"));
    }
}

TEST(NearestKeptView, IsNearestInTheTurnOfTheNearestRing) {
    const Rig ring = test::drawn_ring(12);
    const HoldOut hold_out = *choose_hold_out(ring, 3, "set");  // held 1 4 7 10
    EXPECT_EQ(nearest_kept_view(ring, hold_out, 1), 0);         // as near as 2, but first in the turn
    EXPECT_EQ(nearest_kept_view(ring, hold_out, 4), 3);
    EXPECT_EQ(nearest_kept_view(ring, {{0, 5}, {11}}, 11), 0);  // across +Z
    EXPECT_EQ(nearest_kept_view(ring, {{0, 5}, {11}}, 4), 5);

    // The ring above has a view at the same azimuth, but the view's own ring has precedence.
    Rig two = test::drawn_ring(4);
    const Rig above = test::drawn_ring(8, 30);
    two.views.insert(two.views.end(), above.views.begin(), above.views.end());
    EXPECT_EQ(nearest_kept_view(two, {{0, 2, 5, 6}, {1}}, 1), 0);
    // No view of its ring is kept, so the other ring is used.
    EXPECT_EQ(nearest_kept_view(two, {{4, 6, 8}, {1}}, 1), 6);
}

TEST(WithViews, KeepsWhatTheWholeSetHas) {
    const test::TemporaryFolder folder;
    Rig rig = test::drawn_ring(8, 20);  // pitched cameras, resampled to upright images of one frame size
    rig.object_radius = 0;              // measured over all images
    test::write_drawn_set(folder / "set", rig);
    const Result<CaptureSet> all = open_capture_set(folder / "set");
    ASSERT_TRUE(all.ok()) << all.error().message;
    const CaptureSet some = select_views(*all, std::vector<int>{1, 6});
    ASSERT_EQ(some.upright.views.size(), 2U);
    EXPECT_EQ(some.upright.object_radius, all->upright.object_radius);
    EXPECT_EQ(some.width, all->width);
    EXPECT_EQ(some.height, all->height);
    EXPECT_EQ(some.upright.views[1].file_path, all->upright.views[6].file_path);
    EXPECT_EQ(some.upright.views[1].camera.world_from_camera, all->upright.views[6].camera.world_from_camera);
    const auto image = read_upright_image(some, 1);
    const auto same = read_upright_image(*all, 6);
    ASSERT_TRUE(image.ok() && same.ok());
    EXPECT_EQ(*image, *same);
    CaptureSet completed = *all;
    completed.completed = {{3, Image<Rgba8>(2, 2)}, {6, Image<Rgba8>(1, 1)}};
    EXPECT_EQ(read_upright_image(completed, 6)->width(), 1);
    const CaptureSet some_completed = select_views(completed, std::vector<int>{1, 6});
    EXPECT_EQ(some_completed.completed.size(), 1U);
    EXPECT_EQ(read_upright_image(some_completed, 1)->width(), 1);
    EXPECT_EQ(read_upright_image(some_completed, 0)->width(), all->width);
    EXPECT_TRUE(build_object(some, {.map = {}, .name = "two"}).ok());
}

TEST(Evaluation, MethodsAreRead) {
    const auto methods = parse_methods("shape,photo");
    ASSERT_TRUE(methods.ok());
    EXPECT_THAT(*methods, ElementsAre(Method::kShape, Method::kPhoto));
    for (const char* text : {"", "photo,", ",photo", "photo,foto", "photo,photo", "Photo"}) {
        const auto bad = parse_methods(text);
        ASSERT_FALSE(bad.ok()) << text;
        EXPECT_THAT(bad.error().message, HasSubstr("photo,plane,shape"));
    }
}

TEST(Evaluation, ScoresOnlyWhatWasHeldOutAgainstItsOwnImage) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", test::drawn_ring(24));
    const Result<CaptureSet> set = open_capture_set(folder / "set");
    ASSERT_TRUE(set.ok()) << set.error().message;
    const HoldOut hold_out = *choose_hold_out(set->upright, 2, "set");

    std::mutex mutex;
    std::multiset<int> looked;
    const auto look = [&](const EvaluatedView& evaluated) -> Status {
        const std::lock_guard lock(mutex);
        looked.insert(evaluated.view);
        EXPECT_EQ(evaluated.view, hold_out.held[evaluated.number]);
        EXPECT_EQ(evaluated.truth,
                  test::draw_image(set->upright.views[static_cast<std::size_t>(evaluated.view)].camera));
        EXPECT_EQ(evaluated.psnr_db, compare_images_psnr(evaluated.truth, evaluated.rendering).psnr_db());
        if (evaluated.method == Method::kPhoto) {
            const auto photo = read_upright_image(*set, nearest_kept_view(set->upright, hold_out, evaluated.view));
            EXPECT_TRUE(photo.ok() && *photo == evaluated.rendering);
        }
        return {};
    };
    const auto scores = evaluate(*set, hold_out, {}, look);
    ASSERT_TRUE(scores.ok()) << scores.error().message;
    ASSERT_EQ(scores->size(), 3U);
    for (const int view : hold_out.held) EXPECT_EQ(looked.count(view), 3U) << view;
    for (const int view : hold_out.kept) EXPECT_EQ(looked.count(view), 0U) << view;
    for (const MethodScores& method : *scores) {
        ASSERT_EQ(method.views.size(), 12U);
        double mean = 0;
        for (const HeldOutScore& view : method.views) mean += view.psnr_db / 12;
        EXPECT_NEAR(method.mean_psnr_db, mean, 1e-9) << method.method;
        EXPECT_LE(method.pooled_psnr_db, method.mean_psnr_db + 1e-9) << method.method;
        // Balls seen from 15 degrees aside: neither perfect nor unrelated.
        EXPECT_GT(method.mean_psnr_db, 8) << method.method;
        EXPECT_LT(method.mean_psnr_db, 45) << method.method;
    }
}

TEST(Evaluation, WhatLookingFailsWithIsReturned) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", test::drawn_ring(4));
    const Result<CaptureSet> set = open_capture_set(folder / "set");
    ASSERT_TRUE(set.ok());
    EvaluationOptions options;
    options.methods = {Method::kPhoto};
    const auto scores = evaluate(*set, *choose_hold_out(set->upright, 2, "set"), options,
                                 [](const EvaluatedView&) -> Status { return Error{"no room"}; });
    ASSERT_FALSE(scores.ok());
    EXPECT_EQ(scores.error().message, "no room");
}

}  // namespace
}  // namespace rs::encode
