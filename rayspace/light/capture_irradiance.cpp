#include "rayspace/light/capture_irradiance.hpp"

#include <cmath>
#include <cstddef>

namespace rs {

nlohmann::json irradiance_to_json(const IrradianceHarmonics& irradiance) {
    nlohmann::json json = nlohmann::json::array();
    for (const glm::vec4& factor : irradiance.factors) json.push_back({factor.r, factor.g, factor.b});
    return json;
}

Result<IrradianceHarmonics> irradiance_from_json(const nlohmann::json& json, const std::string& where) {
    const Error malformed{where + ": must be 9 arrays of 3 finite numbers; leave it out if the light is unknown"};
    constexpr double kMaxFactor = 1e6;
    IrradianceHarmonics irradiance;
    if (!json.is_array() || json.size() != irradiance.factors.size()) return malformed;
    for (std::size_t i = 0; i < irradiance.factors.size(); ++i) {
        if (!json[i].is_array() || json[i].size() != 3) return malformed;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const nlohmann::json& number = json[i][channel];
            if (!number.is_number() || !(std::abs(number.get<double>()) <= kMaxFactor)) return malformed;
            irradiance.factors[i][static_cast<glm::length_t>(channel)] = number.get<float>();
        }
    }
    return irradiance;
}

}  // namespace rs
