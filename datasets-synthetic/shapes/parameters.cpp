#include "datasets-synthetic/shapes/parameters.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace rs::synthetic {
namespace {

std::string shortest(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
    return text;
}

}  // namespace

Parameters::Parameters(std::string object, const nlohmann::json& values) : object_(std::move(object)), values_(values) {
    if (!values.is_null() && !values.is_object())
        error_ = Error{object_ + ": the parameters are not a JSON object; write {\"NAME\": VALUE, ...}"};
}

const nlohmann::json* Parameters::find(const std::string& name, const std::string& range) {
    names_.push_back(name);
    descriptions_.push_back(name + " (" + range + ")");
    if (!values_.is_object()) return nullptr;
    const auto it = values_.find(name);
    return it == values_.end() ? nullptr : &*it;
}

void Parameters::report_value(const std::string& name, const std::string& range) {
    // Replaces invalid UTF-8 and truncates long values, so that the message is one readable line.
    std::string value = values_.at(name).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (value.size() > 40) value = value.substr(0, 37) + "...";
    if (!error_) error_ = Error{object_ + ": parameter " + name + " is " + value + "; give " + range};
}

float Parameters::number(const std::string& name, float fallback, float low, float high) {
    const std::string range = shortest(low) + " to " + shortest(high);
    const nlohmann::json* value = find(name, range);
    if (value == nullptr) return fallback;
    if (value->is_number()) {
        // Compared as float, because 0.1 < 0.1F.
        const auto given = value->get<float>();
        if (given >= low && given <= high) return given;
    }
    report_value(name, "a number, " + range);
    return fallback;
}

int Parameters::whole_number(const std::string& name, int fallback, int low, int high) {
    const std::string range = std::to_string(low) + " to " + std::to_string(high);
    const nlohmann::json* value = find(name, range);
    if (value == nullptr) return fallback;
    if (value->is_number_integer()) {
        // An unsigned value beyond the signed range would wrap.
        const bool huge = value->is_number_unsigned() && value->get<std::uint64_t>() > 0x7FFFFFFFU;
        if (!huge && value->get<std::int64_t>() >= low && value->get<std::int64_t>() <= high) return value->get<int>();
    }
    report_value(name, "a whole number, " + range);
    return fallback;
}

std::string Parameters::letters(const std::string& name, const std::string& fallback, int max_length) {
    const std::string range = "1 to " + std::to_string(max_length) + " letters A to Z";
    const nlohmann::json* value = find(name, range);
    if (value == nullptr) return fallback;
    if (value->is_string()) {
        const auto& text = value->get_ref<const std::string&>();
        const bool fits = !text.empty() && text.size() <= static_cast<std::size_t>(max_length);
        if (fits && std::all_of(text.begin(), text.end(), [](char c) { return c >= 'A' && c <= 'Z'; })) return text;
    }
    report_value(name, range);
    return fallback;
}

Status Parameters::finish() const {
    if (error_) return *error_;
    if (!values_.is_object()) return {};
    for (const auto& item : values_.items()) {
        if (std::find(names_.begin(), names_.end(), item.key()) != names_.end()) continue;
        std::string known;
        for (const std::string& description : descriptions_) known += (known.empty() ? "" : ", ") + description;
        const std::string name =
            nlohmann::json(item.key()).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
        return Error{object_ + ": no parameter " + name + "; there are " + known};
    }
    return {};
}

}  // namespace rs::synthetic
