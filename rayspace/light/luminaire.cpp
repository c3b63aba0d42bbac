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

BeamSpread beam_spread(const PhotometricWeb& web, double horizontal_deg) {
    constexpr int kSteps = 18000;  // 0.01 degrees
    const auto angle = [](int step) { return kPi * step / kSteps; };
    double peak = 0;
    for (int step = -kSteps; step <= kSteps; ++step) {
        peak = std::max(peak, candela_in_plane(web, horizontal_deg, angle(step)));
    }
    const auto spread = [&](double share) {
        if (!(peak > 0)) return 0.0;
        int low = -kSteps, high = kSteps;
        while (low < 0 && candela_in_plane(web, horizontal_deg, angle(low)) < share * peak) ++low;
        while (high > 0 && candela_in_plane(web, horizontal_deg, angle(high)) < share * peak) --high;
        return angle(high) - angle(low);
    };
    return {spread(0.5), spread(0.1)};
}

}  // namespace rs
