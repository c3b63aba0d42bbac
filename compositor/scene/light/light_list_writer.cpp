// Writer of light lists; the reader is lights_file.cpp.
#include "compositor/scene/light/lights_file.hpp"

#include "rayspace/file/file_output.hpp"
#include "rayspace/light/light_model.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <utility>

namespace rs::compositor {
namespace {

using Json = nlohmann::ordered_json;

// Integers are written without ".0".
Json json_of(double number) {
    constexpr double kMaxExactInteger = 1e15;
    const bool whole = number == std::floor(number) && std::abs(number) < kMaxExactInteger;
    const bool minus_zero = number == 0 && std::signbit(number);
    return whole && !minus_zero ? Json(static_cast<std::int64_t>(number)) : Json(number);
}

Json json_of(const glm::dvec3& v) {
    return Json::array({json_of(v.x), json_of(v.y), json_of(v.z)});
}

// Path of the file relative to `folder`.
std::string name_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
    const auto whole = [](const std::filesystem::path& path) {
        std::error_code failed;
        const std::filesystem::path absolute = std::filesystem::absolute(path, failed);
        return (failed ? path : absolute).lexically_normal();
    };
    const std::filesystem::path from_there = whole(file).lexically_relative(whole(folder.empty() ? "." : folder));
    return (from_there.empty() ? whole(file) : from_there).generic_string();
}

Json json_of(const LightEntry& entry, const std::filesystem::path& folder) {
    const LightWords& words = model_of(entry).words;
    Json json;
    json["kind"] = words.kind;
    if (!entry.name.empty()) json["name"] = entry.name;
    if (words.has_file) json["file"] = name_from(folder, entry.file);
    if (words.has_place) json["location"] = json_of(entry.location);
    if (words.has_aim) json["aim"] = json_of(entry.aim);
    if (words.turns && entry.turn_deg != 0) json["turn_deg"] = json_of(entry.turn_deg);
    if (words.sizes.size() == 1) json["size"] = json_of(entry.size.x);
    if (words.sizes.size() == 2) json["size"] = Json::array({json_of(entry.size.x), json_of(entry.size.y)});
    if (entry.radiance) {
        json[words.radiance] = json_of(*entry.radiance);
    } else if (!words.power_is_factor || entry.power != 1) {
        json[words.power] = json_of(entry.power);
    }
    if (entry.colour != glm::dvec3(1)) json["colour"] = json_of(entry.colour);
    if (words.falls_off && entry.radiance) json["attenuation"] = json_of(entry.attenuation);
    if (words.falls_off && std::isfinite(entry.reach)) json["reach"] = json_of(entry.reach);
    for (const LightNumber& number : words.numbers) json[number.key] = json_of(entry.*number.value);
    if (entry.ambient != glm::dvec3(0)) json["ambient"] = json_of(entry.ambient);
    if (entry.scope) json["scope"] = *entry.scope;
    return json;
}

// True if the reader accepts the numbers.
bool is_within_limits(const LightEntry& entry) {
    const auto within = [](const glm::dvec3& v, double most) {
        return glm::all(glm::lessThanEqual(glm::abs(v), glm::dvec3(most)));
    };
    return within(entry.location, kMaxLightDistance) && within(entry.aim, kMaxLightDistance) &&
           within(entry.colour, kMaxLightStrength) &&
           within(entry.radiance.value_or(glm::dvec3(0)), kMaxLightStrength) &&
           within(entry.ambient, kMaxLightStrength) && within(entry.attenuation, kMaxLightStrength) &&
           within({entry.size, entry.power / kMaxLightStrength}, kMaxLightDistance) &&
           entry.power <= kMaxLightStrength && glm::all(glm::greaterThanEqual(entry.size, glm::dvec2(kShortest))) &&
           ((entry.reach >= kShortest && entry.reach <= kMaxLightDistance) || std::isinf(entry.reach));
}

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Result<std::string> light_list_to_json(const LightList& list, const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    std::string text = "{";
    if (list.replace) text += " \"replace\": true,\n ";
    if (list.headlight) text += " \"headlight\": true,\n ";
    text += " \"lights\": [";
    for (std::size_t i = 0; i < list.entries.size(); ++i) {
        const LightEntry& entry = list.entries[i];
        if (model_of(entry).words.has_file && entry.file.empty()) {
            return Error{path.string() + ": lights[" + std::to_string(i) + "] has no photometric file; choose one"};
        }
        if (!is_within_limits(entry)) {
            return Error{path.string() + ": lights[" + std::to_string(i) +
                         "] has values outside of a list's limits; change them"};
        }
        text += (i > 0 ? ",\n    " : "\n    ") + text_of(json_of(entry, folder));
    }
    text += " ]";
    if (const auto& environment = list.environment_entry) {
        if (environment->file.empty()) {
            return Error{path.string() + ": environment: has no image file; choose one"};
        }
        Json json;
        json["file"] = name_from(folder, environment->file);
        json["scale"] = json_of(environment->scale);
        if (environment->turn_deg != 0) json["turn_deg"] = json_of(environment->turn_deg);
        if (environment->seen) json["seen"] = true;
        text += ",\n  \"environment\": " + text_of(json);
    }
    return text + " }\n";
}

Status write_light_list(const LightList& list, const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const std::string text, light_list_to_json(list, path));
    return write_file(path, text);
}

}  // namespace rs::compositor
