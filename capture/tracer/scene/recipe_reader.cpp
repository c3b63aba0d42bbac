#include "capture/tracer/scene/recipe_reader.hpp"

#include <cmath>
#include <sstream>
#include <utility>

namespace rs::capture {

namespace {

const nlohmann::json& empty_object() {
    static const nlohmann::json kEmpty = nlohmann::json::object();
    return kEmpty;
}

std::string range_text(double low, double high) {
    std::ostringstream text;
    text << "must be a number";
    if (low > -RecipeReader::kHuge || high < RecipeReader::kHuge) text << " from " << low << " to " << high;
    return text.str();
}

bool in_range(const nlohmann::json& value, double low, double high) {
    return value.is_number() && value.get<double>() >= low && value.get<double>() <= high;
}

}  // namespace

RecipeReader::RecipeReader(const nlohmann::json& object, std::string place, RecipeErrors& errors)
    : object_(object.is_object() ? object : empty_object()), place_(std::move(place)), errors_(errors) {
    if (!object.is_object()) errors_.add(place_, "must be an object {...}");
}

std::string RecipeReader::place_of(const std::string& key) const {
    return place_.empty() ? key : place_ + "." + key;
}

bool RecipeReader::has(const char* key) const {
    return object_.contains(key);
}

const nlohmann::json* RecipeReader::child(const char* key) {
    known_.insert(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

void RecipeReader::read(const char* key, double& value, double low, double high) {
    const nlohmann::json* found = child(key);
    if (found == nullptr) return;
    if (!in_range(*found, low, high)) return complain(key, range_text(low, high));
    value = found->get<double>();
}

void RecipeReader::read(const char* key, float& value, double low, double high) {
    double wide = static_cast<double>(value);
    read(key, wide, low, high);
    value = static_cast<float>(wide);
}

void RecipeReader::read(const char* key, int& value, int low, int high) {
    const nlohmann::json* found = child(key);
    if (found == nullptr) return;
    if (!found->is_number_integer() || !in_range(*found, low, high)) {
        return complain(key, "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    value = found->get<int>();
}

void RecipeReader::read(const char* key, std::uint64_t& value) {
    const nlohmann::json* found = child(key);
    if (found == nullptr) return;
    if (!found->is_number_unsigned()) return complain(key, "must be a whole number, not negative");
    value = found->get<std::uint64_t>();
}

void RecipeReader::read(const char* key, bool& value) {
    const nlohmann::json* found = child(key);
    if (found == nullptr) return;
    if (!found->is_boolean()) return complain(key, "must be true or false");
    value = found->get<bool>();
}

void RecipeReader::read(const char* key, std::string& value) {
    const nlohmann::json* found = child(key);
    if (found == nullptr) return;
    if (!found->is_string()) return complain(key, "must be a text in quotes");
    value = found->get<std::string>();
}

void RecipeReader::read(const char* key, glm::vec3& value, double low, double high) {
    const nlohmann::json* found = child(key);
    if (found == nullptr) return;
    if (in_range(*found, low, high)) {
        value = glm::vec3(found->get<float>());
        return;
    }
    const bool triple = found->is_array() && found->size() == 3;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!triple || !in_range((*found)[i], low, high)) {
            return complain(key, "must be [a, b, c], where each " + range_text(low, high));
        }
        value[static_cast<int>(i)] = (*found)[i].get<float>();
    }
}

void RecipeReader::finish() {
    for (const auto& item : object_.items()) {
        if (known_.contains(item.key())) continue;
        std::string expected;
        for (const std::string& key : known_) expected += (expected.empty() ? "" : ", ") + key;
        return complain("unknown key \"" + item.key() + "\"; known keys are " + expected);
    }
}

}  // namespace rs::capture
