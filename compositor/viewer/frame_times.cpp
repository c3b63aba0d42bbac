#include "compositor/viewer/frame_times.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace rs::compositor {
namespace {

// Quantile, `share` in 0 .. 1; 0 if there are no values.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

}  // namespace

Status FrameTimes::draw(Showroom& showroom, FrameCompositor& compositor, const Camera& camera, double seconds,
                        const TracingWork& traced) {
    const auto begin = Clock::now();
    RS_TRY(showroom.update(camera.centre(), seconds));
    RS_TRY(compositor.draw(camera));
    frames_ms_.push_back(1e3 * (traced.seconds + std::chrono::duration<double>(Clock::now() - begin).count()));
    tracing_ms_.push_back(1e3 * traced.seconds);
    passes_ += traced.passes;
    const FrameStatistics& statistics = compositor.statistics();
    geometry_ms_.push_back(1e3 * statistics.geometry_s);
    engine_ms_.push_back(1e3 * statistics.engine_s);
    engine_wait_ms_.push_back(1e3 * statistics.engine_wait_s);
    upload_ms_.push_back(1e3 * statistics.upload_s);
    composite_ms_.push_back(1e3 * statistics.composite_s);
    pixels_ += statistics.pixels_rendered;
    nodes_ += statistics.nodes_rendered;
    nodes_by_board_ += statistics.nodes_by_board;
    update_missing(statistics);
    return {};
}

void FrameTimes::update_missing(const FrameStatistics& statistics) {
    missing_since_.resize(statistics.nodes.size());
    for (std::size_t i = 0; i < statistics.nodes.size(); ++i) {
        Clock::time_point& since = missing_since_[i];
        const bool was_missing = since != Clock::time_point();
        if (statistics.nodes[i].missing && !was_missing) since = Clock::now();
        if (statistics.nodes[i].missing || !was_missing) continue;
        missing_.push_back({i, std::chrono::duration<double>(Clock::now() - since).count()});
        since = {};
    }
}

std::vector<FrameTimes::Missing> FrameTimes::missing() const {
    std::vector<Missing> all = missing_;
    for (std::size_t i = 0; i < missing_since_.size(); ++i) {
        if (missing_since_[i] == Clock::time_point()) continue;
        all.push_back({i, std::chrono::duration<double>(Clock::now() - missing_since_[i]).count()});
    }
    return all;
}

double FrameTimes::median_ms() const {
    return quantile(frames_ms_, 0.5);
}

double FrameTimes::longest_ms() const {
    return quantile(frames_ms_, 1);
}

std::string FrameTimes::to_json(const Showroom& showroom) const {
    const auto frames = static_cast<double>(std::max<std::size_t>(frames_ms_.size(), 1));
    const CacheStatistics store = showroom.statistics();
    const std::vector<Missing> gaps = missing();
    double longest_gap_s = 0;
    for (const Missing& gap : gaps) longest_gap_s = std::max(longest_gap_s, gap.seconds);
    const nlohmann::json json{{"frames", frames_ms_.size()},
                              {"median_ms", median_ms()},
                              {"p95_ms", quantile(frames_ms_, 0.95)},
                              {"longest_ms", longest_ms()},
                              {"median_parts_ms",
                               {{"tracing", quantile(tracing_ms_, 0.5)},
                                {"geometry", quantile(geometry_ms_, 0.5)},
                                {"engine", quantile(engine_ms_, 0.5)},
                                {"engine_wait", quantile(engine_wait_ms_, 0.5)},
                                {"upload", quantile(upload_ms_, 0.5)},
                                {"composite", quantile(composite_ms_, 0.5)}}},
                              {"passes", passes_},
                              {"objects_per_frame", static_cast<double>(nodes_) / frames},
                              {"engine_pixels_per_frame", static_cast<double>(pixels_) / frames},
                              {"views_by_core", nodes_ - nodes_by_board_},
                              {"views_by_board", nodes_by_board_},
                              {"missing", {{"times", gaps.size()}, {"longest_ms", 1e3 * longest_gap_s}}},
                              {"memory",
                               {{"loads", store.loads},
                                {"evictions", store.evictions},
                                {"failures", store.failures},
                                {"budget_bytes", store.budget_bytes},
                                {"peak_bytes", store.peak_bytes},
                                {"longest_load_ms", 1e3 * store.longest_load_s}}}};
    return json.dump(2) + "\n";
}

}  // namespace rs::compositor
