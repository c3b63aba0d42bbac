#pragma once
// A Progress that passes everything on and notes how long each stage took.

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

// start() and finish() from one thread, advance() from any, as Progress states. Time between a stage's end and the next
// one's start belongs to neither. A stage that comes again is added to its first time.
class StageClock final : public Progress {
public:
    explicit StageClock(Progress& shown) : shown_(shown) {}
    void start(const std::string& label, std::int64_t total) override;
    void advance(std::int64_t steps = 1) override { shown_.advance(steps); }
    void finish() override;

    // In the order in which they began; the one that runs is not in it.
    [[nodiscard]] const std::vector<StageTime>& stages() const { return stages_; }

private:
    using Clock = std::chrono::steady_clock;
    void note();

    Progress& shown_;
    std::vector<StageTime> stages_;
    std::string label_;
    std::optional<Clock::time_point> begun_;
};

}  // namespace rs::encode
