#include "encode/codec/dense_encoder.hpp"

#include "encode/codec/coders.hpp"
#include "encode/codec/encoder_images.hpp"
#include "encode/codec/ring_references.hpp"
#include "encode/codec/tile_encoder.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/codec/bool_encoder.hpp"
#include "rayspace/codec/context_states.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/codec/stream/decode_image.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::encode {
namespace {

using codec::CodedImage;
using codec::CodedImages;
using codec::MotionVector;

struct DenseWorkImage {
    codec::Planes reconstruction;
    std::vector<std::vector<Decision>> decisions;  // [tile]
    std::array<int, 2> reach = {0, 0};
    std::array<std::vector<std::vector<MotionVector>>, 2> motions;  // [reference][tile]
};

class DenseEncoder {
public:
    DenseEncoder(const RaySpaceObject& object, const std::vector<SourceImage>& sources, const DenseSettings& settings,
                 Progress* progress)
        : object_(object),
          sources_(sources),
          settings_(settings),
          progress_(progress),
          work_(object.views.size()),
          errors_(object.views.size()) {
        coded_.width = object.width;
        coded_.height = object.height;
        coded_.dense.alpha_bits = settings.alpha_bits;
        coded_.tile_width_log2 = settings.tile_width_log2;
        coded_.tile_height_log2 = settings.tile_height_log2;
        coded_.dense.chroma_step_offset = settings.chroma_offset;
        coded_.dense.probabilities.fill(2048);
        if (coded_.dense.has_edge_alpha()) coded_.dense.edge_alpha = estimate_edge_alpha(sources);
        start_probabilities();
        coded_.levels.assign(object.views.size(), 0);
        coded_.images.resize(object.views.size());
        plan();
        for_each_index(work_.size(), [&](std::size_t v) { find_tiles(static_cast<int>(v)); });
    }

    EncodedImages encode() {
        const SearchEffort effort = search_effort(settings_.effort);
        jobs_ = present_tiles();
        if (progress_ != nullptr) {
            std::int64_t count = 0;
            for (const auto& jobs : jobs_) count += static_cast<std::int64_t>(jobs.size());
            progress_->start("encoding", count + count / effort.sampled);
        }
        // The first pass measures the probabilities, which are the prices of the second pass, and the global motion.
        run_pass(effort.first_pass, effort.sampled);
        for (std::size_t v = 0; v < work_.size(); ++v) set_global_motion(v);
        run_pass(effort.unit, 1);
        write_tiles();
        if (progress_ != nullptr) progress_->finish();
        return {std::move(coded_), coded_psnr_db(errors_)};
    }

private:
    // Initial probabilities for the first pass: zeros are likelier the higher the coefficient.
    void start_probabilities() {
        namespace context = codec::context;
        auto& p = coded_.dense.probabilities;
        for (int kind = 0; kind < context::kBlockKinds; ++kind) {
            for (int band = 0; band < context::kBands; ++band) {
                for (int near = 0; near < context::kNearSums; ++near) {
                    const int zero = std::clamp(3600 - 500 * near - (band == 0 ? 1200 : 0) + 100 * band, 600, 3900);
                    p[static_cast<std::size_t>(context::kNonZero +
                                               (kind * context::kBands + band) * context::kNearSums + near)] =
                        static_cast<std::uint16_t>(zero);
                }
            }
            for (int i = 0; i < 2 * context::kNearSums; ++i) {
                p[static_cast<std::size_t>(context::kAboveOne + 2 * context::kNearSums * kind + i)] = 2900;
                p[static_cast<std::size_t>(context::kAboveTwo + 2 * context::kNearSums * kind + i)] = 2600;
            }
        }
    }

    // Assigns progressive levels, references and steps.
    void plan() {
        const double base = std::log2(std::max(settings_.step, 1.0)) * 8;
        for (const Ring& ring : object_.rings) {
            const int count = static_cast<int>(ring.views.size());
            for (int n = 0; n < count; ++n) {
                const std::size_t view = ring.views[static_cast<std::size_t>(n)];
                const int level = progressive_level(n);
                coded_.levels[view] = static_cast<std::uint8_t>(level);
                codec::ImageHead& head = coded_.images[view].head;
                head.step = std::clamp(
                    static_cast<int>(std::lround(base)) + settings_.level_offset[static_cast<std::size_t>(level)], 0,
                    codec::kMaxStep);
                if (level == 0) continue;
                std::size_t found = 0;
                for_ring_references(
                    ring, n, object_.width, 96, [&](int p) { return progressive_level(p) < level; },
                    [&](std::uint16_t reference, int reach_px) {
                        work_[view].reach[found] = reach_px;
                        head.reference[found++] = reference;
                    });
            }
        }
    }

    void find_tiles(int view) {
        DenseWorkImage& work = work_[static_cast<std::size_t>(view)];
        CodedImage& coded = coded_.images[static_cast<std::size_t>(view)];
        const auto tiles = static_cast<std::size_t>(coded_.tile_columns() * coded_.tile_rows());
        coded.tiles.resize(tiles);
        work.decisions.resize(tiles);
        for (auto& motions : work.motions) motions.resize(tiles);
        for (std::size_t t = 0; t < tiles; ++t) {
            const codec::TileRect place = codec::tile_rect(coded_, t);
            for (int y = place.top; y < place.top + place.height && !coded.tiles[t].present; ++y) {
                const std::uint8_t* const row = sources_[static_cast<std::size_t>(view)].valid.row(y) + place.left;
                coded.tiles[t].present = std::any_of(row, row + place.width, [](std::uint8_t m) { return m != 0; });
            }
        }
    }

    struct Job {
        std::size_t view;
        std::size_t tile;
    };
    using LevelJobs = std::array<std::vector<Job>, kProgressiveLevels>;

    [[nodiscard]] LevelJobs present_tiles() const {
        LevelJobs jobs;
        for (std::size_t v = 0; v < work_.size(); ++v) {
            for (std::size_t t = 0; t < coded_.images[v].tiles.size(); ++t) {
                if (coded_.images[v].tiles[t].present) jobs[coded_.levels[v]].push_back({v, t});
            }
        }
        return jobs;
    }

    // Codes every `sampled`-th tile and updates the probabilities from the decisions. Images refer to those of their
    // ring only, so that reconstructions of one ring are in memory at a time.
    void run_pass(const UnitEffort& effort, int sampled) {
        const CostTable costs(coded_.dense.probabilities);
        for (const Ring& ring : object_.rings) {
            for_each_view(ring, [&](std::size_t v) { start_reconstruction(v, sampled > 1); });
            for (int level = 0; level < kProgressiveLevels; ++level) {
                const std::vector<ImageTask> tasks = tasks_of_level(ring, level, effort);
                if (sampled == 1) clear_absent_tiles(tasks);
                run_jobs(tasks, costs, static_cast<std::size_t>(level), static_cast<std::size_t>(sampled));
            }
            for_each_view(ring, [&](std::size_t v) {
                if (sampled == 1) {
                    errors_[v] =
                        measure_coded_error(sources_[v], codec::plane_views(std::as_const(work_[v].reconstruction)),
                                            object_.width, object_.height, settings_.alpha_bits);
                }
                work_[v].reconstruction = {};
            });
        }
        train();
    }

    template <class Work>
    static void for_each_view(const Ring& ring, const Work& work) {
        for_each_index(ring.views.size(), [&](std::size_t n) { work(ring.views[n]); });
    }

    // Fills it with the source for a pass that does not code all tiles.
    void start_reconstruction(std::size_t v, bool with_source) {
        codec::Planes& reconstruction = work_[v].reconstruction;
        for (auto& plane : reconstruction) plane = Image<std::uint8_t>(coded_.coded_width(), coded_.coded_height());
        if (!with_source) return;
        for (std::size_t p = 0; p < 3; ++p) reconstruction[p] = sources_[v].planes[p];
        std::ranges::transform(sources_[v].alpha.pixels(), reconstruction[3].pixels().begin(), [&](int level) {
            return static_cast<std::uint8_t>(codec::alpha_of_level(level, settings_.alpha_bits));
        });
    }

    // Every `sampled`-th job of a level among those that have a task.
    void run_jobs(const std::vector<ImageTask>& tasks, const CostTable& costs, std::size_t level, std::size_t sampled) {
        std::vector<Job> jobs;
        for (std::size_t j = 0; j < jobs_[level].size(); j += sampled) {
            if (tasks[jobs_[level][j].view].source != nullptr) jobs.push_back(jobs_[level][j]);
        }
        for_each_index(jobs.size(), [&](std::size_t j) {
            const auto [v, t] = jobs[j];
            std::vector<Decision>& decisions = work_[v].decisions[t];
            decisions.clear();
            std::array<std::vector<MotionVector>, 2> motions;
            encode_tile(tasks[v], costs, codec::tile_rect(coded_, t), decisions, motions);
            decisions.shrink_to_fit();
            for (std::size_t r = 0; r < 2; ++r) work_[v].motions[r][t] = std::move(motions[r]);
            if (progress_ != nullptr) progress_->advance();
        });
    }

    // One task per view; tasks of other rings and levels stay empty.
    std::vector<ImageTask> tasks_of_level(const Ring& ring, int level, const UnitEffort& effort) {
        std::vector<ImageTask> tasks(work_.size());
        for (const std::size_t v : ring.views) {
            if (coded_.levels[v] != level) continue;
            ImageTask& task = tasks[v];
            task.code = &coded_.dense;
            task.head = coded_.images[v].head;
            task.source = &sources_[v];
            task.effort = effort;
            task.reach = work_[v].reach;
            const float step = static_cast<float>(codec::step_q4(task.head.step)) / 16.0F;
            task.lambda = settings_.lambda_factor * kPlaneWeights[0] * step * step;
            task.out = codec::plane_views(work_[v].reconstruction);
            for (std::size_t r = 0; r < static_cast<std::size_t>(task.head.references()); ++r) {
                task.references[r] = codec::plane_views(std::as_const(work_[task.head.reference[r]].reconstruction));
            }
        }
        return tasks;
    }

    void clear_absent_tiles(const std::vector<ImageTask>& tasks) {
        for (std::size_t v = 0; v < tasks.size(); ++v) {
            if (tasks[v].source == nullptr) continue;
            for (std::size_t t = 0; t < coded_.images[v].tiles.size(); ++t) {
                if (!coded_.images[v].tiles[t].present) codec::clear_tile(codec::tile_rect(coded_, t), tasks[v].out);
            }
        }
    }

    void set_global_motion(std::size_t v) {
        for (std::size_t r = 0; r < 2; ++r) {
            std::vector<std::int16_t> x;
            std::vector<std::int16_t> y;
            for (const auto& tile : work_[v].motions[r]) {
                for (const MotionVector m : tile) {
                    x.push_back(m.x);
                    y.push_back(m.y);
                }
            }
            coded_.images[v].head.global_motion[r] = {median(std::move(x)), median(std::move(y))};
        }
    }

    void train() {
        std::vector<std::array<std::uint64_t, 2>> counts(codec::context::kCount + 1);
        for (const DenseWorkImage& work : work_) {
            for (const auto& tile : work.decisions) {
                for (const Decision d : tile) ++counts[d >> 1U][d & 1U];
            }
        }
        for (std::size_t c = 0; c < coded_.dense.probabilities.size(); ++c) {
            const auto zeros = static_cast<double>(counts[c][0]);
            const auto all = zeros + static_cast<double>(counts[c][1]);
            const double zero = (zeros + 0.4) / (all + 0.8);
            coded_.dense.probabilities[c] =
                static_cast<std::uint16_t>(16 * std::clamp(std::lround(zero * 256), 1L, 255L));
        }
    }

    void write_tiles() {
        for_each_index(work_.size(), [&](std::size_t v) {
            CodedImage& image = coded_.images[v];
            for (std::size_t t = 0; t < image.tiles.size(); ++t) {
                if (!image.tiles[t].present) continue;
                codec::BoolEncoder encoder;
                codec::ContextStates states(coded_.dense);
                for (const Decision d : work_[v].decisions[t]) {
                    const int context = d >> 1;
                    if (context == codec::context::kCount) {
                        encoder.bit(d & 1, 2048);
                        continue;
                    }
                    encoder.bit(d & 1, states.probability(context));
                    states.adapt(context, d & 1);
                }
                const std::vector<std::byte> bytes = encoder.finish();
                image.tiles[t].begin = static_cast<std::uint32_t>(image.bytes.size());
                image.tiles[t].size = static_cast<std::uint32_t>(bytes.size());
                image.bytes.insert(image.bytes.end(), bytes.begin(), bytes.end());
            }
        });
    }

    const RaySpaceObject& object_;
    const std::vector<SourceImage>& sources_;
    const DenseSettings& settings_;
    Progress* progress_;
    CodedImages coded_;
    std::vector<DenseWorkImage> work_;
    std::vector<CodedError> errors_;  // [view]
    LevelJobs jobs_;
};

}  // namespace

EncodedImages encode_dense(const RaySpaceObject& object, const std::vector<SourceImage>& sources,
                           const DenseSettings& settings, Progress* progress) {
    return DenseEncoder(object, sources, settings, progress).encode();
}

codec::CodedImages encode_dense(const RaySpaceObject& object, const std::function<Image<Rgba8>(int)>& image,
                                const DenseSettings& settings, Progress* progress) {
    std::vector<SourceImage> sources(object.views.size());
    for_each_index(sources.size(),
                   [&](std::size_t v) { sources[v] = source_image(image(static_cast<int>(v)), settings.alpha_bits); });
    return encode_dense(object, sources, settings, progress).coded;
}

}  // namespace rs::encode
