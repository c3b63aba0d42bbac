#include "datasets-synthetic/shapes/portable_math.hpp"

#include "rayspace/base/conventions.hpp"

#include <cmath>

namespace rs::synthetic::portable {
namespace {

// Taylor series on [-pi/4, pi/4]; the first omitted term is below 1e-17.
double sine_series(double x) {
    const double x2 = x * x;
    double sum = 0;
    for (int n = 17; n >= 3; n -= 2) sum = (1.0 + sum) * (-x2 / static_cast<double>(n * (n - 1)));
    return x * (1.0 + sum);
}

double cosine_series(double x) {
    const double x2 = x * x;
    double sum = 0;
    for (int n = 18; n >= 2; n -= 2) sum = (1.0 + sum) * (-x2 / static_cast<double>(n * (n - 1)));
    return 1.0 + sum;
}

// sin(x + quarter_turns * pi/2). pi/2 is subtracted in two parts so that large arguments keep their low bits.
double sine_of_shifted(double x, int quarter_turns) {
    constexpr double kHalfPiHigh = 1.57079632673412561417;
    constexpr double kHalfPiLow = 6.07710050650619224932e-11;
    const double quarters = std::floor(x * (2.0 / kPi) + 0.5);
    const double rest = (x - quarters * kHalfPiHigh) - quarters * kHalfPiLow;
    const double turn = quarters + quarter_turns;
    const int quadrant = static_cast<int>(turn - 4.0 * std::floor(turn / 4.0));
    const double value = (quadrant & 1) != 0 ? cosine_series(rest) : sine_series(rest);
    return (quadrant & 2) != 0 ? -value : value;
}

// Three half-angle steps, atan(x) = 2 atan(x / (1 + sqrt(1 + x^2))), bring |x| <= 1 below 0.1, where the series is
// short.
double arctangent(double x) {
    for (int step = 0; step < 3; ++step) x /= 1.0 + std::sqrt(1.0 + x * x);
    const double x2 = x * x;
    double sum = 0;
    for (int n = 17; n >= 1; n -= 2) sum = 1.0 / n - x2 * sum;
    return 8.0 * x * sum;
}

}  // namespace

double sin(double x_rad) {
    return sine_of_shifted(x_rad, 0);
}
double cos(double x_rad) {
    return sine_of_shifted(x_rad, 1);
}

double atan2(double y, double x) {
    if (x == 0 && y == 0) return 0;
    if (std::abs(y) <= std::abs(x)) {
        const double angle = arctangent(y / x);
        if (x > 0) return angle;
        return y >= 0 ? angle + kPi : angle - kPi;
    }
    const double angle = arctangent(x / y);
    return y > 0 ? kPi / 2 - angle : -kPi / 2 - angle;
}

double exp(double x) {
    // exp(x) = exp(x / 1024)^1024: a short series, then ten squarings.
    const double small = x / 1024.0;
    double sum = 1.0;
    for (int n = 14; n >= 1; --n) sum = 1.0 + sum * small / static_cast<double>(n);
    for (int step = 0; step < 10; ++step) sum *= sum;
    return sum;
}

double srgb_to_linear(double v) {
    if (v <= 0.04045) return v / 12.92;
    const double base = (v + 0.055) / 1.055;
    // base^2.4 = base^2 * root, root^5 = base^2; Newton from above converges monotonically.
    const double square = base * base;
    double root = 1.0;
    for (int step = 0; step < 12; ++step) root -= (root - square / (root * root * root * root)) / 5.0;
    return square * root;
}

}  // namespace rs::synthetic::portable
