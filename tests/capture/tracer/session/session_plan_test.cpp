// Random errors of session plans have the requested size, and the sensor adds the requested noise.

#include "capture/tracer/session/session_plan.hpp"
#include "capture/tracer/session/seeded_draws.hpp"
#include "capture/tracer/session/sensor.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::capture::test {
namespace {

const std::vector<AxisCircle> kBall = {{0.9, -0.4}, {1, 0}, {0.9, 0.4}, {0.1, 1}, {0.1, -1}};

SessionPlan plan_of(const SessionOptions& options) {
    const Result<SessionPlan> plan = plan_session(options, kBall);
    EXPECT_TRUE(plan.ok()) << plan.error().message;
    return *plan;
}

TEST(SessionPlan, StepsAreUnequalAsAskedAndMakeOneTurn) {
    SessionOptions options;
    options.views = 400;
    options.step_error_deg = 0.3;
    for (const bool counter_clockwise : {false, true}) {
        options.counter_clockwise = counter_clockwise;
        const std::vector<double> angles = plan_of(options).model.angles_rad;
        const double sense = counter_clockwise ? 1 : -1;
        ASSERT_EQ(angles.size(), 400U);
        EXPECT_EQ(angles[0], 0);
        double sum2 = 0;
        for (std::size_t i = 1; i < 400; ++i) {
            const double error_deg = degrees(sense * (angles[i] - angles[i - 1])) - 0.9;
            sum2 += error_deg * error_deg;
        }
        EXPECT_NEAR(std::sqrt(sum2 / 399), 0.3, 0.03);
        EXPECT_NEAR(degrees(sense * angles.back()), 360 - 0.9, 1.5);
    }
    options.step_error_deg = 0;
    options.views = 8;
    EXPECT_NEAR(plan_of(options).model.angles_rad[3], 2 * kPi * 3 / 8, 1e-12);
}

TEST(SessionPlan, TheAimIsOffByNoMoreThanAsked) {
    double largest = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        SessionOptions options;
        options.seed = seed;
        options.views = 1;
        const CameraPose pose = plan_of(options).model.pose;
        for (const double error_rad : {pose.pan_rad, pose.tilt_rad - radians(20), pose.roll_rad}) {
            EXPECT_LE(std::abs(error_rad), radians(0.7));
            largest = std::max(largest, std::abs(error_rad));
        }
    }
    EXPECT_GT(largest, radians(0.6));
}

TEST(SessionPlan, TheExposureDriftsSlowlyWithinItsRange) {
    SessionOptions options;
    options.views = 72;
    options.exposure_drift = 0.05;
    const std::vector<double> exposures = plan_of(options).exposures;
    const auto [least, most] = std::ranges::minmax(exposures);
    EXPECT_GE(least, 0.95);
    EXPECT_LE(most, 1.05);
    EXPECT_GT(most - least, 0.05);
    for (std::size_t i = 1; i < 72; ++i) EXPECT_LT(std::abs(exposures[i] - exposures[i - 1]), 0.01);
}

TEST(SessionPlan, TheCameraStandsAsNearAsEverythingFitsIn) {
    SessionOptions options;
    options.k1 = -0.12;
    options.elevation_deg = 30;
    const SessionPlan plan = plan_of(options);
    EXPECT_NEAR(std::atan2(plan.camera_height, plan.distance), radians(30), 1e-9);
    double least_margin = 1e9;
    for (const AxisCircle& circle : kBall) {
        for (int i = 0; i < 720; ++i) {
            const double a = 2 * kPi * i / 720;
            const glm::dvec3 p(circle.radius * std::sin(a), circle.height - plan.camera_height,
                               circle.radius * std::cos(a));
            const auto seen = project(plan.model.lens, plan.model.pose, p / plan.distance);
            ASSERT_TRUE(seen.has_value());
            least_margin = std::min({least_margin, seen->x, seen->y, 640 - seen->x, 512 - seen->y});
        }
    }
    EXPECT_NEAR(least_margin, 0.03 * 512, 0.5);
}

TEST(SessionPlan, RefusesWhatNoLensCanDo) {
    SessionOptions options;
    options.k1 = -1;
    options.focal_widths = 0.5;
    EXPECT_FALSE(plan_session(options, kBall).ok());
    options.k1 = 0;
    options.focal_widths = 1.4;
    EXPECT_FALSE(plan_session(options, {{5000, 0}}).ok());
}

TEST(Sensor, AddsNoiseOfTheAskedSizeAndTheExposure) {
    const float linear = 0.2F;
    const Image<RgbaF> light(200, 200, {linear, linear, linear, 1});
    for (const double noise : {0.0, 1.5, 6.0}) {
        for (const double exposure : {1.0, 0.8}) {
            const Image<Rgba8> image = expose(light, {exposure, noise, 3});
            double sum = 0, sum2 = 0;
            for (const Rgba8& p : image.pixels()) {
                sum += p.g;
                sum2 += static_cast<double>(p.g) * p.g;
            }
            const double mean = sum / 40000;
            const double expected = 255 * static_cast<double>(srgb_from_linear(linear * static_cast<float>(exposure)));
            EXPECT_NEAR(mean, expected, noise > 0 ? 0.1 : 0.51);
            if (noise > 0) {
                EXPECT_NEAR(std::sqrt(sum2 / 40000 - mean * mean), std::hypot(noise, 0.289), 0.03 * noise);
            }
        }
    }
    EXPECT_EQ(expose(light, {1, 2, 5}), expose(light, {1, 2, 5}));
    EXPECT_NE(expose(light, {1, 2, 5}), expose(light, {1, 2, 6}));
    const Image<RgbaF> bright(2, 2, {5, 5, 5, 1});
    EXPECT_EQ(expose(bright, {})(0, 0), (Rgba8{255, 255, 255, 255}));
}

}  // namespace
}  // namespace rs::capture::test
