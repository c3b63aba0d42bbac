#include "rayspace/light/photometric_web.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace rs {
namespace {

constexpr double kAngleTolerance_deg = 1e-6;

bool is_angle(double found, double target) {
    return std::abs(found - target) <= kAngleTolerance_deg;
}

std::string format_number(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

Status check_angles(const std::vector<double>& angles, const std::string& name, double least, double most) {
    if (angles.empty()) return Error{"there are no " + name + " angles"};
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const std::string subject = name + " angle " + std::to_string(i + 1) + " is " + format_number(angles[i]);
        if (!(angles[i] >= least - kAngleTolerance_deg && angles[i] <= most + kAngleTolerance_deg)) {
            return Error{subject + "; it must be " + format_number(least) + ".." + format_number(most)};
        }
        if (i > 0 && !(angles[i] > angles[i - 1])) {
            return Error{subject + ", after " + format_number(angles[i - 1]) + "; angles must ascend"};
        }
    }
    return {};
}

Status check_table(const PhotometricTable& table) {
    const std::size_t most = PhotometricWeb::kMaxAngles;
    for (const std::size_t count : {table.vertical_deg.size(), table.horizontal_deg.size()}) {
        if (count > most) {
            return Error{"has " + std::to_string(count) + " angles; " + std::to_string(most) + " are allowed"};
        }
    }
    if (table.vertical_deg.size() < 2) return Error{"needs at least 2 vertical angles"};
    if (table.candela.size() != table.vertical_deg.size() * table.horizontal_deg.size() ||
        table.candela.size() > PhotometricWeb::kMaxValues) {
        return Error{"has " + std::to_string(table.candela.size()) + " values for " +
                     std::to_string(table.vertical_deg.size()) + " by " + std::to_string(table.horizontal_deg.size()) +
                     " angles; at most " + std::to_string(PhotometricWeb::kMaxValues) + " are allowed"};
    }
    const bool round = table.type == Goniometer::kTypeC;
    if (Status fine = check_angles(table.vertical_deg, "vertical", round ? 0 : -90, round ? 180 : 90); !fine) {
        return fine;
    }
    if (Status fine = check_angles(table.horizontal_deg, "horizontal", round ? 0 : -90, round ? 360 : 90); !fine) {
        return fine;
    }
    for (const double value : table.candela) {
        if (!std::isfinite(value) || value < 0)
            return Error{"an intensity is " + format_number(value) + "; it must be 0 or more"};
    }
    if (!round) return {};
    const double first = table.horizontal_deg.front();
    const double last = table.horizontal_deg.back();
    const bool known = (is_angle(first, 0) && (is_angle(last, 0) || is_angle(last, 90) || last >= 180)) ||
                       (is_angle(first, 90) && is_angle(last, 270));
    if (known) return {};
    return Error{"horizontal angles go from " + format_number(first) + " to " + format_number(last) +
                 "; they must end at 0, 90, 180 or 360, or go from 90 to 270"};
}

// A plane of the table, original or mirrored.
using Plane = std::pair<double, std::size_t>;  // angle in degrees, index in the table

// Expands the planes to 0..360 degrees by symmetry.
std::vector<Plane> planes_of_circle(const std::vector<double>& horizontal_deg) {
    std::vector<Plane> planes;
    for (std::size_t h = 0; h < horizontal_deg.size(); ++h) planes.emplace_back(horizontal_deg[h], h);
    const auto add_mirrored = [&planes](double about_deg) {
        const std::vector<Plane> given = planes;
        for (const auto& [angle, h] : given) {
            const double other = 2 * about_deg - angle;
            if (!is_angle(other, angle)) planes.emplace_back(other, h);
        }
        std::sort(planes.begin(), planes.end());
    };
    const double last = horizontal_deg.back();
    if (is_angle(last, 0)) return {{0.0, 0}, {360.0, 0}};
    if (is_angle(horizontal_deg.front(), 90)) {  // 90..270
        add_mirrored(270);                       // .. 450; planes beyond 360 are those before 90
        for (auto& [angle, h] : planes) {
            if (angle > 360 + kAngleTolerance_deg) angle -= 360;
        }
        std::sort(planes.begin(), planes.end());
        // The seam, which may lie between two planes, is inserted by create().
        return planes;
    }
    if (is_angle(last, 90)) add_mirrored(90);
    if (is_angle(last, 90) || is_angle(last, 180)) add_mirrored(180);
    if (last > 180 + kAngleTolerance_deg && !is_angle(last, 360)) planes.emplace_back(360.0, 0);
    return planes;
}

// Mirrors angles that start at 0 to negative ones.
std::vector<Plane> mirrored_angles(const std::vector<double>& angles_deg) {
    std::vector<Plane> all;
    for (std::size_t i = 0; i < angles_deg.size(); ++i) all.emplace_back(angles_deg[i], i);
    if (!is_angle(angles_deg.front(), 0)) return all;
    for (std::size_t i = 1; i < angles_deg.size(); ++i) all.emplace_back(-angles_deg[i], i);
    std::sort(all.begin(), all.end());
    return all;
}

// Index of the interval of `edges` that contains `value`, which must lie between their ends.
std::size_t interval(const std::vector<double>& edges, double value) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
    return static_cast<std::size_t>(above - edges.begin()) - 1;
}

// Integral of (i0 + (i1 - i0) (p - p0) / (p1 - p0)) sin p from p0 to p.
double column_integral(double p0, double p1, double i0, double i1, double p) {
    const double slope = (i1 - i0) / (p1 - p0);
    const double at_zero = i0 - slope * p0;
    const auto primitive = [&](double x) { return -at_zero * std::cos(x) + slope * (std::sin(x) - x * std::cos(x)); };
    return primitive(p) - primitive(p0);
}

// Argument in low..high at which a monotonic integral reaches `target`.
template <class Integral>
double invert(const Integral& integral, double target, double low, double high) {
    for (int step = 0; step < 52; ++step) {
        const double middle = 0.5 * (low + high);
        (integral(middle) < target ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

Result<PhotometricWeb> PhotometricWeb::create(const PhotometricTable& table) {
    RS_TRY(check_table(table));
    PhotometricWeb web;
    const std::size_t rows = table.vertical_deg.size();
    std::vector<Plane> azimuths, polars;
    if (table.type == Goniometer::kTypeC) {
        azimuths = planes_of_circle(table.horizontal_deg);
        for (std::size_t v = 0; v < rows; ++v) polars.emplace_back(table.vertical_deg[v], v);
    } else {
        web.zero_ = {0, -1, 0};
        azimuths = mirrored_angles(table.type == Goniometer::kTypeA ? table.horizontal_deg : table.vertical_deg);
        polars = mirrored_angles(table.type == Goniometer::kTypeA ? table.vertical_deg : table.horizontal_deg);
        std::reverse(polars.begin(), polars.end());
        for (auto& [angle, number] : polars) angle = 90 - angle;
        const glm::dvec3 across(1, 0, 0), upwards(0, 0, -1);
        web.axis_ = table.type == Goniometer::kTypeA ? upwards : across;
        web.quarter_ = table.type == Goniometer::kTypeA ? across : upwards;
        if (azimuths.size() < 2 || polars.size() < 2) return Error{"needs at least 2 angles of each kind"};
    }
    const bool transposed = table.type == Goniometer::kTypeB;
    for (const auto& [angle, number] : polars) web.polar_.push_back(std::clamp(radians(angle), 0.0, kPi));
    for (const auto& [angle, plane] : azimuths) {
        web.azimuth_.push_back(radians(angle));
        for (const auto& [polar, row] : polars) {
            web.candela_.push_back(transposed ? table.candela[row * rows + plane] : table.candela[plane * rows + row]);
        }
    }
    if (table.type == Goniometer::kTypeC) {
        // Closes the circle: 90..270 may have no plane at the seam.
        const auto put_seam = [&](bool front) {
            const double before = web.azimuth_.back() - 2 * kPi, after = web.azimuth_.front();
            const double share = (0 - before) / std::max(after - before, 1e-12);
            const std::size_t n = web.polar_.size();
            std::vector<double> seam(n);
            for (std::size_t p = 0; p < n; ++p) {
                seam[p] = (1 - share) * web.candela_[web.candela_.size() - n + p] + share * web.candela_[p];
            }
            web.azimuth_.insert(front ? web.azimuth_.begin() : web.azimuth_.end(), front ? 0.0 : 2 * kPi);
            web.candela_.insert(front ? web.candela_.begin() : web.candela_.end(), seam.begin(), seam.end());
        };
        const bool open_front = web.azimuth_.front() > radians(kAngleTolerance_deg);
        const bool open_back = web.azimuth_.back() < 2 * kPi - radians(kAngleTolerance_deg);
        if (open_front && open_back) {
            put_seam(true);
            web.azimuth_.push_back(2 * kPi);
            const std::vector<double> first(web.candela_.begin(),
                                            web.candela_.begin() + static_cast<std::ptrdiff_t>(web.polar_.size()));
            web.candela_.insert(web.candela_.end(), first.begin(), first.end());
        } else if (open_front || open_back) {
            put_seam(open_front);
        }
        web.azimuth_.front() = 0;
        web.azimuth_.back() = 2 * kPi;
        web.round_ = web.is_round();
    }
    web.accumulate();
    if (!(web.total_ > 0) || !std::isfinite(web.total_)) return Error{"has no light, or more than can be represented"};
    return web;
}

bool PhotometricWeb::is_round() const {
    const auto plane = static_cast<std::ptrdiff_t>(polar_.size());
    return std::equal(candela_.begin() + plane, candela_.end(),
                      candela_.begin());  // each plane equals the previous one
}

void PhotometricWeb::accumulate() {
    peak_ = *std::max_element(candela_.begin(), candela_.end());
    for (std::size_t a = 0; a + 1 < azimuth_.size(); ++a) {
        for (std::size_t p = 0; p + 1 < polar_.size(); ++p) {
            const double first = 0.5 * (at(a, p) + at(a + 1, p));
            const double second = 0.5 * (at(a, p + 1) + at(a + 1, p + 1));
            const double flux = column_integral(polar_[p], polar_[p + 1], first, second, polar_[p + 1]);
            total_ += std::max(flux, 0.0) * (azimuth_[a + 1] - azimuth_[a]);
            flux_.push_back(total_);
        }
    }
}

double PhotometricWeb::candela(const glm::dvec3& direction) const {
    const double along = glm::dot(direction, axis_);
    const double x = glm::dot(direction, zero_);
    const double y = glm::dot(direction, quarter_);
    const double polar = std::atan2(std::hypot(x, y), along);
    if (polar < polar_.front() || polar > polar_.back()) return 0;
    const std::size_t p = interval(polar_, polar);
    const double t = (polar - polar_[p]) / (polar_[p + 1] - polar_[p]);
    if (round_) return (1 - t) * at(0, p) + t * at(0, p + 1);
    double azimuth = std::atan2(y, x);
    if (azimuth < azimuth_.front()) azimuth += 2 * kPi;
    if (azimuth < azimuth_.front() || azimuth > azimuth_.back()) return 0;
    const std::size_t a = interval(azimuth_, azimuth);
    const double s = (azimuth - azimuth_[a]) / (azimuth_[a + 1] - azimuth_[a]);
    return (1 - s) * ((1 - t) * at(a, p) + t * at(a, p + 1)) + s * ((1 - t) * at(a + 1, p) + t * at(a + 1, p + 1));
}

double PhotometricWeb::zonal_lumens() const {
    double sum = 0;
    for (std::size_t a = 0; a + 1 < azimuth_.size(); ++a) {
        for (std::size_t p = 0; p + 1 < polar_.size(); ++p) {
            const double mean = 0.25 * (at(a, p) + at(a, p + 1) + at(a + 1, p) + at(a + 1, p + 1));
            sum += mean * (azimuth_[a + 1] - azimuth_[a]) * (std::cos(polar_[p]) - std::cos(polar_[p + 1]));
        }
    }
    return sum;
}

glm::dvec3 PhotometricWeb::direction_of(double polar, double azimuth) const {
    return std::cos(polar) * axis_ + std::sin(polar) * (std::cos(azimuth) * zero_ + std::sin(azimuth) * quarter_);
}

glm::dvec3 PhotometricWeb::sample(const glm::dvec2& u) const {
    // Samples the cell by its flux and reuses the remainder of u.x for the azimuth, whose column flux is linear, then
    // samples the polar angle in the column.
    const double target = u.x * total_;
    auto found = std::upper_bound(flux_.begin(), flux_.end(), target);
    if (found == flux_.end()) --found;
    const auto cell = static_cast<std::size_t>(found - flux_.begin());
    const double before = cell > 0 ? flux_[cell - 1] : 0;
    const double rest = std::clamp((target - before) / (flux_[cell] - before), 0.0, 1.0);
    const std::size_t a = cell / (polar_.size() - 1);
    const std::size_t p = cell % (polar_.size() - 1);
    const double p0 = polar_[p], p1 = polar_[p + 1];
    const double first = column_integral(p0, p1, at(a, p), at(a, p + 1), p1);
    const double second = column_integral(p0, p1, at(a + 1, p), at(a + 1, p + 1), p1);
    const double root = std::sqrt(std::max(first * first + rest * (second * second - first * first), 0.0));
    const double s = std::clamp(first + root > 0 ? rest * (first + second) / (first + root) : 0.0, 0.0, 1.0);
    const double i0 = (1 - s) * at(a, p) + s * at(a + 1, p);
    const double i1 = (1 - s) * at(a, p + 1) + s * at(a + 1, p + 1);
    const auto integral = [&](double x) { return column_integral(p0, p1, i0, i1, x); };
    const double polar = invert(integral, u.y * integral(p1), p0, p1);
    return direction_of(polar, azimuth_[a] + s * (azimuth_[a + 1] - azimuth_[a]));
}

}  // namespace rs
