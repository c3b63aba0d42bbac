#include "capture/photos/intake/film/turn_period.hpp"

#include "rayspace/base/check.hpp"
#include "rayspace/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>

namespace rs::capture {
namespace {

constexpr std::size_t kMostSamples = 480;
constexpr double kRisen = 0.6;   // of the median difference: the pose has changed
constexpr double kRepeat = 0.4;  // of the median difference: most that a repeat differs by
constexpr double kAlike = 1.4;   // of the best repeat: an earlier one that is as good is taken
constexpr double kNoise_codes = 1;
constexpr std::size_t kRun = 3;  // samples compared one after the other

// The moving pixels of every second row and column, averaged over 2 x 2.
std::vector<std::uint8_t> samples_of(const FrameCopy& copy, const Image<std::uint8_t>& region) {
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

float difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    int sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return a.empty() ? 0 : static_cast<float>(sum) / static_cast<float>(a.size());
}

// Mean absolute differences of frames at equal steps of angle.
class SelfSimilarity {
public:
    SelfSimilarity(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region,
                   std::vector<std::size_t> frames)
        : frames_(std::move(frames)), differences_(frames_.size() * frames_.size()) {
        std::vector<std::vector<std::uint8_t>> codes;
        for (const std::size_t frame : frames_) codes.push_back(samples_of(copies[frame], region));
        for (std::size_t i = 0; i < count(); ++i) {
            for (std::size_t j = i + 1; j < count(); ++j) {
                differences_[i * count() + j] = differences_[j * count() + i] = difference(codes[i], codes[j]);
            }
        }
    }
    [[nodiscard]] std::size_t count() const { return frames_.size(); }
    [[nodiscard]] std::size_t frame(std::size_t sample) const { return frames_[sample]; }
    [[nodiscard]] float operator()(std::size_t i, std::size_t j) const { return differences_[i * count() + j]; }

    // Mean difference of the runs of kRun samples from i and from j on, as far as the film goes; later samples may be
    // one off, as the speed may differ.
    [[nodiscard]] float of_runs(std::size_t i, std::size_t j) const {
        float sum = (*this)(i, j);
        std::size_t terms = 1;
        for (std::size_t k = 1; k < kRun && j + k < count(); ++k, ++terms) {
            float least = (*this)(i + k, j + k);
            if (j + k - 1 > i + k) least = std::min(least, (*this)(i + k, j + k - 1));
            if (j + k + 1 < count()) least = std::min(least, (*this)(i + k, j + k + 1));
            sum += least;
        }
        return sum / static_cast<float>(terms);
    }
    [[nodiscard]] float median_from(std::size_t i) const {
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
    float quality = 0;             // difference over what is usual; 0 is best
};

// The first sample that repeats sample i.
std::optional<Repeat> repeat_of(const SelfSimilarity& similarity, std::size_t i) {
    const float usual = similarity.median_from(i);
    const float between = i + 1 < similarity.count() ? similarity(i, i + 1) : 0;  // a turn need not be whole samples
    std::size_t risen = i + 1;
    while (risen < similarity.count() && similarity(i, risen) < kRisen * usual) ++risen;
    std::vector<float> differences(similarity.count(), std::numeric_limits<float>::max());
    for (std::size_t j = risen; j < similarity.count(); ++j) differences[j] = similarity.of_runs(i, j);
    const float best = *std::ranges::min_element(differences);
    if (!(best < kRepeat * usual)) return std::nullopt;
    for (std::size_t j = risen; j < similarity.count(); ++j) {
        const auto begin = differences.begin() + static_cast<std::ptrdiff_t>(std::max(risen, j - std::min(j, kRun)));
        const auto end = differences.begin() + static_cast<std::ptrdiff_t>(std::min(similarity.count(), j + kRun + 1));
        const bool is_least = differences[j] <= *std::min_element(begin, end);
        if (is_least && differences[j] < kRepeat * usual && differences[j] <= kAlike * best + between + kNoise_codes) {
            return Repeat{i, j, differences[j] / usual};
        }
    }
    return std::nullopt;
}

std::optional<Repeat> choose_repeat(const SelfSimilarity& similarity) {
    std::vector<Repeat> repeats;
    float best = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i + kRun < similarity.count(); ++i) {
        const std::optional<Repeat> repeat = repeat_of(similarity, i);
        if (!repeat) continue;
        repeats.push_back(*repeat);
        best = std::min(best, repeat->quality);
    }
    if (repeats.empty()) return std::nullopt;
    // Objects with similar sides repeat too early from some poses.
    std::vector<std::size_t> lengths;
    for (const Repeat& repeat : repeats) lengths.push_back(repeat.to - repeat.from);
    const std::size_t usual = median(lengths);
    constexpr float kAsGood = 1.25F, kAlmost = 0.03F;
    for (const Repeat& repeat : repeats) {
        const std::size_t length = repeat.to - repeat.from;
        const bool is_whole = 4 * length > 3 * usual && 3 * length < 4 * usual;
        if (is_whole && repeat.quality <= kAsGood * best + kAlmost) return repeat;
    }
    return std::nullopt;
}

// The frame near `end` that is most like `begin`.
std::size_t refine_end(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region, std::size_t begin,
                       std::size_t end, std::size_t around, std::size_t limit) {
    const std::vector<std::uint8_t> first = samples_of(copies[begin], region);
    std::size_t best = end;
    float least = std::numeric_limits<float>::max();
    for (std::size_t frame = end - std::min(end, around); frame < std::min(limit, end + around + 1); ++frame) {
        const float here = difference(first, samples_of(copies[frame], region));
        if (here < least) {
            least = here;
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
    const std::size_t count = std::min(all.end - all.begin, kMostSamples);
    std::vector<std::size_t> frames;
    double passed = 0;
    for (std::size_t frame = all.begin; frame < all.end; ++frame) {
        if (passed * static_cast<double>(count) >= angle * static_cast<double>(frames.size())) frames.push_back(frame);
        passed += speed[frame];
    }
    constexpr std::size_t kFewest = 8;
    if (frames.size() < kFewest) return all;
    const SelfSimilarity similarity(copies, region, std::move(frames));
    const std::optional<Repeat> repeat = choose_repeat(similarity);
    if (!repeat) return all;
    const std::size_t begin = similarity.frame(repeat->from), end = similarity.frame(repeat->to);
    const std::size_t around = end - similarity.frame(repeat->to - 1);
    return {begin, refine_end(copies, region, begin, end, around, all.end), true};
}

}  // namespace rs::capture
