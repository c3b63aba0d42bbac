#include "capture/photos/background/clean_plate.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/photos/background/disc_inpainting.hpp"
#include "capture/photos/background/plate_propagation.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace rs::capture {
namespace {

Image<std::uint8_t> supported_pixels(const PropagatedPlate& plate) {
    Image<std::uint8_t> mask(plate.support.width(), plate.support.height());
    std::transform(plate.support.pixels().begin(), plate.support.pixels().end(), mask.pixels().begin(),
                   [](std::uint64_t support) { return support != 0 ? std::uint8_t{255} : std::uint8_t{0}; });
    return mask;
}

// 255 where `condition(a != 0, b != 0)`.
template <class Condition>
Image<std::uint8_t> combined(ConstImageView<std::uint8_t> a, ConstImageView<std::uint8_t> b, Condition condition) {
    RS_CHECK(a.width() == b.width() && a.height() == b.height());
    Image<std::uint8_t> mask(a.width(), a.height());
    for (int y = 0; y < mask.height(); ++y) {
        for (int x = 0; x < mask.width(); ++x) mask(x, y) = condition(a(x, y) != 0, b(x, y) != 0) ? 255 : 0;
    }
    return mask;
}

// Pixels of a mask that the plate explains; 255 or 0.
struct ExplainedPixels {
    cv::Mat1b plain;   // by its own colour
    cv::Mat1b shaded;  // by a shadow on it only
};

ExplainedPixels explained_by_plate(ConstImageView<Rgba8> plate, ConstImageView<Rgba8> colour,
                                   ConstImageView<std::uint8_t> mask, const BackgroundParameters::Shadow& parameters) {
    constexpr float kMaxShade = 1;  // a shadow does not brighten
    ExplainedPixels explained{cv::Mat1b(plate.height(), plate.width(), std::uint8_t{0}),
                              cv::Mat1b(plate.height(), plate.width(), std::uint8_t{0})};
    for_each_index(plate.height(), [&](int y) {
        for (int x = 0; x < plate.width(); ++x) {
            if (mask(x, y) == 0) continue;
            const ShadowFit e =
                fit_shadow(linear_rgb(colour(x, y)), linear_rgb(plate(x, y)), parameters.min_shade, kMaxShade);
            if (e.plain <= parameters.explained_delta_e) {
                explained.plain(y, x) = 255;
            } else if (e.shaded <= parameters.explained_delta_e) {
                explained.shaded(y, x) = 255;
            }
        }
    });
    return explained;
}

// Boundary statistics of the connected parts of a mask. The surroundings are read a few pixels away, since boundaries
// are blurred.
class BoundaryStatistics {
public:
    struct Count {                  // boundary pixels whose outside
        int moving = 0;             // changes over time
        int static_background = 0;  // is static background,
        int clear_edge = 0;         // of these: and differs clearly from the part
    };
    // `is_background(x, y)` of a static pixel.
    template <class IsBackground>
    BoundaryStatistics(const cv::Mat1b& mask, ConstImageView<Rgba8> colour, ConstImageView<std::uint8_t> static_pixels,
                       const BackgroundParameters::CoveredParts& parameters, IsBackground is_background)
        : parts_(mask, 8), counts_(parts_.accumulate<Count>([&](int x, int y, Count& count) {
              const int reach = parameters.boundary_reach_px;
              for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                  const int u = x + reach * dx;
                  const int v = y + reach * dy;
                  if (u < 0 || v < 0 || u >= mask.cols || v >= mask.rows || mask(y + dy, x + dx) != 0) continue;
                  if (static_pixels(u, v) == 0) {
                      ++count.moving;
                  } else if (is_background(u, v)) {
                      const int in_x = std::clamp(x - reach * dx, 0, mask.cols - 1);
                      const int in_y = std::clamp(y - reach * dy, 0, mask.rows - 1);
                      const float step = delta_e(lab_from_linear(linear_rgb(colour(u, v))),
                                                 lab_from_linear(linear_rgb(colour(in_x, in_y))));
                      ++count.static_background;
                      count.clear_edge += step > parameters.edge_delta_e ? 1 : 0;
                  }
              }
          })) {}
    // Statistics of the part that contains (x, y).
    [[nodiscard]] const Count& at(int x, int y) const { return counts_[parts_.label(x, y)]; }

private:
    ConnectedComponents parts_;
    PerComponent<Count> counts_;
};

// Static pixels of the swept region that belong to the object: all of them except
// - those that the plate explains: the region has a coarse contour and spans concavities;
// - shadows. The lamp is fixed, so the core of a shadow never changes but its contour does as the object turns. A
//   shaded part with a static contour against plain background is a part of the object, of the background's colour in
//   shadow, unless the background is colourful, which objects seldom match;
// - parts that fade into the background without an edge.
Image<std::uint8_t> always_covered_pixels(ConstImageView<std::uint8_t> static_pixels,
                                          ConstImageView<std::uint8_t> swept, ConstImageView<Rgba8> plate,
                                          ConstImageView<Rgba8> colour, const BackgroundParameters& parameters) {
    Image<std::uint8_t> covered =
        combined(static_pixels, swept, [](bool is_static, bool is_swept) { return is_static && is_swept; });
    const ExplainedPixels explained = explained_by_plate(plate, colour, covered, parameters.shadow);
    const BoundaryStatistics shadow_boundaries(
        explained.shaded, colour, static_pixels, parameters.covered_parts,
        [&](int x, int y) { return covered(x, y) == 0 || explained.plain(y, x) != 0; });
    cv::Mat1b unexplained(covered.height(), covered.width(), std::uint8_t{0});
    for (int y = 0; y < covered.height(); ++y) {
        for (int x = 0; x < covered.width(); ++x) {
            if (covered(x, y) == 0 || explained.plain(y, x) != 0) continue;
            const auto& boundary = shadow_boundaries.at(x, y);
            const bool is_shadow = explained.shaded(y, x) != 0 && (is_colourful(linear_rgb(plate(x, y))) ||
                                                                   boundary.moving > boundary.static_background);
            unexplained(y, x) = is_shadow ? 0 : 255;
        }
    }
    const BoundaryStatistics boundaries(unexplained, colour, static_pixels, parameters.covered_parts,
                                        [&](int x, int y) { return unexplained(y, x) == 0; });
    for (int y = 0; y < covered.height(); ++y) {
        for (int x = 0; x < covered.width(); ++x) {
            const auto& boundary = boundaries.at(x, y);
            const double min_clear = parameters.covered_parts.min_edge_share * boundary.static_background;
            covered(x, y) = unexplained(y, x) != 0 && boundary.clear_edge >= min_clear ? 255 : 0;
        }
    }
    return covered;
}

// Moves a static foot on the disc from the plate, which took it for the disc, to the swept region.
void exclude_foot(const Image<std::uint8_t>& foot, Image<std::uint8_t>& swept, Image<std::uint8_t>& known,
                  Image<std::uint8_t>& always_visible, PropagatedPlate& plate) {
    for (int y = 0; y < foot.height(); ++y) {
        for (int x = 0; x < foot.width(); ++x) {
            if (foot(x, y) == 0) continue;
            swept(x, y) = 255;
            known(x, y) = always_visible(x, y) = 0;
            plate.support(x, y) = 0;
        }
    }
}

}  // namespace

CleanPlate clean_plate_of_turn(const ExposureNormalizedFrames& frames, const BackgroundEstimate& background,
                               ConstImageView<std::uint8_t> static_pixels, const BackgroundParameters& parameters) {
    const Image<std::uint8_t> moves =
        combined(static_pixels, static_pixels, [](bool is_static, bool) { return !is_static; });
    Image<std::uint8_t> swept = swept_region(background.colour, moves, parameters.swept_region);
    CleanPlate result;
    result.always_visible =
        combined(static_pixels, swept, [](bool is_static, bool is_swept) { return is_static && !is_swept; });
    result.always_covered =
        combined(static_pixels, swept, [](bool is_static, bool is_swept) { return is_static && is_swept; });
    PropagatedPlate plate;
    propagate_plate(frames,
                    {.guess = background.colour,
                     .seeds = result.always_visible,
                     .barred = result.always_covered,
                     .growth = Growth::kFree},
                    parameters.propagation, plate);
    Image<Rgba8> guess = plate.colour;
    Image<std::uint8_t> known = supported_pixels(plate);
    result.disc = find_turntable_disc(guess, known, swept, parameters.disc);
    if (result.disc) {
        const Image<std::uint8_t> foot = static_foot(*result.disc, background.colour, known, swept, parameters);
        exclude_foot(foot, swept, known, result.always_visible, plate);
    }
    // Inpainting along the row, or along the circle of a disc, is a good guess. Where frames confirm it, such as one
    // through a hole of the object, the plate grows from there, too.
    Image<std::uint8_t> inpainted = known;
    inpaint_gaps(result.disc, guess, inpainted, parameters);
    const Image<std::uint8_t> guessed =
        combined(inpainted, known, [](bool is_filled, bool is_known) { return is_filled && !is_known; });
    fill_push_pull(guess, inpainted);
    result.always_covered = always_covered_pixels(static_pixels, swept, guess, background.colour, parameters);
    const Image<std::uint8_t> confirmed = confirm_plate(frames, guess, guessed, parameters.propagation);
    propagate_plate(frames,
                    {.guess = guess, .seeds = confirmed, .barred = result.always_covered, .growth = Growth::kNearGuess},
                    parameters.propagation, plate);
    result.colour = undenoised_colours(frames, plate);
    result.known = supported_pixels(plate);
    return result;
}

Image<float> plate_noise(const ExposureNormalizedFrames& frames, const Image<Rgba8>& plate,
                         const Image<std::uint8_t>& known, const BackgroundParameters& parameters) {
    cv::Mat1f sums(plate.height(), plate.width(), 0.0F);
    cv::Mat1f counts(plate.height(), plate.width(), 0.0F);
    const std::size_t step =
        std::max<std::size_t>(1, frames.count() / std::max<std::size_t>(1, parameters.noise.min_frames));
    for_each_index(plate.height(), [&](int y) {
        for (int x = 0; x < plate.width(); ++x) {
            if (known(x, y) == 0) continue;
            const Lab background = lab_from_linear(linear_rgb(plate(x, y)));
            for (std::size_t i = 0; i < frames.count(); i += step) {
                if (!within_codes(frames.smooth(i, x, y), plate(x, y), parameters.estimate.tolerance_codes)) continue;
                sums(y, x) += delta_e(lab_from_linear(linear_rgb(frames(i, x, y))), background);
                counts(y, x) += 1;
            }
        }
    });
    const cv::Size neighbourhood(parameters.noise.neighbourhood_px, parameters.noise.neighbourhood_px);
    cv::boxFilter(sums, sums, -1, neighbourhood, {-1, -1}, false);
    cv::boxFilter(counts, counts, -1, neighbourhood, {-1, -1}, false);
    Image<float> noise(plate.width(), plate.height());
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            noise(x, y) = std::min(parameters.noise.max_delta_e, sums(y, x) / std::max(1.0F, counts(y, x)));
        }
    }
    return noise;
}

}  // namespace rs::capture
