#pragma once
// Numbers of lights as they are changed by hand: brightness by factors, so that a candle and the sun are as easily set;
// lengths and angles by steps of one order of magnitude, as the rings of a number wheel. What comes out has few digits.
// Pure; thread-safe.

namespace rs::compositor {

// `value` times `factor`, to four digits, within lowest..highest; a value of 0 begins at `first`.
double scaled(double value, double factor, double first, double lowest, double highest);

// `value` plus `count` steps of 10^order, without what rounding adds, within lowest..highest.
double shifted(double value, int order, int count, double lowest, double highest);

// To that many significant digits.
double rounded_to_digits(double value, int digits);

}  // namespace rs::compositor
