#include "capture/photos/segmentation/segmentation_checks.hpp"

#include "capture/photos/background/border_statistics.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr std::size_t kMinContradicting = 8;  // photos; fewer show no course of the area

constexpr const char* kRemedy = "give another --segmenter, --segmentation-model FILE.onnx, or --masks";

std::string of_photos(std::size_t count, std::size_t all) {
    return std::to_string(count) + " of " + std::to_string(all) + " photos";
}

}  // namespace

bool is_static_at_border(std::span<const Image<Rgba8>> foregrounds) {
    constexpr std::size_t kMinPhotos = 6;
    constexpr double kMostPhotos = 0.7;
    constexpr double kMinOfBorder = 0.02;
    constexpr int kSame_codes = 24;  // exposures differ
    if (foregrounds.size() < kMinPhotos) return false;
    const int width = foregrounds[0].width(), height = foregrounds[0].height();
    const double most = kMostPhotos * static_cast<double>(foregrounds.size());
    int border = 0, covered = 0, still = 0;  // pixels
    std::vector<Rgba8> seen;
    for_border(width, height, [&](int x, int y) {
        ++border;
        seen.clear();
        for (const Image<Rgba8>& foreground : foregrounds) {
            if (foreground(x, y).a >= 128) seen.push_back(foreground(x, y));
        }
        if (static_cast<double>(seen.size()) < most) return;
        ++covered;
        const Rgba8 usual = median_colour(seen);
        const auto same =
            std::ranges::count_if(seen, [&](const Rgba8& c) { return within_codes(c, usual, kSame_codes); });
        still += static_cast<double>(same) >= most ? 1 : 0;
    });
    return covered > kMinOfBorder * border && 2 * still > covered;
}

std::vector<std::size_t> contradicting_silhouettes(std::span<const double> coverage,
                                                   const CheckParameters& parameters) {
    std::vector<std::size_t> found;
    const std::size_t count = coverage.size();
    if (count < kMinContradicting) return found;
    const double largest = *std::ranges::max_element(coverage);
    const double tolerated =
        (parameters.plate_factor * std::sin(2 * kPi / static_cast<double>(count)) + parameters.area_margin) * largest;
    // The turn may not close: its ends have one neighbour each.
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double expected = (coverage[i - 1] + coverage[i + 1]) / 2;
        if (std::abs(coverage[i] - expected) > tolerated) found.push_back(i);
    }
    return found;
}

SegmentationFindings check_segmentation(const PhotoFolder& folder, const SegmentedTurn& turn, SegmenterKind kind,
                                        const CheckParameters& parameters) {
    SegmentationFindings found;
    const std::size_t count = folder.photos.size();
    const bool is_given = kind == SegmenterKind::kAlpha || kind == SegmenterKind::kMasks;

    const double typical = median(std::vector<double>(turn.coverage));
    if (!is_given && typical > parameters.max_coverage) {
        found.problems.push_back("the object covers " + std::to_string(std::lround(100 * typical)) +
                                 " % of the image: background was probably kept; " + kRemedy);
    }
    const auto at_border = static_cast<std::size_t>(std::ranges::count(turn.at_border, std::uint8_t{1}));
    if (at_border > 0) {
        const std::string text = "the object reaches the image border in " + of_photos(at_border, count);
        if (is_static_at_border(turn.small)) {
            found.problems.push_back(text + " and most of it never changes: background was kept; " + kRemedy);
        } else if (!is_given &&
                   static_cast<double>(at_border) > parameters.max_at_border * static_cast<double>(count)) {
            found.problems.push_back(text + " and is cut off there; take the photos from farther away, or " + kRemedy);
        } else {
            found.notes.push_back(text + "; it will look cut off there");
        }
    }
    const std::vector<std::size_t> contradicting = contradicting_silhouettes(turn.coverage, parameters);
    if (!contradicting.empty()) {
        const std::string text = "silhouettes contradict their neighbours in " +
                                 of_photos(contradicting.size(), count) + " (first " +
                                 folder.photos[contradicting.front()].filename().string() + ")";
        const bool is_many =
            static_cast<double>(contradicting.size()) > parameters.max_contradicting * static_cast<double>(count);
        (is_many ? found.problems : found.notes)
            .push_back(text + ": parts are missing or background was kept; " + kRemedy);
    }
    return found;
}

}  // namespace rs::capture
