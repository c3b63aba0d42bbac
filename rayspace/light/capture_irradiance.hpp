#pragma once
// The light of a capture in its transforms.json. Thread-safe.

#include "rayspace/base/result.hpp"
#include "rayspace/light/irradiance_harmonics.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace rs {

/// Top-level key of transforms.json: irradiance at the object, without the object, while its images were taken, in the
/// axes of the cameras and the scale of the images' linear light.
inline constexpr const char* kCaptureIrradianceKey = "capture_irradiance";

/// Nine arrays of red, green and blue: IrradianceHarmonics::factors.
nlohmann::json irradiance_to_json(const IrradianceHarmonics& irradiance);
/// \param where names the value in errors
Result<IrradianceHarmonics> irradiance_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace rs
