// Invariants of all kinds of light; a new kind needs only a row in the table.

#include "rayspace/light/light_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace rs {
namespace {

constexpr const char* kIes = "TILT=NONE\n1 -1 1 4 2 1 2 0 0 0 1 1 9\n0 45 70 80\n0 90\n179 150 40 0\n179 160 80 0\n";

// Entries with power or, if supported, with radiance and its related fields.
struct Example {
    LightKind kind;
    bool by_radiance;
};

std::string name_of_example(const testing::TestParamInfo<Example>& info) {
    return model_of(info.param.kind).words.kind + std::string(info.param.by_radiance ? "_by_radiance" : "");
}

std::vector<LightKind> all_kinds() {
    std::vector<LightKind> kinds;
    for (std::size_t i = 0; i < kLightKinds; ++i) kinds.push_back(static_cast<LightKind>(i));
    return kinds;
}

std::vector<Example> all_examples() {
    std::vector<Example> examples;
    for (const LightKind kind : all_kinds()) {
        examples.push_back({kind, false});
        if (model_of(kind).words.radiance != nullptr) examples.push_back({kind, true});
    }
    return examples;
}

// A light in general position.
LightEntry entry_of_example(const Example& example) {
    const LightModel& model = model_of(example.kind);
    LightEntry entry = model.example();
    entry.kind = example.kind;
    if (example.by_radiance) entry.radiance = {3, 2, 1};
    if (example.by_radiance && model.words.falls_off) {
        entry.attenuation = {1, 0.5, 0.25};
        entry.reach = 2;
    }
    entry.name = "this";
    entry.colour = {1, 0.5, 0.25};
    entry.ambient = {0.1, 0.2, 0.3};
    if (model.words.has_place) entry.location = {1, 2, -3};
    if (model.words.has_aim) entry.aim = {1, -2, 0.5};
    if (model.words.turns) entry.turn_deg = 20;
    if (model.words.has_file) {
        entry.file = "this.ies";
        entry.luminaire = std::make_shared<const Luminaire>(parse_ies(kIes, "this.ies").value());
    }
    return entry;
}

class EveryLight : public testing::TestWithParam<Example> {
protected:
    const LightModel& model_ = model_of(GetParam().kind);
    const LightEntry entry_ = entry_of_example(GetParam());
    const Light light_ = light_of(entry_);

    // Uniform direction on the sphere; u in [0, 1)^2.
    static glm::dvec3 on_sphere(const glm::dvec2& u) {
        const double z = 1 - 2 * u.x;
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
    }

    std::mt19937 random_{3};
    std::uniform_real_distribution<float> any_{0, 1};
};

TEST_P(EveryLight, IsItself) {
    EXPECT_EQ(light_.kind, GetParam().kind);
    EXPECT_TRUE(check_light(light_)) << check_light(light_).error().message;
    EXPECT_FALSE(std::string(model_.words.kind).empty());
    EXPECT_TRUE(entry_.power == 1 || !model_.words.power_is_factor);
}

TEST_P(EveryLight, EntriesComeBack) {
    const LightEntry again = entry_from_light(light_);
    EXPECT_EQ(again.name, entry_.name);
    EXPECT_EQ(again.ambient, glm::dvec3(light_.ambient));
    EXPECT_EQ(again.location, entry_.location);
    EXPECT_EQ(again.reach, entry_.reach);
    EXPECT_EQ(again.attenuation, entry_.attenuation);
    const Light same = light_of(again);
    EXPECT_EQ(same.radius, light_.radius);
    EXPECT_LT(glm::distance(same.colour, light_.colour), 1e-5F * glm::length(light_.colour));
    if (!model_.words.has_aim) return;
    EXPECT_LT(glm::distance(model_.axis(light_), unit_vector(entry_.aim)), 1e-12);
    EXPECT_LT(glm::distance(model_.axis(same), model_.axis(light_)), 1e-9);
    EXPECT_NEAR(again.turn_deg, entry_.turn_deg, 1e-9);
    if (model_.words.turns) {
        LightEntry turned = entry_;
        turned.turn_deg = -70;
        EXPECT_NEAR(entry_from_light(light_of(turned)).turn_deg, -70, 1e-9);
    }
    for (std::size_t i = 0; i < model_.words.sizes.size(); ++i) {
        EXPECT_NEAR(again.size[static_cast<int>(i)], entry_.size[static_cast<int>(i)], 1e-12);
    }
    for (const LightNumber& number : model_.words.numbers) {
        EXPECT_NEAR(again.*number.value, entry_.*number.value, 1e-9) << number.key;
    }
}

// One invalid field at a time.
TEST_P(EveryLight, RefusesWhatCannotBe) {
    const auto refuses = [&](const auto& change) {
        Light wrong = light_;
        change(wrong);
        return !check_light(wrong);
    };
    EXPECT_TRUE(refuses([](Light& light) { light.colour.y = -1; }));
    EXPECT_TRUE(refuses([](Light& light) { light.colour.y = std::nanf(""); }));
    EXPECT_EQ(refuses([](Light& light) { light.location.z = std::nan(""); }), model_.words.has_place);
    EXPECT_EQ(refuses([](Light& light) { light.luminaire = nullptr; }), model_.words.has_file);
    const bool is_area = model_.form == LightForm::kArea;
    EXPECT_EQ(refuses([](Light& light) { light.half_u = light.half_v; }), is_area);
    const bool has_direction = model_.words.has_aim && !is_area && !model_.words.has_file;
    EXPECT_EQ(refuses([](Light& light) { light.towards = glm::dvec3(0); }), has_direction);
}

TEST_P(EveryLight, TurnsAboutY) {
    const Light turned = rotate_about_y(light_, kPi / 2);
    const auto expected = [](const glm::dvec3& v) { return glm::dvec3(v.z, v.y, -v.x); };
    EXPECT_LT(glm::distance(model_.axis(turned), expected(model_.axis(light_))), 1e-12);
    EXPECT_NEAR(model_.strength(turned), model_.strength(light_), 1e-12);
    const glm::dvec3 place(0.3, -0.7, 0.2);
    EXPECT_LT(glm::distance(irradiance_at(turned, expected(place)), irradiance_at(light_, place)), 1e-4F);
}

TEST_P(EveryLight, ForRasterIsPunctual) {
    const Light punctual = to_punctual_light(light_);
    EXPECT_TRUE(punctual.kind == LightKind::kDirectional || punctual.kind == LightKind::kPoint ||
                punctual.kind == LightKind::kSpot);
    EXPECT_TRUE(check_light(punctual));
    EXPECT_EQ(punctual.name, light_.name);
    EXPECT_EQ(punctual.everywhere, light_.everywhere);
    if (entry_.reach < 50) {
        EXPECT_EQ(punctual.radius, light_.radius);
        return;
    }
    // Equally bright at a large distance on the axis.
    const double far = 50;
    const glm::vec3 seen = irradiance_at(punctual, light_.location + far * model_.axis(light_));
    const double share = model_.form == LightForm::kDistant ? 1 : 1 / (far * far);
    const glm::vec3 expected = light_.colour * static_cast<float>(model_.strength(light_) * share);
    EXPECT_LT(glm::distance(seen, expected), 2e-3F * glm::length(expected));
}

TEST_P(EveryLight, HasItsFlux) {
    const double distance = 0.7;
    const double flux = model_.flux(light_, distance).x;
    if (model_.form == LightForm::kDistant) {
        EXPECT_EQ(flux, 0);
        return;
    }
    if (model_.form == LightForm::kArea) {
        const double radiosity = kPi * static_cast<double>(light_.colour.x);
        EXPECT_NEAR(flux, radiosity * model_.strength(light_), 1e-5 * flux);
        return;
    }
    // Flux through a sphere against the mean of sampled directions.
    constexpr int kSteps = 400;
    double arrives = 0, sent = 0;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const glm::dvec2 u((i / kSteps + 0.5) / kSteps, (i % kSteps + 0.5) / kSteps);
        const auto at = [&](const glm::dvec3& direction) {
            return static_cast<double>(irradiance_at(light_, light_.location + distance * direction).x) * distance *
                   distance;
        };
        arrives += at(on_sphere(u)) * 4 * kPi;
        const auto drawn = model_.sample(light_, glm::vec2(u));
        if (drawn) sent += at(glm::dvec3(drawn->direction)) * static_cast<double>(drawn->inverse_pdf);
    }
    EXPECT_NEAR(arrives / (kSteps * kSteps), flux, 2e-3 * flux);
    EXPECT_NEAR(sent / (kSteps * kSteps), flux, 2e-3 * flux);
}

TEST_P(EveryLight, GoesNoFartherThanItSays) {
    if (model_.form != LightForm::kPoint) return;
    const LightReach reach = model_.reach(light_);
    const double most = static_cast<double>(light_.colour.x) * model_.strength(light_);
    for (int i = 0; i < 20'000; ++i) {
        const double d = 4 * static_cast<double>(any_(random_)) + 1e-3;
        const glm::dvec3 direction = on_sphere({any_(random_), any_(random_)});
        const auto arrives = static_cast<double>(irradiance_at(light_, light_.location + d * direction).x);
        const double falloff = std::max(glm::dot(glm::dvec3(reach.attenuation), glm::dvec3(1, d, d * d)),
                                        static_cast<double>(reach.least_attenuation));
        EXPECT_LE(arrives, most / falloff * (1 + 1e-6));
        const double cosine = glm::dot(direction, model_.axis(light_));
        const bool outside = d > reach.radius || cosine < static_cast<double>(reach.min_cos);
        EXPECT_TRUE(!outside || arrives == 0) << d << " " << cosine;
    }
}

TEST_P(EveryLight, IsEvenWhereItSaysSo) {
    if (model_.form != LightForm::kPoint) return;
    const float on_axis = irradiance_at(light_, light_.location + model_.axis(light_)).x;
    float least = on_axis;
    double widest = 1;  // cosine
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 direction = on_sphere({any_(random_), any_(random_)});
        const float arrives = irradiance_at(light_, light_.location + direction).x;
        least = std::min(least, arrives);
        if (arrives > 0) widest = std::min(widest, glm::dot(direction, model_.axis(light_)));
    }
    EXPECT_EQ(least > 0.99F * on_axis, model_.is_isotropic());
    EXPECT_NEAR(widest, static_cast<double>(model_.reach(light_).min_cos), 0.06) << "no wider than need be";
}

TEST_P(EveryLight, CoversItsArea) {
    if (model_.form != LightForm::kArea) return;
    constexpr int kSteps = 512;
    int covered = 0;
    glm::dvec2 mean(0), squares(0), drawn_mean(0), drawn_squares(0);
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const glm::vec2 u((static_cast<float>(i / kSteps) + 0.5F) / kSteps,
                          (static_cast<float>(i % kSteps) + 0.5F) / kSteps);
        const glm::vec2 at = 2.0F * u - 1.0F;
        if (model_.covers(at)) {
            ++covered;
            mean += at;
            squares += at * at;
        }
        const glm::vec2 drawn = model_.point(u);
        ASSERT_TRUE(model_.covers(drawn * 0.99999F));
        drawn_mean += drawn;
        drawn_squares += drawn * drawn;
    }
    const double count = kSteps * kSteps;
    const double parallelogram = 4 * glm::length(glm::cross(light_.half_u, light_.half_v));
    EXPECT_NEAR(covered / count * parallelogram, model_.strength(light_), 2e-3 * model_.strength(light_));
    // Points are uniformly distributed, tested by two moments.
    EXPECT_LT(glm::distance(drawn_mean / count, mean / static_cast<double>(covered)), 1e-3);
    EXPECT_LT(glm::distance(drawn_squares / count, squares / static_cast<double>(covered)), 1e-3);
}

TEST_P(EveryLight, HasAnOutlineThatCanBeSeen) {
    EXPECT_EQ(model_.outline(entry_).lines.empty(), model_.form == LightForm::kDistant || model_.is_isotropic());
    for (const std::vector<glm::dvec3>& line : model_.outline(entry_).lines) {
        EXPECT_GE(line.size(), 2U);
        for (const glm::dvec3& point : line) EXPECT_LT(glm::length(point), 2);
    }
}

TEST(LightKinds, HaveWordsOfTheirOwn) {
    std::set<std::string> words;
    for (const LightKind kind : all_kinds()) words.insert(model_of(kind).words.kind);
    EXPECT_EQ(words.size(), kLightKinds);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryLight, testing::ValuesIn(all_examples()), name_of_example);

}  // namespace
}  // namespace rs
