#include "capture/calibration/patch_alignment.hpp"

#include "rayspace/conventions.hpp"

#include <tbb/parallel_for.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace rs::capture {
namespace {

constexpr int kHalf = kPatchSide_px / 2;
constexpr std::size_t kSamples = static_cast<std::size_t>(kPatchSide_px) * kPatchSide_px;
constexpr double kFarthest_rad = 0.75;  // from the reference view; beyond, a surface is seen too aslant
constexpr double kLeastCorrelation = 0.85;
constexpr double kFarthestMove_px = 3;  // from where the bundle expects the point
constexpr double kLeastDeviation = 3;   // of a patch's grey values; below, there is nothing to align
constexpr int kMostIterations = 12;

constexpr std::size_t kFewestSamples = 60;

struct Patch {
    std::array<float, kSamples> value;
    std::array<bool, kSamples> counts;  // on the object
};

// Grey, smoothed a little so that slopes mean something beside sensor noise and JPEG.
Image<float> smoothed(const Image<std::uint8_t>& grey) {
    constexpr std::array<float, 5> kKernel{0.03F, 0.235F, 0.47F, 0.235F, 0.03F};
    const int width = grey.width(), height = grey.height();
    Image<float> across(width, height), result(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int k = -2; k <= 2; ++k) {
                sum += kKernel[static_cast<std::size_t>(k + 2)] *
                       static_cast<float>(grey(std::clamp(x + k, 0, width - 1), y));
            }
            across(x, y) = sum;
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int k = -2; k <= 2; ++k) {
                sum += kKernel[static_cast<std::size_t>(k + 2)] * across(x, std::clamp(y + k, 0, height - 1));
            }
            result(x, y) = sum;
        }
    }
    return result;
}

// Bilinear; (x, y) in px with centres at +0.5, at least one pixel inside.
float sample(const Image<float>& picture, double x, double y) {
    const int left = static_cast<int>(std::floor(x - 0.5));
    const int top = static_cast<int>(std::floor(y - 0.5));
    const auto u = static_cast<float>(x - 0.5 - left);
    const auto v = static_cast<float>(y - 0.5 - top);
    const float upper = picture(left, top) * (1 - u) + picture(left + 1, top) * u;
    const float lower = picture(left, top + 1) * (1 - u) + picture(left + 1, top + 1) * u;
    return upper * (1 - v) + lower * v;
}

bool is_inside(const Image<std::uint8_t>& alpha, double x, double y) {
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    return column >= 2 && row >= 2 && column < alpha.width() - 2 && row < alpha.height() - 2 &&
           alpha(column, row) > 250;
}

// Patch pixel (i, j) of the reference is seen at centre + matrix * (i, j).
struct Warp {
    glm::dvec2 centre{0.0};
    glm::dmat2 matrix{1.0};
    [[nodiscard]] glm::dvec2 at(int i, int j) const { return centre + matrix * glm::dvec2(i, j); }
};

// The middle lies on the object; samples beside it do not count.
bool centre_is_inside(const Warp& warp, const Image<std::uint8_t>& alpha) {
    return is_inside(alpha, warp.centre.x, warp.centre.y);
}

Patch cut(const Image<float>& picture, const Image<std::uint8_t>& alpha, const Warp& warp) {
    Patch patch;
    std::size_t n = 0;
    for (int j = -kHalf; j <= kHalf; ++j) {
        for (int i = -kHalf; i <= kHalf; ++i, ++n) {
            const glm::dvec2 p = warp.at(i, j);
            patch.counts[n] = is_inside(alpha, p.x, p.y);
            patch.value[n] = patch.counts[n] ? sample(picture, p.x, p.y) : 0.0F;
        }
    }
    return patch;
}

// Over the samples that count in both.
struct Spread {
    std::size_t count = 0;
    double mean = 0;
    double deviation = 0;
};
Spread spread(const Patch& patch, const Patch& other) {
    Spread result;
    double sum = 0, squares = 0;
    for (std::size_t n = 0; n < kSamples; ++n) {
        if (!patch.counts[n] || !other.counts[n]) continue;
        const auto value = static_cast<double>(patch.value[n]);
        sum += value;
        squares += value * value;
        ++result.count;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, result.count));
    result.mean = sum / count;
    result.deviation = std::sqrt(std::max(0.0, squares / count - result.mean * result.mean));
    return result;
}

bool can_be_aligned(const Spread& spread) {
    return spread.count >= kFewestSamples && spread.deviation >= kLeastDeviation;
}

// Moves the warp until the picture shows the patch, up to gain and bias; the correlation reached, or nothing where it
// runs away.
std::optional<double> align(const Image<float>& picture, const Image<std::uint8_t>& alpha, const Patch& patch,
                            Warp& warp) {
    const Warp start = warp;
    double correlation = 0;
    for (int round = 0; round < kMostIterations; ++round) {
        if (!centre_is_inside(warp, alpha)) return std::nullopt;
        const Patch seen = cut(picture, alpha, warp);
        const Spread here = spread(seen, patch);
        const Spread wanted = spread(patch, seen);
        if (!can_be_aligned(here) || !can_be_aligned(wanted)) return std::nullopt;
        const double gain = here.deviation / wanted.deviation;
        Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
        Eigen::Matrix<double, 6, 1> right_side = Eigen::Matrix<double, 6, 1>::Zero();
        correlation = 0;
        std::size_t n = 0;
        for (int j = -kHalf; j <= kHalf; ++j) {
            for (int i = -kHalf; i <= kHalf; ++i, ++n) {
                if (!seen.counts[n] || !patch.counts[n]) continue;
                const glm::dvec2 p = warp.at(i, j);
                const double sx =
                    0.5 * static_cast<double>(sample(picture, p.x + 1, p.y) - sample(picture, p.x - 1, p.y));
                const double sy =
                    0.5 * static_cast<double>(sample(picture, p.x, p.y + 1) - sample(picture, p.x, p.y - 1));
                const double target = (static_cast<double>(patch.value[n]) - wanted.mean) * gain;
                const double value = static_cast<double>(seen.value[n]) - here.mean;
                correlation += target * value;
                Eigen::Matrix<double, 6, 1> slope;
                slope << sx, sy, sx * i, sx * j, sy * i, sy * j;
                normal += slope * slope.transpose();
                right_side += slope * (target - value);
            }
        }
        correlation /= static_cast<double>(here.count) * here.deviation * here.deviation;
        const Eigen::Matrix<double, 6, 1> step = normal.ldlt().solve(right_side);
        if (!step.allFinite()) return std::nullopt;
        warp.centre += glm::dvec2(step[0], step[1]);
        warp.matrix += glm::dmat2(step[2], step[4], step[3], step[5]);  // columns
        if (glm::distance(warp.centre, start.centre) > 2 * kFarthestMove_px) return std::nullopt;
        if (step.head<2>().norm() < 0.003 && step.tail<4>().norm() * kHalf < 0.01) break;
    }
    if (glm::distance(warp.centre, start.centre) > kFarthestMove_px) return std::nullopt;
    const glm::dmat2 change = warp.matrix - start.matrix;
    if (std::max(glm::length(change[0]), glm::length(change[1])) > 0.5) return std::nullopt;
    return correlation;
}

double nearest_turn(double angle_rad) {
    return std::remainder(angle_rad, 2 * kPi);
}

// Of a track, the view nearest to the middle of the arc it is seen from.
const Observation& reference_of(const TurntableModel& model, const Track& track) {
    glm::dvec2 sum(0.0);
    const auto angle = [&](const Observation& seen) { return model.angles_rad[static_cast<std::size_t>(seen.view)]; };
    for (const Observation& seen : track.seen) sum += glm::dvec2(std::cos(angle(seen)), std::sin(angle(seen)));
    const double middle = std::atan2(sum.y, sum.x);
    return *std::min_element(track.seen.begin(), track.seen.end(), [&](const Observation& a, const Observation& b) {
        return std::abs(nearest_turn(angle(a) - middle)) < std::abs(nearest_turn(angle(b) - middle));
    });
}

// A point with a plane through it that faces the reference camera: two vectors in it, each one (reduced) px long there.
struct Facet {
    Observation reference;
    glm::dvec3 point{0.0};
    glm::dvec3 along_x{0.0};
    glm::dvec3 along_y{0.0};
};

std::optional<Facet> facet_of(const Bundle& bundle, std::size_t i, int reduction) {
    const TurntableModel& model = bundle.model;
    Facet facet{reference_of(model, bundle.tracks[i]), bundle.points[i], {}, {}};
    const auto view = static_cast<std::size_t>(facet.reference.view);
    const Camera camera = object_camera(model, view);
    const double depth = glm::dot(facet.point - camera.centre(), camera.forward());
    if (depth <= 0) return std::nullopt;
    facet.along_x = camera.right() * (depth / camera.fl_x * reduction);
    facet.along_y = -camera.up() * (depth / camera.fl_x * reduction);
    return facet;
}

// Where the facet is expected in a view, px of the reduced pictures.
std::optional<Warp> expected(const TurntableModel& model, const Facet& facet, int view, int reduction) {
    const auto seen = [&](const glm::dvec3& p) { return residual(model, p, Observation{view, glm::dvec2(0.0)}); };
    const auto centre = seen(facet.point);
    const auto x = seen(facet.point + facet.along_x);
    const auto y = seen(facet.point + facet.along_y);
    if (!centre || !x || !y) return std::nullopt;
    const double scale = 1.0 / reduction;
    return Warp{*centre * scale, glm::dmat2((*x - *centre) * scale, (*y - *centre) * scale)};
}

}  // namespace

std::vector<Track> aligned_tracks(std::span<const CalibrationPicture> turn, int reduction, const Bundle& bundle) {
    const TurntableModel& model = bundle.model;
    const std::size_t points = bundle.points.size();
    std::vector<std::optional<Facet>> facets(points);
    for (std::size_t i = 0; i < points; ++i) facets[i] = facet_of(bundle, i, reduction);

    std::vector<Patch> patches(points);
    tbb::parallel_for(std::size_t{0}, turn.size(), [&](std::size_t view) {
        const Image<float> picture = smoothed(turn[view].grey);
        for (std::size_t i = 0; i < points; ++i) {
            if (!facets[i] || facets[i]->reference.view != static_cast<int>(view)) continue;
            const Warp warp{facets[i]->reference.p * (1.0 / reduction), glm::dmat2(1.0)};
            patches[i] = cut(picture, turn[view].alpha, warp);
            if (!can_be_aligned(spread(patches[i], patches[i]))) facets[i].reset();
        }
    });

    std::vector<std::vector<std::optional<glm::dvec2>>> found(turn.size());
    tbb::parallel_for(std::size_t{0}, turn.size(), [&](std::size_t view) {
        const Image<float> picture = smoothed(turn[view].grey);
        found[view].resize(points);
        for (std::size_t i = 0; i < points; ++i) {
            if (!facets[i]) continue;
            const auto reference = static_cast<std::size_t>(facets[i]->reference.view);
            if (reference == view) {
                found[view][i] = facets[i]->reference.p;
                continue;
            }
            const double apart = nearest_turn(model.angles_rad[view] - model.angles_rad[reference]);
            if (std::abs(apart) > kFarthest_rad) continue;
            auto warp = expected(model, *facets[i], static_cast<int>(view), reduction);
            if (!warp) continue;
            const auto correlation = align(picture, turn[view].alpha, patches[i], *warp);
            if (correlation && *correlation >= kLeastCorrelation)
                found[view][i] = warp->centre * static_cast<double>(reduction);
        }
    });

    std::vector<Track> tracks(points);
    for (std::size_t view = 0; view < turn.size(); ++view) {
        for (std::size_t i = 0; i < points; ++i) {
            if (found[view][i]) tracks[i].seen.push_back({static_cast<int>(view), *found[view][i]});
        }
    }
    for (std::size_t i = 0; i < points; ++i) {
        if (tracks[i].seen.size() >= 3) continue;
        tracks[i] = bundle.tracks[i];
        for (Observation& seen : tracks[i].seen) seen.weight = kDetectedWeight;
    }
    return tracks;
}

}  // namespace rs::capture
