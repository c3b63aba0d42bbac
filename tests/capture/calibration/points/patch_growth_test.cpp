#include "capture/calibration/points/patch_alignment.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/point_turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

constexpr double kStep_px = 7;

// One point in front of the axis, visible in the first views of a turn.
Bundle one_point(int views) {
    Bundle bundle;
    bundle.model = test::turn_model(36, radians(10));
    bundle.points = {{0, -std::tan(radians(20)), 0.1}};
    Track track;
    for (int view = 0; view < views; ++view) {
        track.seen.push_back({view, *project_point(bundle.model, bundle.points[0], view)});
    }
    bundle.tracks = {track};
    return bundle;
}

double depth(const Bundle& bundle, std::size_t i, std::size_t view) {
    const Camera camera = object_camera(bundle.model, view);
    return glm::dot(bundle.points[i] - camera.centre(), camera.forward());
}

TEST(PatchGrowth, PointsComeOneStepBesideAsFarFromTheCamera) {
    for (const int reduction : {1, 2}) {
        Bundle bundle = one_point(5);
        grow_patches(bundle, reduction, 1000);
        ASSERT_EQ(bundle.tracks.size(), 5U);
        ASSERT_EQ(bundle.points.size(), 5U);
        const Observation middle = reference_observation(bundle.model, bundle.tracks[0]);
        ASSERT_EQ(middle.view, 2);
        glm::dvec2 sum(0.0);
        for (std::size_t i = 1; i < 5; ++i) {
            ASSERT_EQ(bundle.tracks[i].seen.size(), 5U);
            EXPECT_NEAR(depth(bundle, i, 2), depth(bundle, 0, 2), 1e-9);
            const glm::dvec2 aside = bundle.tracks[i].seen[2].p - middle.p;
            EXPECT_NEAR(glm::length(aside), kStep_px * reduction, 0.05 * kStep_px * reduction);
            sum += aside;
            for (const Observation& seen : bundle.tracks[i].seen) {
                const auto expected = project_point(bundle.model, bundle.points[i], seen.view);
                EXPECT_LT(glm::distance(*expected, seen.p), 1e-9);
            }
        }
        EXPECT_LT(glm::length(sum), 0.2 * reduction);  // one to each side
    }
}

TEST(PatchGrowth, NoPlaceGetsASecondPoint) {
    Bundle bundle = one_point(3);
    for (int round = 0; round < 4; ++round) grow_patches(bundle, 1, 100000);
    EXPECT_GT(bundle.tracks.size(), 25U);
    // No two points of the middle view are in the same cell.
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (std::size_t k = i + 1; k < bundle.tracks.size(); ++k) {
            const glm::dvec2 a = glm::floor(bundle.tracks[i].seen[1].p / kStep_px);
            const glm::dvec2 b = glm::floor(bundle.tracks[k].seen[1].p / kStep_px);
            EXPECT_FALSE(a == b) << i << " and " << k;
        }
    }
}

TEST(PatchGrowth, ThereAreNoMoreObservationsThanAskedFor) {
    const auto tracks = test::tracks_of(test::turn_model(36, radians(10)), test::surface_points(120, 5), 0, 1);
    const Bundle start = make_bundle(test::turn_model(36, radians(10)), tracks);
    const int before = observation_count(start);
    Bundle all = start, some = start, none = start;
    grow_patches(all, 1, 10 * before);
    grow_patches(none, 1, before);
    EXPECT_EQ(none.tracks.size(), start.tracks.size());
    const int grown = observation_count(all) - before;
    ASSERT_GT(grown, before);
    grow_patches(some, 1, before + grown / 3);
    EXPECT_NEAR(observation_count(some) - before, grown / 3, grown / 30);
    // Evenly spaced: some candidates are neighbours of early points, some of late ones.
    const auto is_of_some = [&](const glm::dvec3& p) {
        return std::find(some.points.begin(), some.points.end(), p) != some.points.end();
    };
    const auto share = [&](std::size_t from, std::size_t to) {
        int kept = 0;
        for (std::size_t i = from; i < to; ++i) kept += is_of_some(all.points[i]) ? 1 : 0;
        return static_cast<double>(kept) / static_cast<double>(to - from);
    };
    const std::size_t middle = (start.points.size() + all.points.size()) / 2;
    EXPECT_NEAR(share(start.points.size(), middle), 1.0 / 3, 0.05);
    EXPECT_NEAR(share(middle, all.points.size()), 1.0 / 3, 0.05);
}

TEST(PatchGrowth, NothingGrowsBesideTheImage) {
    Bundle bundle = one_point(3);
    const Observation middle = reference_observation(bundle.model, bundle.tracks[0]);
    bundle.model.lens.width = static_cast<int>(middle.p.x) + 1;  // the point is in the last column
    grow_patches(bundle, 1, 1000);
    for (const Track& track : bundle.tracks) {
        EXPECT_LT(reference_observation(bundle.model, track).p.x, bundle.model.lens.width);
    }
    EXPECT_LT(bundle.tracks.size(), 5U);
}

}  // namespace
}  // namespace rs::capture
