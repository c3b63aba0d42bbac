#include "compositor/farm/work/timed_job.hpp"

#include <chrono>

namespace rs::farm {
namespace {

class TimedJob final : public Job {
public:
    explicit TimedJob(double seconds) : seconds_(seconds) {}
    std::optional<Outcome> poll() override {
        const double gone_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
        if (gone_s < seconds_) return std::nullopt;
        return Outcome{.state = State::kMade, .seconds = gone_s};
    }

private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    double seconds_;
};

}  // namespace

std::vector<Item> timed_items(int count, double seconds) {
    std::vector<Item> items;
    for (int i = 0; i < count; ++i) {
        items.push_back({.name = std::to_string(i),
                         .size = static_cast<double>(count - i),
                         .memory_bytes = 0,
                         .after = {},
                         .order = {{"seconds", seconds}}});
    }
    return items;
}

BeginJob begin_timed_jobs() {
    return [](const nlohmann::json& order, const Outcome* /*record*/) {
        return std::make_unique<TimedJob>(order.at("seconds").get<double>());
    };
}

}  // namespace rs::farm
