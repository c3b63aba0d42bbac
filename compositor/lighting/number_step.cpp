#include "compositor/lighting/number_step.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {

double rounded_to_digits(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return value;
    const int order = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1 - digits;
    // Only non-negative powers of ten are exact.
    const double power = std::pow(10.0, std::abs(order));
    return order < 0 ? std::round(value * power) / power : std::round(value / power) * power;
}

double scaled(double value, double factor, double first, double lowest, double highest) {
    constexpr int kDigits = 4;
    const double changed = value > 0 ? value * factor : factor > 1 ? first : value;
    return std::clamp(rounded_to_digits(changed, kDigits), lowest, highest);
}

double shifted(double value, int order, int count, double lowest, double highest) {
    constexpr int kDigitsBelow = 6;  // decimals kept below the step's digit
    const double power = std::pow(10.0, std::abs(order));
    const double step = order < 0 ? count / power : count * power;
    const double fine = std::pow(10.0, kDigitsBelow + std::max(-order, 0));
    return std::clamp(std::round((value + step) * fine) / fine, lowest, highest);
}

}  // namespace rs::compositor
