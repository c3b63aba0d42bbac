#include "capture/photos/foreground/graph_cut.hpp"

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

// Half of the 8-neighbourhood: every pair is visited once.
constexpr std::pair<int, int> kNeighbours[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

}  // namespace

Image<std::uint8_t> graph_cut(ConstImageView<Lab> lab, ConstImageView<float> score,
                              const ForegroundParameters::GraphCut& parameters) {
    RS_CHECK(lab.width() == score.width() && lab.height() == score.height());
    const int width = lab.width();
    const int height = lab.height();
    Image<int> node(width, height, kNoNode);
    int nodes = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (std::abs(score(x, y)) < kCertainScore) node(x, y) = nodes++;
        }
    }
    Image<std::uint8_t> object(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) object(x, y) = score(x, y) >= kCertainScore ? 255 : 0;
    }
    if (nodes == 0) return object;

    // A decided neighbour acts as a terminal: a label change costs the same as between undecided pixels.
    std::vector<float> to_object(static_cast<std::size_t>(nodes), 0.0F);
    std::vector<float> to_background(static_cast<std::size_t>(nodes), 0.0F);
    cv::detail::GCGraph<float> graph(static_cast<unsigned>(nodes) + 2, static_cast<unsigned>(nodes) * 8 + 2);
    for (int i = 0; i < nodes; ++i) graph.addVtx();
    // GCGraph requires an edge; there is none if no two undecided pixels are neighbours.
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
                const float contrast = delta_e(lab(x, y), lab(u, v)) / parameters.contrast_delta_e;
                const float length = dx != 0 && dy != 0 ? 0.70710678F : 1.0F;
                const float cost =
                    length * (parameters.min_edge_cost + parameters.smoothness * std::exp(-0.5F * contrast * contrast));
                if (a != kNoNode && b != kNoNode) {
                    graph.addEdges(a, b, cost, cost);
                } else {
                    const int undecided = a != kNoNode ? a : b;
                    const bool decided_object = (a == kNoNode ? object(x, y) : object(u, v)) != 0;
                    (decided_object ? to_object : to_background)[static_cast<std::size_t>(undecided)] += cost;
                }
            }
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int i = node(x, y);
            if (i == kNoNode) continue;
            const float own = score(x, y);
            graph.addTermWeights(i, to_object[static_cast<std::size_t>(i)] + std::max(0.0F, own),
                                 to_background[static_cast<std::size_t>(i)] + std::max(0.0F, -own));
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

std::ptrdiff_t count_undecided(ConstImageView<float> score) {
    std::ptrdiff_t count = 0;
    for (int y = 0; y < score.height(); ++y) {
        count += std::count_if(score.row(y), score.row(y) + score.width(),
                               [](float own) { return std::abs(own) < kCertainScore; });
    }
    return count;
}

struct Level {
    Image<Lab> lab;
    Image<float> score;
};

// Averages 2 x 2 pixels. A pixel is decided where all four are, with one label. The score is twice the mean, because
// areas shrink to a quarter and contours to half.
Level halved(ConstImageView<Lab> lab, ConstImageView<float> score) {
    const int width = (lab.width() + 1) / 2, height = (lab.height() + 1) / 2;
    Level half{Image<Lab>(width, height), Image<float>(width, height)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Lab sum;
            float sum_score = 0, lowest = kCertainScore, highest = -kCertainScore;
            for (int v = 2 * y; v < 2 * y + 2; ++v) {
                for (int u = 2 * x; u < 2 * x + 2; ++u) {
                    const int at_x = std::min(u, lab.width() - 1), at_y = std::min(v, lab.height() - 1);
                    const Lab& colour = lab(at_x, at_y);
                    sum = {sum.l + colour.l, sum.a + colour.a, sum.b + colour.b};
                    const float pixel_score = score(at_x, at_y);
                    sum_score += pixel_score;
                    lowest = std::min(lowest, pixel_score);
                    highest = std::max(highest, pixel_score);
                }
            }
            constexpr float kAlmostCertain = 0.99F * kCertainScore;
            half.lab(x, y) = {sum.l / 4, sum.a / 4, sum.b / 4};
            half.score(x, y) = lowest >= kCertainScore     ? kCertainScore
                               : highest <= -kCertainScore ? -kCertainScore
                                                           : std::clamp(sum_score / 2, -kAlmostCertain, kAlmostCertain);
        }
    }
    return half;
}

}  // namespace

Image<std::uint8_t> graph_cut_coarse_to_fine(ConstImageView<Lab> lab, ConstImageView<float> score,
                                             const ForegroundParameters::GraphCut& parameters) {
    RS_CHECK(parameters.coarse_min_px > 1);
    if (count_undecided(score) < parameters.coarse_min_px) return graph_cut(lab, score, parameters);
    Image<std::uint8_t> coarse = [&] {
        const Level half = halved(lab, score);
        return graph_cut_coarse_to_fine(half.lab, half.score, parameters);
    }();
    const cv::Mat1b labels(coarse.height(), coarse.width(), coarse.data());
    const cv::Mat1b window =
        cv::getStructuringElement(cv::MORPH_RECT, {parameters.refine_band_px + 1, parameters.refine_band_px + 1});
    cv::Mat1b eroded, dilated;
    cv::erode(labels, eroded, window);
    cv::dilate(labels, dilated, window);
    Image<float> remaining(score.width(), score.height());
    for (int y = 0; y < remaining.height(); ++y) {
        for (int x = 0; x < remaining.width(); ++x) {
            const float own = score(x, y);
            const bool object = eroded(y / 2, x / 2) != 0, background = dilated(y / 2, x / 2) == 0;
            const bool is_cut_again = (!object && !background) ||
                                      (object ? own <= -parameters.overrule_score : own >= parameters.overrule_score);
            remaining(x, y) = std::abs(own) >= kCertainScore || is_cut_again ? own
                              : object                                       ? kCertainScore
                                                                             : -kCertainScore;
        }
    }
    return graph_cut(lab, remaining, parameters);
}

}  // namespace rs::capture
