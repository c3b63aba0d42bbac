#include "capture/posed/up_axis.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace rs::capture {
namespace {

constexpr double kLevel = 0.1736;           // sine of 10 degrees
constexpr double kWeightWidth = 0.0872;     // sine of 5 degrees
constexpr double kSideways = 0.5;           // sine of the elevation of a photo's up, from which it tells up from down
constexpr double kMinSecondScatter = 0.05;  // below it, the axes are nearly parallel and do not span a plane
constexpr double kCostOnSide = 0.3;         // most photos are not on their side
constexpr double kMinLevelShare = 0.7;      // chance fits reach a half
constexpr double kMinMeanUp = 0.2;

// Direction perpendicular to most of the unit vectors `axes`, and the share of those within 10 degrees of it. Nullopt
// if they do not span a plane.
struct PlaneNormal {
    glm::dvec3 direction{0};
    double share = 0;
    double cost = 0;  // robust sum of the deviations
};

using ScatterSolver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

ScatterSolver scatter_of(std::span<const glm::dvec3> axes, std::span<const double> weights) {
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    double sum = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Eigen::Vector3d a(axes[i].x, axes[i].y, axes[i].z);
        scatter += weights[i] * a * a.transpose();
        sum += weights[i];
    }
    return ScatterSolver(scatter / sum);
}

glm::dvec3 eigenvector(const ScatterSolver& solver, int i) {
    const Eigen::Vector3d n = solver.eigenvectors().col(i);
    return {n.x(), n.y(), n.z()};
}

// Horizontal axis of each camera for the vertical `up`: right, or the photo's up if it is stored on its side.
std::vector<glm::dvec3> horizontal_axes(std::span<const Camera> cameras, const glm::dvec3& up) {
    std::vector<glm::dvec3> axes;
    for (const Camera& camera : cameras) {
        const double right = std::abs(glm::dot(camera.right(), up)), along = std::abs(glm::dot(camera.up(), up));
        axes.push_back(right > kLevel && along < right ? camera.up() : camera.right());
    }
    return axes;
}

// Fit that starts at the direction `up`.
std::optional<PlaneNormal> fit_normal(std::span<const Camera> cameras, const glm::dvec3& up) {
    constexpr int kIterations = 20;
    PlaneNormal found{up, 0, 0};
    std::vector<double> weights(cameras.size(), 1);
    std::vector<glm::dvec3> axes = horizontal_axes(cameras, up);
    for (int i = 0; i < kIterations; ++i) {
        const ScatterSolver solver = scatter_of(axes, weights);
        if (!(solver.eigenvalues()[1] > kMinSecondScatter)) return std::nullopt;
        found.direction = eigenvector(solver, 0);
        axes = horizontal_axes(cameras, found.direction);
        found.cost = 0;
        for (std::size_t k = 0; k < axes.size(); ++k) {
            const double off = glm::dot(axes[k], found.direction) / kWeightWidth;
            weights[k] = 1 / ((1 + off * off) * (1 + off * off));
            const bool is_on_side = axes[k] != cameras[k].right();
            found.cost += off * off / (1 + off * off) + (is_on_side ? kCostOnSide : 0);  // Geman-McClure
        }
    }
    const auto is_level = [&](const glm::dvec3& axis) { return std::abs(glm::dot(axis, found.direction)) < kLevel; };
    found.share = static_cast<double>(std::ranges::count_if(axes, is_level)) / static_cast<double>(axes.size());
    return found;
}

// The best fit of those that start at the principal axes of the photos' right and up directions.
std::optional<PlaneNormal> best_normal(std::span<const Camera> cameras) {
    std::vector<glm::dvec3> rights, ups;
    for (const Camera& camera : cameras) {
        rights.push_back(camera.right());
        ups.push_back(camera.up());
    }
    const std::vector<double> weights(cameras.size(), 1);
    std::optional<PlaneNormal> best;
    for (const std::vector<glm::dvec3>& axes : {rights, ups}) {
        const ScatterSolver solver = scatter_of(axes, weights);
        for (int i = 0; i < 3; ++i) {
            const auto fit = fit_normal(cameras, eigenvector(solver, i));
            if (fit && (!best || fit->cost < best->cost - 1e-6)) best = fit;
        }
    }
    return best;
}

glm::dvec3 mean_up(std::span<const Camera> cameras) {
    glm::dvec3 sum(0);
    for (const Camera& camera : cameras) sum += camera.up();
    return sum / static_cast<double>(cameras.size());
}

// Gives `up` the sign of the photos that are not on their side, else that of the cameras' mean height over `target`.
void orient(UpAxis& up, std::span<const Camera> cameras, const glm::dvec3& target) {
    double votes = 0, height = 0;
    for (const Camera& camera : cameras) {
        const double along = glm::dot(camera.up(), up.direction);
        if (std::abs(along) > kSideways) votes += along;
        height += glm::dot(glm::normalize(camera.centre() - target), up.direction);
    }
    height /= static_cast<double>(cameras.size());
    if (votes == 0 && std::abs(height) < kWeightWidth) {
        up.notes.emplace_back(
            "all photos are stored on their side, from the object's height: up may be down; check, and give --up "
            "x,y,z");
    }
    if ((votes != 0 ? votes : height) < 0) up.direction = -up.direction;
}

Result<UpAxis> up_of_photos(std::span<const Camera> cameras) {
    const glm::dvec3 sum = mean_up(cameras);
    if (!(glm::length(sum) > kMinMeanUp)) {
        return Error{"the photos have no common up direction; give --up x,y,z in the axes of the cameras' file"};
    }
    return UpAxis{glm::normalize(sum), "photos", 0, {}};
}

}  // namespace

Result<UpRequest> parse_up(const std::string& text) {
    if (text == "auto") return UpRequest{};
    if (text == "photo") return UpRequest{UpRequest::Kind::kPhoto, {}};
    const Error malformed{"'" + printable(text) + "' is not a direction; give auto, photo, or x,y,z such as 0,0,1"};
    UpRequest request{UpRequest::Kind::kGiven, {}};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int i = 0; i < 3; ++i) {
        const auto [rest, error] = std::from_chars(at, end, request.direction[i]);
        if (error != std::errc{} || (i < 2 && (rest == end || *rest != ','))) return malformed;
        at = i < 2 ? rest + 1 : rest;
    }
    const double length = glm::length(request.direction);
    if (at != end || !(length > 1e-9 && length < 1e9)) return malformed;
    return request;
}

Result<UpAxis> find_up(const UpRequest& request, std::span<const Camera> cameras, const glm::dvec3& target) {
    if (request.kind == UpRequest::Kind::kGiven) return UpAxis{glm::normalize(request.direction), "given", 0, {}};
    if (request.kind == UpRequest::Kind::kPhoto) return up_of_photos(cameras);
    const auto best = best_normal(cameras);
    if (!best || best->share < kMinLevelShare) {
        RS_ASSIGN_OR_RETURN(UpAxis up, up_of_photos(cameras));
        up.notes.emplace_back(
            "the photos have no common horizon; their mean up direction is used: check, and give --up x,y,z");
        return up;
    }
    UpAxis up{best->direction, "horizons", best->share, {}};
    orient(up, cameras, target);
    return up;
}

}  // namespace rs::capture
