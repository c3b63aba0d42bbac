#include "encode/set/soft_coverage.hpp"

#include <algorithm>

namespace rs::encode {
namespace {

bool is_soft(std::uint8_t alpha) {
    return alpha >= kMinVisibleAlpha && alpha <= 255 - kMinVisibleAlpha;
}

// Summed-area table of set samples.
class Sums {
public:
    explicit Sums(const Image<std::uint8_t>& set) : sums_(set.width() + 1, set.height() + 1, 0) {
        for (int y = 0; y < set.height(); ++y) {
            int row = 0;
            for (int x = 0; x < set.width(); ++x) {
                row += set(x, y) != 0 ? 1 : 0;
                sums_(x + 1, y + 1) = sums_(x + 1, y) + row;
            }
        }
    }
    // The number of set samples in left <= x < right, top <= y < bottom, clipped to the image.
    [[nodiscard]] int within(int left, int top, int right, int bottom) const {
        left = std::max(left, 0);
        top = std::max(top, 0);
        right = std::min(right, sums_.width() - 1);
        bottom = std::min(bottom, sums_.height() - 1);
        return sums_(right, bottom) - sums_(left, bottom) - sums_(right, top) + sums_(left, top);
    }

private:
    Image<int> sums_;
};

// 255 where holds(n) is true for the number n of set samples in the square around a sample.
template <class Holds>
Image<std::uint8_t> where(const Image<std::uint8_t>& set, int radius, const Holds& holds) {
    const Sums sums(set);
    Image<std::uint8_t> result(set.width(), set.height());
    for (int y = 0; y < set.height(); ++y) {
        for (int x = 0; x < set.width(); ++x) {
            if (holds(sums.within(x - radius, y - radius, x + radius + 1, y + radius + 1))) result(x, y) = 255;
        }
    }
    return result;
}

}  // namespace

Image<std::uint8_t> find_soft_patches(ConstImageView<std::uint8_t> alpha, int radius) {
    Image<std::uint8_t> soft(alpha.width(), alpha.height());
    for (int y = 0; y < alpha.height(); ++y) {
        for (int x = 0; x < alpha.width(); ++x) soft(x, y) = is_soft(alpha(x, y)) ? 255 : 0;
    }
    // An erosion with a square, then a dilation with it: an opening.
    const int side = 2 * radius + 1;
    const Image<std::uint8_t> middles = where(soft, radius, [&](int count) { return count == side * side; });
    return dilated(middles, radius);
}

Image<std::uint8_t> dilated(const Image<std::uint8_t>& set, int radius) {
    return where(set, radius, [](int count) { return count > 0; });
}

}  // namespace rs::encode
