#include "encode/report/stage_clock.hpp"

#include <algorithm>

namespace rs::encode {

void StageClock::start(const std::string& label, std::int64_t total) {
    record();
    label_ = label;
    begun_ = Clock::now();
    shown_.start(label, total);
}

void StageClock::finish() {
    record();
    shown_.finish();
}

void StageClock::record() {
    if (!begun_) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - *begun_).count();
    begun_.reset();
    const auto known =
        std::find_if(stages_.begin(), stages_.end(), [&](const StageTime& stage) { return stage.name == label_; });
    if (known != stages_.end()) {
        known->seconds += seconds;
    } else {
        stages_.push_back({label_, seconds});
    }
}

}  // namespace rs::encode
