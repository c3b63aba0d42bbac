// Photometric webs against analytic integrals and symmetries.

#include "rayspace/light/photometric_web.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace rs {
namespace {

std::vector<double> steps(double first, double last, double step) {
    std::vector<double> angles;
    for (int i = 0; first + i * step <= last + 1e-9; ++i) angles.push_back(first + i * step);
    return angles;
}

using Intensity = std::function<double(double vertical_deg, double horizontal_deg)>;

PhotometricTable table_of(Goniometer type, std::vector<double> vertical, std::vector<double> horizontal,
                          const Intensity& intensity) {
    PhotometricTable table{type, std::move(vertical), std::move(horizontal), {}};
    for (const double h : table.horizontal_deg) {
        for (const double v : table.vertical_deg) table.candela.push_back(intensity(v, h));
    }
    return table;
}

// Independent reference implementation of the header's specification.
glm::dvec3 type_c(double vertical_deg, double horizontal_deg) {
    const double v = radians(vertical_deg), h = radians(horizontal_deg);
    return {std::sin(v) * std::cos(h), -std::cos(v), -std::sin(v) * std::sin(h)};
}
glm::dvec3 type_a(double v_deg, double h_deg) {
    const double v = radians(v_deg), h = radians(h_deg);
    return {std::cos(v) * std::sin(h), -std::cos(v) * std::cos(h), -std::sin(v)};
}
glm::dvec3 type_b(double v_deg, double h_deg) {
    const double v = radians(v_deg), h = radians(h_deg);
    return {std::sin(h), -std::cos(h) * std::cos(v), -std::cos(h) * std::sin(v)};
}

TEST(PhotometricWeb, AllDirectionsAlikeGiveFourPiLumensAndALambertDiscPi) {
    const auto even =
        PhotometricWeb::create(table_of(Goniometer::kTypeC, {0, 180}, {0}, [](double, double) { return 1; }));
    ASSERT_TRUE(even) << even.error().message;
    EXPECT_NEAR(even->lumens(), 4 * kPi, 1e-9);
    EXPECT_NEAR(even->zonal_lumens(), 4 * kPi, 1e-9);
    const auto cosine = [](double v, double) { return std::max(std::cos(radians(v)), 0.0); };
    const auto disc = PhotometricWeb::create(table_of(Goniometer::kTypeC, steps(0, 90, 0.5), {0}, cosine));
    ASSERT_TRUE(disc);
    EXPECT_NEAR(disc->lumens(), kPi, 1e-4 * kPi);
    EXPECT_DOUBLE_EQ(disc->candela({0, 1, 0}), 0);
    EXPECT_NEAR(disc->candela({0, -3, 0}), 1, 1e-12);
}

TEST(PhotometricWeb, PlanesThatAreLeftOutAreMirrored) {
    const auto quarter = [](double v, double h) { return 100 + v + h; };
    const auto both = PhotometricWeb::create(table_of(Goniometer::kTypeC, steps(0, 180, 5), {0, 30, 90}, quarter));
    const auto one = PhotometricWeb::create(table_of(Goniometer::kTypeC, steps(0, 180, 5), {0, 45, 90, 180}, quarter));
    const auto other = PhotometricWeb::create(table_of(Goniometer::kTypeC, steps(0, 180, 5), {90, 120, 270}, quarter));
    const auto all = PhotometricWeb::create(table_of(Goniometer::kTypeC, steps(0, 180, 5), {0, 90, 200, 350}, quarter));
    ASSERT_TRUE(both && one && other && all);
    for (const double h : {10.0, 30.0, 77.0, 90.0}) {
        for (const double v : {5.0, 40.0, 122.0}) {
            const double wanted = both->candela(type_c(v, h));
            EXPECT_NEAR(wanted, 100 + v + h, 1e-9);
            for (const double like : {180 - h, 180 + h, 360 - h}) {
                EXPECT_NEAR(both->candela(type_c(v, like)), wanted, 1e-9) << h << " " << like;
            }
            EXPECT_NEAR(one->candela(type_c(v, 360 - h)), one->candela(type_c(v, h)), 1e-9);
            EXPECT_NEAR(one->candela(type_c(v, 180 - h)), 100 + v + 180 - h, 1e-9);
            EXPECT_NEAR(other->candela(type_c(v, 180 - h)), 100 + v + 180 - h, 1e-9);
            EXPECT_NEAR(other->candela(type_c(v, h)), 100 + v + 180 - h, 1e-9);
            EXPECT_NEAR(other->candela(type_c(v, 180 + h)), 100 + v + 180 + h, 1e-9);
            EXPECT_NEAR(other->candela(type_c(v, 360 - h)), 100 + v + 180 + h, 1e-9);
            EXPECT_NEAR(all->candela(type_c(v, h)), 100 + v + h, 1e-9);
        }
    }
    EXPECT_NEAR(all->candela(type_c(30, 355)), 0.5 * (130 + 350) + 0.5 * 130, 1e-9);  // round to plane 0
}

// A web with one plane against the same plane repeated beside a different one: equal away from the latter.
TEST(PhotometricWeb, OnePlaneForAllIsThatPlaneAllAround) {
    const auto plane = [](double v, double) { return 310 - v * (2 + v / 200); };
    const auto dented = [&](double v, double h) { return h == 180 ? plane(v, h) / 2 : plane(v, h); };
    const std::vector<double> vertical = {0, 20, 45, 80, 100};
    const auto alone = PhotometricWeb::create(table_of(Goniometer::kTypeC, vertical, {0}, plane));
    const auto among = PhotometricWeb::create(table_of(Goniometer::kTypeC, vertical, steps(0, 360, 30), dented));
    ASSERT_TRUE(alone && among);
    for (int v = 1; v < 180; v += 3) {
        for (int h = 0; h < 360; h += 7) {
            const double found = alone->candela(type_c(v, h)), expected = among->candela(2.5 * type_c(v, h));
            if (h <= 150 || h >= 210) {
                EXPECT_NEAR(found, expected, 1e-10) << v << ", " << h;
            } else if (v < 100) {
                EXPECT_GT(found, expected) << v << ", " << h;
            }
        }
    }
}

TEST(PhotometricWeb, TypesAAndBHaveTheirPolesWhereTheGoniometerHas) {
    const auto odd = [](double v, double h) { return 500 + 2 * v + h; };
    const std::vector<double> whole = steps(-90, 90, 10);
    const auto a = PhotometricWeb::create(table_of(Goniometer::kTypeA, whole, whole, odd));
    const auto b = PhotometricWeb::create(table_of(Goniometer::kTypeB, whole, whole, odd));
    const auto mirrored = PhotometricWeb::create(table_of(Goniometer::kTypeB, steps(0, 90, 10), steps(0, 90, 10), odd));
    ASSERT_TRUE(a && b && mirrored);
    for (const double v : {-75.0, -20.0, 0.0, 35.0}) {
        for (const double h : {-60.0, -5.0, 0.0, 82.0}) {
            EXPECT_NEAR(a->candela(type_a(v, h)), odd(v, h), 1e-9);
            EXPECT_NEAR(b->candela(type_b(v, h)), odd(v, h), 1e-9);
            EXPECT_NEAR(mirrored->candela(type_b(v, h)), odd(std::abs(v), std::abs(h)), 1e-9);
        }
    }
    EXPECT_EQ(b->candela({0, 1, 0}), 0);  // behind
    const auto even = [](double, double) { return 1; };
    for (const Goniometer type : {Goniometer::kTypeA, Goniometer::kTypeB}) {
        EXPECT_NEAR(PhotometricWeb::create(table_of(type, whole, whole, even))->lumens(), 2 * kPi, 1e-9);
    }
}

// Chi-squared test over cells of equal solid angle; degrees of freedom: number of cells with flux minus one.
TEST(PhotometricWebProperty, DirectionsAreDrawnAsTheWebShines) {
    const auto lobes = [](double v, double h) { return v > 130 ? 0.0 : 5 + v * (1 + std::cos(radians(2 * h))); };
    const std::vector<double> uneven = {0, 3, 10, 30, 31, 60, 90, 130, 131, 180};
    for (const bool floodlight : {false, true}) {
        const auto web =
            floodlight ? PhotometricWeb::create(table_of(Goniometer::kTypeB, steps(-40, 70, 10), steps(-80, 60, 20),
                                                         [](double v, double h) { return 90 + v + h / 2; }))
                       : PhotometricWeb::create(table_of(Goniometer::kTypeC, uneven, {0, 20, 90}, lobes));
        ASSERT_TRUE(web);
        constexpr int kHeights = 24, kTurns = 36, kDraws = 400'000, kFine = 24;
        const auto cell = [&](const glm::dvec3& d) {
            const int height = std::min(static_cast<int>((d.y + 1) / 2 * kHeights), kHeights - 1);
            const int turn = std::min(static_cast<int>((std::atan2(d.z, d.x) + kPi) / (2 * kPi) * kTurns), kTurns - 1);
            return static_cast<std::size_t>(height * kTurns + turn);
        };
        std::vector<double> expected(kHeights * kTurns), found(kHeights * kTurns);
        for (int i = 0; i < kHeights * kFine; ++i) {
            for (int j = 0; j < kTurns * kFine; ++j) {
                const double y = -1 + 2 * (i + 0.5) / (kHeights * kFine);
                const double turn = -kPi + 2 * kPi * (j + 0.5) / (kTurns * kFine);
                const double across = std::sqrt(1 - y * y);
                const glm::dvec3 d(across * std::cos(turn), y, across * std::sin(turn));
                expected[cell(d)] += web->pdf(d) * 4 * kPi / (kHeights * kTurns * kFine * kFine) * kDraws;
            }
        }
        EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), kDraws, 1e-3 * kDraws);
        test::Random random(7);
        for (int i = 0; i < kDraws; ++i) {
            const glm::dvec3 d = web->sample({random.real(0, 1), random.real(0, 1)});
            ASSERT_NEAR(glm::length(d), 1, 1e-12);
            ++found[cell(d)];
        }
        double chi2 = 0, few_expected = 0, few_found = 0;
        int cells = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (expected[i] < 10) {
                few_expected += expected[i], few_found += found[i];
                continue;
            }
            chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
            ++cells;
        }
        EXPECT_NEAR(few_found, few_expected, 5 * std::sqrt(few_expected) + 25);
        // The 99 % point by Wilson and Hilferty.
        const double n = cells - 1;
        const double limit = n * std::pow(1 - 2 / (9 * n) + 2.326 * std::sqrt(2 / (9 * n)), 3);
        EXPECT_LT(chi2, limit) << n << " degrees of freedom";
    }
}

TEST(PhotometricWeb, TablesThatMeanNothingAreRefused) {
    const auto even = [](double, double) { return 1.0; };
    const auto refused = [&](std::vector<double> vertical, std::vector<double> horizontal, const Intensity& values) {
        const auto web =
            PhotometricWeb::create(table_of(Goniometer::kTypeC, std::move(vertical), std::move(horizontal), values));
        return web ? std::string() : web.error().message;
    };
    EXPECT_NE(refused({0}, {0}, even), "");
    EXPECT_NE(refused({0, 200}, {0}, even), "");
    EXPECT_NE(refused({0, 90, 90}, {0}, even), "");
    EXPECT_NE(refused({0, 90}, {0, 45}, even), "");
    EXPECT_NE(refused({0, 90}, {10, 180}, even), "");
    EXPECT_NE(refused({0, 90}, {0}, [](double, double) { return -1.0; }), "");
    EXPECT_NE(refused({0, 90}, {0}, [](double, double) { return std::nan(""); }), "");
    EXPECT_NE(refused({0, 90}, {0}, [](double, double) { return 1e308; }), "");
    EXPECT_NE(refused({0, 90}, {0}, [](double, double) { return 0.0; }), "");
    EXPECT_EQ(refused({0, 90}, {0}, even), "");
}

}  // namespace
}  // namespace rs
