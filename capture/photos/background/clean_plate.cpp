#include "capture/photos/background/clean_plate.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "capture/photos/background/clean_plate_growth.hpp"
#include "capture/photos/background/disc_bridging.hpp"
#include "capture/photos/background/revolution_rows.hpp"
#include "capture/photos/background/swept_region.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace rs::capture {
namespace {

// What the plate may explain; its guess where the object hides it is a rough one.
constexpr float kExplained_delta_e = 6;
constexpr float kDeepestShadow = 0.25F;
constexpr float kBrightest = 1;  // no shadow is brighter than the plate

Image<std::uint8_t> seen_in(const GrownCleanPlate& plate) {
    Image<std::uint8_t> seen(plate.witnesses.width(), plate.witnesses.height());
    std::transform(plate.witnesses.pixels().begin(), plate.witnesses.pixels().end(), seen.pixels().begin(),
                   [](std::uint64_t witnesses) { return witnesses != 0 ? std::uint8_t{255} : std::uint8_t{0}; });
    return seen;
}

template <class Condition>
Image<std::uint8_t> where(ConstImageView<std::uint8_t> a, ConstImageView<std::uint8_t> b, Condition condition) {
    RS_CHECK(a.width() == b.width() && a.height() == b.height());
    Image<std::uint8_t> mask(a.width(), a.height());
    for (int y = 0; y < mask.height(); ++y) {
        for (int x = 0; x < mask.width(); ++x) mask(x, y) = condition(a(x, y) != 0, b(x, y) != 0) ? 255 : 0;
    }
    return mask;
}

// What a pixel that never changes within the swept region looks like, seen from the plate.
struct Explained {
    cv::Mat1b plain;   // 255 where it looks like the plate ...
    cv::Mat1b shaded;  // ... and where only a shadow on it explains it
};

Explained explained_by(ConstImageView<Rgba8> plate, ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> hidden) {
    Explained explained{cv::Mat1b(plate.height(), plate.width(), std::uint8_t{0}),
                        cv::Mat1b(plate.height(), plate.width(), std::uint8_t{0})};
    for_each_index(plate.height(), [&](int y) {
        for (int x = 0; x < plate.width(); ++x) {
            if (hidden(x, y) == 0) continue;
            const Explanation e =
                explain_by_backdrop(linear_rgb(still(x, y)), linear_rgb(plate(x, y)), kDeepestShadow, kBrightest);
            if (e.plain <= kExplained_delta_e) {
                explained.plain(y, x) = 255;
            } else if (e.shaded <= kExplained_delta_e) {
                explained.shaded(y, x) = 255;
            }
        }
    });
    return explained;
}

// The connected parts of a mask and what they end at, a few pixels away, for borders are blurred.
class Ends {
public:
    struct Count {
        int moving = 0;  // places beyond the part's border where something moves
        int still = 0;   // where the backdrop stands still ...
        int clear = 0;   // ... and of those, where it looks different
    };
    // `is_backdrop(x, y)` of a place that does not move.
    template <class IsBackdrop>
    Ends(const cv::Mat1b& mask, ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> motionless,
         IsBackdrop is_backdrop)
        : parts_(mask, 8), counts_(parts_.tallied<Count>([&](int x, int y, Count& count) {
              constexpr int kReach_px = 3;
              constexpr float kClear_delta_e = 6;
              for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                  const int u = x + kReach_px * dx;
                  const int v = y + kReach_px * dy;
                  if (u < 0 || v < 0 || u >= mask.cols || v >= mask.rows || mask(y + dy, x + dx) != 0) continue;
                  if (motionless(u, v) == 0) {
                      ++count.moving;
                  } else if (is_backdrop(u, v)) {
                      const int in_x = std::clamp(x - kReach_px * dx, 0, mask.cols - 1);
                      const int in_y = std::clamp(y - kReach_px * dy, 0, mask.rows - 1);
                      const float step = delta_e(lab_from_linear(linear_rgb(still(u, v))),
                                                 lab_from_linear(linear_rgb(still(in_x, in_y))));
                      ++count.still;
                      count.clear += step > kClear_delta_e ? 1 : 0;
                  }
              }
          })) {}
    // Of the part that (x, y) belongs to.
    [[nodiscard]] const Count& at(int x, int y) const { return counts_[parts_.label(x, y)]; }

private:
    ConnectedParts parts_;
    PerPart<Count> counts_;
};

// Where the object always hides the plate: what never changes within the region swept, less
// - what looks like the plate: the region's border is coarse, and it spans hollows;
// - shadows. The lamp stands still, so the core of a shadow never changes, but its outline does as the object turns;
//   what ends at a still outline against the plain backdrop is a part of the object, of a colour like the backdrop's in
//   a shadow, unless the backdrop has a colour to know it by;
// - parts that go over into the backdrop without an edge.
Image<std::uint8_t> hidden_within(ConstImageView<std::uint8_t> motionless, ConstImageView<std::uint8_t> swept,
                                  ConstImageView<Rgba8> guess, ConstImageView<Rgba8> still) {
    constexpr double kClearShare = 0.6;
    Image<std::uint8_t> hidden = where(motionless, swept, [](bool rests, bool within) { return rests && within; });
    const Explained explained = explained_by(guess, still, hidden);
    const Ends shade_ends(explained.shaded, still, motionless,
                          [&](int x, int y) { return hidden(x, y) == 0 || explained.plain(y, x) != 0; });
    cv::Mat1b left(hidden.height(), hidden.width(), std::uint8_t{0});
    for (int y = 0; y < hidden.height(); ++y) {
        for (int x = 0; x < hidden.width(); ++x) {
            if (hidden(x, y) == 0 || explained.plain(y, x) != 0) continue;
            const bool shadow = explained.shaded(y, x) != 0 && (is_colourful(linear_rgb(guess(x, y))) ||
                                                                shade_ends.at(x, y).moving > shade_ends.at(x, y).still);
            left(y, x) = shadow ? 0 : 255;
        }
    }
    const Ends ends(left, still, motionless, [&](int x, int y) { return left(y, x) == 0; });
    for (int y = 0; y < hidden.height(); ++y) {
        for (int x = 0; x < hidden.width(); ++x) {
            const bool stays = left(y, x) != 0 && ends.at(x, y).clear >= kClearShare * ends.at(x, y).still;
            hidden(x, y) = stays ? 255 : 0;
        }
    }
    return hidden;
}

// Of what never changes within the region swept, only what may be a body of revolution is the object's in a room.
void keep_bodies_of_revolution(const RevolutionRows& rows, ConstImageView<Rgba8> still, Image<std::uint8_t>& hidden) {
    const cv::Mat1b mask(hidden.height(), hidden.width(), hidden.data());
    const ConnectedParts parts(mask, 8);
    // Pixels for it less those against.
    const auto balance = parts.tallied<int>([&](int x, int y, int& sum) {
        const LinearRgb own = linear_rgb(still(x, y));
        const auto is_alike = [&](int u) { return alike_in_some_light(own, linear_rgb(still(u, y))); };
        sum += rows.may_be_body(x, y) && rows.any_mirrored(x, is_alike) ? 1 : -1;
    });
    parts.for_each_pixel([&](int x, int y, int label) {
        if (balance[label] < 0) hidden(x, y) = 0;
    });
}

}  // namespace

CleanPlate clean_plate_of_turn(const EvenedSamples& samples, const StillPicture& still,
                               ConstImageView<std::uint8_t> motionless, Behind behind) {
    const Image<std::uint8_t> moves = where(motionless, motionless, [](bool rests, bool) { return !rests; });
    auto [swept, axis_px] = swept_region(still.colour, moves);
    CleanPlate result;
    result.untouched = where(motionless, swept, [](bool rests, bool within) { return rests && !within; });
    result.hidden = where(motionless, swept, [](bool rests, bool within) { return rests && within; });
    GrownCleanPlate plate;
    grow_plate(samples, still.colour, result.untouched, result.hidden, plate);
    Image<Rgba8> guess = plate.colour;
    Image<std::uint8_t> known = seen_in(plate);
    result.disc = find_turntable_disc(guess, known, swept);
    Image<std::uint8_t> foot(swept.width(), swept.height());
    if (result.disc) {  // a foot that looks the same from all sides was taken for the disc
        foot = still_foot(*result.disc, still.colour, known, swept);
        for (int y = 0; y < foot.height(); ++y) {
            for (int x = 0; x < foot.width(); ++x) {
                if (foot(x, y) == 0) continue;
                swept(x, y) = 255;
                known(x, y) = result.untouched(x, y) = 0;
                plate.witnesses(x, y) = 0;
            }
        }
    }
    // What the row, or the circle of a disc, shows at both ends of what is hidden is a good guess; where pictures
    // confirm it, for one through the holes of the object, the plate grows from there too.
    Image<std::uint8_t> bridged = known;
    bridge_gaps(result.disc, guess, bridged);
    const Image<std::uint8_t> guessed = where(bridged, known, [](bool has, bool had) { return has && !had; });
    fill_unknown(guess, bridged);
    result.hidden = hidden_within(motionless, swept, guess, still.colour);
    std::optional<RevolutionRows> rows;
    if (behind == Behind::kAnything && axis_px) rows.emplace(still, result.untouched, *axis_px);
    if (rows) keep_bodies_of_revolution(*rows, still.colour, result.hidden);
    grow_plate(samples, guess, confirm_plate(samples, guess, guessed), result.hidden, plate, Growth::kNearGuess);
    if (rows) {
        const auto either = [](bool hides, bool stands) { return hides || stands; };
        grow_across_edges(samples, where(result.hidden, foot, either), *rows, plate);
    }
    result.colour = sharp_colours(samples, plate);
    result.known = seen_in(plate);
    return result;
}

Image<float> plate_noise(const EvenedSamples& samples, const Image<Rgba8>& plate, const Image<std::uint8_t>& known) {
    constexpr int kNeighbourhood_px = 15;
    constexpr float kMostNoise_delta_e = 4;
    constexpr std::size_t kEnoughSamples = 12;
    cv::Mat1f sums(plate.height(), plate.width(), 0.0F);
    cv::Mat1f counts(plate.height(), plate.width(), 0.0F);
    const std::size_t step = std::max<std::size_t>(1, samples.count() / kEnoughSamples);
    for_each_index(plate.height(), [&](int y) {
        for (int x = 0; x < plate.width(); ++x) {
            if (known(x, y) == 0) continue;
            const Lab behind = lab_from_linear(linear_rgb(plate(x, y)));
            for (std::size_t i = 0; i < samples.count(); i += step) {
                if (!samples_agree(samples.smooth(i, x, y), plate(x, y))) continue;
                sums(y, x) += delta_e(lab_from_linear(linear_rgb(samples(i, x, y))), behind);
                counts(y, x) += 1;
            }
        }
    });
    cv::boxFilter(sums, sums, -1, {kNeighbourhood_px, kNeighbourhood_px}, {-1, -1}, false);
    cv::boxFilter(counts, counts, -1, {kNeighbourhood_px, kNeighbourhood_px}, {-1, -1}, false);
    Image<float> noise(plate.width(), plate.height());
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            noise(x, y) = std::min(kMostNoise_delta_e, sums(y, x) / std::max(1.0F, counts(y, x)));
        }
    }
    return noise;
}

}  // namespace rs::capture
