#include "rayspace/base/strict_json.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/base/printable.hpp"

#include <charconv>
#include <cmath>
#include <utility>

namespace rs {
namespace {

std::string shown(double number) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number).ptr;
    return {text, end};
}

}  // namespace

nlohmann::json parse_json_text(std::string_view text, const std::string& file) {
    Result<nlohmann::json> parsed = parse_json(text, file);
    if (!parsed) throw MalformedJson{printable(parsed.error().message)};
    return std::move(*parsed);
}

JsonValue::JsonValue(const nlohmann::json& value, std::string file, std::string key)
    : value_(&value), file_(std::move(file)), key_(std::move(key)) {}

MalformedJson JsonValue::wrong(const std::string& what) const {
    return {printable(file_ + ": " + (key_.empty() ? "" : key_ + ": ") + what)};
}

double JsonValue::number(double lowest, double highest) const {
    const double number = value_->is_number() ? value_->get<double>() : NAN;
    if (!(number >= lowest && number <= highest)) {
        throw wrong("must be a number from " + shown(lowest) + " to " + shown(highest));
    }
    return number;
}

int JsonValue::whole_number(int lowest, int highest) const {
    const double value = value_->is_number() ? value_->get<double>() : NAN;
    if (!(value >= lowest && value <= highest && value == std::floor(value))) {
        throw wrong("must be a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
    }
    return static_cast<int>(value);
}

std::uint64_t JsonValue::unsigned_number() const {
    if (!value_->is_number_unsigned()) throw wrong("must be a whole number, not negative");
    return value_->get<std::uint64_t>();
}

bool JsonValue::boolean() const {
    if (!value_->is_boolean()) throw wrong("must be true or false");
    return value_->get<bool>();
}

std::string JsonValue::text() const {
    std::string text = text_or_empty();
    if (text.empty()) throw wrong("must not be empty");
    return text;
}

std::string JsonValue::text_or_empty() const {
    if (!value_->is_string()) throw wrong("must be a text in quotes");
    auto text = value_->get<std::string>();
    if (text.find('\0') != std::string::npos) throw wrong("must not hold zero characters");
    return text;
}

std::size_t JsonValue::one_of(const std::vector<std::string>& words) const {
    std::string known;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (*value_ == words[i]) return i;
        known += (i == 0 ? "\"" : ", \"") + words[i] + '"';
    }
    throw wrong("must be one of " + known);
}

glm::dvec3 JsonValue::triple(double lowest, double highest) const {
    if (!value_->is_array() || value_->size() != 3) throw wrong("must be a list of three numbers");
    return {item(0).number(lowest, highest), item(1).number(lowest, highest), item(2).number(lowest, highest)};
}

glm::dvec3 JsonValue::direction() const {
    constexpr double kLongest = 1e6;
    constexpr double kShortestLength = 1e-6;
    const glm::dvec3 direction = triple(-kLongest, kLongest);
    if (glm::length(direction) < kShortestLength) throw wrong("must be a direction, not 0, 0, 0");
    return glm::normalize(direction);
}

std::size_t JsonValue::list_size(std::size_t least, std::size_t most) const {
    if (!value_->is_array()) throw wrong("must be a list [ ... ]");
    if (value_->size() < least || value_->size() > most) {
        throw wrong("must have " + std::to_string(least) + " to " + std::to_string(most) + " entries");
    }
    return value_->size();
}

JsonValue JsonValue::item(std::size_t i) const {
    return {value_->at(i), file_, key_ + "[" + std::to_string(i) + "]"};
}

JsonValue JsonValue::child(const std::string& name) const {
    return {value_->at(name), file_, key_.empty() ? name : key_ + "." + name};
}

JsonObject::JsonObject(const JsonValue& value) : JsonValue(value) {
    if (!json().is_object()) throw wrong("must be an object { ... }");
}

bool JsonObject::has(const std::string& name) const {
    known_.insert(name);
    return json().contains(name);
}

JsonValue JsonObject::take(const std::string& name) {
    if (!has(name)) throw wrong(name + " is missing; add it");
    taken_.insert(name);
    return child(name);
}

std::optional<JsonValue> JsonObject::find(const std::string& name) {
    return has(name) ? std::optional(take(name)) : std::nullopt;
}

void JsonObject::read(const std::string& name, double& value, double lowest, double highest) {
    if (const auto found = find(name)) value = found->number(lowest, highest);
}

void JsonObject::read(const std::string& name, float& value, double lowest, double highest) {
    if (const auto found = find(name)) value = static_cast<float>(found->number(lowest, highest));
}

void JsonObject::read(const std::string& name, int& value, int lowest, int highest) {
    if (const auto found = find(name)) value = found->whole_number(lowest, highest);
}

void JsonObject::read(const std::string& name, bool& value) {
    if (const auto found = find(name)) value = found->boolean();
}

void JsonObject::read(const std::string& name, std::string& value) {
    if (const auto found = find(name)) value = found->text_or_empty();
}

void JsonObject::read(const std::string& name, glm::vec3& value, double lowest, double highest) {
    const auto found = find(name);
    if (!found) return;
    value = found->json().is_number() ? glm::vec3(static_cast<float>(found->number(lowest, highest)))
                                      : glm::vec3(found->triple(lowest, highest));
}

nlohmann::json JsonObject::take_rest() {
    nlohmann::json rest = nlohmann::json::object();
    for (const auto& [name, value] : json().items()) {
        if (taken_.insert(name).second) rest[name] = value;
    }
    return rest;
}

void JsonObject::expect_no_unknown_keys() const {
    for (const auto& [name, value] : json().items()) {
        if (taken_.contains(name)) continue;
        std::string known;
        for (const std::string& key : known_) known += (known.empty() ? "" : ", ") + key;
        throw wrong("has a key '" + name + "' that means nothing here; it may have: " + known);
    }
}

}  // namespace rs
