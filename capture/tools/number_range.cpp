#include "capture/tools/number_range.hpp"

#include <cmath>
#include <cstdlib>
#include <string>

namespace rs::capture {

CLI::Validator within(double low, double high) {
    const CLI::Validator is_number(
        [](const std::string& text) {
            return std::isnan(std::strtod(text.c_str(), nullptr)) ? "'" + text + "' is no number" : std::string();
        },
        "");
    return CLI::Range(low, high) & is_number;
}

}  // namespace rs::capture
