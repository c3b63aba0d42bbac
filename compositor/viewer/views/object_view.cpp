#include "compositor/viewer/views/object_view.hpp"

#include "compositor/viewer/views/upright_image.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/conventions.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

// The foot's depth is evaluated this much above the foot (object radii), so that it is in front of the floor.
constexpr double kAboveGround = 0.01;

// Reciprocal depth of the plane { p : dot(p - eye, normal) = distance } as a linear form of (x, y, 1).
glm::dvec3 inverse_depth_of_plane(const Camera& camera, const glm::dvec3& normal, double distance) {
    // eye + depth * ray(x, y) is on the plane if depth * dot(normal, ray) = distance.
    return glm::dvec3(glm::dot(normal, camera.right()) / camera.fl_x, -glm::dot(normal, camera.up()) / camera.fl_y,
                      glm::dot(normal, camera.ray(0, 0))) /
           distance;
}

// Captured pixels per camera pixel at the object's axis.
double captured_pixels_per_pixel(const RaySpaceObject& object, const Camera& camera, double distance) {
    const CapturedView& captured = object.views.front();
    const double radius_px = std::ldexp(captured.fl_y_q16, -16) / std::ldexp(captured.lines.front().l0_q20, -20);
    return radius_px / (camera.fl_x / distance);
}

// Elevation above and below the object up to which it is rendered: that of the highest ring, but at least this.
constexpr double kLeastSteepest_rad = kPi / 3;

double steepest_elevation(const RaySpaceObject& object) {
    double steepest = kLeastSteepest_rad;
    for (const Ring& ring : object.rings) {
        if (!ring.rotation.is_identity()) return kPi / 2;
        steepest = std::max(steepest, std::abs(radians(ring.elevation_udeg * 1e-6)));
    }
    return steepest;
}

// The camera, turned about the object's middle to the nearest elevation at which the object is rendered. In the image,
// the middle stays in its place.
Camera at_rendered_elevation(const Camera& camera, const ViewableObject& object) {
    const glm::dvec3 middle(0, 0.5 * (object.bounds.bottom + object.bounds.top), 0);
    const glm::dvec3 v = camera.centre() - middle;
    const double level = std::hypot(v.x, v.z);
    const double elevation = std::atan2(v.y, level);
    const double steepest = steepest_elevation(object.renderer.object());
    if (std::abs(elevation) <= steepest) return camera;
    // Horizontal direction to the viewer; on the object's axis, that of the lower edge of the image.
    glm::dvec3 out(v.x, 0, v.z);
    if (level < 1e-6) out = std::copysign(1.0, -v.y) * glm::dvec3(camera.up().x, 0, camera.up().z);
    out = glm::length(out) > 0 ? glm::normalize(out) : glm::dvec3(0, 0, 1);
    const glm::dvec3 axis(out.z, 0, -out.x);  // turns Y to `out`
    const glm::dmat4 to_middle = glm::translate(glm::dmat4(1.0), middle);
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), elevation - std::copysign(steepest, elevation), axis);
    Camera turned = camera;
    turned.world_from_camera = to_middle * turn * glm::inverse(to_middle) * camera.world_from_camera;
    return turned;
}

struct ObjectImage {
    Camera camera;  // object radii
    glm::dmat3 image_from_screen{1.0};
};

// Image of the camera's rectangle with `samples_across` pixels per screen pixel.
ObjectImage direct_image(const Camera& camera, const ScreenRectangle& area, int samples_across, bool mirrored) {
    ObjectImage made{camera, glm::dmat3(1.0)};
    made.camera.cx -= area.x;
    made.camera.cy -= area.y;
    double right = samples_across;
    double left_edge = area.x;
    if (mirrored) {  // engines require right-handed cameras: render the mirrored image of the mirrored scene
        made.camera.world_from_camera[0] = -made.camera.world_from_camera[0];
        made.camera.cx = area.width - made.camera.cx;
        right = -right;
        left_edge = area.x + area.width;
    }
    for (double* length_px : {&made.camera.fl_x, &made.camera.fl_y, &made.camera.cx, &made.camera.cy}) {
        *length_px *= samples_across;
    }
    made.camera.width = area.width * samples_across;
    made.camera.height = area.height * samples_across;
    const double down = samples_across;
    made.image_from_screen =
        glm::dmat3(glm::dvec3(right, 0, 0), glm::dvec3(0, down, 0), glm::dvec3(-right * left_edge, -down * area.y, 1));
    return made;
}

}  // namespace

std::optional<glm::ivec2> ObjectView::image_pixel(int x, int y) const {
    const glm::dvec3 p = image_from_screen * glm::dvec3(x + 0.5, y + 0.5, 1);
    const glm::ivec2 at(static_cast<int>(std::floor(p.x / p.z)), static_cast<int>(std::floor(p.y / p.z)));
    if (at.x < 0 || at.y < 0 || at.x >= camera.width || at.y >= camera.height) return std::nullopt;
    return at;
}

std::optional<ObjectView> view_of_object(const PlacedObject& placed, const Camera& camera_in_world,
                                         const ObjectViewOptions& options) {
    const Camera camera =
        at_rendered_elevation(camera_in_node(camera_in_world, placed.world_from_object), *placed.object);
    const glm::dvec3 eye = camera.centre();
    if (camera.fl_x < 0.5 * glm::length(eye)) return std::nullopt;
    const double distance = std::hypot(eye.x, eye.z);
    if (distance < 1e-6) return std::nullopt;  // inside of the object
    const BoundingCylinder& bounds = placed.object->bounds;
    const auto rectangle = covering_rectangle(bounds, camera);
    if (!rectangle) return std::nullopt;

    const RaySpaceObject& object = placed.object->renderer.object();
    const double scale = placed.world_from_object.scale;
    ObjectView view;
    view.rectangle = *rectangle;
    const int most = std::min({options.max_samples_across, kMaxSamplesAcross,
                               kMaxImageSide_px / std::max(rectangle->width, rectangle->height)});
    const double samples =
        std::clamp(captured_pixels_per_pixel(object, camera, glm::length(eye)), 1.0, std::max<double>(most, 1));
    view.samples_across = static_cast<int>(std::lround(samples));
    std::optional<UprightImage> upright;
    if (options.upright && !is_upright(camera)) {
        upright = upright_image(camera, *rectangle, bounds, samples);
    }
    view.smooth = upright && view.samples_across == 1;
    const ObjectImage image =
        upright ? ObjectImage{upright->camera, upright->image_from_screen}
                : direct_image(camera, *rectangle, view.samples_across, placed.world_from_object.mirrors());
    view.camera = image.camera;
    view.image_from_screen = image.image_from_screen;
    view.camera.world_from_camera[3] = glm::dvec4(eye * object.units_per_radius, 1);
    // In very wide images objects may be too far off axis for the engine.
    if (!engine::prepare_view(object, view.camera)) return std::nullopt;
    view.units_per_rig_unit = scale / object.units_per_radius;
    view.plane_distance = distance * scale;
    const glm::dvec3 inward(-eye.x / distance, 0, -eye.z / distance);
    view.inverse_depth_facing = inverse_depth_of_plane(camera, inward, distance * scale);
    const double above_foot = eye.y - (placed.object->extent.bottom + kAboveGround);
    view.from_above = above_foot >= 0;
    const double foot_distance = std::copysign(std::max(std::abs(above_foot), 1e-6), above_foot);
    view.inverse_depth_foot = inverse_depth_of_plane(camera, {0, -1, 0}, foot_distance * scale);
    return view;
}

}  // namespace rs::compositor
