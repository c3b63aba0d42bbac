#include "capture/photos/matte/contrast_cut.hpp"

#include "capture/photos/matte/object_mask.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kNoNode = -1;

// Half of the 8-neighbourhood, so that every pair is met once.
constexpr std::pair<int, int> kNeighbours[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

}  // namespace

Image<std::uint8_t> cut_by_contrast(ConstImageView<Lab> looks, ConstImageView<float> preference,
                                    const CutOptions& options) {
    RS_CHECK(looks.width() == preference.width() && looks.height() == preference.height());
    const int width = looks.width();
    const int height = looks.height();
    Image<int> node(width, height, kNoNode);
    int nodes = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (std::abs(preference(x, y)) < kDecided) node(x, y) = nodes++;
        }
    }
    Image<std::uint8_t> object(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) object(x, y) = preference(x, y) >= kDecided ? 255 : 0;
    }
    if (nodes == 0) return object;

    // A decided neighbour is a terminal: parting from it costs the same as parting from an undecided one.
    std::vector<float> to_object(static_cast<std::size_t>(nodes), 0.0F);
    std::vector<float> to_backdrop(static_cast<std::size_t>(nodes), 0.0F);
    cv::detail::GCGraph<float> graph(static_cast<unsigned>(nodes) + 2, static_cast<unsigned>(nodes) * 8 + 2);
    for (int i = 0; i < nodes; ++i) graph.addVtx();
    // GCGraph refuses to be without edges, as it would be where no two undecided pixels touch.
    const int spare = graph.addVtx();
    graph.addEdges(spare, graph.addVtx(), 0, 0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (const auto& [dx, dy] : kNeighbours) {
                const int u = x + dx;
                const int v = y + dy;
                if (u < 0 || u >= width || v >= height) continue;
                const int a = node(x, y);
                const int b = node(u, v);
                if (a == kNoNode && b == kNoNode) continue;
                const float contrast = delta_e(looks(x, y), looks(u, v)) / options.contrast_delta_e;
                const float length = dx != 0 && dy != 0 ? 0.70710678F : 1.0F;
                const float cost =
                    length * (options.floor + options.smoothness * std::exp(-0.5F * contrast * contrast));
                if (a != kNoNode && b != kNoNode) {
                    graph.addEdges(a, b, cost, cost);
                } else {
                    const int undecided = a != kNoNode ? a : b;
                    const bool decided_object = (a == kNoNode ? object(x, y) : object(u, v)) != 0;
                    (decided_object ? to_object : to_backdrop)[static_cast<std::size_t>(undecided)] += cost;
                }
            }
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int i = node(x, y);
            if (i == kNoNode) continue;
            const float own = preference(x, y);
            graph.addTermWeights(i, to_object[static_cast<std::size_t>(i)] + std::max(0.0F, own),
                                 to_backdrop[static_cast<std::size_t>(i)] + std::max(0.0F, -own));
        }
    }
    graph.maxFlow();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int i = node(x, y);
            if (i != kNoNode) object(x, y) = graph.inSourceSegment(i) ? 255 : 0;
        }
    }
    return object;
}

namespace {

constexpr float kClearly = 1;

std::ptrdiff_t undecided_in(ConstImageView<float> preference) {
    std::ptrdiff_t count = 0;
    for (int y = 0; y < preference.height(); ++y) {
        count += std::count_if(preference.row(y), preference.row(y) + preference.width(),
                               [](float own) { return std::abs(own) < kDecided; });
    }
    return count;
}

struct HalfSize {
    Image<Lab> looks;
    Image<float> preference;
};

// Means of 2 x 2 pixels. A pixel is decided where all four are and agree. Twice the mean preference: areas shrink to a
// quarter, borders to half.
HalfSize half_size(ConstImageView<Lab> looks, ConstImageView<float> preference) {
    const int width = (looks.width() + 1) / 2, height = (looks.height() + 1) / 2;
    HalfSize half{Image<Lab>(width, height), Image<float>(width, height)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Lab sum;
            float own = 0, least = kDecided, most = -kDecided;
            for (int v = 2 * y; v < 2 * y + 2; ++v) {
                for (int u = 2 * x; u < 2 * x + 2; ++u) {
                    const int at_x = std::min(u, looks.width() - 1), at_y = std::min(v, looks.height() - 1);
                    const Lab& look = looks(at_x, at_y);
                    sum = {sum.l + look.l, sum.a + look.a, sum.b + look.b};
                    const float one = preference(at_x, at_y);
                    own += one;
                    least = std::min(least, one);
                    most = std::max(most, one);
                }
            }
            constexpr float kAlmostDecided = 0.99F * kDecided;
            half.looks(x, y) = {sum.l / 4, sum.a / 4, sum.b / 4};
            half.preference(x, y) = least >= kDecided   ? kDecided
                                    : most <= -kDecided ? -kDecided
                                                        : std::clamp(own / 2, -kAlmostDecided, kAlmostDecided);
        }
    }
    return half;
}

}  // namespace

Image<std::uint8_t> cut_coarse_first(ConstImageView<Lab> looks, ConstImageView<float> preference,
                                     const CutOptions& options) {
    RS_CHECK(options.coarse_from_px > 1);
    if (undecided_in(preference) < options.coarse_from_px) return cut_by_contrast(looks, preference, options);
    Image<std::uint8_t> coarse = [&] {
        const HalfSize half = half_size(looks, preference);
        return cut_coarse_first(half.looks, half.preference, options);
    }();
    const cv::Mat1b sides(coarse.height(), coarse.width(), coarse.data());
    const cv::Mat1b around = cv::getStructuringElement(cv::MORPH_RECT, {kCoarseBand_px + 1, kCoarseBand_px + 1});
    cv::Mat1b least, most;
    cv::erode(sides, least, around);
    cv::dilate(sides, most, around);
    Image<float> left(preference.width(), preference.height());
    for (int y = 0; y < left.height(); ++y) {
        for (int x = 0; x < left.width(); ++x) {
            const float own = preference(x, y);
            const bool object = least(y / 2, x / 2) != 0, backdrop = most(y / 2, x / 2) == 0;
            const bool open = (!object && !backdrop) || (object ? own <= -kClearly : own >= kClearly);
            left(x, y) = std::abs(own) >= kDecided || open ? own : object ? kDecided : -kDecided;
        }
    }
    return cut_by_contrast(looks, left, options);
}

}  // namespace rs::capture
