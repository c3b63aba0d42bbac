#include "capture/photos/foreground/foreground_mask.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/foreground/graph_cut.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

using Score = ForegroundParameters::Score;
using Cleanup = ForegroundParameters::Cleanup;

// 0 at `low`, 1 at `high`, linear between.
float ramp(float value, float low, float high) {
    return std::clamp((value - low) / (high - low), 0.0F, 1.0F);
}

bool is_set(const Image<std::uint8_t>& region, int x, int y) {
    return !region.empty() && region(x, y) != 0;
}

bool is_above_shadows(const CleanPlateView& plate, int x, int y) {
    return plate.disc.empty() ? is_set(plate.above_shadows, x, y) : plate.disc(x, y) == 0;
}

float noise_at(const CleanPlateView& plate, int x, int y) {
    return plate.noise_delta_e.empty() ? 0 : plate.noise_delta_e(x, y);
}

Score on_disc(Score score) {
    score.min_foreground_delta_e = score.disc_min_foreground_delta_e;
    score.certain_foreground_delta_e = score.disc_certain_foreground_delta_e;
    score.shadow_tolerance = score.disc_shadow_tolerance;
    score.min_shade = score.crevice_shade = score.disc_min_shade;
    return score;
}

Score above_shadows(Score score) {
    score.ambiguous_score = score.above_shadows_ambiguous_score;
    return score;
}

// Score of a pixel against one background colour.
float score_against(const ColourSample& pixel, const ColourSample& background, float noise_delta_e,
                    const Score& parameters) {
    const bool colourful = is_colourful(background.lab);
    const float background_delta_e =
        std::max(colourful ? parameters.colourful_background_delta_e : parameters.background_delta_e,
                 parameters.noise_factor * noise_delta_e);
    const ShadowFit fit =
        fit_shadow(pixel, background, colourful ? parameters.colourful_min_shade : parameters.min_shade,
                   parameters.max_shade, background_delta_e);
    if (fit.plain <= background_delta_e) return -kCertainScore;
    const float min_foreground_delta_e =
        std::max(parameters.min_foreground_delta_e, parameters.min_foreground_factor * background_delta_e);
    const float certain_foreground_delta_e =
        std::max(parameters.certain_foreground_delta_e, parameters.certain_foreground_factor * min_foreground_delta_e);
    const float tolerance = 1 + parameters.shadow_tolerance * std::max(0.0F, 1 - fit.shade);
    const float foreground =
        ramp(fit.shaded, min_foreground_delta_e * tolerance, certain_foreground_delta_e * tolerance);
    if (foreground > 0) return std::max(std::abs(parameters.ambiguous_score), foreground * kCertainScore);
    const float near_background =
        1 - ramp(fit.plain, background_delta_e, parameters.near_background_factor * background_delta_e);
    if (near_background > 0) return near_background * parameters.near_background_score;
    const bool is_shadow = fit.shade >= parameters.crevice_shade &&
                           fit.shaded <= parameters.shadow_residual_share * min_foreground_delta_e;
    return is_shadow ? parameters.ambiguous_score : std::abs(parameters.ambiguous_score);
}

// White patches of an object look like a white background. Small achromatic background components that do not touch
// the image border become undecided, so that the contrast around them determines their label.
void release_small_islands(Image<float>& score, ConstImageView<Lab> background, const Score& parameters) {
    cv::Mat1b not_background(score.height(), score.width());
    for (int y = 0; y < not_background.rows; ++y) {
        for (int x = 0; x < not_background.cols; ++x) not_background(y, x) = score(x, y) <= -kCertainScore ? 0 : 255;
    }
    const ConnectedComponents islands = ConnectedComponents::of_complement(not_background);
    islands.for_each_pixel([&](int x, int y, int label) {
        if (islands.touches_border(label)) return;
        const bool is_small = islands.area(label) < parameters.max_island * static_cast<double>(not_background.total());
        if (is_small && !is_colourful(background(x, y))) score(x, y) = parameters.island_score;
    });
}

// Removes components without a pixel of `strong_score`, and specks. If no component has one, keeps the largest where
// weak foreground is allowed.
void remove_weak_components(cv::Mat1b& mask, ConstImageView<float> score, float strong_score,
                            const Cleanup& parameters) {
    const ConnectedComponents components(mask, 8);
    struct Evidence {
        bool is_strong = false;
    };
    const auto evidence = components.accumulate<Evidence>(
        [&](int x, int y, Evidence& of_component) { of_component.is_strong |= score(x, y) >= strong_score; });
    const bool use_weak = parameters.keep_weak_foreground && std::ranges::none_of(evidence, &Evidence::is_strong);
    int largest = 0;
    for (int label = 1; label < components.count(); ++label) {
        if (!use_weak && !evidence[label].is_strong) continue;
        if (largest == 0 || components.area(label) > components.area(largest)) largest = label;
    }
    PerComponent<std::uint8_t> keep(components.count());
    for (int label = 1; label < components.count(); ++label) {
        const bool is_kept =
            evidence[label].is_strong && components.area(label) >= parameters.min_component * components.area(largest);
        keep[label] = is_kept || label == largest ? 1 : 0;
    }
    components.for_each_pixel([&](int x, int y, int label) {
        if (keep[label] == 0) mask(y, x) = 0;
    });
}

// Fills tiny holes and those that do not show the background. The rim of a hole is blurred, so its inner part is tested
// where there is one: a true hole looks like the background nearly everywhere, a white inside of the object only in
// places. A shadow counts as background if the background is colourful and thereby recognizable.
void fill_false_holes(cv::Mat1b& mask, ConstImageView<float> score, ConstImageView<Lab> background,
                      const Cleanup& parameters) {
    cv::Mat1b outside;
    cv::bitwise_not(mask, outside);
    cv::Mat1b inner;
    cv::erode(outside, inner, cv::Mat(), {-1, -1}, parameters.hole_rim_px);
    const ConnectedComponents holes = ConnectedComponents::of_complement(mask);
    struct Areas {  // px
        int background = 0;
        int inner = 0, inner_background = 0;  // without the rim
    };
    const auto areas = holes.accumulate<Areas>([&](int x, int y, Areas& hole) {
        const int is_background = score(x, y) < 0 || is_colourful(background(x, y)) ? 1 : 0;
        const bool is_inner = inner(y, x) != 0;
        hole.background += is_background;
        hole.inner += is_inner ? 1 : 0;
        hole.inner_background += is_inner ? is_background : 0;
    });
    holes.for_each_pixel([&](int x, int y, int label) {
        if (holes.touches_border(label)) return;
        const Areas& hole = areas[label];
        const int area = holes.area(label);
        const bool shows_background = hole.inner > 0
                                          ? hole.inner_background >= parameters.min_hole_background * hole.inner
                                          : 2 * hole.background >= area;
        const bool is_tiny =
            area < std::max(parameters.min_hole_px, parameters.min_hole * static_cast<double>(mask.total()));
        if (!shows_background || is_tiny) mask(y, x) = 255;
    });
}

// Pixels of `mask` removed by an opening with a line of width_px + 1 in any of four directions: 255 where the mask is
// at most `width_px` wide along a row, a column or a diagonal. The mask is taken to continue beyond the image border.
cv::Mat1b thin_structures(const cv::Mat1b& mask, int width_px) {
    cv::Mat1b padded;
    cv::copyMakeBorder(mask, padded, width_px, width_px, width_px, width_px, cv::BORDER_CONSTANT, 255);
    const cv::Rect inner(width_px, width_px, mask.cols, mask.rows);
    const int length = width_px + 1;
    cv::Mat1b diagonal(length, length, std::uint8_t{0});
    cv::setIdentity(diagonal);
    cv::Mat1b other_diagonal;
    cv::flip(diagonal, other_diagonal, 0);
    const std::array<cv::Mat1b, 4> lines{cv::Mat1b(1, length, std::uint8_t{1}), cv::Mat1b(length, 1, std::uint8_t{1}),
                                         diagonal, other_diagonal};
    cv::Mat1b thin(mask.size(), std::uint8_t{0});
    for (const cv::Mat1b& line : lines) {
        // The anchors are the line's two ends, so that lines of even length do not shift the mask.
        const cv::Point first(0, line(0, 0) != 0 ? 0 : line.rows - 1);
        const cv::Point last(line.cols - 1, line.rows - 1 - first.y);
        cv::Mat1b opened;
        cv::erode(padded, opened, line, first);
        cv::dilate(opened, opened, line, last);
        cv::Mat1b removed;
        cv::subtract(mask, opened(inner), removed);
        cv::bitwise_or(thin, removed, thin);
    }
    return thin;
}

// Raises the score of undecided thin structures, such as wires and narrow rods, that differ clearly from a plate of
// known noise and exposure: shadows are broad. Skips colourful backgrounds, on which shadows and grey parts differ.
void favour_thin_structures(ConstImageView<Rgba8> photo, const CleanPlateView& plate, const Score& parameters,
                            Image<float>& score) {
    cv::Mat3f smooth;
    cv::GaussianBlur(linear_mat(photo), smooth, {3, 3}, 0);
    const int width_px = std::max(1, std::max(smooth.cols, smooth.rows) / parameters.thin_width_divisor);
    // Only the neighbourhood of undecided pixels, a small part of the image, has an effect.
    cv::Mat1b needed(smooth.size());
    for (int y = 0; y < smooth.rows; ++y) {
        for (int x = 0; x < smooth.cols; ++x) needed(y, x) = std::abs(score(x, y)) < kCertainScore ? 255 : 0;
    }
    cv::dilate(needed, needed, cv::getStructuringElement(cv::MORPH_RECT, {2 * width_px + 1, 2 * width_px + 1}));
    cv::Mat1f beyond_noise(smooth.size(), 0.0F);
    cv::Mat1b differs(smooth.size(), std::uint8_t{0});
    for (int y = 0; y < smooth.rows; ++y) {
        for (int x = 0; x < smooth.cols; ++x) {
            if (needed(y, x) == 0) continue;
            const cv::Vec3f& p = smooth(y, x);
            const float noise = noise_at(plate, x, y);
            const float difference = delta_e(lab_from_linear({p[0], p[1], p[2]}), plate.background.lab(x, y));
            beyond_noise(y, x) = difference - noise;
            differs(y, x) =
                difference > std::max(parameters.background_delta_e, parameters.thin_noise_factor * noise) ? 255 : 0;
        }
    }
    const cv::Mat1b thin = thin_structures(differs, width_px);
    for (int y = 0; y < smooth.rows; ++y) {
        for (int x = 0; x < smooth.cols; ++x) {
            float& own = score(x, y);
            if (std::abs(own) >= kCertainScore || thin(y, x) == 0) continue;
            if (beyond_noise(y, x) < parameters.thin_delta_e) continue;
            if (beyond_noise(y, x) < parameters.thin_on_disc_delta_e && is_set(plate.disc, x, y)) continue;
            if (!is_colourful(plate.background.lab(x, y))) own = std::max(own, parameters.thin_score);
        }
    }
}

}  // namespace

LinearLabImage::LinearLabImage(Image<LinearRgb> unclipped) : light(std::move(unclipped)) {
    for (LinearRgb& p : light.pixels()) p = {std::min(1.0F, p.r), std::min(1.0F, p.g), std::min(1.0F, p.b)};
    lab = lab_image(light);
}

Image<float> foreground_score(const LabPhoto& photo, const CleanPlateView& plate, const Score& parameters) {
    RS_CHECK(photo.width() == plate.background.width() && photo.height() == plate.background.height());
    const Score disc = on_disc(parameters);
    const Score above = above_shadows(parameters);
    const int reach_px = parameters.misalignment_px;
    const std::array<std::pair<int, int>, 4> offsets{{{-reach_px, 0}, {reach_px, 0}, {0, -reach_px}, {0, reach_px}}};
    std::vector<ColourSample> screen_colours;
    for (const LinearRgb& colour : plate.screen_colours) screen_colours.emplace_back(colour);
    const auto background_at = [&](int x, int y) {
        return ColourSample(plate.background.light(x, y), plate.background.lab(x, y));
    };
    Image<float> score(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            if (is_set(plate.visible, x, y)) {
                score(x, y) = -kCertainScore;
                continue;
            }
            const Score& local = is_above_shadows(plate, x, y) ? above : (is_set(plate.disc, x, y) ? disc : parameters);
            const ColourSample pixel(linear_rgb(photo.image(x, y)), photo.lab(x, y));
            const float noise = noise_at(plate, x, y);
            const ColourSample background = background_at(x, y);
            float best = score_against(pixel, background, noise, local);
            if (is_set(plate.occluded, x, y)) {
                score(x, y) = std::max(best, parameters.occluded_score);
                continue;
            }
            if (best > 0) {
                for (const auto& [dx, dy] : offsets) {
                    const ColourSample neighbour = background_at(std::clamp(x + dx, 0, photo.width() - 1),
                                                                 std::clamp(y + dy, 0, photo.height() - 1));
                    if (delta_e(neighbour.lab, background.lab) < local.background_delta_e) continue;
                    best = std::min(best, score_against(pixel, neighbour, noise, local));
                }
            }
            for (const ColourSample& colour : screen_colours) {
                if (best <= 0) break;
                best = std::min(best, score_against(pixel, colour, noise, local));
            }
            score(x, y) = best;
        }
    }
    return score;
}

Image<std::uint8_t> segment_foreground(const LabPhoto& photo, const CleanPlateView& plate,
                                       const ForegroundParameters& parameters) {
    RS_CHECK(photo.width() == plate.background.width() && photo.height() == plate.background.height());
    Image<std::uint8_t> result(photo.width(), photo.height());
    if (result.empty()) return result;
    Image<float> score = foreground_score(photo, plate, parameters.score);
    if (parameters.score.thin_delta_e > 0) favour_thin_structures(photo.image, plate, parameters.score, score);
    release_small_islands(score, plate.background.lab, parameters.score);
    result = graph_cut_coarse_to_fine(photo.lab, score, parameters.graph_cut);
    cv::Mat1b mask(result.height(), result.width(), result.data());
    remove_weak_components(mask, score, parameters.score.strong_score, parameters.cleanup);
    fill_false_holes(mask, score, plate.background.lab, parameters.cleanup);
    return result;
}

}  // namespace rs::capture
