#include "capture/calibration/silhouettes/silhouette_turn.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace rs::capture {
namespace {

constexpr std::size_t kFewestSilhouettes = 6;
constexpr int kMargin_px = 24;
constexpr float kHalfway = 0.5F;

struct Box {
    int left = 1 << 30, right = 0, top = 1 << 30, bottom = 0;
    [[nodiscard]] bool empty() const { return left >= right; }
    void include(int x, int y) {
        left = std::min(left, x);
        right = std::max(right, x + 1);
        top = std::min(top, y);
        bottom = std::max(bottom, y + 1);
    }
};

void include_solid(Box& box, const Image<std::uint8_t>& mask) {
    for (int y = 0; y < mask.height(); ++y) {
        for (int x = 0; x < mask.width(); ++x) {
            if (mask(x, y) >= 128) box.include(x, y);
        }
    }
}

// Mean coverage 0..1 of blocks of `reduction` px; blocks at the right and at the bottom may be cut.
Image<float> reduced(const Image<std::uint8_t>& mask, int reduction) {
    Image<float> small((mask.width() + reduction - 1) / reduction, (mask.height() + reduction - 1) / reduction);
    for (int y = 0; y < small.height(); ++y) {
        for (int x = 0; x < small.width(); ++x) {
            const int right = std::min((x + 1) * reduction, mask.width());
            const int bottom = std::min((y + 1) * reduction, mask.height());
            int sum = 0;
            int count = 0;
            for (int v = y * reduction; v < bottom; ++v) {
                for (int u = x * reduction; u < right; ++u, ++count) sum += mask(u, v);
            }
            small(x, y) = static_cast<float>(sum) / (255.0F * static_cast<float>(count));
        }
    }
    return small;
}

bool solid(float coverage) {
    return coverage >= kHalfway;
}

// True if the contour crosses the pixel, or runs along its border.
bool is_edge(ConstImageView<float> coverage, int x, int y) {
    const float c = coverage(x, y);
    if (c > 0.02F && c < 0.98F) return true;
    const auto differs = [&](int u, int v) {
        return u >= 0 && v >= 0 && u < coverage.width() && v < coverage.height() && solid(coverage(u, v)) != solid(c);
    };
    return differs(x - 1, y) || differs(x + 1, y) || differs(x, y - 1) || differs(x, y + 1);
}

// Distance to the nearest edge pixel plus the subpixel position of the contour in it, from its coverage.
Image<float> signed_distance(ConstImageView<float> coverage) {
    cv::Mat1b far_from_edge(coverage.height(), coverage.width());
    for (int y = 0; y < coverage.height(); ++y) {
        for (int x = 0; x < coverage.width(); ++x) far_from_edge(y, x) = is_edge(coverage, x, y) ? 0 : 255;
    }
    cv::Mat1f to_edge;
    cv::Mat1i nearest;
    cv::distanceTransform(far_from_edge, to_edge, nearest, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
    std::vector<float> within;  // [label] of edge pixels
    for (int y = 0; y < coverage.height(); ++y) {
        for (int x = 0; x < coverage.width(); ++x) {
            if (far_from_edge(y, x) != 0) continue;
            const auto label = static_cast<std::size_t>(nearest(y, x));
            if (label >= within.size()) within.resize(label + 1);
            within[label] = coverage(x, y) - kHalfway;
        }
    }
    Image<float> distance(coverage.width(), coverage.height());
    for (int y = 0; y < coverage.height(); ++y) {
        for (int x = 0; x < coverage.width(); ++x) {
            const float sign = solid(coverage(x, y)) ? 1.0F : -1.0F;
            distance(x, y) = sign * to_edge(y, x) + within[static_cast<std::size_t>(nearest(y, x))];
        }
    }
    return distance;
}

// Points where coverage crosses one half between neighbours, sorted by direction from the middle and thinned out
// evenly.
std::vector<glm::dvec2> edge_points(ConstImageView<float> coverage, const glm::dvec2& origin, std::size_t most) {
    std::vector<glm::dvec2> points;
    glm::dvec2 middle(0);
    const auto add_crossing = [&](int x, int y, int dx, int dy) {
        if (x + dx >= coverage.width() || y + dy >= coverage.height()) return;
        const float a = coverage(x, y);
        const float b = coverage(x + dx, y + dy);
        if (solid(a) == solid(b)) return;
        const double t = (kHalfway - a) / (b - a);
        points.push_back(origin + glm::dvec2(x + 0.5 + t * dx, y + 0.5 + t * dy));
        middle += points.back();
    };
    for (int y = 0; y < coverage.height(); ++y) {
        for (int x = 0; x < coverage.width(); ++x) {
            add_crossing(x, y, 1, 0);
            add_crossing(x, y, 0, 1);
        }
    }
    if (points.empty()) return points;
    middle /= static_cast<double>(points.size());
    std::stable_sort(points.begin(), points.end(), [&](const glm::dvec2& a, const glm::dvec2& b) {
        return std::atan2(a.y - middle.y, a.x - middle.x) < std::atan2(b.y - middle.y, b.x - middle.x);
    });
    const std::size_t kept = std::min(points.size(), most);
    for (std::size_t i = 0; i < kept; ++i) points[i] = points[i * points.size() / kept];
    points.resize(kept);
    return points;
}

std::string view_name(std::size_t i) {
    return "silhouettes: view " + std::to_string(i + 1);
}

}  // namespace

Result<SilhouetteTurn> SilhouetteTurn::create(std::span<const Image<std::uint8_t>> masks,
                                              const SilhouetteDetail& detail) {
    if (masks.size() < kFewestSilhouettes) {
        return Error{"silhouettes: " + std::to_string(masks.size()) + " views are too few; take at least " +
                     std::to_string(kFewestSilhouettes)};
    }
    Box whole;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        if (masks[i].width() != masks[0].width() || masks[i].height() != masks[0].height()) {
            return Error{view_name(i) + " differs in size from the first; all views must have one size"};
        }
        Box box;
        include_solid(box, masks[i]);
        if (box.empty()) return Error{view_name(i) + " shows no object; check its mask"};
        whole.include(box.left, box.top);
        whole.include(box.right - 1, box.bottom - 1);
    }

    SilhouetteTurn turn;
    const int side = std::max(whole.right - whole.left, whole.bottom - whole.top);
    turn.reduction_ = std::max(1, (side + detail.box_px / 2) / detail.box_px);
    const int n = turn.reduction_;
    turn.open_[0] = whole.left <= 1;
    turn.open_[1] = whole.right >= masks[0].width() - 1;
    turn.open_[2] = whole.top <= 1;
    turn.open_[3] = whole.bottom >= masks[0].height() - 1;
    turn.box_low_ = glm::dvec2(whole.left, whole.top) / static_cast<double>(n);
    turn.box_high_ = glm::dvec2(whole.right, whole.bottom) / static_cast<double>(n);

    turn.edges_.resize(masks.size());
    std::vector<std::optional<DistanceField>> distances(masks.size());
    std::vector<Status> found(masks.size());
    const int left = std::max(0, whole.left / n - kMargin_px);
    const int top = std::max(0, whole.top / n - kMargin_px);
    turn.origin_ = glm::vec2(left, top);
    for_each_index(masks.size(), [&](std::size_t i) {
        const Image<float> coverage = reduced(masks[i], n);
        const int right = std::min(coverage.width(), whole.right / n + 1 + kMargin_px);
        const int bottom = std::min(coverage.height(), whole.bottom / n + 1 + kMargin_px);
        const ConstImageView<float> part = coverage.view().crop(left, top, right - left, bottom - top);
        turn.edges_[i] = edge_points(part, {left, top}, detail.edges_per_view);
        if (part.width() < 2 || part.height() < 2 || turn.edges_[i].size() < kFewestSilhouettes) {
            found[i] = Error{view_name(i) + " has hardly any contour; check its mask"};
            return;
        }
        try {
            distances[i].emplace(signed_distance(part).view());
        } catch (const cv::Exception& problem) {
            found[i] = Error{view_name(i) + ": " + problem.err};
        }
    });
    for (std::size_t i = 0; i < masks.size(); ++i) {
        if (!found[i]) return found[i].error();
        turn.distances_.push_back(*std::move(distances[i]));
    }
    return turn;
}

}  // namespace rs::capture
