#include "capture/photos/background/plate_propagation.hpp"

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kMaxFrames = 64;  // bits of a support

// Frames whose denoised value is within the tolerance of `colour`.
std::uint64_t support_of(const ExposureNormalizedFrames& frames, const Rgba8& colour, int x, int y,
                         int tolerance_codes) {
    std::uint64_t support = 0;
    for (std::size_t i = 0; i < frames.count(); ++i) {
        if (within_codes(frames.smooth(i, x, y), colour, tolerance_codes)) support |= std::uint64_t{1} << i;
    }
    return support;
}

// Rounded mean of `value(frame)` over the support, which is not 0.
template <class Value>
Rgba8 mean_over(std::uint64_t support, Value value) {
    int r = 0;
    int g = 0;
    int b = 0;
    const int count = std::popcount(support);
    for (; support != 0; support &= support - 1) {
        const Rgba8 p = value(static_cast<std::size_t>(std::countr_zero(support)));
        r += p.r;
        g += p.g;
        b += p.b;
    }
    const auto code = [&](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
    return {code(r), code(g), code(b), 255};
}

Rgba8 smooth_mean(const ExposureNormalizedFrames& frames, std::uint64_t support, int x, int y) {
    return mean_over(support, [&](std::size_t i) { return frames.smooth(i, x, y); });
}

// Region growing with one queue per size of the support.
class PlateGrowth {
public:
    PlateGrowth(const ExposureNormalizedFrames& frames, ConstImageView<std::uint8_t> barred,
                const BackgroundParameters::Propagation& parameters, PropagatedPlate& plate)
        : frames_(frames), barred_(barred), parameters_(parameters), plate_(plate) {
        RS_CHECK(barred.width() == frames.width() && barred.height() == frames.height());
        RS_CHECK(frames.count() <= kMaxFrames);
    }

    void accept(int x, int y, const Rgba8& colour, std::uint64_t support) {
        plate_.colour(x, y) = colour;
        plate_.support(x, y) = support;
        queues_[static_cast<std::size_t>(std::popcount(support))].emplace_back(x, y);
    }

    // Pixels with the largest support grow first: they are the most certain. `is_allowed(u, v, colour)`: whether the
    // plate may have this colour at (u, v).
    template <class IsAllowed>
    void grow(IsAllowed is_allowed) {
        for (int size = kMaxFrames; size > 0;) {
            auto& queue = queues_[static_cast<std::size_t>(size)];
            if (queue.empty()) {
                --size;
                continue;
            }
            const auto [x, y] = queue.front();
            queue.pop_front();
            int largest = 0;
            for (int v = std::max(0, y - 1); v <= std::min(frames_.height() - 1, y + 1); ++v) {
                for (int u = std::max(0, x - 1); u <= std::min(frames_.width() - 1, x + 1); ++u) {
                    if (plate_.support(u, v) != 0 || barred_(u, v) != 0) continue;
                    largest = std::max(largest, extend(x, y, u, v, is_allowed));
                }
            }
            size = std::max(size, largest);
        }
    }

private:
    // Extends the plate from its pixel (x, y) to the neighbour (u, v) if that continues it. Returns the size of the new
    // support, 0 if not accepted.
    template <class IsAllowed>
    int extend(int x, int y, int u, int v, IsAllowed is_allowed) {
        const int tolerance = parameters_.tolerance_codes;
        const std::uint64_t before = plate_.support(x, y);
        std::uint64_t support = support_of(frames_, plate_.colour(x, y), u, v, tolerance) & before;
        if (std::popcount(support) < parameters_.min_support) return 0;
        if (std::popcount(support) < parameters_.min_kept_share * std::popcount(before)) return 0;
        Rgba8 colour = smooth_mean(frames_, support, u, v);
        support = support_of(frames_, colour, u, v, tolerance);
        if (support == 0) return 0;
        if (!has_front(u, v, support, colour) || !is_allowed(u, v, colour)) return 0;
        colour = smooth_mean(frames_, support, u, v);
        accept(u, v, colour, support);
        return std::popcount(support);
    }

    // True if enough plate pixels around (u, v) have the same colour and are seen by the same frames. Growth advances
    // on a broad front: through a single pixel in which the object happens to match the background it would spread over
    // the whole object.
    [[nodiscard]] bool has_front(int u, int v, std::uint64_t support, const Rgba8& colour) const {
        const int radius = parameters_.front_radius_px;
        int front = 0;
        int known = 0;
        for (int y = std::max(0, v - radius); y <= std::min(frames_.height() - 1, v + radius); ++y) {
            for (int x = std::max(0, u - radius); x <= std::min(frames_.width() - 1, u + radius); ++x) {
                const int size = std::popcount(plate_.support(x, y));
                known += size == 0 ? 0 : 1;
                if (size == 0 || !within_codes(plate_.colour(x, y), colour, parameters_.tolerance_codes)) continue;
                front += std::popcount(support & plate_.support(x, y)) >= parameters_.min_kept_share * size ? 1 : 0;
            }
        }
        return front >= parameters_.min_front && front >= parameters_.min_front_share * known;
    }

    const ExposureNormalizedFrames& frames_;
    ConstImageView<std::uint8_t> barred_;
    const BackgroundParameters::Propagation& parameters_;
    PropagatedPlate& plate_;
    std::array<std::deque<std::pair<int, int>>, kMaxFrames + 1> queues_;  // [size of the support]
};

// Joins the bits of all pixels within `radius_px` of each.
template <class Join>
Image<std::uint64_t> joined_over_square(const Image<std::uint64_t>& from, int radius_px, Join join) {
    const int width = from.width();
    const int height = from.height();
    Image<std::uint64_t> to(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::uint64_t bits = from(x, y);
            for (int v = std::max(0, y - radius_px); v <= std::min(height - 1, y + radius_px); ++v) {
                for (int u = std::max(0, x - radius_px); u <= std::min(width - 1, x + radius_px); ++u) {
                    bits = join(bits, from(u, v));
                }
            }
            to(x, y) = bits;
        }
    }
    return to;
}

}  // namespace

void propagate_plate(const ExposureNormalizedFrames& frames, const PlateSeeds& from,
                     const BackgroundParameters::Propagation& parameters, PropagatedPlate& plate) {
    const int width = frames.width();
    const int height = frames.height();
    RS_CHECK(from.guess.width() == width && from.guess.height() == height);
    RS_CHECK(from.seeds.width() == width && from.seeds.height() == height);
    if (plate.colour.empty()) {
        plate = {Image<Rgba8>(width, height), Image<std::uint64_t>(width, height)};
    }
    PlateGrowth plate_growth(frames, from.barred, parameters, plate);
    PropagatedPlate seeded{Image<Rgba8>(width, height), Image<std::uint64_t>(width, height)};
    for_each_index(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            if (from.seeds(x, y) == 0 || plate.support(x, y) != 0) continue;
            const std::uint64_t support = support_of(frames, from.guess(x, y), x, y, parameters.tolerance_codes);
            if (support == 0) continue;
            seeded.colour(x, y) = smooth_mean(frames, support, x, y);
            seeded.support(x, y) = support_of(frames, seeded.colour(x, y), x, y, parameters.tolerance_codes);
        }
    });
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (seeded.support(x, y) != 0) plate_growth.accept(x, y, seeded.colour(x, y), seeded.support(x, y));
        }
    }
    plate_growth.grow([&](int u, int v, const Rgba8& colour) {
        return from.growth == Growth::kFree || within_codes(colour, from.guess(u, v), parameters.guess_tolerance_codes);
    });
}

Image<Rgba8> undenoised_colours(const ExposureNormalizedFrames& frames, const PropagatedPlate& plate) {
    Image<Rgba8> colours(plate.colour.width(), plate.colour.height(), Rgba8{0, 0, 0, 255});
    for_each_index(colours.height(), [&](int y) {
        for (int x = 0; x < colours.width(); ++x) {
            const std::uint64_t support = plate.support(x, y);
            if (support == 0) continue;
            colours(x, y) = mean_over(support, [&](std::size_t i) { return frames(i, x, y); });
        }
    });
    return colours;
}

Image<std::uint8_t> confirm_plate(const ExposureNormalizedFrames& frames, ConstImageView<Rgba8> plate,
                                  ConstImageView<std::uint8_t> candidates,
                                  const BackgroundParameters::Propagation& parameters) {
    RS_CHECK(plate.width() == frames.width() && plate.height() == frames.height());
    RS_CHECK(plate.width() == candidates.width() && plate.height() == candidates.height());
    const int width = plate.width();
    const int height = plate.height();
    Image<std::uint64_t> agreeing(width, height);  // bit i: frame i shows the guess at this pixel
    for_each_index(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            agreeing(x, y) = support_of(frames, plate(x, y), x, y, parameters.tolerance_codes);
        }
    });
    // Opening of every frame's mask: whole patches first, then all pixels that such a patch contains.
    const int radius = parameters.patch_radius_px;
    const Image<std::uint64_t> centres = joined_over_square(agreeing, radius, std::bit_and<std::uint64_t>());
    const Image<std::uint64_t> patches = joined_over_square(centres, radius, std::bit_or<std::uint64_t>());
    Image<std::uint8_t> confirmed(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool is_shown = std::popcount(patches(x, y)) >= parameters.min_support;
            confirmed(x, y) = candidates(x, y) != 0 && is_shown ? 255 : 0;
        }
    }
    return confirmed;
}

}  // namespace rs::capture
