#include "tests/bench/scenes/light_list.hpp"

#include "rayspace/base/conventions.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace rs::synthetic {
namespace {

using Json = nlohmann::ordered_json;

double to_four_places(double value) {
    return std::round(value * 1e4) / 1e4;
}

Json numbers(const glm::vec3& v) {
    return Json{to_four_places(static_cast<double>(v.x)), to_four_places(static_cast<double>(v.y)),
                to_four_places(static_cast<double>(v.z))};
}

}  // namespace

LightList::LightList() : lights_(std::make_unique<Json>(Json::array())) {}
LightList::~LightList() = default;

void LightList::sun(glm::vec3 aim, double lux, glm::vec3 colour) {
    lights_->push_back(
        {{"kind", "directional"}, {"name", "sun"}, {"aim", numbers(aim)}, {"lux", lux}, {"colour", numbers(colour)}});
}

void LightList::point(glm::vec3 place, double candela, glm::vec3 colour) {
    lights_->push_back(
        {{"kind", "point"}, {"location", numbers(place)}, {"candela", candela}, {"colour", numbers(colour)}});
}

void LightList::rectangle(glm::vec3 middle, glm::vec3 aim, glm::vec2 size, double lumens, glm::vec3 colour) {
    const Json sides{to_four_places(static_cast<double>(size.x)), to_four_places(static_cast<double>(size.y))};
    lights_->push_back({{"kind", "rectangle"},
                        {"location", numbers(middle)},
                        {"aim", numbers(aim)},
                        {"size", sides},
                        {"lumens", lumens},
                        {"colour", numbers(colour)}});
}

void LightList::luminaire(const std::string& file, glm::vec3 place, glm::vec3 aim, glm::vec3 colour) {
    lights_->push_back({{"kind", "luminaire"},
                        {"file", file},
                        {"location", numbers(place)},
                        {"aim", numbers(aim)},
                        {"colour", numbers(colour)}});
}

std::string LightList::text() const {
    const Json list{{"replace", true}, {"lights", *lights_}};
    return list.dump(1) + "\n";
}

std::string beam_ies(const std::string& name, double lumens, double half_deg) {
    constexpr double kStep_deg = 1.5;
    constexpr int kAngles = 61;
    const auto shape = [&](double angle_deg) {
        const double share = angle_deg / half_deg;
        return std::exp2(-share * share) * std::cos(radians(angle_deg));
    };
    // Flux, by the midpoint rule with a tenth of the step.
    double flux = 0;
    for (int i = 0; i < 900; ++i) {
        const double angle = (i + 0.5) * 0.1;
        flux += shape(angle) * std::sin(radians(angle)) * radians(0.1) * 2 * kPi;
    }
    std::string text = "IESNA:LM-63-2002\n[TEST]none: computed\n[MANUFAC]Rayspace\n[LUMCAT]" + name +
                       "\n[LUMINAIRE]spot light, computed\nTILT=NONE\n1 -1 1 " + std::to_string(kAngles) +
                       " 1 1 2 -0.04 -0.04 0\n1 1 6\n";
    char number[32];
    for (int step = 0; step < kAngles; ++step) {
        std::snprintf(number, sizeof number, "%g%c", step * kStep_deg,
                      step % 10 == 9 || step + 1 == kAngles ? '\n' : ' ');
        text += number;
    }
    text += "0\n";
    for (int step = 0; step < kAngles; ++step) {
        const double candela = step + 1 == kAngles ? 0 : lumens / flux * shape(step * kStep_deg);
        std::snprintf(number, sizeof number, "%.2f%c", candela, step % 10 == 9 || step + 1 == kAngles ? '\n' : ' ');
        text += number;
    }
    return text;
}

}  // namespace rs::synthetic
