#include "encode/report/build_report.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/page/plots.hpp"
#include "rayspace/page/svg_parts.hpp"

#include <algorithm>
#include <cmath>

namespace rs::encode {
namespace {

constexpr double kSide_px = 340;
constexpr double kMargin_px = 26;
constexpr int kColours = 5;

double azimuth_rad(const glm::dvec3& centre) {
    const double angle = std::atan2(centre.x, centre.z);
    // As in find_rings, tiny negative angles count as zero.
    return angle < -1e-9 ? angle + 2 * kPi : std::max(angle, 0.0);
}

std::vector<double> azimuths_of(const Rig& rig, const ViewRing& ring) {
    std::vector<double> azimuths;
    for (const int view : ring.views) {
        azimuths.push_back(azimuth_rad(rig.views[static_cast<std::size_t>(view)].camera.centre()));
    }
    return azimuths;
}

// Maps (x, z) of the object frame to the plan's pixels.
struct Plan {
    double px_per_unit = 1;
    [[nodiscard]] std::string at(double x, double z) const {
        return two_decimals(kSide_px / 2 + x * px_per_unit) + " " + two_decimals(kSide_px / 2 + z * px_per_unit);
    }
    [[nodiscard]] std::string polar(double radius, double angle_rad) const {
        return at(radius * std::sin(angle_rad), radius * std::cos(angle_rad));
    }
};

std::string wedge(const Plan& plan, const MissingSector& sector, double inner, double outer) {
    const std::string large = sector.to_rad - sector.from_rad > kPi ? "1" : "0";
    const auto arc = [&](double radius, const char* sweep, double to) {
        const std::string r = two_decimals(radius * plan.px_per_unit);
        return "A" + r + " " + r + " 0 " + large + " " + sweep + " " + plan.polar(radius, to);
    };
    // Angles grow counterclockwise on the plan, which is SVG's sweep 0.
    return "<path d=\"M" + plan.polar(inner, sector.from_rad) + "L" + plan.polar(outer, sector.from_rad) +
           arc(outer, "0", sector.to_rad) + "L" + plan.polar(inner, sector.to_rad) + arc(inner, "1", sector.from_rad) +
           "Z\" style=\"fill:var(--bad);fill-opacity:.25;stroke:var(--bad)\"/>\n";
}

std::string camera_mark(const Plan& plan, const Camera& camera, double size, const std::string& colour) {
    const glm::dvec3 centre = camera.centre();
    const glm::dvec3 ahead = camera.forward() * (size * 1.6);
    const glm::dvec3 aside = camera.right() * (size * 0.7);
    const auto corner = [&](const glm::dvec3& p) { return plan.at(p.x, p.z); };
    return "<path d=\"M" + corner(centre) + "L" + corner(centre + ahead + aside) + "L" +
           corner(centre + ahead - aside) + "Z\" style=\"fill:" + colour + "\"/>\n";
}

}  // namespace

std::vector<MissingSector> find_missing_sectors(const std::vector<double>& azimuths_rad) {
    const std::size_t count = azimuths_rad.size();
    if (count < 3) return {};
    std::vector<double> steps;
    for (std::size_t n = 0; n < count; ++n) {
        const double next = n + 1 < count ? azimuths_rad[n + 1] : azimuths_rad[0] + 2 * kPi;
        steps.push_back(next - azimuths_rad[n]);
    }
    const double usual = median(steps);
    std::vector<MissingSector> missing;
    for (std::size_t n = 0; n < count; ++n) {
        if (steps[n] > 1.75 * usual) missing.push_back({azimuths_rad[n], azimuths_rad[n] + steps[n]});
    }
    return missing;
}

std::string draw_ring_plan(const Rig& rig) {
    double farthest = rig.object_radius;
    for (const RigView& view : rig.views) {
        farthest = std::max(farthest, std::hypot(view.camera.centre().x, view.camera.centre().z));
    }
    const Plan plan{(kSide_px / 2 - kMargin_px) / std::max(farthest, 1e-9)};
    const std::string side = two_decimals(kSide_px);
    const std::string middle = two_decimals(kSide_px / 2);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"" + side + "\" height=\"" + side +
                      "\" viewBox=\"0 0 " + side + " " + side + "\">\n<title>The cameras from above</title>\n" +
                      "<circle cx=\"" + middle + "\" cy=\"" + middle + "\" r=\"" +
                      two_decimals(rig.object_radius * plan.px_per_unit) +
                      "\" style=\"fill:var(--tile);stroke:var(--faint)\"/>\n";
    const std::vector<ViewRing> rings = find_rings(rig);
    for (std::size_t r = 0; r < rings.size(); ++r) {
        double radius = 0;
        for (const int view : rings[r].views) {
            const glm::dvec3 centre = rig.views[static_cast<std::size_t>(view)].camera.centre();
            radius += std::hypot(centre.x, centre.z) / static_cast<double>(rings[r].views.size());
        }
        for (const MissingSector& sector : find_missing_sectors(azimuths_of(rig, rings[r]))) {
            svg += wedge(plan, sector, std::min(rig.object_radius, radius), radius);
        }
        const std::string colour = "var(--s" + std::to_string(r % kColours) + ")";
        for (const int view : rings[r].views) {
            svg += camera_mark(plan, rig.views[static_cast<std::size_t>(view)].camera, farthest / 28, colour);
        }
    }
    svg += "<text x=\"" + middle + "\" y=\"" + two_decimals(kSide_px - 6) + "\" text-anchor=\"middle\">+Z</text>\n";
    svg += "<text x=\"" + two_decimals(kSide_px - 6) + "\" y=\"" + two_decimals(kSide_px / 2 + 4) +
           "\" text-anchor=\"end\">+X</text>\n";
    return svg + "</svg>";
}

std::vector<std::string> describe_missing_sectors(const Rig& rig) {
    std::vector<std::string> lines;
    const std::vector<ViewRing> rings = find_rings(rig);
    for (std::size_t r = 0; r < rings.size(); ++r) {
        for (const MissingSector& sector : find_missing_sectors(azimuths_of(rig, rings[r]))) {
            lines.push_back("from " + two_decimals(degrees(sector.from_rad)) + " to " +
                            two_decimals(degrees(sector.to_rad)) + " degrees (ring " + std::to_string(r + 1) + ")");
        }
    }
    return lines;
}

}  // namespace rs::encode
