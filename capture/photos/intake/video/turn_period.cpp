#include "capture/photos/intake/video/turn_period.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>

namespace rs::capture {
namespace {

constexpr std::size_t kMaxPeriodSamples = 480;
constexpr double kChanged = 0.6;              // of the median difference: above it the pose has changed
constexpr double kMaxRepeatDifference = 0.4;  // of the median difference
constexpr double kEarlierTolerance = 1.4;     // of the best difference: an earlier repeat within it is preferred
constexpr double kNoise_codes = 1;
constexpr std::size_t kRunLength = 3;  // consecutive samples compared

// Codes of the moving region at half resolution.
std::vector<std::uint8_t> region_codes(const FrameCopy& copy, const Image<std::uint8_t>& region) {
    std::vector<std::uint8_t> codes;
    for (int y = 0; y + 1 < region.height(); y += 2) {
        for (int x = 0; x + 1 < region.width(); x += 2) {
            if (region(x, y) == 0) continue;
            const Image<std::uint8_t>& l = copy.luma;
            codes.push_back(static_cast<std::uint8_t>((l(x, y) + l(x + 1, y) + l(x, y + 1) + l(x + 1, y + 1) + 2) / 4));
        }
    }
    return codes;
}

float mean_abs_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    int sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return a.empty() ? 0 : static_cast<float>(sum) / static_cast<float>(a.size());
}

// Mean absolute differences between all pairs of frames sampled at equal steps of angle.
class SelfSimilarity {
public:
    SelfSimilarity(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region,
                   std::vector<std::size_t> frames)
        : frames_(std::move(frames)), differences_(frames_.size() * frames_.size()) {
        std::vector<std::vector<std::uint8_t>> codes;
        for (const std::size_t frame : frames_) codes.push_back(region_codes(copies[frame], region));
        for (std::size_t i = 0; i < count(); ++i) {
            for (std::size_t j = i + 1; j < count(); ++j) {
                differences_[i * count() + j] = differences_[j * count() + i] = mean_abs_difference(codes[i], codes[j]);
            }
        }
    }
    [[nodiscard]] std::size_t count() const { return frames_.size(); }
    [[nodiscard]] std::size_t frame(std::size_t sample) const { return frames_[sample]; }
    [[nodiscard]] float operator()(std::size_t i, std::size_t j) const { return differences_[i * count() + j]; }

    // Mean difference between the runs of kRunLength samples that start at i and j. Later samples may be shifted by
    // one, because the speed may differ.
    [[nodiscard]] float run_difference(std::size_t i, std::size_t j) const {
        float sum = (*this)(i, j);
        std::size_t terms = 1;
        for (std::size_t k = 1; k < kRunLength && j + k < count(); ++k, ++terms) {
            float minimum = (*this)(i + k, j + k);
            if (j + k - 1 > i + k) minimum = std::min(minimum, (*this)(i + k, j + k - 1));
            if (j + k + 1 < count()) minimum = std::min(minimum, (*this)(i + k, j + k + 1));
            sum += minimum;
        }
        return sum / static_cast<float>(terms);
    }
    [[nodiscard]] float median_difference(std::size_t i) const {
        std::vector<float> row(differences_.begin() + static_cast<std::ptrdiff_t>(i * count()),
                               differences_.begin() + static_cast<std::ptrdiff_t>((i + 1) * count()));
        return median_of(std::span(row));
    }

private:
    std::vector<std::size_t> frames_;
    std::vector<float> differences_;
};

struct Repeat {
    std::size_t from = 0, to = 0;  // samples
    float quality = 0;             // difference over the median difference; 0 is best
};

// Finds the first sample that repeats sample i.
std::optional<Repeat> find_repeat(const SelfSimilarity& similarity, std::size_t i) {
    const float typical = similarity.median_difference(i);
    const float between = i + 1 < similarity.count() ? similarity(i, i + 1) : 0;  // a turn may end between samples
    std::size_t changed = i + 1;
    while (changed < similarity.count() && similarity(i, changed) < kChanged * typical) ++changed;
    std::vector<float> differences(similarity.count(), std::numeric_limits<float>::max());
    for (std::size_t j = changed; j < similarity.count(); ++j) differences[j] = similarity.run_difference(i, j);
    const float best = *std::ranges::min_element(differences);
    if (!(best < kMaxRepeatDifference * typical)) return std::nullopt;
    for (std::size_t j = changed; j < similarity.count(); ++j) {
        const auto begin =
            differences.begin() + static_cast<std::ptrdiff_t>(std::max(changed, j - std::min(j, kRunLength)));
        const auto end =
            differences.begin() + static_cast<std::ptrdiff_t>(std::min(similarity.count(), j + kRunLength + 1));
        const bool is_minimum = differences[j] <= *std::min_element(begin, end);
        if (is_minimum && differences[j] < kMaxRepeatDifference * typical &&
            differences[j] <= kEarlierTolerance * best + between + kNoise_codes) {
            return Repeat{i, j, differences[j] / typical};
        }
    }
    return std::nullopt;
}

std::optional<Repeat> choose_repeat(const SelfSimilarity& similarity) {
    std::vector<Repeat> repeats;
    float best = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i + kRunLength < similarity.count(); ++i) {
        const std::optional<Repeat> repeat = find_repeat(similarity, i);
        if (!repeat) continue;
        repeats.push_back(*repeat);
        best = std::min(best, repeat->quality);
    }
    if (repeats.empty()) return std::nullopt;
    // Objects with similar sides repeat too early from some poses: the median length is used.
    std::vector<std::size_t> lengths;
    for (const Repeat& repeat : repeats) lengths.push_back(repeat.to - repeat.from);
    const std::size_t typical = median(lengths);
    constexpr float kQualityFactor = 1.25F, kQualityOffset = 0.03F;
    for (const Repeat& repeat : repeats) {
        const std::size_t length = repeat.to - repeat.from;
        const bool is_whole = 4 * length > 3 * typical && 3 * length < 4 * typical;
        if (is_whole && repeat.quality <= kQualityFactor * best + kQualityOffset) return repeat;
    }
    return std::nullopt;
}

// Finds the frame near `end` that is most similar to `begin`.
std::size_t refine_end(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region, std::size_t begin,
                       std::size_t end, std::size_t around, std::size_t limit) {
    const std::vector<std::uint8_t> first = region_codes(copies[begin], region);
    std::size_t best = end;
    float minimum = std::numeric_limits<float>::max();
    for (std::size_t frame = end - std::min(end, around); frame < std::min(limit, end + around + 1); ++frame) {
        const float here = mean_abs_difference(first, region_codes(copies[frame], region));
        if (here < minimum) {
            minimum = here;
            best = frame;
        }
    }
    return best;
}

}  // namespace

TurnRange find_turn(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region,
                    const std::vector<double>& speed) {
    RS_CHECK(!copies.empty() && speed.size() == copies.size());
    TurnRange all{0, copies.size(), false};
    while (all.begin < all.end && speed[all.begin] == 0) ++all.begin;
    while (all.end > all.begin && speed[all.end - 1] == 0) --all.end;
    if (all.begin >= all.end) return {0, copies.size(), false};
    all.end = std::min(all.end + 1, copies.size());  // the frame after the last step

    double angle = 0;
    for (std::size_t frame = all.begin; frame < all.end; ++frame) angle += speed[frame];
    const std::size_t count = std::min(all.end - all.begin, kMaxPeriodSamples);
    std::vector<std::size_t> frames;
    double passed = 0;
    for (std::size_t frame = all.begin; frame < all.end; ++frame) {
        if (passed * static_cast<double>(count) >= angle * static_cast<double>(frames.size())) frames.push_back(frame);
        passed += speed[frame];
    }
    constexpr std::size_t kMinSamples = 8;
    if (frames.size() < kMinSamples) return all;
    const SelfSimilarity similarity(copies, region, std::move(frames));
    const std::optional<Repeat> repeat = choose_repeat(similarity);
    if (!repeat) return all;
    const std::size_t begin = similarity.frame(repeat->from), end = similarity.frame(repeat->to);
    const std::size_t around = end - similarity.frame(repeat->to - 1);
    return {begin, refine_end(copies, region, begin, end, around, all.end), true};
}

}  // namespace rs::capture
