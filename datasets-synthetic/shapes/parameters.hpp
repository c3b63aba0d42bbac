#pragma once
// Reads an object's parameters from JSON. finish() returns the first error, so that a generator reads all its
// parameters in a row and checks once.
//
//     Parameters in("vase", json);
//     const float height = in.number("height", 2.1F, 1.6F, 2.6F);
//     RS_TRY(in.finish());

#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace rs::synthetic {

class Parameters {
public:
    // `values` is a JSON object or null (all defaults).
    Parameters(std::string object, const nlohmann::json& values);

    // The value of `name`, or `fallback` if absent; an error unless low <= value <= high.
    float number(const std::string& name, float fallback, float low, float high);
    int whole_number(const std::string& name, int fallback, int low, int high);
    // A string of 1..max_length letters A..Z.
    std::string letters(const std::string& name, const std::string& fallback, int max_length);

    // The first error, if any: an invalid value, or an unknown name.
    [[nodiscard]] Status finish() const;

private:
    const nlohmann::json* find(const std::string& name, const std::string& range);
    void report_value(const std::string& name, const std::string& range);

    std::string object_;
    const nlohmann::json& values_;
    std::vector<std::string> names_;
    std::vector<std::string> descriptions_;  // "height (1.6 to 2.6)"
    std::optional<Error> error_;
};

}  // namespace rs::synthetic
