#include "capture/photos/background/border_statistics.hpp"

#include <opencv2/core.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace rs::capture {

std::vector<Rgba8> border_colours(const BackgroundEstimate& background, bool only_static,
                                  const BackgroundParameters::Border& parameters) {
    std::vector<cv::Vec3f> pixels;
    for_border(background.colour.width(), background.colour.height(), [&](int x, int y) {
        if (only_static && background.agreement(x, y) < parameters.static_share) return;
        const Rgba8& c = background.colour(x, y);
        pixels.emplace_back(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b));
    });
    if (pixels.size() < static_cast<std::size_t>(parameters.clusters)) return {};
    cv::theRNG().state = 1;  // cv::kmeans draws its initial centres from it; the result must be reproducible
    std::vector<int> labels;
    cv::Mat centres;
    cv::kmeans(cv::Mat(pixels).reshape(1), parameters.clusters, labels,
               cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 20, 0.5), 3, cv::KMEANS_PP_CENTERS,
               centres);
    std::vector<std::pair<std::ptrdiff_t, Rgba8>> ranked;
    for (int k = 0; k < centres.rows; ++k) {
        const auto code = [&](int channel) { return cv::saturate_cast<std::uint8_t>(centres.at<float>(k, channel)); };
        ranked.emplace_back(std::count(labels.begin(), labels.end(), k), Rgba8{code(0), code(1), code(2), 255});
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    const double min_count = parameters.min_cluster_share * static_cast<double>(pixels.size());
    std::vector<Rgba8> colours;
    for (const auto& [count, colour] : ranked) {
        if (static_cast<double>(count) >= min_count) colours.push_back(colour);
    }
    return colours;
}

bool is_black(const Rgba8& colour, const BackgroundParameters::Border& parameters) {
    return std::max({colour.r, colour.g, colour.b}) <= parameters.max_black_code;
}

bool BorderStatistics::is_white(const BackgroundParameters::Border& parameters) const {
    return white >= parameters.majority;
}

bool BorderStatistics::is_black(bool static_is_known, const BackgroundParameters::Border& parameters) const {
    return black >= parameters.majority && (!static_is_known || bright < parameters.max_bright_share);
}

BorderStatistics border_statistics(const BackgroundEstimate& background,
                                   const BackgroundParameters::Border& parameters) {
    BorderStatistics shares;
    double count = 0;
    for_border(background.colour.width(), background.colour.height(), [&](int x, int y) {
        const Rgba8& c = background.colour(x, y);
        const bool is_static = background.agreement(x, y) >= parameters.static_share;
        ++count;
        shares.white += std::min({c.r, c.g, c.b}) >= parameters.min_white_code ? 1 : 0;
        shares.black += is_black(c, parameters) ? 1 : 0;
        shares.static_pixels += is_static ? 1 : 0;
        shares.bright += is_static && std::max({c.r, c.g, c.b}) > parameters.max_lit_black_code ? 1 : 0;
    });
    shares.white /= count;
    shares.black /= count;
    shares.bright /= count;
    shares.static_pixels /= count;
    return shares;
}

}  // namespace rs::capture
