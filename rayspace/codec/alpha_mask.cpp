#include "rayspace/codec/alpha_mask.hpp"

namespace rs::codec {
namespace {

int alpha_between(const ConstImageView<std::uint8_t>& plane, int x, int y, MotionVector vector) {
    const int left = std::clamp(x + (vector.x >> 2), 0, plane.width() - 1);
    const int right = std::clamp(x + (vector.x >> 2) + 1, 0, plane.width() - 1);
    const std::uint8_t* const upper = plane.row(std::clamp(y + (vector.y >> 2), 0, plane.height() - 1));
    const std::uint8_t* const lower = plane.row(std::clamp(y + (vector.y >> 2) + 1, 0, plane.height() - 1));
    const int fx = vector.x & 3;
    const int fy = vector.y & 3;
    const int above = (4 - fx) * upper[left] + fx * upper[right];
    const int below = (4 - fx) * lower[left] + fx * lower[right];
    return ((4 - fy) * above + fy * below + 8) >> 4;
}

}  // namespace

int interpolate_alpha(Source source, const std::array<MotionVector, 2>& motion,
                      const std::array<ConstPlaneViews, 2>& references, int x, int y) {
    if (!is_inter(source)) return -1;
    if (source != Source::kBoth) {
        const std::size_t r = uses(source, 0) ? 0 : 1;
        return alpha_between(references[r][3], x, y, motion[r]);
    }
    return (alpha_between(references[0][3], x, y, motion[0]) + alpha_between(references[1][3], x, y, motion[1]) + 1) >>
           1;
}

}  // namespace rs::codec
