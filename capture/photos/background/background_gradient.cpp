#include "capture/photos/background/background_gradient.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/log_ratio.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/image/linear_light.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kTerms = 6;
using Terms = cv::Vec<double, kTerms>;
using Rgb = cv::Vec3d;  // sRGB codes or their logarithms
using Normal = cv::Matx<double, kTerms, kTerms>;
using Coefficients = cv::Matx<double, kTerms, 3>;
using GradientParameters = BackgroundParameters::Gradient;

// Plate and mask of its always visible pixels, with the border band that the model is fitted to. Farther inside, static
// pixels may be the object's.
struct BorderBand {
    ConstImageView<Rgba8> plate;
    ConstImageView<std::uint8_t> always_visible;
    int width_px;

    BorderBand(ConstImageView<Rgba8> of_plate, ConstImageView<std::uint8_t> visible, double share)
        : plate(of_plate),
          always_visible(visible),
          width_px(std::max(1, static_cast<int>(share * std::min(of_plate.width(), of_plate.height())))) {}
    [[nodiscard]] bool contains(int x, int y) const {
        return x < width_px || y < width_px || x >= plate.width() - width_px || y >= plate.height() - width_px;
    }
};

// Polynomial without the constant, which is the row's level; u and v are -1..1.
Terms terms_at(int x, int y, int width, int height) {
    const double u = (2 * x + 1.0) / width - 1, v = (2 * y + 1.0) / height - 1;
    return {u, u * u, u * v, u * u * v, u * v * v, u * u * v * v};
}

Rgb codes_of(const Rgba8& p) {
    return {static_cast<double>(p.r), static_cast<double>(p.g), static_cast<double>(p.b)};
}

Rgb log_codes_of(const Rgba8& p) {
    return {std::log(p.r + 1.0), std::log(p.g + 1.0), std::log(p.b + 1.0)};
}

bool is_within(const Rgb& a, const Rgb& b, double codes) {
    const Rgb difference = a - b;
    return std::max({std::abs(difference(0)), std::abs(difference(1)), std::abs(difference(2))}) <= codes;
}

// Rows parallel to the horizon of a rolled camera, numbered by y in the image's middle column plus a margin.
class SlopedRows {
public:
    SlopedRows(int width, int height, double slope)
        : width_(width),
          middle_((width - 1) / 2.0),
          slope_(slope),
          margin_(static_cast<int>(std::ceil(std::abs(slope) * middle_)) + 1),
          count_(height + 2 * margin_) {}
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int count() const { return count_; }
    // Fractional row of a pixel; at least 0 and below count() - 1.
    [[nodiscard]] double row_of(int x, int y) const { return y + slope_ * (x - middle_) + margin_; }
    // Nearest pixel of a row in column x; may lie outside of the image.
    [[nodiscard]] int y_of(int row, int x) const {
        return static_cast<int>(std::floor(row - margin_ - slope_ * (x - middle_) + 0.5));
    }

private:
    int width_;
    double middle_, slope_;
    int margin_, count_;
};

// Logarithms of sRGB codes, since vignetting and falloff are factors.
struct GradientModel {
    SlopedRows rows;
    int height = 0;
    std::vector<Rgb> levels;  // [row]
    Coefficients coefficients;

    [[nodiscard]] Rgb codes_at(int x, int y) const {
        const cv::Matx<double, 1, 3> a = terms_at(x, y, rows.width(), height).t() * coefficients;
        const double row = rows.row_of(x, y);
        const auto above = static_cast<std::size_t>(row);
        const double fraction = row - std::floor(row);
        const Rgb level = levels[above] * (1 - fraction) + levels[above + 1] * fraction;
        return {std::exp(level(0) + a(0)) - 1, std::exp(level(1) + a(1)) - 1, std::exp(level(2) + a(2)) - 1};
    }
};

// A row's contribution to the normal equations, relative to its means.
struct RowEquations {
    std::ptrdiff_t visible = 0, count = 0;  // px of the band, and those within the tolerance
    Terms mean_terms;
    Rgb mean_log_codes;
    Normal normal = Normal::zeros();
    Coefficients right_side = Coefficients::zeros();
};

// Calls visit(x, y) for the row's always visible pixels in the band.
template <class Visit>
void for_visible(const BorderBand& band, const SlopedRows& rows, int row, Visit visit) {
    for (int x = 0; x < band.plate.width(); ++x) {
        const int y = rows.y_of(row, x);
        if (y >= 0 && y < band.plate.height() && band.always_visible(x, y) != 0 && band.contains(x, y)) visit(x, y);
    }
}

template <class IsInlier>
RowEquations row_equations(const BorderBand& band, const SlopedRows& rows, int row, IsInlier is_inlier) {
    RowEquations sums;
    for_visible(band, rows, row, [&](int x, int y) {
        sums.visible += 1;
        if (!is_inlier(x, y)) return;
        const Terms terms = terms_at(x, y, band.plate.width(), band.plate.height());
        const Rgb log_codes = log_codes_of(band.plate(x, y));
        sums.count += 1;
        sums.mean_terms += terms;
        sums.mean_log_codes += log_codes;
        sums.normal += terms * terms.t();
        sums.right_side += terms * log_codes.t();
    });
    if (sums.count == 0) return sums;
    const auto count = static_cast<double>(sums.count);
    sums.mean_terms *= 1 / count;
    sums.mean_log_codes *= 1 / count;
    sums.normal -= count * (sums.mean_terms * sums.mean_terms.t());
    sums.right_side -= count * (sums.mean_terms * sums.mean_log_codes.t());
    return sums;
}

// Interpolates the levels of rows without one linearly between their neighbours. Nullopt if no row has a level.
std::optional<std::vector<Rgb>> interpolated_levels(const std::vector<std::optional<Rgb>>& measured) {
    std::vector<std::size_t> known;
    for (std::size_t row = 0; row < measured.size(); ++row) {
        if (measured[row]) known.push_back(row);
    }
    if (known.empty()) return std::nullopt;
    std::vector<Rgb> levels(measured.size(), *measured[known.front()]);
    std::fill(levels.begin() + static_cast<std::ptrdiff_t>(known.back()), levels.end(), *measured[known.back()]);
    for (std::size_t i = 1; i < known.size(); ++i) {
        const std::size_t from = known[i - 1], to = known[i];
        for (std::size_t row = from; row < to; ++row) {
            const double fraction = static_cast<double>(row - from) / static_cast<double>(to - from);
            levels[row] = *measured[from] * (1 - fraction) + *measured[to] * fraction;
        }
    }
    return levels;
}

// Start of the iteration: the median of every row in the band, which is robust to marks.
std::optional<GradientModel> median_model(const BorderBand& band, const SlopedRows& rows, double min_row_share) {
    std::vector<std::optional<Rgb>> medians(static_cast<std::size_t>(rows.count()));
    for_each_index(rows.count(), [&](int row) {
        std::array<std::vector<double>, 3> log_codes;  // [channel]
        for_visible(band, rows, row, [&](int x, int y) {
            const Rgb of_pixel = log_codes_of(band.plate(x, y));
            for (int c = 0; c < 3; ++c) log_codes[static_cast<std::size_t>(c)].push_back(of_pixel(c));
        });
        if (static_cast<double>(log_codes[0].size()) < min_row_share * band.plate.width()) return;
        medians[static_cast<std::size_t>(row)] =
            Rgb(median(std::move(log_codes[0])), median(std::move(log_codes[1])), median(std::move(log_codes[2])));
    });
    std::optional<std::vector<Rgb>> levels = interpolated_levels(medians);
    if (!levels) return std::nullopt;
    return GradientModel{rows, band.plate.height(), *std::move(levels), Coefficients::zeros()};
}

// Least-squares model of the inliers.
std::optional<GradientModel> solved_model(const std::vector<RowEquations>& sums, const SlopedRows& rows, int height,
                                          double min_row_share) {
    Normal normal = Normal::zeros();
    Coefficients right_side = Coefficients::zeros();
    for (const RowEquations& row : sums) {
        normal += row.normal;
        right_side += row.right_side;
    }
    const Coefficients coefficients = normal.solve(right_side, cv::DECOMP_SVD);
    std::vector<std::optional<Rgb>> measured(sums.size());
    for (std::size_t row = 0; row < sums.size(); ++row) {
        if (static_cast<double>(sums[row].count) < min_row_share * rows.width()) continue;
        const cv::Matx<double, 1, 3> a = sums[row].mean_terms.t() * coefficients;
        measured[row] = sums[row].mean_log_codes - Rgb(a(0), a(1), a(2));
    }
    std::optional<std::vector<Rgb>> levels = interpolated_levels(measured);
    if (!levels) return std::nullopt;
    return GradientModel{rows, height, *std::move(levels), coefficients};
}

// Alternates between inliers and least squares, with a tolerance that is halved every round. Nullopt unless most of the
// band is within the final tolerance.
std::optional<GradientModel> robust_model(const BorderBand& band, const SlopedRows& rows,
                                          const GradientParameters& parameters) {
    constexpr int kRounds = 4;
    std::optional<GradientModel> model = median_model(band, rows, parameters.min_row_share);
    std::vector<RowEquations> sums(static_cast<std::size_t>(rows.count()));
    for (int round = 0; model && round <= kRounds; ++round) {  // the last one counts inliers only
        const double tolerance_codes = std::ldexp(parameters.tolerance_codes, kRounds - round);
        const auto is_inlier = [&](int x, int y) {
            return is_within(model->codes_at(x, y), codes_of(band.plate(x, y)), tolerance_codes);
        };
        for_each_index(rows.count(), [&](int row) {
            sums[static_cast<std::size_t>(row)] = row_equations(band, rows, row, is_inlier);
        });
        if (round < kRounds) model = solved_model(sums, rows, band.plate.height(), parameters.min_row_share);
    }
    if (!model) return std::nullopt;
    std::ptrdiff_t visible = 0, inliers = 0;  // px
    for (const RowEquations& row : sums) {
        visible += row.visible;
        inliers += row.count;
    }
    if (static_cast<double>(inliers) < parameters.min_fit_share * static_cast<double>(visible)) return std::nullopt;
    return model;
}

// [y]: vertical change of the mean log codes (sum of the channels) over a few rows, columns [from_x, to_x); nullopt
// where less than half of them are visible.
std::vector<std::optional<double>> vertical_steps(const BorderBand& band, int from_x, int to_x) {
    constexpr int kStep_px = 4;
    std::vector<std::optional<double>> means(static_cast<std::size_t>(band.plate.height()));
    for (int y = 0; y < band.plate.height(); ++y) {
        double sum = 0;
        int count = 0;
        for (int x = from_x; x < to_x; ++x) {
            if (band.always_visible(x, y) == 0) continue;
            const Rgb log_codes = log_codes_of(band.plate(x, y));
            sum += log_codes(0) + log_codes(1) + log_codes(2);
            ++count;
        }
        if (2 * count >= to_x - from_x) means[static_cast<std::size_t>(y)] = sum / count;
    }
    std::vector<std::optional<double>> steps(means.size());
    for (std::size_t y = kStep_px; y < means.size(); ++y) {
        if (means[y] && means[y - kStep_px]) steps[y] = *means[y] - *means[y - kStep_px];
    }
    return steps;
}

// Estimates the horizon's slope from the left and right bands: the vertical shift that aligns their steps best, px down
// per px to the left. 0 unless that is clearly better than no shift.
double horizon_slope(const BorderBand& band, const GradientParameters& parameters) {
    const int width = band.plate.width(), height = band.plate.height();
    const int strip_px = std::max(1, band.width_px / 2);
    const auto left = vertical_steps(band, 0, strip_px);
    const auto right = vertical_steps(band, width - strip_px, width);
    const int distance_px = width - strip_px;
    if (distance_px <= 0) return 0;
    const auto residual = [&](int shift) -> std::optional<double> {
        double squared = 0;
        int count = 0;
        for (int y = std::max(0, -shift); y < std::min(height, height - shift); ++y) {
            const auto& a = left[static_cast<std::size_t>(y)];
            const auto& b = right[static_cast<std::size_t>(y + shift)];
            if (!a || !b) continue;
            squared += (*a - *b) * (*a - *b);
            ++count;
        }
        if (4 * count < height) return std::nullopt;
        return squared / count;
    };
    const std::optional<double> level = residual(0);
    if (!level) return 0;
    double min_residual = parameters.max_slope_residual * *level;
    int best = 0;
    const int max_shift = static_cast<int>(parameters.max_slope * distance_px);
    for (int shift = -max_shift; shift <= max_shift; ++shift) {
        const std::optional<double> of_shift = residual(shift);
        if (!of_shift || *of_shift >= min_residual) continue;
        min_residual = *of_shift;
        best = shift;
    }
    return -static_cast<double>(best) / distance_px;
}

bool all_sides_visible(const BorderBand& band, double min_side_share) {
    const int px = band.width_px;
    const cv::Mat1b visible = mat_view(band.always_visible);
    const std::array sides{visible.rowRange(0, px), visible.rowRange(visible.rows - px, visible.rows),
                           visible.colRange(0, px), visible.colRange(visible.cols - px, visible.cols)};
    return std::ranges::all_of(sides, [&](const cv::Mat& side) {
        return cv::countNonZero(side) >= min_side_share * static_cast<double>(side.total());
    });
}

Image<LinearRgb> light_of(const GradientModel& model) {
    Image<LinearRgb> light(model.rows.width(), model.height);
    for_each_index(model.height, [&](int y) {
        for (int x = 0; x < light.width(); ++x) {
            const Rgb codes = model.codes_at(x, y);
            const auto linear = [](double code) {
                return linear_from_srgb(static_cast<float>(std::clamp(code / 255, 0.0, 1.0)));
            };
            light(x, y) = {linear(codes(0)), linear(codes(1)), linear(codes(2))};
        }
    });
    return light;
}

// Always visible pixels that deviate from the gradient; 255 or 0.
struct Deviations {
    cv::Mat1b visible;     // differ
    cv::Mat1b not_shadow;  // of these: have an edge or a colour that no soft shadow has
};

Deviations deviations_from(const Image<LinearRgb>& gradient, const BorderBand& band,
                           const BackgroundParameters& parameters) {
    const cv::Mat1b edges =
        edges_of_log_ratio(log_ratio(smoothed_light(linear_mat(band.plate)), smoothed_light(light_mat(gradient))),
                           parameters.shadow.edge_log_per_px);
    Deviations deviations{cv::Mat1b(edges.size(), std::uint8_t{0}), cv::Mat1b(edges.size(), std::uint8_t{0})};
    for_each_index(gradient.height(), [&](int y) {
        for (int x = 0; x < gradient.width(); ++x) {
            if (band.always_visible(x, y) == 0) continue;
            const ShadowFit e =
                fit_shadow(linear_rgb(band.plate(x, y)), gradient(x, y), parameters.shadow.min_shade, 1);
            if (e.plain <= parameters.gradient.visible_delta_e) continue;
            deviations.visible(y, x) = 255;
            const bool is_not_shadow = edges(y, x) != 0 || e.shaded > parameters.shadow.explained_delta_e;
            deviations.not_shadow(y, x) = is_not_shadow ? 255 : 0;
        }
    });
    return deviations;
}

// Copies isolated deviations, such as a mark on the wall or a cable, from the plate. Returns false if there are many,
// or if some are connected to the swept region: those may continue behind the object, as a turntable does.
bool keep_isolated_marks(Image<LinearRgb>& gradient, const BorderBand& band, const BackgroundParameters& parameters) {
    const GradientParameters& limits = parameters.gradient;
    const Deviations deviations = deviations_from(gradient, band, parameters);
    const int margin_px = 2 * limits.swept_margin_px + 1;
    cv::Mat1b swept, near_swept, joined;
    cv::bitwise_not(mat_view(band.always_visible), swept);
    cv::dilate(swept, near_swept, cv::getStructuringElement(cv::MORPH_RECT, {margin_px, margin_px}));
    cv::bitwise_or(deviations.visible, swept, joined);
    const ConnectedComponents parts(joined, 8);
    struct Tally {
        int swept = 0, not_shadow = 0;  // px
    };
    const auto tallies = parts.accumulate<Tally>([&](int x, int y, Tally& tally) {
        tally.swept += swept(y, x) != 0 ? 1 : 0;
        tally.not_shadow += deviations.not_shadow(y, x) != 0 && near_swept(y, x) == 0 ? 1 : 0;
    });
    const auto image_px = static_cast<double>(joined.total());
    const auto is_at_object = [&](const Tally& tally) { return tally.swept >= limits.min_swept_share * image_px; };
    int at_object = 0, elsewhere = 0;  // px
    for (const Tally& tally : tallies) (is_at_object(tally) ? at_object : elsewhere) += tally.not_shadow;
    if (at_object > limits.max_share_at_object * image_px) return false;
    if (elsewhere > limits.max_share_elsewhere * image_px) return false;
    parts.for_each_pixel([&](int x, int y, int label) {
        const bool is_mark = deviations.visible(y, x) != 0 && !is_at_object(tallies[label]);
        if (is_mark) gradient(x, y) = linear_rgb(band.plate(x, y));
    });
    return true;
}

}  // namespace

Image<LinearRgb> fit_background_gradient(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> always_visible,
                                         const BackgroundParameters& parameters) {
    RS_CHECK(plate.width() == always_visible.width() && plate.height() == always_visible.height());
    const int width = plate.width(), height = plate.height();
    if (width == 0 || height == 0) return {};
    const BorderBand band(plate, always_visible, parameters.gradient.band_share);
    if (!all_sides_visible(band, parameters.gradient.min_side_share)) return {};
    const SlopedRows rows(width, height, horizon_slope(band, parameters.gradient));
    const std::optional<GradientModel> model = robust_model(band, rows, parameters.gradient);
    if (!model) return {};
    Image<LinearRgb> light = light_of(*model);
    return keep_isolated_marks(light, band, parameters) ? std::move(light) : Image<LinearRgb>{};
}

namespace {

// Label of the part with most pixels at the image border; 0 if no part reaches it.
int part_at_border(const ConnectedComponents& parts) {
    PerComponent<int> border_pixels(parts.count());
    parts.for_each_border_pixel([&](int, int, int label) { ++border_pixels[label]; });
    const auto max = std::ranges::max_element(border_pixels);
    return max == border_pixels.end() || *max == 0 ? 0 : static_cast<int>(max - border_pixels.begin()) + 1;
}

// [y]: whether the row shows a soft shadow.
std::vector<bool> rows_with_soft_shadow(const cv::Mat3f& photo, const cv::Mat3f& plate,
                                        const BackgroundParameters::Shadow& parameters) {
    const cv::Mat1f ratio = log_ratio(photo, plate);
    const int dilation_px = 2 * parameters.edge_dilation_px + 1;
    cv::Mat1b edges = edges_of_log_ratio(ratio, parameters.edge_log_per_px), open;
    cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_ELLIPSE, {dilation_px, dilation_px}));
    cv::bitwise_not(edges, open);
    const ConnectedComponents parts(open, 4);
    const int background = part_at_border(parts);
    std::vector<bool> rows(static_cast<std::size_t>(ratio.rows));
    if (background == 0) return rows;
    for (int y = 0; y < ratio.rows; ++y) {
        int shadow_px = 0;
        for (int x = 0; x < ratio.cols; ++x) {
            shadow_px += parts.label(x, y) == background && ratio(y, x) < parameters.max_log_ratio ? 1 : 0;
        }
        rows[static_cast<std::size_t>(y)] = shadow_px > parameters.min_row_share * ratio.cols;
    }
    return rows;
}

}  // namespace

Image<std::uint8_t> shadow_free_rows(const ExposureNormalizedFrames& frames, ConstImageView<Rgba8> plate,
                                     const BackgroundParameters::Shadow& parameters) {
    const int width = frames.width(), height = frames.height();
    RS_CHECK(plate.width() == width && plate.height() == height);
    const cv::Mat3f background = smoothed_light(linear_mat(plate));
    std::vector<std::vector<bool>> has_shadow(frames.count());  // [frame][y]
    for_each_index(frames.count(), [&](std::size_t i) {
        Image<Rgba8> frame(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) frame(x, y) = frames.smooth(i, x, y);
        }
        has_shadow[i] = rows_with_soft_shadow(smoothed_light(linear_mat(frame)), background, parameters);
    });
    const double min_frames = parameters.min_frame_share * static_cast<double>(frames.count());
    for (int y = 0; y < height; ++y) {
        const auto row = static_cast<std::size_t>(y);
        const auto count = std::ranges::count_if(has_shadow, [&](const std::vector<bool>& rows) { return rows[row]; });
        if (static_cast<double>(count) < min_frames) continue;
        Image<std::uint8_t> shadow_free(width, height);
        const int end = std::max(0, y - static_cast<int>(parameters.fade_share * height));
        std::fill_n(shadow_free.data(), static_cast<std::ptrdiff_t>(end) * width, std::uint8_t{255});
        return shadow_free;
    }
    return {};
}

}  // namespace rs::capture
