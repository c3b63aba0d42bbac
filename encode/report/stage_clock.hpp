#pragma once
// Progress decorator that measures the duration of each stage.

#include "rayspace/base/progress.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace rs::encode {

struct StageTime {
    std::string name;
    double seconds = 0;
};

/// Threads as in Progress: start() and finish() from one thread, advance() from any. Time between a stage's end and the
/// next start is not counted. The time of a repeated stage is added to its first entry.
class StageClock final : public Progress {
public:
    explicit StageClock(Progress& shown) : shown_(shown) {}
    void start(const std::string& label, std::int64_t total) override;
    void advance(std::int64_t steps = 1) override { shown_.advance(steps); }
    void finish() override;

    /// Finished stages, in the order of their first start.
    [[nodiscard]] const std::vector<StageTime>& stages() const { return stages_; }

private:
    using Clock = std::chrono::steady_clock;
    void record();

    Progress& shown_;
    std::vector<StageTime> stages_;
    std::string label_;
    std::optional<Clock::time_point> begun_;
};

}  // namespace rs::encode
