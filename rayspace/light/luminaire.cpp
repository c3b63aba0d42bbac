#include "rayspace/light/luminaire.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs {

const char* name_of(OpeningShape shape) {
    constexpr std::array kNames = {"point",           "rectangle",      "box",      "disc", "cylinder",
                                   "cylinder across", "cylinder along", "ellipsoid"};
    return kNames.at(static_cast<std::size_t>(shape));
}

double TiltTable::factor(double tilt_deg) const {
    if (angles_deg.empty()) return 1;
    const auto above = std::upper_bound(angles_deg.begin(), angles_deg.end(), tilt_deg);
    if (above == angles_deg.begin()) return factors.front();
    if (above == angles_deg.end()) return factors.back();
    const auto i = static_cast<std::size_t>(above - angles_deg.begin());
    const double share = (tilt_deg - angles_deg[i - 1]) / (angles_deg[i] - angles_deg[i - 1]);
    return (1 - share) * factors[i - 1] + share * factors[i];
}

const std::string& Luminaire::keyword(std::string_view name) const {
    static const std::string kNone;
    const auto found = std::ranges::find_if(keywords, [&](const auto& entry) { return entry.first == name; });
    return found == keywords.end() ? kNone : found->second;
}

double candela_in_plane(const PhotometricWeb& web, double horizontal_deg, double angle_rad) {
    const double h = radians(horizontal_deg);
    const double across = std::sin(angle_rad);
    return web.candela({across * std::cos(h), -std::cos(angle_rad), -across * std::sin(h)});
}

BeamSpread beam_spread(const PhotometricWeb& web, double horizontal_deg, BeamPart part) {
    constexpr double kStep_rad = kPi / 18000;  // 0.01 degrees
    const int steps = part == BeamPart::kWhole ? 18000 : 9000;
    const auto candela = [&](int step) {
        const double angle = kStep_rad * step;
        return candela_in_plane(web, horizontal_deg, part == BeamPart::kOpposite ? kPi - angle : angle);
    };
    double peak = 0;
    for (int step = -steps; step <= steps; ++step) peak = std::max(peak, candela(step));
    const auto spread = [&](double share) {
        if (!(peak > 0)) return 0.0;
        int low = -steps, high = steps;
        while (low < 0 && candela(low) < share * peak) ++low;
        while (high > 0 && candela(high) < share * peak) --high;
        return kStep_rad * (high - low);
    };
    return {spread(0.5), spread(0.1)};
}

bool is_direct_indirect(const PhotometricWeb& web) {
    constexpr int kPolarSteps = 180, kAzimuthSteps = 72;
    double down = 0, up = 0;
    for (int polar = 0; polar < kPolarSteps; ++polar) {
        const double angle = kPi * (polar + 0.5) / kPolarSteps;
        double ring = 0;
        for (int step = 0; step < kAzimuthSteps; ++step) {
            ring += candela_in_plane(web, 360.0 * step / kAzimuthSteps, angle);
        }
        (2 * polar < kPolarSteps ? down : up) += ring * std::sin(angle);
    }
    return std::min(down, up) >= 0.1 * (down + up);
}

}  // namespace rs
