#include "capture/photos/background/clean_plate_growth.hpp"

#include "capture/photos/background/still_picture.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kMostWitnesses = 64;
constexpr int kFewestWitnesses = 3;
constexpr int kTolerance_codes = 8;
constexpr double kKeptShare = 0.7;  // of a neighbour's witnesses must see the same
// Growth advances on a broad front: of the 81 pixels around the next one so many must be the plate already and look the
// same. Through a single pixel in which the object happens to look like the backdrop it would spread all over the
// object.
constexpr int kFront_px = 4;
constexpr int kFewestInFront = 4;
constexpr double kAlikeShare = 0.5;  // of the pixels in front that are the plate already

// A plate that is only expected is confirmed by patches of 5 x 5 pixels; it may err by more than one that is seen.
constexpr int kExpected_codes = 8;
constexpr int kPatch_px = 2;
constexpr int kGuessed_codes = 16;

std::uint64_t witnesses_of(const EvenedSamples& samples, const Rgba8& colour, int x, int y,
                           int codes = kTolerance_codes) {
    std::uint64_t witnesses = 0;
    for (std::size_t i = 0; i < samples.count(); ++i) {
        if (samples_agree(samples.smooth(i, x, y), colour, codes)) witnesses |= std::uint64_t{1} << i;
    }
    return witnesses;
}

template <class Value>
Rgba8 mean_of(std::uint64_t witnesses, Value value) {
    int r = 0;
    int g = 0;
    int b = 0;
    const int count = std::popcount(witnesses);
    for (; witnesses != 0; witnesses &= witnesses - 1) {
        const Rgba8 p = value(static_cast<std::size_t>(std::countr_zero(witnesses)));
        r += p.r;
        g += p.g;
        b += p.b;
    }
    const auto code = [&](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
    return {code(r), code(g), code(b), 255};
}

Rgba8 smooth_mean(const EvenedSamples& samples, std::uint64_t witnesses, int x, int y) {
    return mean_of(witnesses, [&](std::size_t i) { return samples.smooth(i, x, y); });
}

}  // namespace

void grow_plate(const EvenedSamples& samples, ConstImageView<Rgba8> guess, ConstImageView<std::uint8_t> seeds,
                ConstImageView<std::uint8_t> barred, GrownCleanPlate& plate, Growth growth) {
    const int width = samples.width();
    const int height = samples.height();
    RS_CHECK(guess.width() == width && guess.height() == height);
    RS_CHECK(seeds.width() == width && seeds.height() == height);
    RS_CHECK(barred.width() == width && barred.height() == height);
    RS_CHECK(samples.count() <= kMostWitnesses);
    if (plate.colour.empty()) {
        plate = {Image<Rgba8>(width, height), Image<std::uint64_t>(width, height)};
    }
    // The pixels with the most witnesses grow first: they know best.
    std::array<std::deque<std::pair<int, int>>, kMostWitnesses + 1> open;
    const auto accept = [&](int x, int y, const Rgba8& colour, std::uint64_t witnesses) {
        plate.colour(x, y) = colour;
        plate.witnesses(x, y) = witnesses;
        open[static_cast<std::size_t>(std::popcount(witnesses))].emplace_back(x, y);
    };
    GrownCleanPlate seeded{Image<Rgba8>(width, height), Image<std::uint64_t>(width, height)};
    for_each_index(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            if (seeds(x, y) == 0 || plate.witnesses(x, y) != 0) continue;
            const std::uint64_t witnesses = witnesses_of(samples, guess(x, y), x, y, kExpected_codes);
            if (witnesses == 0) continue;
            seeded.colour(x, y) = smooth_mean(samples, witnesses, x, y);
            seeded.witnesses(x, y) = witnesses_of(samples, seeded.colour(x, y), x, y);
        }
    });
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (seeded.witnesses(x, y) != 0) accept(x, y, seeded.colour(x, y), seeded.witnesses(x, y));
        }
    }
    // Pixels of the plate around (u, v) that show the same in the same pictures.
    const auto support = [&](int u, int v, const Rgba8& colour, std::uint64_t witnesses) {
        int count = 0;
        int known = 0;
        for (int y = std::max(0, v - kFront_px); y <= std::min(height - 1, v + kFront_px); ++y) {
            for (int x = std::max(0, u - kFront_px); x <= std::min(width - 1, u + kFront_px); ++x) {
                const int held = std::popcount(plate.witnesses(x, y));
                known += held == 0 ? 0 : 1;
                if (held == 0 || !samples_agree(plate.colour(x, y), colour, kTolerance_codes)) continue;
                count += std::popcount(witnesses & plate.witnesses(x, y)) >= kKeptShare * held ? 1 : 0;
            }
        }
        return count >= kAlikeShare * known ? count : 0;
    };
    const auto try_from = [&](int x, int y, int u, int v) {
        const std::uint64_t before = plate.witnesses(x, y);
        std::uint64_t witnesses = witnesses_of(samples, plate.colour(x, y), u, v) & before;
        if (std::popcount(witnesses) < kFewestWitnesses) return 0;
        if (std::popcount(witnesses) < kKeptShare * std::popcount(before)) return 0;
        Rgba8 colour = smooth_mean(samples, witnesses, u, v);
        witnesses = witnesses_of(samples, colour, u, v);
        if (witnesses == 0 || support(u, v, colour, witnesses) < kFewestInFront) return 0;
        if (growth == Growth::kNearGuess && !samples_agree(colour, guess(u, v), kGuessed_codes)) return 0;
        colour = smooth_mean(samples, witnesses, u, v);
        accept(u, v, colour, witnesses);
        return std::popcount(witnesses);
    };
    for (int most = kMostWitnesses; most > 0;) {
        auto& queue = open[static_cast<std::size_t>(most)];
        if (queue.empty()) {
            --most;
            continue;
        }
        const auto [x, y] = queue.front();
        queue.pop_front();
        int found = 0;
        for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v) {
            for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
                if (plate.witnesses(u, v) == 0 && barred(u, v) == 0) found = std::max(found, try_from(x, y, u, v));
            }
        }
        most = std::max(most, found);
    }
}

Image<Rgba8> sharp_colours(const EvenedSamples& samples, const GrownCleanPlate& plate) {
    Image<Rgba8> sharp(plate.colour.width(), plate.colour.height(), Rgba8{0, 0, 0, 255});
    for_each_index(sharp.height(), [&](int y) {
        for (int x = 0; x < sharp.width(); ++x) {
            const std::uint64_t witnesses = plate.witnesses(x, y);
            if (witnesses == 0) continue;
            sharp(x, y) = mean_of(witnesses, [&](std::size_t i) { return samples(i, x, y); });
        }
    });
    return sharp;
}

Image<std::uint8_t> confirm_plate(const EvenedSamples& samples, ConstImageView<Rgba8> plate,
                                  ConstImageView<std::uint8_t> asked) {
    RS_CHECK(plate.width() == samples.width() && plate.height() == samples.height());
    RS_CHECK(plate.width() == asked.width() && plate.height() == asked.height());
    const int width = plate.width();
    const int height = plate.height();
    // Bit i: sample i shows what was expected there; then the same all around; then wherever that is near.
    Image<std::uint64_t> alike(width, height);
    for_each_index(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            alike(x, y) = witnesses_of(samples, plate(x, y), x, y, kExpected_codes);
        }
    });
    const auto gathered = [&](const Image<std::uint64_t>& from, auto join) {
        Image<std::uint64_t> to(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                std::uint64_t bits = from(x, y);
                for (int v = std::max(0, y - kPatch_px); v <= std::min(height - 1, y + kPatch_px); ++v) {
                    for (int u = std::max(0, x - kPatch_px); u <= std::min(width - 1, x + kPatch_px); ++u) {
                        bits = join(bits, from(u, v));
                    }
                }
                to(x, y) = bits;
            }
        }
        return to;
    };
    const Image<std::uint64_t> around = gathered(alike, std::bit_and<std::uint64_t>());
    const Image<std::uint64_t> patches = gathered(around, std::bit_or<std::uint64_t>());
    Image<std::uint8_t> confirmed(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool seen = std::popcount(patches(x, y)) >= kFewestWitnesses;
            confirmed(x, y) = asked(x, y) != 0 && seen ? 255 : 0;
        }
    }
    return confirmed;
}

}  // namespace rs::capture
