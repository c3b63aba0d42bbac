#pragma once
// Frame times in total and by part, and the durations for which objects were missing.

#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::compositor {

/// Tracing of one frame before it is drawn.
struct TracingWork {
    double seconds = 0;
    int passes = 0;
};

class FrameTimes {
public:
    /// Updates the showroom for the camera's position, draws, and measures both. The times of parts do not overlap only
    /// with FrameOptions::time_parts.
    /// \param seconds since the previous frame
    /// \param traced is counted in the frame's time, too
    Status draw(Showroom& showroom, FrameCompositor& compositor, const Camera& camera, double seconds,
                const TracingWork& traced = {});

    [[nodiscard]] std::size_t frames() const { return frames_ms_.size(); }
    [[nodiscard]] double median_ms() const;
    [[nodiscard]] double longest_ms() const;

    /// A period in which a node was in view without its object.
    struct Missing {
        std::size_t node = 0;
        double seconds = 0;
    };
    [[nodiscard]] std::vector<Missing> missing() const;

    /// {"frames", "median_ms", "p95_ms", "longest_ms", "median_parts_ms": {"tracing", "geometry", "engine",
    /// "engine_wait", "upload", "composite"}, "passes" of all frames, "objects_per_frame", "engine_pixels_per_frame",
    /// "views_by_core", "views_by_board", "missing": {"times", "longest_ms"}, "memory": {"loads", "evictions",
    /// "failures", "budget_bytes", "peak_bytes", "longest_load_ms"}}
    [[nodiscard]] std::string to_json(const Showroom& showroom) const;

private:
    void update_missing(const FrameStatistics& statistics);

    std::vector<double> frames_ms_;
    std::vector<double> tracing_ms_;
    std::vector<double> geometry_ms_;
    std::vector<double> engine_ms_;
    std::vector<double> engine_wait_ms_;
    std::vector<double> upload_ms_;
    std::vector<double> composite_ms_;
    std::int64_t passes_ = 0;
    std::int64_t pixels_ = 0;
    std::int64_t nodes_ = 0;
    std::int64_t nodes_by_board_ = 0;
    using Clock = std::chrono::steady_clock;
    std::vector<Clock::time_point> missing_since_;  // [node]; epoch: not missing
    std::vector<Missing> missing_;                  // completed periods
};

}  // namespace rs::compositor
