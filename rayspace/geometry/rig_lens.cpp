#include "rayspace/geometry/rig_lens.hpp"

#include "rayspace/base/printable.hpp"

#include <algorithm>

namespace rs {
namespace {

constexpr std::size_t kShownName_bytes = 40;

bool is_true(const nlohmann::json& value) {
    return (value.is_boolean() && value.get<bool>()) || (value.is_number() && value.get<double>() != 0);
}

}  // namespace

nlohmann::json stated_key(const nlohmann::json& file, const nlohmann::json& frame, std::string_view key) {
    for (const nlohmann::json* const keys : {&frame, &file}) {
        if (const auto found = keys->find(key); keys->is_object() && found != keys->end()) return *found;
    }
    return {};
}

StatedLens stated_lens(const nlohmann::json& file, const nlohmann::json& frame) {
    for (const nlohmann::json* const keys : {&frame, &file}) {
        if (!keys->is_object()) continue;
        for (const auto& [key, value] : keys->items()) {
            if (key.starts_with("ftheta_")) return {LensKind::kOther, printable(key)};
        }
    }
    for (const std::string_view flag : kPanoramaFlags) {
        if (is_true(stated_key(file, frame, flag))) return {LensKind::kOther, std::string(flag)};
    }
    StatedLens lens;
    for (const char* const key : {"camera_model", "camera_type"}) {
        const nlohmann::json value = stated_key(file, frame, key);
        if (!value.is_string()) continue;
        const auto name = value.get<std::string>();
        const std::string stated = std::string(key) + " " + printable(name.substr(0, kShownName_bytes));
        if (std::ranges::find(kFisheyeLensNames, name) != kFisheyeLensNames.end()) {
            lens = {LensKind::kFisheye, stated};
        } else if (std::ranges::find(kPinholeLensNames, name) == kPinholeLensNames.end()) {
            return {LensKind::kOther, stated};
        }
        break;
    }
    if (is_true(stated_key(file, frame, "is_fisheye"))) return {LensKind::kFisheye, "is_fisheye"};
    return lens;
}

}  // namespace rs
