#pragma once
// The projection of turntable_model.hpp for any scalar type, for automatic differentiation by Ceres.

#include <cmath>

namespace rs::capture {

/// lens: f, cx, cy, k1, k2; pose: pan, tilt, roll; point: X, Y, Z of the object at angle 0. Writes pixel x, y. Returns
/// false if the point is not in front of the camera.
template <class T>
bool project_turned(const T* lens, const T* pose, const T& angle_rad, const T* point, T* pixel) {
    using std::cos;
    using std::sin;
    const T ca = cos(angle_rad), sa = sin(angle_rad);
    const T x0 = ca * point[0] + sa * point[2];
    const T y0 = point[1];
    const T z0 = -sa * point[0] + ca * point[2] - T(1.0);
    const T cp = cos(pose[0]), sp = sin(pose[0]);
    const T x1 = cp * x0 + sp * z0;
    const T z1 = -sp * x0 + cp * z0;
    const T ct = cos(pose[1]), st = sin(pose[1]);
    const T y2 = ct * y0 - st * z1;
    const T z2 = st * y0 + ct * z1;
    const T cr = cos(pose[2]), sr = sin(pose[2]);
    const T x3 = cr * x1 - sr * y2;
    const T y3 = sr * x1 + cr * y2;
    if (z2 > T(-1e-6)) return false;
    const T x = x3 / -z2;
    const T y = -y3 / -z2;
    const T r2 = x * x + y * y;
    const T radial = T(1.0) + r2 * (lens[3] + r2 * lens[4]);
    pixel[0] = lens[1] + lens[0] * radial * x;
    pixel[1] = lens[2] + lens[0] * radial * y;
    return true;
}

}  // namespace rs::capture
