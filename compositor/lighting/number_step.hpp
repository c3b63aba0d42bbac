#pragma once
// Stepwise changes of numbers in user interfaces: brightness by factors, which suits candles and the sun alike; lengths
// and angles by steps of a power of ten. Results have few digits. Pure; thread-safe.

namespace rs::compositor {

// `value` times `factor`, rounded to four digits, clamped to lowest..highest; a value of 0 becomes `first`.
double scaled(double value, double factor, double first, double lowest, double highest);

// `value` plus `count` steps of 10^order, without rounding errors, clamped to lowest..highest.
double shifted(double value, int order, int count, double lowest, double highest);

// Rounds to significant digits.
double rounded_to_digits(double value, int digits);

}  // namespace rs::compositor
