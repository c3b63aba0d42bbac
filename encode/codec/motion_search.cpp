#include "encode/codec/motion_search.hpp"

#include "encode/codec/search_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace rs::encode {
namespace {

using codec::MotionVector;

constexpr int kLargestBlock = 16;

class Searcher {
public:
    Searcher(const MotionSearch& search, MotionVector from, const std::uint8_t* other)
        : search_(search),
          from_(from),
          other_(other),
          target_{search.source->planes[0].row(search.y) + search.x, search.source->valid.row(search.y) + search.x,
                  search.source->valid.width(), search.size} {}

    void try_whole(int x, int y) {
        const int left = search_.x + x;
        const int top = search_.y + y;
        if (left < 0 || top < 0 || left + search_.size > search_.reference.width() ||
            top + search_.size > search_.reference.height() || std::abs(4 * x) > codec::kMaxMotion_q2 ||
            std::abs(4 * y) > codec::kMaxMotion_q2) {
            return;
        }
        take({static_cast<std::int16_t>(4 * x), static_cast<std::int16_t>(4 * y)}, search_.reference.row(top) + left,
             search_.reference.stride());
    }

    void try_full_sample(MotionVector vector) {
        if (std::abs(vector.x) > codec::kMaxMotion_q2 || std::abs(vector.y) > codec::kMaxMotion_q2) return;
        std::uint8_t samples[kLargestBlock * kLargestBlock];
        codec::predict_from_image(search_.reference, search_.x, search_.y, vector, search_.size, samples, search_.size);
        take(vector, samples, search_.size);
    }

    [[nodiscard]] const MotionMatch& best() const { return best_; }

private:
    void take(MotionVector vector, const std::uint8_t* samples, std::ptrdiff_t stride) {
        const auto bits_of = [](int off) {
            return off == 0 ? 1 : 2 * static_cast<int>(std::bit_width(static_cast<unsigned>(std::abs(off)))) + 1;
        };
        float cost = search_.bit_cost * static_cast<float>(bits_of(vector.x - from_.x) + bits_of(vector.y - from_.y));
        if (any_ && cost >= best_.cost) return;
        cost += static_cast<float>(other_ == nullptr ? absolute_differences(target_, samples, stride)
                                                     : absolute_differences_of_mean(target_, samples, stride, other_));
        if (any_ && cost >= best_.cost) return;
        best_ = {vector, cost};
        any_ = true;
    }

    const MotionSearch& search_;
    MotionVector from_;
    const std::uint8_t* other_;
    SampleBlock target_;
    MotionMatch best_;
    bool any_ = false;
};

}  // namespace

MotionMatch search_motion(const MotionSearch& search, std::span<const MotionVector> starts, MotionVector from,
                          const std::uint8_t* other) {
    Searcher searcher(search, from, other);
    if (search.fractions) {
        for (const MotionVector start : starts) searcher.try_full_sample(start);
        searcher.try_full_sample(from);
    }
    const auto look_around = [&](MotionVector start, int reach_x, int reach_y, int step) {
        const int x = (start.x + 2) >> 2;
        const int y = (start.y + 2) >> 2;
        for (int dy = -reach_y; dy <= reach_y; dy += step) {
            for (int dx = -reach_x; dx <= reach_x; dx += step) searcher.try_whole(x + dx, y + dy);
        }
    };
    for (const MotionVector start : starts) look_around(start, search.reach_x, search.reach_y, search.step);
    if (search.step > 1) look_around(searcher.best().vector, 1, 1, 1);
    if (!search.fractions) return searcher.best();
    for (const int step : {2, 1}) {
        const MotionVector centre = searcher.best().vector;
        for (int dy = -step; dy <= step; dy += step) {
            for (int dx = -step; dx <= step; dx += step) {
                if ((dx == 0 && dy == 0) || (search.neighbours < 8 && dx != 0 && dy != 0)) continue;
                searcher.try_full_sample(
                    {static_cast<std::int16_t>(centre.x + dx), static_cast<std::int16_t>(centre.y + dy)});
            }
        }
    }
    return searcher.best();
}

}  // namespace rs::encode
