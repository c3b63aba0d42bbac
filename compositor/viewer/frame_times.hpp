#pragma once
// How long frames take, all in all and by part.

#include "compositor/viewer/frame_compositor.hpp"
#include "rayspace/camera.hpp"
#include "rayspace/result.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rs::compositor {

class FrameTimes {
public:
    // Draws a frame and takes its time. Parts are its own only with FrameOptions::time_parts.
    Status draw(FrameCompositor& compositor, const Camera& camera);

    // {"frames", "median_ms", "p95_ms", "longest_ms", "median_parts_ms": {"geometry", "engine", "upload", "composite"},
    // "objects_per_frame", "engine_pixels_per_frame"}
    [[nodiscard]] std::string to_json() const;

private:
    std::vector<double> frames_ms_;
    std::vector<double> geometry_ms_;
    std::vector<double> engine_ms_;
    std::vector<double> upload_ms_;
    std::vector<double> composite_ms_;
    std::int64_t pixels_ = 0;
    std::int64_t nodes_ = 0;
};

}  // namespace rs::compositor
