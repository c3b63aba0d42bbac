#include "capture/photos/background/clean_plate_growth.hpp"

#include "capture/photos/background/still_picture.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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

// What stands still behind the object has edges, too. Across one all witnesses show another colour at once; of an
// object they would not, for its outlines lie elsewhere in each picture, unless they are few: those that show a flat
// object from its edge.
constexpr int kFewestWitnessesAtEdge = 6;
constexpr double kWitnessShareAtEdge = 0.25;  // of all samples
constexpr double kKeptShareAtEdge = 0.9;

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

// A plate and the places it can still grow from.
class GrowingPlate {
public:
    GrowingPlate(const EvenedSamples& samples, ConstImageView<std::uint8_t> barred, GrownCleanPlate& plate)
        : samples_(samples), barred_(barred), plate_(plate) {
        RS_CHECK(barred.width() == samples.width() && barred.height() == samples.height());
        RS_CHECK(samples.count() <= kMostWitnesses);
    }

    // The pixel is the plate's.
    void accept(int x, int y, const Rgba8& colour, std::uint64_t witnesses) {
        plate_.colour(x, y) = colour;
        plate_.witnesses(x, y) = witnesses;
        begin_at(x, y);
    }
    void begin_at(int x, int y) {
        open_[static_cast<std::size_t>(std::popcount(plate_.witnesses(x, y)))].emplace_back(x, y);
    }

    // From pixel (x, y) of the plate to its neighbour (u, v) of the same colour: how many witnesses that has, 0 where
    // it is not accepted. `may_have(colour)`.
    template <class MayHave>
    int go_on(int x, int y, int u, int v, MayHave may_have) {
        const std::uint64_t before = plate_.witnesses(x, y);
        std::uint64_t witnesses = witnesses_of(samples_, plate_.colour(x, y), u, v) & before;
        if (std::popcount(witnesses) < kFewestWitnesses) return 0;
        if (std::popcount(witnesses) < kKeptShare * std::popcount(before)) return 0;
        Rgba8 colour = smooth_mean(samples_, witnesses, u, v);
        witnesses = witnesses_of(samples_, colour, u, v);
        if (witnesses == 0) return 0;
        const auto looks_alike = [&](const Rgba8& seen) { return samples_agree(seen, colour, kTolerance_codes); };
        if (!has_front(u, v, witnesses, looks_alike) || !may_have(colour)) return 0;
        colour = smooth_mean(samples_, witnesses, u, v);
        accept(u, v, colour, witnesses);
        return std::popcount(witnesses);
    }

    // The same to a neighbour of another colour.
    int cross(int x, int y, int u, int v) {
        const auto samples = static_cast<double>(samples_.count());
        const std::uint64_t before = plate_.witnesses(x, y);
        if (std::popcount(before) < std::max<double>(kFewestWitnessesAtEdge, kWitnessShareAtEdge * samples)) return 0;
        std::uint64_t witnesses = before;
        Rgba8 colour;
        for (int round = 0; round < 2; ++round) {
            colour = smooth_mean(samples_, witnesses, u, v);
            witnesses = witnesses_of(samples_, colour, u, v);
            if (std::popcount(witnesses & before) < kKeptShareAtEdge * std::popcount(before)) return 0;
        }
        if (!has_front(u, v, witnesses, [](const Rgba8&) { return true; })) return 0;
        accept(u, v, colour, witnesses);
        return std::popcount(witnesses);
    }

    // The pixels with the most witnesses grow first: they know best. `step(x, y, u, v)` as go_on() and cross().
    template <class Step>
    void grow(Step step) {
        for (int most = kMostWitnesses; most > 0;) {
            auto& queue = open_[static_cast<std::size_t>(most)];
            if (queue.empty()) {
                --most;
                continue;
            }
            const auto [x, y] = queue.front();
            queue.pop_front();
            int found = 0;
            for (int v = std::max(0, y - 1); v <= std::min(samples_.height() - 1, y + 1); ++v) {
                for (int u = std::max(0, x - 1); u <= std::min(samples_.width() - 1, x + 1); ++u) {
                    if (plate_.witnesses(u, v) == 0 && barred_(u, v) == 0) found = std::max(found, step(x, y, u, v));
                }
            }
            most = std::max(most, found);
        }
    }

private:
    // Whether around (u, v) enough of the plate is seen by the same pictures, of those whose colour is `alike`.
    template <class Alike>
    [[nodiscard]] bool has_front(int u, int v, std::uint64_t witnesses, Alike alike) const {
        int count = 0;
        int known = 0;
        for (int y = std::max(0, v - kFront_px); y <= std::min(samples_.height() - 1, v + kFront_px); ++y) {
            for (int x = std::max(0, u - kFront_px); x <= std::min(samples_.width() - 1, u + kFront_px); ++x) {
                const int held = std::popcount(plate_.witnesses(x, y));
                known += held == 0 ? 0 : 1;
                if (held == 0 || !alike(plate_.colour(x, y))) continue;
                count += std::popcount(witnesses & plate_.witnesses(x, y)) >= kKeptShare * held ? 1 : 0;
            }
        }
        return count >= kFewestInFront && count >= kAlikeShare * known;
    }

    const EvenedSamples& samples_;
    ConstImageView<std::uint8_t> barred_;
    GrownCleanPlate& plate_;
    std::array<std::deque<std::pair<int, int>>, kMostWitnesses + 1> open_;  // by how many witnesses they have
};

}  // namespace

void grow_plate(const EvenedSamples& samples, ConstImageView<Rgba8> guess, ConstImageView<std::uint8_t> seeds,
                ConstImageView<std::uint8_t> barred, GrownCleanPlate& plate, Growth growth) {
    const int width = samples.width();
    const int height = samples.height();
    RS_CHECK(guess.width() == width && guess.height() == height);
    RS_CHECK(seeds.width() == width && seeds.height() == height);
    if (plate.colour.empty()) {
        plate = {Image<Rgba8>(width, height), Image<std::uint64_t>(width, height)};
    }
    GrowingPlate growing(samples, barred, plate);
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
            if (seeded.witnesses(x, y) != 0) growing.accept(x, y, seeded.colour(x, y), seeded.witnesses(x, y));
        }
    }
    growing.grow([&](int x, int y, int u, int v) {
        return growing.go_on(x, y, u, v, [&](const Rgba8& colour) {
            return growth == Growth::kFree || samples_agree(colour, guess(u, v), kGuessed_codes);
        });
    });
}

namespace {

// Whether what the witnesses show at (x, y) looks, in some light, as most of them see it on the other side of the axis.
bool is_mirrored(const EvenedSamples& samples, std::uint64_t witnesses, int x, int y, const RevolutionRows& rows) {
    const LinearRgb own = linear_rgb(smooth_mean(samples, witnesses, x, y));
    int alike = 0;
    for (std::uint64_t left = witnesses; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        const auto looks_alike = [&](int u) { return alike_in_some_light(own, linear_rgb(samples.smooth(i, u, y))); };
        alike += rows.any_mirrored(x, looks_alike) ? 1 : 0;
    }
    return 2 * alike > std::popcount(witnesses);
}

}  // namespace

void grow_across_edges(const EvenedSamples& samples, ConstImageView<std::uint8_t> barred, const RevolutionRows& rows,
                       GrownCleanPlate& plate) {
    RS_CHECK(plate.witnesses.width() == samples.width() && plate.witnesses.height() == samples.height());
    GrowingPlate growing(samples, barred, plate);
    for (int y = 0; y < samples.height(); ++y) {
        for (int x = 0; x < samples.width(); ++x) {
            if (plate.witnesses(x, y) != 0) growing.begin_at(x, y);
        }
    }
    growing.grow([&](int x, int y, int u, int v) {
        if (rows.may_be_body(u, v) && is_mirrored(samples, plate.witnesses(x, y), u, v, rows)) return 0;
        const int found = growing.go_on(x, y, u, v, [](const Rgba8&) { return true; });
        return found > 0 ? found : growing.cross(x, y, u, v);
    });
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
