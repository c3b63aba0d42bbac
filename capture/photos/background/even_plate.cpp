#include "capture/photos/background/even_plate.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/light_share.hpp"
#include "rayspace/base/check.hpp"
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
using Codes = cv::Vec3d;
using Matrix = cv::Matx<double, kTerms, kTerms>;
using Along = cv::Matx<double, kTerms, 3>;

// Of the shorter side. Farther inside, what hardly moves may be the object in some of the pictures.
constexpr double kBand = 0.15;
constexpr double kEnoughSeen = 0.3;    // of the band on each of the four sides
constexpr double kEnoughOfRow = 0.04;  // of a row; others lie between their neighbours
constexpr double kFits_codes = 3;      // so near the course is ...
constexpr double kFittingShare = 0.8;  // ... most of the band; a shadow may reach it
constexpr int kRounds = 4;             // of what is near; for each, twice as near
constexpr double kMostSlope = 0.07;    // of a horizon, where the camera is rolled

int band_px_of(int width, int height) {
    return std::max(1, static_cast<int>(kBand * std::min(width, height)));
}

// Where the backdrop surely is seen.
bool in_border_band(int x, int y, int width, int height) {
    const int band_px = band_px_of(width, height);
    return x < band_px || y < band_px || x >= width - band_px || y >= height - band_px;
}

// Without a constant, which is the row's.
Terms terms_at(int x, int y, int width, int height) {
    const double u = (2 * x + 1.0) / width - 1, v = (2 * y + 1.0) / height - 1;
    return {u, u * u, u * v, u * u * v, u * v * v, u * u * v * v};
}

Codes codes_of(const Rgba8& p) {
    return {static_cast<double>(p.r), static_cast<double>(p.g), static_cast<double>(p.b)};
}

Codes logarithms_of(const Rgba8& p) {
    return {std::log(p.r + 1.0), std::log(p.g + 1.0), std::log(p.b + 1.0)};
}

bool is_near(const Codes& a, const Codes& b, double codes) {
    const Codes off = a - b;
    return std::max({std::abs(off(0)), std::abs(off(1)), std::abs(off(2))}) <= codes;
}

// Rows of a camera that is rolled: y of the picture's middle column.
class Rows {
public:
    Rows(int width, int height, double slope)
        : width_(width),
          middle_((width - 1) / 2.0),
          slope_(slope),
          margin_(static_cast<int>(std::ceil(std::abs(slope) * middle_)) + 1),
          count_(height + 2 * margin_) {}
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int count() const { return count_; }
    // Of a pixel, between two rows; at least 0 and below count() - 1.
    [[nodiscard]] double at(int x, int y) const { return y + slope_ * (x - middle_) + margin_; }
    // The pixel of a column that is nearest to a row; it may lie outside of the picture.
    [[nodiscard]] int y_of(int row, int x) const {
        return static_cast<int>(std::floor(row - margin_ - slope_ * (x - middle_) + 0.5));
    }

private:
    int width_;
    double middle_, slope_;
    int margin_, count_;
};

// Logarithms of codes, for light that falls off multiplies what another lamp leaves.
struct Course {
    Rows rows;
    int height = 0;
    std::vector<Codes> of_row;
    Along along;

    [[nodiscard]] Codes at(int x, int y) const {
        const cv::Matx<double, 1, 3> a = terms_at(x, y, rows.width(), height).t() * along;
        const double row = rows.at(x, y);
        const auto above = static_cast<std::size_t>(row);
        const double share = row - std::floor(row);
        const Codes own = of_row[above] * (1 - share) + of_row[above + 1] * share;
        return {std::exp(own(0) + a(0)) - 1, std::exp(own(1) + a(1)) - 1, std::exp(own(2) + a(2)) - 1};
    }
};

// What a row has for a fit, about its own means.
struct RowFit {
    std::ptrdiff_t seen = 0, count = 0;  // px of the band; those of them that take part
    Terms terms;                         // means
    Codes logarithms;                    // means
    Matrix normal = Matrix::zeros();
    Along right_side = Along::zeros();
};

// Calls visit(x, y) for what is seen of a row in the band.
template <class Visit>
void for_seen(ConstImageView<std::uint8_t> untouched, const Rows& rows, int row, Visit visit) {
    const int width = untouched.width(), height = untouched.height();
    for (int x = 0; x < width; ++x) {
        const int y = rows.y_of(row, x);
        if (y >= 0 && y < height && untouched(x, y) != 0 && in_border_band(x, y, width, height)) visit(x, y);
    }
}

template <class TakesPart>
RowFit row_fit(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched, const Rows& rows, int row,
               TakesPart takes_part) {
    RowFit fit;
    for_seen(untouched, rows, row, [&](int x, int y) {
        fit.seen += 1;
        if (!takes_part(x, y)) return;
        const Terms terms = terms_at(x, y, plate.width(), plate.height());
        const Codes logarithms = logarithms_of(plate(x, y));
        fit.count += 1;
        fit.terms += terms;
        fit.logarithms += logarithms;
        fit.normal += terms * terms.t();
        fit.right_side += terms * logarithms.t();
    });
    if (fit.count == 0) return fit;
    const auto count = static_cast<double>(fit.count);
    fit.terms *= 1 / count;
    fit.logarithms *= 1 / count;
    fit.normal -= count * (fit.terms * fit.terms.t());
    fit.right_side -= count * (fit.terms * fit.logarithms.t());
    return fit;
}

// What a course has of each row that is seen enough; others lie evenly between those beside them. Nothing where no row
// is seen.
std::optional<std::vector<Codes>> filled(const std::vector<std::optional<Codes>>& seen_rows) {
    std::vector<std::size_t> seen;
    for (std::size_t row = 0; row < seen_rows.size(); ++row) {
        if (seen_rows[row]) seen.push_back(row);
    }
    if (seen.empty()) return std::nullopt;
    std::vector<Codes> rows(seen_rows.size(), *seen_rows[seen.front()]);
    std::fill(rows.begin() + static_cast<std::ptrdiff_t>(seen.back()), rows.end(), *seen_rows[seen.back()]);
    for (std::size_t i = 1; i < seen.size(); ++i) {
        const std::size_t from = seen[i - 1], to = seen[i];
        for (std::size_t row = from; row < to; ++row) {
            const double share = static_cast<double>(row - from) / static_cast<double>(to - from);
            rows[row] = *seen_rows[from] * (1 - share) + *seen_rows[to] * share;
        }
    }
    return rows;
}

// Every row at the median of what the band shows of it, which a mark does not move.
std::optional<Course> median_course(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched,
                                    const Rows& rows) {
    std::vector<std::optional<Codes>> medians(static_cast<std::size_t>(rows.count()));
    for_each_index(rows.count(), [&](int row) {
        std::array<std::vector<double>, 3> logarithms;  // [channel]
        for_seen(untouched, rows, row, [&](int x, int y) {
            const Codes of_pixel = logarithms_of(plate(x, y));
            for (int c = 0; c < 3; ++c) logarithms[static_cast<std::size_t>(c)].push_back(of_pixel(c));
        });
        if (static_cast<double>(logarithms[0].size()) < kEnoughOfRow * plate.width()) return;
        medians[static_cast<std::size_t>(row)] =
            Codes(median(std::move(logarithms[0])), median(std::move(logarithms[1])), median(std::move(logarithms[2])));
    });
    std::optional<std::vector<Codes>> of_row = filled(medians);
    if (!of_row) return std::nullopt;
    return Course{rows, plate.height(), *std::move(of_row), Along::zeros()};
}

std::optional<Course> fitted(const std::vector<RowFit>& sums, const Rows& rows, int height) {
    Matrix normal = Matrix::zeros();
    Along right_side = Along::zeros();
    for (const RowFit& row : sums) {
        normal += row.normal;
        right_side += row.right_side;
    }
    const Along along = normal.solve(right_side, cv::DECOMP_SVD);
    std::vector<std::optional<Codes>> own(sums.size());
    for (std::size_t row = 0; row < sums.size(); ++row) {
        if (static_cast<double>(sums[row].count) < kEnoughOfRow * rows.width()) continue;
        const cv::Matx<double, 1, 3> a = sums[row].terms.t() * along;
        own[row] = sums[row].logarithms - Codes(a(0), a(1), a(2));
    }
    std::optional<std::vector<Codes>> of_row = filled(own);
    if (!of_row) return std::nullopt;
    return Course{rows, height, *std::move(of_row), along};
}

// How the mean of a band at the picture's left or right goes over from row to row; nothing where it is not seen.
std::vector<std::optional<double>> steps_down(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched,
                                              int from_x, int to_x) {
    constexpr int kApart_px = 4;
    std::vector<std::optional<double>> means(static_cast<std::size_t>(plate.height()));
    for (int y = 0; y < plate.height(); ++y) {
        double sum = 0;
        int count = 0;
        for (int x = from_x; x < to_x; ++x) {
            if (untouched(x, y) == 0) continue;
            const Codes logarithms = logarithms_of(plate(x, y));
            sum += logarithms(0) + logarithms(1) + logarithms(2);
            ++count;
        }
        if (2 * count >= to_x - from_x) means[static_cast<std::size_t>(y)] = sum / count;
    }
    std::vector<std::optional<double>> steps(means.size());
    for (std::size_t y = kApart_px; y < means.size(); ++y) {
        if (means[y] && means[y - kApart_px]) steps[y] = *means[y] - *means[y - kApart_px];
    }
    return steps;
}

// Of the horizon, by what the left and the right of the picture show: down by so many px per px to the left.
double slope_of(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched) {
    constexpr double kClearly = 0.5;  // so much less must be left of what a level horizon leaves
    const int width = plate.width(), height = plate.height(), band_px = std::max(1, band_px_of(width, height) / 2);
    const auto left = steps_down(plate, untouched, 0, band_px);
    const auto right = steps_down(plate, untouched, width - band_px, width);
    const int apart_px = width - band_px;
    if (apart_px <= 0) return 0;
    const auto left_over = [&](int shift) -> std::optional<double> {
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
    const std::optional<double> level = left_over(0);
    if (!level) return 0;
    double least = kClearly * *level;
    int best = 0;
    const int most = static_cast<int>(kMostSlope * apart_px);
    for (int shift = -most; shift <= most; ++shift) {
        const std::optional<double> left_there = left_over(shift);
        if (!left_there || *left_there >= least) continue;
        least = *left_there;
        best = shift;
    }
    return -static_cast<double>(best) / apart_px;
}

bool all_sides_seen(ConstImageView<std::uint8_t> untouched) {
    const int band_px = band_px_of(untouched.width(), untouched.height());
    const cv::Mat1b seen = mat_over(untouched);
    const std::array sides{seen.rowRange(0, band_px), seen.rowRange(seen.rows - band_px, seen.rows),
                           seen.colRange(0, band_px), seen.colRange(seen.cols - band_px, seen.cols)};
    return std::ranges::all_of(sides, [](const cv::Mat& side) {
        return cv::countNonZero(side) >= kEnoughSeen * static_cast<double>(side.total());
    });
}

Image<LinearRgb> light_of(const Course& course) {
    Image<LinearRgb> light(course.rows.width(), course.height);
    for_each_index(course.height, [&](int y) {
        for (int x = 0; x < light.width(); ++x) {
            const Codes codes = course.at(x, y);
            const auto linear = [](double code) {
                return linear_from_srgb(static_cast<float>(std::clamp(code / 255, 0.0, 1.0)));
            };
            light(x, y) = {linear(codes(0)), linear(codes(1)), linear(codes(2))};
        }
    });
    return light;
}

// What is seen of other things than the course; 255 or 0.
struct Others {
    cv::Mat1b differ;  // that looks otherwise ...
    cv::Mat1b clear;   // ... and is no shadow on it, for a soft one has no edges
};

Others others_of(const Image<LinearRgb>& course, ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched) {
    constexpr float kVisible_delta_e = 2.5F, kNoShadow_delta_e = 6, kDeepestOnCourse = 0.25F;
    const cv::Mat1b edges =
        edges_of_share(log_light_share(smoothed_light(linear_mat(plate)), smoothed_light(light_mat(course))));
    Others others{cv::Mat1b(edges.size(), std::uint8_t{0}), cv::Mat1b(edges.size(), std::uint8_t{0})};
    for_each_index(course.height(), [&](int y) {
        for (int x = 0; x < course.width(); ++x) {
            if (untouched(x, y) == 0) continue;
            const Explanation e = explain_by_backdrop(linear_rgb(plate(x, y)), course(x, y), kDeepestOnCourse, 1);
            if (e.plain <= kVisible_delta_e) continue;
            others.differ(y, x) = 255;
            others.clear(y, x) = edges(y, x) != 0 || e.shaded > kNoShadow_delta_e ? 255 : 0;
        }
    });
    return others;
}

// Other things stay as they are where they stand alone, as a mark on the wall or a cable. False where there are many,
// and where one hangs together with what the object sweeps, for it may go on behind the object, as a turntable does.
bool keep_marks(Image<LinearRgb>& course, ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched) {
    // Of the picture. Measured at the object: studios 0, with steep shadows up to 0.0015; turntables 0.0012 to 0.02.
    constexpr double kAtObject = 0.002, kElsewhere = 0.05, kSwept = 0.01;
    constexpr int kRim_px = 4;  // the region swept ends where a grid's cell does
    const Others others = others_of(course, plate, untouched);
    cv::Mat1b swept, beside, both;
    cv::bitwise_not(mat_over(untouched), swept);
    cv::dilate(swept, beside, cv::getStructuringElement(cv::MORPH_RECT, {2 * kRim_px + 1, 2 * kRim_px + 1}));
    cv::bitwise_or(others.differ, swept, both);
    const ConnectedParts parts(both, 8);
    struct Tally {
        int swept = 0, clear = 0;  // px
    };
    const auto tallies = parts.tallied<Tally>([&](int x, int y, Tally& tally) {
        tally.swept += swept(y, x) != 0 ? 1 : 0;
        tally.clear += others.clear(y, x) != 0 && beside(y, x) == 0 ? 1 : 0;
    });
    const auto picture = static_cast<double>(both.total());
    const auto is_at_object = [&](const Tally& tally) { return tally.swept >= kSwept * picture; };
    int at_object = 0, elsewhere = 0;  // px
    for (const Tally& tally : tallies) (is_at_object(tally) ? at_object : elsewhere) += tally.clear;
    if (at_object > kAtObject * picture || elsewhere > kElsewhere * picture) return false;
    parts.for_each_pixel([&](int x, int y, int label) {
        const bool is_mark = others.differ(y, x) != 0 && !is_at_object(tallies[label]);
        if (is_mark) course(x, y) = linear_rgb(plate(x, y));
    });
    return true;
}

}  // namespace

Image<LinearRgb> even_plate(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched) {
    RS_CHECK(plate.width() == untouched.width() && plate.height() == untouched.height());
    const int width = plate.width(), height = plate.height();
    if (width == 0 || height == 0) return {};
    if (!all_sides_seen(untouched)) return {};
    const Rows rows(width, height, slope_of(plate, untouched));
    std::optional<Course> course = median_course(plate, untouched, rows);
    std::vector<RowFit> sums(static_cast<std::size_t>(rows.count()));
    for (int round = 0; course && round <= kRounds; ++round) {  // the last only looks whether it fits
        const double near_codes = std::ldexp(kFits_codes, kRounds - round);
        const auto takes_part = [&](int x, int y) {
            return is_near(course->at(x, y), codes_of(plate(x, y)), near_codes);
        };
        for_each_index(rows.count(), [&](int row) {
            sums[static_cast<std::size_t>(row)] = row_fit(plate, untouched, rows, row, takes_part);
        });
        if (round < kRounds) course = fitted(sums, rows, height);
    }
    if (!course) return {};
    std::ptrdiff_t seen = 0, fits = 0;  // px
    for (const RowFit& row : sums) {
        seen += row.seen;
        fits += row.count;
    }
    if (static_cast<double>(fits) < kFittingShare * static_cast<double>(seen)) return {};
    Image<LinearRgb> light = light_of(*course);
    return keep_marks(light, plate, untouched) ? std::move(light) : Image<LinearRgb>{};
}

}  // namespace rs::capture
