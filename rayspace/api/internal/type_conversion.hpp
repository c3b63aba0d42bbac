#pragma once
// Conversions between the types of the public headers and those of the library: cameras and progress.

#include "rayspace/api/builder.hpp"
#include "rayspace/api/camera.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/geometry/rig.hpp"

#include <algorithm>
#include <mutex>

namespace rs::api {

rs::Camera to_internal(const Camera& camera);
Camera to_public(const rs::Camera& camera);
std::vector<CapturedCamera> cameras_of(const Rig& rig);

/// Reports the progress of the library's own functions to a ProgressCallback.
class ProgressAdapter final : public Progress {
public:
    explicit ProgressAdapter(const ProgressCallback& callback) : callback_(callback) {}

    void start(const std::string& label, std::int64_t total) override {
        const std::lock_guard lock(mutex_);
        stage_ = label;
        total_ = total;
        done_ = 0;
        report();
    }
    void advance(std::int64_t steps) override {
        const std::lock_guard lock(mutex_);
        done_ += steps;
        report();
    }
    void finish() override {}

private:
    void report() const {
        if (!callback_ || total_ <= 0) return;
        // Totals may be estimates.
        callback_(stage_, std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_)));
    }

    const ProgressCallback& callback_;
    std::mutex mutex_;
    std::string stage_;
    std::int64_t total_ = 0;
    std::int64_t done_ = 0;
};

}  // namespace rs::api
