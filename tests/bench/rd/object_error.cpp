#include "tests/bench/rd/object_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rs::bench {

ObjectError& ObjectError::operator+=(const ObjectError& other) {
    object_pixels += other.object_pixels;
    squared_error += other.squared_error;
    block_pixels += other.block_pixels;
    alpha_error += other.alpha_error;
    return *this;
}

double ObjectError::psnr_db() const {
    if (squared_error == 0) return 99;
    const double mean = static_cast<double>(squared_error) / (3.0 * static_cast<double>(object_pixels));
    return 10 * std::log10(255.0 * 255.0 / mean);
}

double ObjectError::alpha_mae() const {
    return static_cast<double>(alpha_error) / static_cast<double>(std::max<std::int64_t>(1, block_pixels));
}

ObjectError object_error(const ReferenceImages& images, std::size_t view, ConstImageView<Rgba8> decoded) {
    const Image<Rgba8>& original = images.views[view];
    RS_CHECK(decoded.width() == original.width() && decoded.height() == original.height());
    ObjectError sum;
    for (int y = 0; y < original.height(); ++y) {
        for (int x = 0; x < original.width(); ++x) {
            if (images.touched[view](x / kBlock_px, y / kBlock_px) == 0) continue;
            const Rgba8& p = original(x, y);
            const Rgba8& q = decoded(x, y);
            ++sum.block_pixels;
            sum.alpha_error += std::abs(p.a - q.a);
            if (p.a < kObjectAlpha) continue;
            ++sum.object_pixels;
            sum.squared_error += (p.r - q.r) * (p.r - q.r) + (p.g - q.g) * (p.g - q.g) + (p.b - q.b) * (p.b - q.b);
        }
    }
    return sum;
}

}  // namespace rs::bench
