#include "encode/encode_images.hpp"

#include "encode/set/soft_coverage.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/codec/stream/coded_chunks.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace rs::encode {
namespace {

// Steps are searched on the quantiser's scale, eight per doubling.
constexpr int kFinest = 0;
constexpr int kCoarsest = 60;

double step_of_index(int index) {
    return std::exp2(index / 8.0);
}

// At full size; wider than the soft edges of alpha mattes.
constexpr int kSoftRadius_px = 6;
// Share of the visible pixels in soft regions from which on few alpha levels would show as contour lines.
constexpr double kSoftShare = .01;
constexpr int kSoftAlphaBits = 6;

double soft_share(const std::vector<SourceImage>& sources) {
    std::atomic<std::int64_t> soft = 0;
    std::atomic<std::int64_t> shown = 0;
    for_each_index(sources.size(), [&](std::size_t v) {
        const Image<std::uint8_t> patches = find_soft_patches(sources[v].coverage, kSoftRadius_px);
        soft += std::ranges::count(patches.pixels(), 255);
        shown +=
            std::ranges::count_if(sources[v].coverage.pixels(), [](int alpha) { return alpha >= kMinVisibleAlpha; });
    });
    return static_cast<double>(soft) / static_cast<double>(std::max<std::int64_t>(shown, 1));
}

std::string text_of(double value) {
    std::string text = std::to_string(value);
    text.resize(text.find('.') + 3);
    return text;
}

// Finds the coarsest step that reaches a fidelity, or the finest one within a size.
class GoalSearch {
public:
    GoalSearch(const RaySpaceObject& object, std::vector<SourceImage>& sources, const ImageGoal& goal,
               std::optional<int> alpha_bits, Progress* progress)
        : object_(object),
          sources_(sources),
          profile_(goal.profile),
          effort_(goal.effort),
          alpha_bits_(alpha_bits),
          progress_(progress) {}

    EncodedImages at_step(double step) {
        if (profile_ == codec::Profile::kBoard) {
            BoardSettings settings;
            settings.step = step;
            settings.alpha_bits = alpha_bits_.value_or(settings.alpha_bits);
            prepare_sources(settings.alpha_bits);
            return encode_board(object_, sources_, settings, progress_);
        }
        DenseSettings settings;
        settings.step = step;
        settings.effort = effort_;
        settings.alpha_bits = alpha_bits_.value_or(dense_alpha_bits(step, wanted_db_));
        prepare_sources(settings.alpha_bits);
        return encode_dense(object_, sources_, settings, progress_);
    }

    Result<EncodedImages> for_psnr(double psnr_db) {
        wanted_db_ = psnr_db;
        // One decibel is about 1.6 steps of the scale.
        const auto reached = [&](const EncodedImages& e) { return e.psnr_db >= psnr_db; };
        const auto off = [&](const EncodedImages& e) { return 1.6 * (e.psnr_db - psnr_db); };
        Result<EncodedImages> best = search(reached, off);
        if (best) return best;
        return Error{"--psnr " + text_of(psnr_db) + ": the finest quantiser reaches " + text_of(reached_db_) +
                     " dB; request at most that, or use --profile " +
                     (profile_ == codec::Profile::kBoard ? "dense" : "raw")};
    }

    Result<EncodedImages> for_size(std::uint64_t bytes) {
        // Doubling the step removes about two thirds of the bytes. `too_large` is the monotonic condition here.
        const auto too_large = [&](const EncodedImages& e) { return count_coded_bytes(e.coded) > bytes; };
        const auto off = [&](const EncodedImages& e) {
            return 6 * std::log2(static_cast<double>(count_coded_bytes(e.coded)) /
                                 static_cast<double>(std::max<std::uint64_t>(bytes, 1)));
        };
        // The coarsest step that is too large; the next one is within the limit.
        const Result<EncodedImages> last = search(too_large, off);
        const int next = last ? found_ + 1 : kFinest;
        if (next > kCoarsest) {
            return Error{"--size: the images take " + std::to_string(count_coded_bytes(last->coded)) +
                         " bytes with the coarsest quantiser, more than the " + std::to_string(bytes) +
                         " allowed; use fewer or smaller images"};
        }
        return take(next);
    }

private:
    void prepare_sources(int alpha_bits) {
        if (std::exchange(source_bits_, alpha_bits) == alpha_bits) return;
        for_each_index(sources_.size(), [&](std::size_t v) { set_alpha_bits(sources_[v], alpha_bits); });
    }

    // Searches for the coarsest step for which `holds`, which is monotonic: true for fine steps, false for coarse ones.
    // `off`: the estimated distance in steps, above 0 if a step is too fine.
    template <class Holds, class Off>
    Result<EncodedImages> search(const Holds& holds, const Off& off) {
        int low = kFinest - 1;     // coarsest step known to hold
        int high = kCoarsest + 1;  // finest step known not to hold
        int index = 28;
        while (high - low > 1) {
            index = std::clamp(index, low + 1, high - 1);
            const EncodedImages& tried = at_index(index);
            reached_db_ = tried.psnr_db;
            const double distance = off(tried);
            if (holds(tried)) {
                low = index;
                index += std::max(1, static_cast<int>(std::lround(distance)));
            } else {
                high = index;
                index += std::min(-1, static_cast<int>(std::lround(distance)));
            }
        }
        if (low < kFinest) return Error{"cannot be reached"};
        found_ = low;
        return take(low);
    }

    const EncodedImages& at_index(int index) {
        auto found = tried_.find(index);
        if (found == tried_.end()) found = tried_.emplace(index, at_step(step_of_index(index))).first;
        return found->second;
    }

    EncodedImages take(int index) { return at_index(index); }

    const RaySpaceObject& object_;
    std::vector<SourceImage>& sources_;
    codec::Profile profile_;
    int effort_;
    std::optional<int> alpha_bits_;
    double wanted_db_ = 0;  // 0: no fidelity is requested
    int source_bits_ = 0;   // current alpha bits of the sources
    Progress* progress_;
    std::map<int, EncodedImages> tried_;
    double reached_db_ = 0;
    int found_ = 0;
};

}  // namespace

double quantiser_step_of_quality(double quality) {
    return 2 * std::exp2((kMaxQuality - quality) / 14);
}

std::uint64_t count_coded_bytes(const codec::CodedImages& coded) {
    std::uint64_t bytes = codec::code_payload(coded).size();
    for (std::size_t v = 0; v < coded.images.size(); ++v) bytes += codec::coded_image_payload(coded, v).size();
    return bytes;
}

Result<EncodedImages> encode_images(const CaptureSet& set, const RaySpaceObject& object, const ImageGoal& goal,
                                    std::optional<int> alpha_bits, Progress* progress) {
    std::vector<SourceImage> sources(object.views.size());
    RS_TRY(for_each_in_parallel(static_cast<int>(sources.size()), "images", progress, [&](int view) -> Status {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, read_upright_image(set, view));
        sources[static_cast<std::size_t>(view)] = source_image(image, alpha_bits.value_or(2));
        return {};
    }));
    if (!alpha_bits && goal.profile == codec::Profile::kDense && soft_share(sources) >= kSoftShare) {
        alpha_bits = kSoftAlphaBits;
    }
    GoalSearch search(object, sources, goal, alpha_bits, progress);
    if (goal.images_bytes) return search.for_size(*goal.images_bytes);
    if (goal.psnr_db) return search.for_psnr(*goal.psnr_db);
    return search.at_step(quantiser_step_of_quality(goal.quality));
}

}  // namespace rs::encode
