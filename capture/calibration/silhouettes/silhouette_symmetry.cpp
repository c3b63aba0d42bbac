#include "capture/calibration/silhouettes/silhouette_symmetry.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kFewestRows = 40;
constexpr double kMostRows = 600;   // more are redundant with their neighbours
constexpr double kWidestGap = 0.1;  // of the turn
constexpr std::size_t kBands = 12;  // of height: rows of one band show the same edges
constexpr double kLeastScatter_px = 0.1;
constexpr int kRounds = 20;
constexpr int kMoves = 3;
constexpr double kBelievedApart = 2;  // deviations of the silhouettes
constexpr double kHalfCover = 127.5;

// Edges of one row of the image rectified about the axis.
struct RimRow {
    double v = 0;
    double left = 0;  // u
    double right = 0;
    double weight = 0;
};

glm::dvec3 direction(double u, double v) {
    return {u, v, -1};
}

// Extent of the covered region in u and v.
struct Extent {
    double least_v = std::numeric_limits<double>::infinity();
    double most_v = -std::numeric_limits<double>::infinity();
    double most_u = 0;  // largest |u|

    void include(const glm::dvec3& ray) {
        if (!(ray.z < -1e-3)) return;
        least_v = std::min(least_v, ray.y / -ray.z);
        most_v = std::max(most_v, ray.y / -ray.z);
        most_u = std::max(most_u, std::abs(ray.x / ray.z));
    }
};

Extent extent_of(ConstImageView<std::uint8_t> covered, int reduction, const TurntableModel& model) {
    Extent extent;
    const auto include = [&](int x, int y) {
        const glm::dvec2 p = static_cast<double>(reduction) * glm::dvec2(x + 0.5, y + 0.5);
        if (const auto ray = table_ray(model.lens, model.pose, p)) extent.include(*ray);
    };
    for (int y = 0; y < covered.height(); ++y) {
        int first = 0, last = covered.width() - 1;
        while (first <= last && covered(first, y) < kHalfCover) ++first;
        while (last > first && covered(last, y) < kHalfCover) --last;
        if (first > last) continue;
        include(first, y);
        include(last, y);
    }
    return extent;
}

// Covered region along the rays of one row; nothing is covered outside the image.
class Row {
public:
    Row(ConstImageView<std::uint8_t> covered, int reduction, const TurntableModel& model, double v)
        : covered_(covered), reduction_(reduction), model_(model), v_(v) {}

    // The first crossing into the covered region from u = `from` towards -from, in steps of `step` > 0; nothing if the
    // image ends there.
    [[nodiscard]] std::optional<double> rim(double from, double step) const {
        const double towards = from > 0 ? -step : step;
        std::optional<double> before = at(from);
        for (double u = from + towards; u * from > -from * from; u += towards) {
            const std::optional<double> here = at(u);
            if (here && *here >= kHalfCover) {
                if (!before) return std::nullopt;
                return u - towards * (*here - kHalfCover) / (*here - *before);
            }
            before = here;
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] std::optional<double> at(double u) const {
        const auto p = project(model_.lens, model_.pose, glm::dvec3(0, 0, 1) + direction(u, v_));
        if (!p) return std::nullopt;
        const double x = p->x / reduction_ - 0.5, y = p->y / reduction_ - 0.5;
        if (!(x >= 0 && y >= 0 && x < covered_.width() - 1 && y < covered_.height() - 1)) return std::nullopt;
        const int left = static_cast<int>(x), top = static_cast<int>(y);
        const double s = x - left, t = y - top;
        return (1 - t) * ((1 - s) * covered_(left, top) + s * covered_(left + 1, top)) +
               t * ((1 - s) * covered_(left, top + 1) + s * covered_(left + 1, top + 1));
    }

    ConstImageView<std::uint8_t> covered_;
    double reduction_;
    const TurntableModel& model_;
    double v_;
};

// Weights rows by the slope of their edge: the less upright an edge, the less accurate its position in the row.
void weight_rows(std::vector<RimRow>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RimRow& above = rows[i > 0 ? i - 1 : i];
        const RimRow& below = rows[i + 1 < rows.size() ? i + 1 : i];
        const double slope = 0.5 * ((above.right - above.left) - (below.right - below.left)) / (above.v - below.v);
        rows[i].weight = 1 / (1 + slope * slope);
    }
}

double weighted_median(std::vector<std::pair<double, double>> value_and_weight) {
    std::sort(value_and_weight.begin(), value_and_weight.end());
    double half = 0;
    for (const auto& each : value_and_weight) half += 0.5 * each.second;
    for (const auto& [value, weight] : value_and_weight) {
        half -= weight;
        if (half <= 0) return value;
    }
    return value_and_weight.back().first;
}

struct Offset {
    double u = 0;
    double deviation = 0;
};

// Robust mean (Cauchy) of the rows' offsets, and its deviation from the sums over bands of rows (the "sandwich").
Offset robust_offset(const std::vector<RimRow>& rows, double least_scatter) {
    std::vector<std::pair<double, double>> offsets, sizes;
    for (const RimRow& row : rows) offsets.emplace_back(0.5 * (row.left + row.right), row.weight);
    double mean = weighted_median(offsets);
    for (const auto& [offset, weight] : offsets) sizes.emplace_back(std::abs(offset - mean), weight);
    const double scale = std::max(least_scatter, 1.4826 * weighted_median(sizes));
    const auto trust = [&](double off) { return 1 / (1 + off * off / (scale * scale)); };
    for (int round = 0; round < kRounds; ++round) {
        double sum = 0, weights = 0;
        for (const auto& [offset, weight] : offsets) {
            const double w = weight * trust(offset - mean);
            sum += w * offset;
            weights += w;
        }
        mean = sum / weights;
    }
    std::vector<double> scores(kBands, 0);
    double slope = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const auto& [offset, weight] = offsets[i];
        const double off = offset - mean, w = trust(off);
        scores[i * kBands / offsets.size()] += weight * w * off;
        slope += weight * w * w * (1 - off * off / (scale * scale));  // derivative of the score
    }
    double sum2 = 0;
    for (const double score : scores) sum2 += score * score;
    const double few = static_cast<double>(kBands) / (kBands - 1);
    return {mean, slope > 0 ? std::sqrt(few * sum2) / slope : std::numeric_limits<double>::infinity()};
}

// Angles between neighbouring views around the turn, [gap].
std::vector<double> gaps(const std::vector<double>& angles_rad) {
    std::vector<double> around;
    for (const double angle : angles_rad) around.push_back(angle - 2 * kPi * std::floor(angle / (2 * kPi)));
    std::sort(around.begin(), around.end());
    std::vector<double> result;
    for (std::size_t i = 1; i < around.size(); ++i) result.push_back(around[i] - around[i - 1]);
    result.push_back(around.front() + 2 * kPi - around.back());
    return result;
}

// An edge at radius 1 that comes within angle d of the silhouette in the nearest view loses d^2 / 2. Returns the
// deviation of half the difference of both sides' losses if all rows show the same edge at a random angle.
double missed_rim_deviation(const std::vector<double>& gaps_rad) {
    double mean2 = 0, mean4 = 0;
    for (const double gap : gaps_rad) {
        const double share = gap / (2 * kPi), half = 0.5 * gap;
        mean2 += share * half * half / 3;
        mean4 += share * half * half * half * half / 5;
    }
    return 0.5 * std::sqrt(0.5 * std::max(0.0, mean4 - mean2 * mean2));
}

// Measurement of the edges for one model.
struct RimMeasurement {
    Offset offset;
    double v = 0;       // the middle of the rows
    double radius = 0;  // weighted mean, in u
};

std::optional<RimMeasurement> measure_rims(ConstImageView<std::uint8_t> covered, int reduction,
                                           const TurntableModel& model) {
    const Extent extent = extent_of(covered, reduction, model);
    if (!(extent.most_u > 0) || !(extent.most_u < 10)) return std::nullopt;
    const double pixel = reduction / model.lens.f_px;  // in u and v
    const double from = extent.most_u + 4 * pixel;
    const double step = std::max(pixel, (extent.most_v - extent.least_v) / kMostRows);
    std::vector<RimRow> rows;
    for (double v = extent.most_v - 0.5 * step; v > extent.least_v; v -= step) {
        const Row row(covered, reduction, model, v);
        const auto left = row.rim(-from, pixel), right = row.rim(from, pixel);
        if (left && right && *left < *right) rows.push_back({v, *left, *right, 0});
    }
    if (rows.size() < kFewestRows) return std::nullopt;
    weight_rows(rows);
    RimMeasurement rims{robust_offset(rows, kLeastScatter_px * pixel)};
    double weights = 0;
    for (const RimRow& row : rows) {
        weights += row.weight;
        rims.v += row.weight * row.v;
        rims.radius += row.weight * 0.5 * (row.right - row.left);
    }
    rims.v /= weights;
    rims.radius /= weights;
    return rims;
}

// The model with its axis moved by u to the side.
TurntableModel shift_axis(TurntableModel model, double u) {
    model.pose.pan_rad -= std::atan(u);
    return model;
}

}  // namespace

Image<std::uint8_t> union_of_alphas(std::span<const CalibrationImage> images) {
    Image<std::uint8_t> covered = images.front().alpha;
    for (const CalibrationImage& image : images.subspan(1)) {
        for (int y = 0; y < covered.height(); ++y) {
            for (int x = 0; x < covered.width(); ++x) covered(x, y) = std::max(covered(x, y), image.alpha(x, y));
        }
    }
    return covered;
}

std::optional<AxisPosition> axis_from_silhouettes(ConstImageView<std::uint8_t> covered, int reduction,
                                                  const TurntableModel& start) {
    const std::vector<double> gaps_rad = gaps(start.angles_rad);
    if (*std::max_element(gaps_rad.begin(), gaps_rad.end()) > kWidestGap * 2 * kPi) return std::nullopt;
    // For a camera that looks down, an axis at a wrong position also seems inclined, so the measurement is repeated
    // after moving it.
    TurntableModel model = start;
    std::optional<RimMeasurement> rims;
    for (int round = 0; round < kMoves; ++round) {
        rims = measure_rims(covered, reduction, model);
        if (!rims) return std::nullopt;
        model = shift_axis(std::move(model), rims->offset.u);
    }
    const glm::dvec3 middle = camera_rotation(model.pose) * direction(0, rims->v);
    if (!(middle.z < -1e-3)) return std::nullopt;
    const Lens& lens = model.lens;
    AxisPosition place;
    place.at_px = has_sideways_axis(model.pose) ? lens.cx - lens.f_px * middle.x / middle.z
                                                : lens.cy + lens.f_px * middle.y / middle.z;
    const double deviation = std::hypot(rims->offset.deviation, missed_rim_deviation(gaps_rad) * rims->radius);
    const auto here = axis_position(lens, model.pose, place.at_px);
    const auto beside = axis_position(lens, shift_axis(model, deviation).pose, place.at_px);
    if (!here || !beside || !std::isfinite(deviation)) return std::nullopt;
    place.position_px = *here;
    place.deviation_px = std::abs(*beside - *here);
    return place;
}

AxisPosition combine_axes(const AxisPosition& of_tracks, const AxisPosition& of_silhouettes) {
    const double apart = of_silhouettes.position_px - of_tracks.position_px;
    const double silhouettes2 = of_silhouettes.deviation_px * of_silhouettes.deviation_px;
    const double stated2 = of_tracks.deviation_px * of_tracks.deviation_px;
    const double tracks2 = std::max(stated2, apart * apart - kBelievedApart * kBelievedApart * silhouettes2);
    const double sum = tracks2 + silhouettes2;
    if (!(sum > 0)) return of_tracks;
    return {of_tracks.at_px, of_tracks.position_px + apart * tracks2 / sum, std::sqrt(tracks2 * silhouettes2 / sum)};
}

std::optional<TurntableModel> move_axis_to(TurntableModel model, const AxisPosition& place) {
    constexpr double kStep_rad = 1e-5;
    for (int round = 0; round < 10; ++round) {
        CameraPose beside = model.pose;
        beside.pan_rad += kStep_rad;
        const auto here = axis_position(model.lens, model.pose, place.at_px);
        const auto there = axis_position(model.lens, beside, place.at_px);
        if (!here || !there || *here == *there) return std::nullopt;
        const double off = place.position_px - *here;
        if (std::abs(off) < 1e-6) return model;
        model.pose.pan_rad += off * kStep_rad / (*there - *here);
    }
    return std::nullopt;
}

}  // namespace rs::capture
