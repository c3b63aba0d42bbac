#include "datasets-synthetic/showroom/evening.hpp"

#include "rayspace/base/conventions.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rs::synthetic {
namespace {

constexpr double kPower = 1.5;
constexpr double kLumens = 560;
constexpr double kStep_deg = 2.5;
constexpr float kBelowCeiling_m = 0.3F;
constexpr float kApart_m = 2.0F;

double rounded(double value) {
    return std::round(value * 1e4) / 1e4;
}

nlohmann::ordered_json luminaire_at(const glm::vec3& place, const glm::vec3& colour) {
    const auto triple = [](const glm::vec3& v) {
        return nlohmann::ordered_json{rounded(static_cast<double>(v.x)), rounded(static_cast<double>(v.y)),
                                      rounded(static_cast<double>(v.z))};
    };
    return {{"kind", "luminaire"}, {"file", kDownlightFile}, {"location", triple(place)}, {"colour", triple(colour)}};
}

}  // namespace

std::string downlight_ies() {
    // The flux of cos^p over the lower half is 2 pi / (p + 1).
    const double peak = kLumens * (kPower + 1) / (2 * kPi);
    const int rows = static_cast<int>(90 / kStep_deg) + 1;
    std::string text =
        "IESNA:LM-63-2002\n[TEST]none: computed\n[MANUFAC]Rayspace\n[LUMCAT]downlight\n"
        "[LUMINAIRE]round downlight of the showroom\nTILT=NONE\n";
    text += "1 -1 1 " + std::to_string(rows) + " 1 1 2 -0.12 -0.12 0\n1 1 7\n";
    char number[32];
    for (int row = 0; row < rows; ++row) {
        std::snprintf(number, sizeof number, "%g%c", row * kStep_deg, row % 10 == 9 || row + 1 == rows ? '\n' : ' ');
        text += number;
    }
    text += "0\n";
    for (int row = 0; row < rows; ++row) {
        const double candela = peak * std::pow(std::max(std::cos(radians(row * kStep_deg)), 0.0), kPower);
        std::snprintf(number, sizeof number, "%.2f%c", candela, row % 10 == 9 || row + 1 == rows ? '\n' : ' ');
        text += number;
    }
    return text;
}

std::string evening_lights(const World& world) {
    const glm::vec3 warm(1.0F, 0.8F, 0.55F), neutral(1.0F, 0.95F, 0.88F);
    nlohmann::ordered_json list;
    list["replace"] = true;
    list["lights"] = nlohmann::ordered_json::array();
    for (const Room& room : world.rooms) {
        const bool lamps = std::ranges::any_of(
            room.lights, [](const WorldLight& light) { return light.kind == WorldLightKind::point; });
        const glm::vec3 size = room.high - room.low;
        const int columns = std::max(static_cast<int>(std::lround(size.x / kApart_m)), 1);
        const int rows = std::max(static_cast<int>(std::lround(size.z / kApart_m)), 1);
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const glm::vec3 place(
                    room.low.x + size.x * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns),
                    room.high.y - kBelowCeiling_m,
                    room.low.z + size.z * (static_cast<float>(row) + 0.5F) / static_cast<float>(rows));
                list["lights"].push_back(luminaire_at(place, lamps ? warm : neutral));
            }
        }
        for (const WorldLight& light : room.lights) {
            if (light.kind == WorldLightKind::point) list["lights"].push_back(luminaire_at(light.place, warm));
        }
    }
    return list.dump(1) + "\n";
}

}  // namespace rs::synthetic
