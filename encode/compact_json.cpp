#include "encode/compact_json.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>

namespace rs::encode {
namespace {

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

}  // namespace

std::string compact_json(const std::string& text) {
    auto json = nlohmann::ordered_json::parse(text, nullptr, false);
    if (json.is_discarded()) return text;
    round_fractions(json);
    return json.dump();
}

}  // namespace rs::encode
