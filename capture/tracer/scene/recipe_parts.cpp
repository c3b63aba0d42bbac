#include "capture/tracer/scene/recipe_parts.hpp"

#include "capture/tracer/scene/studio.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {

namespace {

constexpr std::size_t kMaxEntries = 100'000;  // of lights and softboxes
// In the order of SurfaceKind.
const std::vector<std::string> kSurfaceKinds{"diffuse", "glossy", "metal", "mirror", "glass"};

void read_environment_file(const JsonValue& file, const std::filesystem::path& folder, Environment& environment) {
    const std::filesystem::path path = folder / file.text();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        throw file.wrong(path.string() + " does not exist; check the path");
    }
    Result<Image<RgbaF>> pixels = read_radiance(path);
    if (!pixels) throw file.wrong(pixels.error().message);
    environment.pixels = std::move(pixels).value();
}

Softbox read_softbox(JsonObject object) {
    Softbox box;
    object.read("azimuth_deg", box.azimuth_deg, -360, 360);
    object.read("elevation_deg", box.elevation_deg, -90, 90);
    object.read("width_deg", box.width_deg, 0, 360);
    object.read("height_deg", box.height_deg, 0, 180);
    object.read("edge_deg", box.edge_deg, 0, 90);
    object.read("radiance", box.radiance, 0, 1e6);
    object.expect_no_unknown_keys();
    return box;
}

void read_studio(JsonObject object, Environment& environment) {
    Studio studio = default_studio();
    object.read("zenith", studio.zenith, 0, 1e6);
    object.read("horizon", studio.horizon, 0, 1e6);
    object.read("floor", studio.floor, 0, 1e6);
    if (const auto boxes = object.find("softboxes")) {
        const std::size_t count = boxes->list_size(0, kMaxEntries);
        studio.softboxes.clear();
        for (std::size_t i = 0; i < count; ++i) studio.softboxes.push_back(read_softbox(JsonObject(boxes->item(i))));
    }
    object.expect_no_unknown_keys();
    environment = make_studio_environment(studio);
}

void read_light(JsonObject object, Scene& scene) {
    const std::size_t type = object.take("type").one_of({"directional", "point", "rectangle"});
    if (type == 0) {
        glm::vec3 direction{0, -1, 0}, irradiance{1.0F};
        object.read("direction", direction);
        object.read("irradiance", irradiance, 0);
        if (!(glm::length(direction) > 0.0F)) throw object.take("direction").wrong("must not be [0, 0, 0]");
        scene.lights.push_back(directional_light(direction, irradiance));
    } else if (type == 1) {
        glm::vec3 position{0.0F}, intensity{1.0F};
        object.read("position", position);
        object.read("intensity", intensity, 0);
        scene.lights.push_back(point_light(position, intensity));
    } else {
        glm::vec3 corner{0.0F}, edge_u{1, 0, 0}, edge_v{0, 0, 1}, radiance{1.0F};
        object.read("corner", corner);
        object.read("edge_u", edge_u);
        object.read("edge_v", edge_v);
        object.read("radiance", radiance, 0);
        if (!(glm::length(glm::cross(edge_u, edge_v)) > 0.0F)) {
            throw object.wrong("edge_u and edge_v must span an area");
        }
        scene.lights.push_back(rectangle_light(corner, edge_u, edge_v, radiance));
    }
    object.expect_no_unknown_keys();
}

// Replaces `values` by a list of numbers in 0..1.
void read_shares(JsonObject& object, const char* key, std::vector<float>& values) {
    const auto list = object.find(key);
    if (!list) return;
    values.resize(list->list_size(0, ToonStyle::kMaxTones));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(list->item(i).number(0, 1));
}

}  // namespace

void read_toon(JsonObject object, ToonStyle& style) {
    object.read("edge_radius", style.edge_radius, 0, 1);
    object.read("shadow_rays", style.shadow_rays, 0, 1024);
    read_toon_look(object, style, 2);
    object.expect_no_unknown_keys();
}

void read_toon_look(JsonObject& object, ToonStyle& style, double max_depth) {
    double angle_deg = 30;
    read_shares(object, "thresholds", style.thresholds);
    read_shares(object, "values", style.values);
    if (const auto steps = object.find("steps")) {
        style.steps = static_cast<ToonStyle::Steps>(steps->one_of({"intensity", "colour"}));
    }
    object.read("edge_depth", style.edge_depth, 0, max_depth);
    object.read("edge_angle_deg", angle_deg, 1, 180);
    object.read("edge_colour", style.edge_colour, 0, 1);
    if (const auto test = object.find("edge_test")) {
        style.edge_test = static_cast<ToonStyle::EdgeTest>(test->one_of({"slope", "depth"}));
    }
    if (style.edge_test == ToonStyle::EdgeTest::depth && object.has("edge_angle_deg")) {
        throw object.wrong("edge_angle_deg has no effect with \"edge_test\": \"depth\"; remove one of them");
    }
    style.edge_angle_rad = static_cast<float>(radians(angle_deg));
    if (style.values.size() != style.thresholds.size() + 1) {
        throw object.wrong("values must be one more than \"thresholds\": a tone for what is less than all of them");
    }
    if (!std::ranges::is_sorted(style.thresholds, std::ranges::greater())) {
        throw object.wrong("thresholds must fall: the brightest first");
    }
}

void read_material(JsonObject object, Material& material) {
    if (const auto kind = object.find("kind")) material.kind = static_cast<SurfaceKind>(kind->one_of(kSurfaceKinds));
    object.read("colour", material.colour, 0, 1);
    object.read("roughness", material.roughness, 0, 1);
    object.read("ior", material.ior, 1, 10);
    object.read("emission", material.emission, 0, 1e6);
    object.read("two_sided", material.two_sided);
    object.read("translucency", material.translucency, 0, 1);
    object.expect_no_unknown_keys();
}

void read_camera(JsonObject object, CameraRecipe& camera) {
    object.read("distance_radii", camera.distance_radii, 1.001, 1000);
    object.read("focal_widths", camera.focal_widths, 0.1, 100);
    object.read("elevation_deg", camera.elevation_deg, -89, 89);
    object.read("look_at_height", camera.look_at_height, -10, 10);
    object.read("views", camera.views, 1, kMaxViews);
    object.read("width", camera.width, 1, kMaxImageSide_px);
    object.read("height", camera.height, 1, kMaxImageSide_px);
    object.read("spp", camera.samples_per_pixel, 1, 65536);
    object.read("aperture_radii", camera.aperture_radii, 0, 10);
    object.read("focus_radii", camera.focus_radii, 0.001, 1000);
    object.expect_no_unknown_keys();
}

void read_lights(const JsonValue& list, Scene& scene) {
    const std::size_t count = list.list_size(0, kMaxEntries);
    for (std::size_t i = 0; i < count; ++i) read_light(JsonObject(list.item(i)), scene);
}

void read_environment(JsonObject object, const std::filesystem::path& folder, Environment& environment) {
    if (object.has("file") + object.has("studio") + object.has("constant") != 1) {
        throw object.wrong("give one of \"file\", \"studio\" and \"constant\"");
    }
    environment = {};
    if (const auto file = object.find("file")) read_environment_file(*file, folder, environment);
    if (const auto studio = object.find("studio")) read_studio(JsonObject(*studio), environment);
    if (object.has("constant")) {
        glm::vec3 radiance(0.0F);
        object.read("constant", radiance, 0, 1e6);
        environment.pixels = Image<RgbaF>(1, 1, {radiance.r, radiance.g, radiance.b, 1.0F});
    }
    double turn_deg = 0;
    object.read("scale", environment.scale, 0, 1e6);
    object.read("turn_deg", turn_deg, -3600, 3600);
    environment.turn_rad = static_cast<float>(radians(turn_deg));
    object.expect_no_unknown_keys();
}

}  // namespace rs::capture
