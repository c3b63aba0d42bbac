#include "compositor/viewer/frame_times.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace rs::compositor {
namespace {

// The value that `share` of all are not above; 0 of none.
double at_share(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

}  // namespace

Status FrameTimes::draw(FrameCompositor& compositor, const Camera& camera) {
    const auto begin = std::chrono::steady_clock::now();
    if (Status status = compositor.draw(camera); !status) return status;
    frames_ms_.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    const FrameStatistics& statistics = compositor.statistics();
    geometry_ms_.push_back(1e3 * statistics.geometry_s);
    engine_ms_.push_back(1e3 * statistics.engine_s);
    upload_ms_.push_back(1e3 * statistics.upload_s);
    composite_ms_.push_back(1e3 * statistics.composite_s);
    pixels_ += statistics.pixels_rendered;
    nodes_ += statistics.nodes_rendered;
    return {};
}

std::string FrameTimes::to_json() const {
    const auto frames = static_cast<double>(std::max<std::size_t>(frames_ms_.size(), 1));
    const nlohmann::json json{{"frames", frames_ms_.size()},
                              {"median_ms", at_share(frames_ms_, 0.5)},
                              {"p95_ms", at_share(frames_ms_, 0.95)},
                              {"longest_ms", at_share(frames_ms_, 1)},
                              {"median_parts_ms",
                               {{"geometry", at_share(geometry_ms_, 0.5)},
                                {"engine", at_share(engine_ms_, 0.5)},
                                {"upload", at_share(upload_ms_, 0.5)},
                                {"composite", at_share(composite_ms_, 0.5)}}},
                              {"objects_per_frame", static_cast<double>(nodes_) / frames},
                              {"engine_pixels_per_frame", static_cast<double>(pixels_) / frames}};
    return json.dump(2) + "\n";
}

}  // namespace rs::compositor
