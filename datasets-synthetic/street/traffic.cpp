#include "datasets-synthetic/street/traffic.hpp"

#include "datasets-synthetic/shapes/random.hpp"
#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace rs::synthetic {
namespace {

constexpr double kBegin_s = -60;
constexpr double kStep_s = 0.02;
constexpr double kAcceleration = 1.8;  // m/s^2
constexpr double kBraking = 3.0;       // comfortable
constexpr double kHardBraking = 7.0;
constexpr double kGap_m = 2.2;        // between stopped vehicles
constexpr double kStopLine_m = 12.3;  // before the centre of the crossing
constexpr double kAllRed_s = 3;       // from green of one street to green of the other
constexpr double kAmber_s = 1.5;      // part of it

struct Driver {
    const VehicleModel* model = nullptr;
    double along_m = 0;  // position of its centre relative to the centre of the crossing
    double speed_mps = 0;
    double wish_mps = 10;
    std::size_t source = 0;
    int number = 0;  // index within its source
};

bool is_main(Lane lane) {
    return lane == Lane::kEast || lane == Lane::kWest;
}

double reach(Lane lane) {
    return is_main(lane) ? kMainReach_m : kCrossReach_m;
}

bool is_green(const Scenario& scenario, bool main, double seconds) {
    const double period = scenario.main_green_s + scenario.cross_green_s + 2 * kAllRed_s;
    const double phase = seconds - std::floor(seconds / period) * period;
    if (main) return phase < scenario.main_green_s;
    const double begin = scenario.main_green_s + kAllRed_s;
    return phase >= begin && phase < begin + scenario.cross_green_s;
}

SignalColour signal_at(const Scenario& scenario, bool main, double seconds) {
    if (is_green(scenario, main, seconds)) return SignalColour::kGreen;
    return is_green(scenario, main, seconds - kAmber_s) ? SignalColour::kAmber : SignalColour::kRed;
}

VehiclePose place_of(const Driver& driver, Lane lane) {
    const double a = driver.along_m;
    constexpr double o = kLaneOffset_m;
    switch (lane) {
        case Lane::kEast:
            return {driver.model->name, {a, 0, o}, 0};
        case Lane::kWest:
            return {driver.model->name, {-a, 0, -o}, 180};
        case Lane::kNorth:
            return {driver.model->name, {o, 0, -a}, 90};
        case Lane::kSouth:
            break;
    }
    return {driver.model->name, {-o, 0, a}, -90};
}

glm::dvec3 direction_of(Lane lane) {
    switch (lane) {
        case Lane::kEast:
            return {1, 0, 0};
        case Lane::kWest:
            return {-1, 0, 0};
        case Lane::kNorth:
            return {0, 0, -1};
        case Lane::kSouth:
            break;
    }
    return {0, 0, 1};
}

class Simulation {
public:
    explicit Simulation(const Scenario& scenario) : scenario_(scenario), entered_(scenario.sources.size()) {
        for (std::size_t i = 0; i < scenario.sources.size(); ++i) chances_.emplace_back(scenario.seed, i);
    }

    void advance_to(double seconds) {
        while (now_ + kStep_s / 2 < seconds) step();
        since_step_s_ = seconds - now_;
    }

    [[nodiscard]] TrafficFrame frame(const StreetView& view) const {
        TrafficFrame frame;
        frame.view = view;
        frame.main_signal = signal_at(scenario_, true, now_);
        frame.cross_signal = signal_at(scenario_, false, now_);
        for (std::size_t lane = 0; lane < 4; ++lane) {
            for (const Driver& driver : lanes_.at(lane)) {
                // Frames between steps: without this, 30 frames per second would advance by one or two steps in turn.
                Driver moved = driver;
                moved.along_m += std::max(driver.speed_mps, 0.0) * since_step_s_;
                const VehiclePose place = place_of(moved, static_cast<Lane>(lane));
                if (scenario_.ride && driver.source == *scenario_.ride && driver.number == 0) {
                    const glm::dvec3 ahead = direction_of(static_cast<Lane>(lane));
                    frame.view.eye = place.place + 0.35 * ahead + glm::dvec3(0, 1.45, 0);
                    frame.view.at = frame.view.eye + 20.0 * ahead - glm::dvec3(0, 0.6, 0);
                } else {
                    frame.vehicles.push_back(place);
                }
            }
        }
        return frame;
    }

private:
    void enter() {
        for (std::size_t i = 0; i < scenario_.sources.size(); ++i) {
            const TrafficSource& source = scenario_.sources[i];
            int& entered = entered_[i];
            if (entered >= source.count || now_ < source.first_s + source.every_s * entered) continue;
            std::vector<Driver>& lane = lanes_.at(static_cast<std::size_t>(source.lane));
            Driver driver;
            driver.along_m = -reach(source.lane);
            // Waits until the road is free.
            if (!lane.empty() && lane.back().along_m - driver.along_m < 14) continue;
            std::vector<const VehicleModel*> fitting;
            for (const VehicleModel& model : vehicle_models()) {
                const bool any = source.vehicle == Vehicle::kAny && model.kind != Vehicle::kBus;
                if (any || model.kind == source.vehicle) fitting.push_back(&model);
            }
            Random& chance = chances_[i];
            driver.model = fitting[static_cast<std::size_t>(chance.below(static_cast<int>(fitting.size())))];
            driver.wish_mps = source.speed_mps * static_cast<double>(chance.uniform(0.9F, 1.1F));
            driver.speed_mps = driver.wish_mps;
            driver.source = i;
            driver.number = entered++;
            lane.push_back(driver);
        }
    }

    void step() {
        enter();
        for (std::size_t l = 0; l < 4; ++l) {
            const auto lane = static_cast<Lane>(l);
            const bool green = is_green(scenario_, is_main(lane), now_);
            std::optional<Driver> ahead;
            for (Driver& driver : lanes_.at(l)) {
                const double half = driver.model->length_m / 2;
                double gap = 1e9;
                if (ahead) gap = ahead->along_m - ahead->model->length_m / 2 - driver.along_m - half - kGap_m;
                const double to_line = -kStopLine_m - driver.along_m - half;
                // Vehicles that can no longer stop continue.
                const bool can_stop = to_line > driver.speed_mps * driver.speed_mps / (2 * kHardBraking) - 0.1;
                if (!green && to_line > -0.5 && can_stop) gap = std::min(gap, to_line);
                drive(driver, gap);
                ahead = driver;
            }
            std::erase_if(lanes_.at(l), [&](const Driver& driver) { return driver.along_m > reach(lane); });
        }
        now_ = kBegin_s + kStep_s * ++steps_;
    }

    static void drive(Driver& driver, double gap) {
        const double safe = gap > 0 ? std::sqrt(2 * kBraking * gap) : 0;
        const double wish = std::min(driver.wish_mps, safe);
        driver.speed_mps += std::clamp(wish - driver.speed_mps, -kHardBraking * kStep_s, kAcceleration * kStep_s);
        driver.along_m += std::max(driver.speed_mps, 0.0) * kStep_s;
    }

    const Scenario& scenario_;
    std::array<std::vector<Driver>, 4> lanes_;  // sorted from front to back
    std::vector<int> entered_;
    std::vector<Random> chances_;
    double now_ = kBegin_s;
    double since_step_s_ = 0;  // of the frame, from now_
    int steps_ = 0;
};

// Catmull-Rom interpolation of the views.
StreetView view_along(const std::vector<StreetView>& path, double share) {
    if (path.empty()) return {{-44, 1.9, 5.6}, {0, 2, 0}};
    const double at = share * static_cast<double>(path.size() - 1);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(path.size() - 1)));
    const double t = at - static_cast<double>(i);
    const auto key = [&](std::ptrdiff_t k) -> const StreetView& {
        const auto last = static_cast<std::ptrdiff_t>(path.size()) - 1;
        return path[static_cast<std::size_t>(std::clamp(static_cast<std::ptrdiff_t>(i) + k, std::ptrdiff_t{0}, last))];
    };
    const auto smooth = [&](const auto& of) {
        const glm::dvec3 a = of(key(-1));
        const glm::dvec3 b = of(key(0));
        const glm::dvec3 c = of(key(1));
        const glm::dvec3 d = of(key(2));
        return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t) +
                      (3.0 * b - a - 3.0 * c + d) * (t * t * t));
    };
    return {smooth([](const StreetView& v) { return v.eye; }), smooth([](const StreetView& v) { return v.at; })};
}

}  // namespace

const std::vector<VehicleModel>& vehicle_models() {
    static const std::vector<VehicleModel> kModels = {
        {"car_red", Vehicle::kHatchback, 4.1},    {"car_blue", Vehicle::kHatchback, 4.1},
        {"car_white", Vehicle::kHatchback, 4.1},  {"car_black", Vehicle::kHatchback, 4.1},
        {"car_silver", Vehicle::kHatchback, 4.1}, {"car_yellow", Vehicle::kHatchback, 4.1},
        {"van_white", Vehicle::kVan, 5.2},        {"van_green", Vehicle::kVan, 5.2},
        {"bus_red", Vehicle::kBus, 10.5}};
    return kModels;
}

std::vector<TrafficFrame> simulate_traffic(const Scenario& scenario) {
    Simulation simulation(scenario);
    std::vector<TrafficFrame> frames;
    const int count = std::max(static_cast<int>(std::lround(scenario.seconds * scenario.frames_per_second)), 1);
    for (int i = 0; i < count; ++i) {
        simulation.advance_to(i / scenario.frames_per_second);
        frames.push_back(simulation.frame(view_along(scenario.path, count > 1 ? i / (count - 1.0) : 0)));
    }
    return frames;
}

}  // namespace rs::synthetic
