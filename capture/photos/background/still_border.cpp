#include "capture/photos/background/still_border.hpp"

#include <opencv2/core.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kWhite_code = 225;  // every channel at least
constexpr int kBlack_code = 40;   // every channel at most
constexpr double kBorderMajority = 0.6;
constexpr double kOtherThings = 0.1;      // of the border
constexpr int kBrightOnBlack_code = 110;  // the brightest channel of what no black is, however it is lit
constexpr int kBorderColours = 4;
constexpr double kFewestOfColour = 0.02;  // of the pixels
constexpr float kStillShare = 0.6F;       // of the samples agree: never or seldom hidden

bool is_white(const Rgba8& c) {
    return std::min({c.r, c.g, c.b}) >= kWhite_code;
}

}  // namespace

std::vector<Rgba8> border_colours(const StillPicture& still, bool only_still) {
    std::vector<cv::Vec3f> seen;
    for_border(still.colour.width(), still.colour.height(), [&](int x, int y) {
        if (only_still && still.agreement(x, y) < kStillShare) return;
        const Rgba8& c = still.colour(x, y);
        seen.emplace_back(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b));
    });
    if (seen.size() < kBorderColours) return {};
    cv::theRNG().state = 1;  // kmeans draws its starts from here: the same pictures must give the same backdrop
    std::vector<int> labels;
    cv::Mat centres;
    cv::kmeans(cv::Mat(seen).reshape(1), kBorderColours, labels,
               cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 20, 0.5), 3, cv::KMEANS_PP_CENTERS,
               centres);
    std::vector<std::pair<std::ptrdiff_t, Rgba8>> ranked;
    for (int k = 0; k < centres.rows; ++k) {
        const auto code = [&](int channel) { return cv::saturate_cast<std::uint8_t>(centres.at<float>(k, channel)); };
        ranked.emplace_back(std::count(labels.begin(), labels.end(), k), Rgba8{code(0), code(1), code(2), 255});
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Rgba8> colours;
    for (const auto& [count, colour] : ranked) {
        if (static_cast<double>(count) >= kFewestOfColour * static_cast<double>(seen.size())) colours.push_back(colour);
    }
    return colours;
}

bool is_black(const Rgba8& colour) {
    return std::max({colour.r, colour.g, colour.b}) <= kBlack_code;
}

bool BorderShares::is_white() const {
    return white >= kBorderMajority;
}

bool BorderShares::is_black(bool still_is_known) const {
    return black >= kBorderMajority && (!still_is_known || bright < kOtherThings);
}

BorderShares border_shares(const StillPicture& still) {
    BorderShares shares;
    double count = 0;
    for_border(still.colour.width(), still.colour.height(), [&](int x, int y) {
        const Rgba8& c = still.colour(x, y);
        ++count;
        shares.white += is_white(c) ? 1 : 0;
        shares.black += is_black(c) ? 1 : 0;
        const bool rests = still.agreement(x, y) >= kStillShare;
        shares.still += rests ? 1 : 0;
        shares.bright += rests && std::max({c.r, c.g, c.b}) > kBrightOnBlack_code ? 1 : 0;
    });
    shares.white /= count;
    shares.black /= count;
    shares.bright /= count;
    shares.still /= count;
    return shares;
}

}  // namespace rs::capture
