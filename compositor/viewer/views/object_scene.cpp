#include "compositor/viewer/views/object_scene.hpp"

#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/format/object_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kSmallestRadius = 0.01;  // scene units; smaller and larger objects are scaled
constexpr double kLargestRadius = 100;
constexpr double kRowGap = 1.1;        // distance of neighbours over the sum of their radii
constexpr double kGroundRadius = 40;   // largest object radii
constexpr int kSoftLights = 8;         // directional lights in a circle
constexpr float kSoftLight = 0.11F;    // of each
constexpr float kSoftAmbient = 0.04F;  // of each
const glm::vec3 kGround(0.42F);
const glm::vec3 kBackdrop(0.45F);

// Measurements in object radii; the radius in units of the capture set.
struct MeasuredObject {
    double radius = 1;
    UprightExtent extent;
    double distance = 4;  // of the first photo's camera from the axis
    double height = 0;    // of it above the object's origin
};

Result<MeasuredObject> measure_object(const std::filesystem::path& file) {
    RS_ASSIGN_OR_RETURN(const RaySpaceObject object, read_object(file, {.max_level = 0}));
    MeasuredObject measured{.radius = object.units_per_radius, .extent = estimated_extent(object)};
    const CapturedView& first = object.views[object.rings.front().views.front()];
    measured.height = std::ldexp(first.height_q20, -20);
    measured.distance = std::ldexp(first.lines.front().l0_q20, -20);
    return measured;
}

// Reaches in steps of 45 degrees around the objects, so that no single edge of a shadow is visible.
std::vector<Light> soft_lights() {
    std::vector<Light> lights;
    for (int i = 0; i < kSoftLights; ++i) {
        const double azimuth = 2 * kPi * (i + 0.5) / kSoftLights;
        Light light;
        light.name = "soft light " + std::to_string(i + 1);
        light.colour = glm::vec3(kSoftLight);
        light.ambient = glm::vec3(kSoftAmbient);
        light.towards = glm::normalize(glm::dvec3(0.6 * std::sin(azimuth), -1, 0.6 * std::cos(azimuth)));
        lights.push_back(std::move(light));
    }
    return lights;
}

// Viewpoint of the first photo's camera on the +Z side, with a field of view for the object instead of the photo.
Viewpoint capture_viewpoint(const MeasuredObject& object, double scale) {
    const double half_height = scale * (object.extent.top - object.extent.bottom) / 2;
    const glm::dvec3 middle(0, half_height, 0);
    const glm::dvec3 eye(0, scale * (object.height - object.extent.bottom), scale * object.distance);
    const double sine = std::hypot(scale, half_height) / glm::distance(eye, middle);
    const double field_of_view_rad = 2 * std::asin(std::min(sine, 0.8));
    return {"capture", look_at_camera(eye, middle, field_of_view_rad, 1, 1).world_from_camera, field_of_view_rad};
}

}  // namespace

bool is_object_file(const std::filesystem::path& path) {
    return lower_case_extension(path) == ".rso";
}

Result<double> own_radius(const std::filesystem::path& file) {
    RS_ASSIGN_OR_RETURN(const MeasuredObject measured, measure_object(file));
    const bool is_extreme = measured.radius < kSmallestRadius || measured.radius > kLargestRadius;
    return is_extreme ? 1 : measured.radius;
}

Result<Scene> scene_of_objects(const std::vector<std::string>& files) {
    RS_CHECK(!files.empty());
    std::vector<MeasuredObject> measured;
    double largest = 0;
    double smallest = 1e300;
    for (const std::string& file : files) {
        RS_ASSIGN_OR_RETURN(const MeasuredObject object, measure_object(file));
        largest = std::max(largest, object.radius);
        smallest = std::min(smallest, object.radius);
        measured.push_back(object);
    }
    const double unit = smallest < kSmallestRadius || largest > kLargestRadius ? 1 / largest : 1;
    const double room = unit * (measured.size() > 1 ? kRowGap : 1);  // in X, of an object of radius 1
    double width = 0;
    for (const MeasuredObject& object : measured) width += 2 * room * object.radius;
    Scene scene;
    double x = -width / 2;
    for (std::size_t i = 0; i < files.size(); ++i) {
        RaySpaceNode node;
        node.file = files[i];
        node.required = true;
        const double half = room * measured[i].radius;
        node.chain = {{.translation = {x + half, 0, 0}, .scale = unit * measured[i].radius}};
        x += 2 * half;
        scene.objects.push_back(std::move(node));
    }
    const double ground = unit * largest;
    scene.floor = Floor{.radius = kGroundRadius * std::max(ground, width / 2),
                        .square = ground,
                        .colour_a = kGround,
                        .colour_b = kGround};
    scene.background.sky = {kBackdrop};
    scene.lights = soft_lights();
    scene.navigation.types = {"EXAMINE", "ANY"};
    scene.navigation.speed = ground;
    if (files.size() == 1) scene.viewpoints = {capture_viewpoint(measured.front(), unit * largest)};
    return scene;
}

}  // namespace rs::compositor
