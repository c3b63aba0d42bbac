#include "capture/photos/turn_plate.hpp"

#include "capture/photos/colour_difference.hpp"
#include "capture/photos/plate.hpp"
#include "capture/photos/plate_growth.hpp"
#include "capture/photos/swept_region.hpp"

#include <tbb/parallel_for.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
namespace {

// What the plate may explain; its guess where the object hides it is a rough one.
constexpr float kExplained_delta_e = 6;
constexpr float kDeepestShadow = 0.25F;
constexpr float kBrightest = 1;  // no shadow is brighter than the plate

Image<std::uint8_t> seen_in(const GrownPlate& plate) {
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

// Where the plate, fully lit or in a shadow, explains what never changes: a shadow that hardly moves, for the lamp
// stands still, and backdrop that the region swept includes by mistake.
Image<std::uint8_t> explained_by(ConstImageView<Rgba8> plate, ConstImageView<Rgba8> still) {
    Image<std::uint8_t> explained(plate.width(), plate.height());
    tbb::parallel_for(0, plate.height(), [&](int y) {
        for (int x = 0; x < plate.width(); ++x) {
            const Explanation e =
                explain_by_backdrop(linear_rgb(still(x, y)), linear_rgb(plate(x, y)), kDeepestShadow, kBrightest);
            explained(x, y) = e.shaded <= kExplained_delta_e ? 255 : 0;
        }
    });
    return explained;
}

}  // namespace

TurnPlate plate_of_turn(const EvenedSamples& samples, ConstImageView<Rgba8> still,
                        ConstImageView<std::uint8_t> motionless) {
    const Image<std::uint8_t> moves = where(motionless, motionless, [](bool rests, bool) { return !rests; });
    const Image<std::uint8_t> swept = swept_region(still, moves);
    TurnPlate result;
    result.untouched = where(motionless, swept, [](bool rests, bool within) { return rests && !within; });
    result.hidden = where(motionless, swept, [](bool rests, bool within) { return rests && within; });
    GrownPlate plate;
    grow_plate(samples, still, result.untouched, result.hidden, plate);
    // What the row shows at both ends of what is hidden is a good guess; where pictures confirm it, for one through the
    // holes of the object, the plate grows from there too.
    Image<Rgba8> guess = plate.colour;
    const Image<std::uint8_t> known = seen_in(plate);
    Image<std::uint8_t> bridged = known;
    bridge_rows(guess, bridged);
    const Image<std::uint8_t> guessed = where(bridged, known, [](bool has, bool had) { return has && !had; });
    fill_unknown(guess, bridged);
    result.hidden = where(result.hidden, explained_by(guess, still),
                          [](bool never_changes, bool explained) { return never_changes && !explained; });
    grow_plate(samples, guess, confirm_plate(samples, guess, guessed), result.hidden, plate);
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
    tbb::parallel_for(0, plate.height(), [&](int y) {
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
