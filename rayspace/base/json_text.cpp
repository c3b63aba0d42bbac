#include "rayspace/base/json_text.hpp"

#include "rayspace/base/nearest_name.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/utf8.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

namespace rs {
namespace {

constexpr int kMaxNesting = 64;

struct SyntaxError {
    std::string why;
};

// SAX observer that detects input accepted by nlohmann::json: deeply nested brackets, and repeated keys, of which it
// keeps the last.
class SyntaxObserver {
public:
    void see(int depth, nlohmann::json::parse_event_t event, const nlohmann::json& parsed) {
        using Event = nlohmann::json::parse_event_t;
        const bool opens = event == Event::object_start || event == Event::array_start;
        if (opens && depth >= kMaxNesting) {
            throw SyntaxError{"nests brackets more than " + std::to_string(kMaxNesting) + " deep; flatten it"};
        }
        if (event == Event::object_start) open_.emplace_back();
        if (event == Event::object_end) open_.pop_back();
        if (event != Event::key || open_.back().insert(parsed.get<std::string>()).second) return;
        throw SyntaxError{"the key \"" + printable(parsed.get<std::string>()) +
                          "\" is there twice in one object; keep one of them"};
    }

private:
    std::vector<std::set<std::string>> open_;  // keys so far of each open object
};

std::string shown(double number) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number).ptr;
    return {text, end};
}

double nine_digits_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return std::strtod(text, nullptr) + 0.0;  // no negative zeros
}

void round_fractions(nlohmann::ordered_json& json) {
    if (json.is_number_float()) {
        json = nine_digits_of(json.get<double>());
    } else if (json.is_structured()) {
        for (auto& member : json) round_fractions(member);
    }
}

// Fault at the last character that the parser has read, with its remedy.
std::string syntax_fault(std::string_view read) {
    const char last = read.empty() ? '\0' : read.back();
    if (!read.empty()) read.remove_suffix(1);
    const std::size_t before = read.find_last_not_of(" \t\r\n");
    const bool follows_comma = before != std::string_view::npos && read[before] == ',';
    if (follows_comma && (last == ']' || last == '}')) return "a comma precedes a closing bracket; remove it";
    if (last == '/' || last == '#') return "JSON has no comments; remove it";
    return "correct it there (NaN and Infinity are not JSON)";
}

// Error for a text that is not JSON; `end` is the number of characters that the parser has read.
Error syntax_error(std::string_view text, std::size_t end, const std::string& where) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return Error{where + ": is not valid JSON but empty; write it again"};
    if (is_utf16(text)) {
        return Error{where + ": is not valid JSON but UTF-16 text; save it as UTF-8"};
    }
    const std::string_view read = text.substr(0, end);
    const auto line = 1 + std::count(read.begin(), read.end(), '\n');
    const std::size_t column = read.size() - (read.rfind('\n') + 1);  // npos + 1 is 0
    const std::string fault = syntax_fault(read);
    return Error{where + ": is not valid JSON at line " + std::to_string(line) + ", column " + std::to_string(column) +
                 (fault.starts_with("correct") ? "; " : ": ") + fault};
}

}  // namespace

Result<nlohmann::json> parse_json(std::string_view text, const std::string& where) {
    SyntaxObserver watch;
    try {
        using nlohmann::json;
        return json::parse(text, [&](int depth, json::parse_event_t event, const json& parsed) {
            watch.see(depth, event, parsed);
            return true;
        });
    } catch (const SyntaxError& refused) {
        return Error{where + ": " + refused.why};
    } catch (const nlohmann::json::parse_error& error) {
        return syntax_error(text, error.byte, where);
    } catch (const nlohmann::json::exception&) {
        return Error{where + ": holds a number that is out of range; correct it"};
    }
}

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
        const std::vector<std::string> names(known_.begin(), known_.end());
        throw wrong("has a key '" + name + "' that means nothing here; it may have: " + known +
                    suggestion(name, names));
    }
}

std::string compact_json(const std::string& text) {
    auto json = nlohmann::ordered_json::parse(text, nullptr, false);
    if (json.is_discarded()) return text;
    round_fractions(json);
    return json.dump();
}

}  // namespace rs
