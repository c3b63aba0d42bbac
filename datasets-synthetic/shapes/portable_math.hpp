#pragma once
// Elementary functions with bit-identical results on every machine.
//
// The C library's sin, cos and atan2 may differ in the last place between versions, but tests compare hashes of every
// generated mesh and image. These functions use only + - * / sqrt and floor, which IEEE 754 rounds exactly (the project
// is compiled with -ffp-contract=off). Absolute error below 1e-13 for |x| < 300 (tested). Thread-safe; no errors.

#include "rayspace/base/conventions.hpp"

#include <glm/vec3.hpp>

namespace rs::synthetic::portable {

double sin(double x_rad);
double cos(double x_rad);
double atan2(double y, double x);  // (-pi, pi]; 0 at the origin
double exp(double x);              // relative error below 1e-12 for |x| < 300
double srgb_to_linear(double v);   // IEC 61966-2-1, v in [0, 1]

inline float sin(float x_rad) {
    return static_cast<float>(sin(static_cast<double>(x_rad)));
}
inline float cos(float x_rad) {
    return static_cast<float>(cos(static_cast<double>(x_rad)));
}
inline float atan2(float y, float x) {
    return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}

inline constexpr float kPiF = static_cast<float>(kPi);
inline constexpr float kTwoPiF = 2.0F * kPiF;

// Point at an angle about the vertical axis, from the z axis towards x.
inline glm::vec3 around(float angle_rad, float radius, float height) {
    return {radius * sin(angle_rad), height, radius * cos(angle_rad)};
}

}  // namespace rs::synthetic::portable
