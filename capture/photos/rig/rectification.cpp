#include "capture/photos/rig/rectification.hpp"

#include "capture/photos/rig/nominal_rig.hpp"
#include "capture/photos/segmentation/foreground_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/premultiplied_sampling.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

constexpr double kMaxEnlargement = 1.5;
constexpr double kMinScale = 0.5;
// Rays with a smaller forward component are more than 84 degrees off the horizon.
constexpr double kMinForward = 0.1;
constexpr int kPointsPerEdge = 65;

// Maps the pixel `p` of the photo to the upright image at f = 1: x to the right, y down.
std::optional<glm::dvec2> upright_slopes(const TurntableModel& model, const glm::dvec2& p) {
    const auto ray = table_ray(model.lens, model.pose, p);
    if (!ray || -ray->z < kMinForward) return std::nullopt;
    return glm::dvec2(ray->x / -ray->z, -ray->y / -ray->z);
}

struct Stretch {
    double least = 0;
    double most = 0;
};

// Singular values of the Jacobian of upright_slopes() at `p`: change in the upright image at f = 1 per px of the photo.
std::optional<Stretch> stretch_at(const TurntableModel& model, const glm::dvec2& p) {
    constexpr double kStep_px = 0.5;
    std::array<glm::dvec2, 2> change;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const glm::dvec2 step = axis == 0 ? glm::dvec2(kStep_px, 0) : glm::dvec2(0, kStep_px);
        const auto before = upright_slopes(model, p - step);
        const auto behind = upright_slopes(model, p + step);
        if (!before || !behind) return std::nullopt;
        change[axis] = (*behind - *before) / (2 * kStep_px);
    }
    const double sum = glm::dot(change[0], change[0]) + glm::dot(change[1], change[1]);
    const double determinant = change[0].x * change[1].y - change[0].y * change[1].x;
    const double root = std::sqrt(std::max(0.0, sum * sum - 4 * determinant * determinant));
    return Stretch{std::sqrt(std::max(0.0, (sum - root) / 2)), std::sqrt((sum + root) / 2)};
}

std::vector<glm::dvec2> border_points(const TurnSilhouette::Box& box) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < kPointsPerEdge; ++i) {
        const double t = static_cast<double>(i) / (kPointsPerEdge - 1);
        const double x = box.left + t * (box.right - box.left);
        const double y = box.top + t * (box.bottom - box.top);
        points.insert(points.end(), {{x, box.top}, {x, box.bottom}, {box.left, y}, {box.right, y}});
    }
    return points;
}

struct Bounds {
    glm::dvec2 low{std::numeric_limits<double>::max()};
    glm::dvec2 high{std::numeric_limits<double>::lowest()};
    void include(const glm::dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

// Radius (at -Z = 1) beyond which the distortion is not monotonic and folds the image over itself.
double fold_radius(const Lens& lens) {
    // Smallest positive root of 1 + 3 k1 q + 5 k2 q^2 = 0, q = r^2.
    const double a = 5 * lens.k2;
    const double b = 3 * lens.k1;
    double lowest = std::numeric_limits<double>::infinity();
    if (std::abs(a) < 1e-15) {
        if (b < 0) lowest = -1 / b;
    } else if (b * b >= 4 * a) {
        const double root = std::sqrt(b * b - 4 * a);
        for (const double q : {(-b - root) / (2 * a), (-b + root) / (2 * a)}) {
            if (q > 0) lowest = std::min(lowest, q);
        }
    }
    return std::sqrt(lowest);
}

std::string at(const glm::dvec2& p) {
    return "pixel (" + std::to_string(std::lround(p.x)) + ", " + std::to_string(std::lround(p.y)) + ")";
}

}  // namespace

Result<UprightFrame> plan_upright_frame(const TurntableModel& model,
                                        std::span<const TurnSilhouette::Box> object_boxes) {
    Bounds seen;    // upright image at f = 1
    Bounds source;  // photo
    std::vector<glm::dvec2> points;
    for (const TurnSilhouette::Box& box : object_boxes) {
        if (box.empty() || box.top >= box.bottom) continue;
        const auto border = border_points(box);
        points.insert(points.end(), border.begin(), border.end());
    }
    if (points.empty()) return Error{"rectification: no view shows the object; check the masks"};
    double full_detail_f_px = 0;
    for (const glm::dvec2& p : points) {
        const auto slopes = upright_slopes(model, p);
        const auto stretch = stretch_at(model, p);
        if (!slopes || !stretch) {
            return Error{"rectification: an upright camera cannot see " + at(p) +
                         ": the camera looks too steeply down or the lens distortion is too strong there; check the "
                         "calibration, or take the images from lower down"};
        }
        seen.include(*slopes);
        source.include(p);
        full_detail_f_px = std::max(full_detail_f_px, 1 / stretch->least);
    }
    const auto middle = stretch_at(model, (source.low + source.high) / 2.0);
    if (!middle) return Error{"rectification: the calibration does not fit the images; check it"};

    const double least_f_px = 1 / middle->least;
    const double wished_f_px = std::max(least_f_px, std::min(full_detail_f_px, kMaxEnlargement / middle->most));
    const glm::dvec2 extent = seen.high - seen.low;
    const double room_px = kMaxImageSide_px - 2 * kUprightMargin_px - 2;
    const double f_px = std::min(wished_f_px, room_px / std::max(extent.x, extent.y));
    if (f_px < kMinScale * least_f_px) {
        return Error{"rectification: the camera looks so steeply down that the upright images would need more than " +
                     std::to_string(kMaxImageSide_px) + " pixels; take the images from lower down"};
    }

    UprightFrame frame;
    const glm::dvec2 origin = glm::floor(seen.low * f_px) - static_cast<double>(kUprightMargin_px);
    const glm::dvec2 size = glm::ceil(seen.high * f_px) + static_cast<double>(kUprightMargin_px) - origin;
    frame.lens.width = static_cast<int>(size.x);
    frame.lens.height = static_cast<int>(size.y);
    frame.lens.f_px = f_px;
    frame.lens.cx = -origin.x;
    frame.lens.cy = -origin.y;
    frame.scale = f_px * middle->least;
    return frame;
}

Image<Rgba8> rectified(const TurntableModel& model, const UprightFrame& frame, ConstImageView<Rgba8> cut_out,
                       const ImagePlacement& place) {
    RS_CHECK(cut_out.width() == model.lens.width && cut_out.height() == model.lens.height);
    const glm::dmat3 camera_from_table = camera_rotation(model.pose);
    const double fold = fold_radius(model.lens);
    const glm::dvec2 middle(model.lens.width / 2.0, model.lens.height / 2.0);
    const Lens& lens = model.lens;
    const PremultipliedImage from(cut_out);
    Image<Rgba8> upright(frame.lens.width, frame.lens.height);
    for (int y = 0; y < upright.height(); ++y) {
        for (int x = 0; x < upright.width(); ++x) {
            const glm::dvec3 ray((x + 0.5 - frame.lens.cx) / frame.lens.f_px,
                                 (frame.lens.cy - y - 0.5) / frame.lens.f_px, -1);
            const glm::dvec3 seen = camera_from_table * ray;
            if (!(seen.z < -1e-6)) continue;
            const glm::dvec2 at(seen.x / -seen.z, -seen.y / -seen.z);
            const double r2 = glm::dot(at, at);
            if (r2 >= fold * fold) continue;
            const double scale = lens.f_px * (1 + r2 * (lens.k1 + r2 * lens.k2));
            const glm::dvec2 p = place.seen(glm::dvec2(lens.cx, lens.cy) + scale * at, middle);
            if (!(p.x >= -1 && p.y >= -1 && p.x <= cut_out.width() + 1 && p.y <= cut_out.height() + 1)) continue;
            upright(x, y) = from.sample(p.x, p.y);
        }
    }
    bleed_colours(upright);
    return upright;
}

Rig make_rig(const TurntableModel& model, const UprightFrame& frame, const TurnSilhouette::Box& visible,
             std::optional<double> ground_height) {
    RS_CHECK(!visible.empty() && visible.top < visible.bottom);
    const double extent_px = std::max(frame.lens.cx - visible.left, visible.right - frame.lens.cx);
    const double distance = distance_for_unit_radius(extent_px, frame.lens.f_px);
    const double middle_row = (visible.top + visible.bottom) / 2.0;
    const double middle_height = (frame.lens.cy - middle_row) / frame.lens.f_px;

    const TurntableModel upright{frame.lens, {}, model.angles_rad};
    Rig rig;
    rig.object_radius = 1;
    if (ground_height) rig.foot_height = distance * (*ground_height - middle_height);
    for (std::size_t i = 0; i < upright.angles_rad.size(); ++i) {
        RigView view;
        view.camera = object_camera(upright, i, distance, middle_height);
        rig.views.push_back(std::move(view));
    }
    return rig;
}

}  // namespace rs::capture
