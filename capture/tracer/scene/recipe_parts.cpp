#include "capture/tracer/scene/recipe_parts.hpp"

#include "capture/tracer/scene/studio.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {

namespace {

constexpr std::array<std::pair<const char*, SurfaceKind>, 5> kSurfaceKinds{{{"diffuse", SurfaceKind::diffuse},
                                                                            {"glossy", SurfaceKind::glossy},
                                                                            {"metal", SurfaceKind::metal},
                                                                            {"mirror", SurfaceKind::mirror},
                                                                            {"glass", SurfaceKind::glass}}};

void read_environment_file(RecipeReader& reader, const std::filesystem::path& folder, Environment& environment) {
    std::string file;
    reader.read("file", file);
    const std::filesystem::path path = folder / file;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return reader.complain("file", path.string() + " is not there; put it there");
    }
    Result<Image<RgbaF>> pixels = read_radiance(path);
    if (!pixels) return reader.complain("file", pixels.error().message);
    environment.pixels = std::move(pixels).value();
}

void read_studio(const nlohmann::json& json, RecipeErrors& errors, Environment& environment) {
    RecipeReader reader(json, "environment.studio", errors);
    Studio studio = default_studio();
    reader.read("zenith", studio.zenith, 0, 1e6);
    reader.read("horizon", studio.horizon, 0, 1e6);
    reader.read("floor", studio.floor, 0, 1e6);
    if (const nlohmann::json* boxes = reader.child("softboxes")) {
        if (!boxes->is_array()) reader.complain("softboxes", "must be a list [...]");
        studio.softboxes.clear();
        for (std::size_t i = 0; boxes->is_array() && i < boxes->size(); ++i) {
            RecipeReader box_reader((*boxes)[i], "environment.studio.softboxes[" + std::to_string(i) + "]", errors);
            Softbox box;
            box_reader.read("azimuth_deg", box.azimuth_deg, -360, 360);
            box_reader.read("elevation_deg", box.elevation_deg, -90, 90);
            box_reader.read("width_deg", box.width_deg, 0, 360);
            box_reader.read("height_deg", box.height_deg, 0, 180);
            box_reader.read("edge_deg", box.edge_deg, 0, 90);
            box_reader.read("radiance", box.radiance, 0, 1e6);
            box_reader.finish();
            studio.softboxes.push_back(box);
        }
    }
    reader.finish();
    environment = make_studio_environment(studio);
}

void read_light(RecipeReader& reader, Scene& scene) {
    std::string type;
    reader.read("type", type);
    if (type == "directional") {
        glm::vec3 direction{0, -1, 0}, irradiance{1.0F};
        reader.read("direction", direction);
        reader.read("irradiance", irradiance, 0, RecipeReader::kHuge);
        if (!(glm::length(direction) > 0.0F)) {
            reader.complain("direction", "must not be [0, 0, 0]");
        } else {
            scene.lights.push_back(directional_light(direction, irradiance));
        }
    } else if (type == "point") {
        glm::vec3 position{0.0F}, intensity{1.0F};
        reader.read("position", position);
        reader.read("intensity", intensity, 0, RecipeReader::kHuge);
        scene.lights.push_back(point_light(position, intensity));
    } else if (type == "rectangle") {
        glm::vec3 corner{0.0F}, edge_u{1, 0, 0}, edge_v{0, 0, 1}, radiance{1.0F};
        reader.read("corner", corner);
        reader.read("edge_u", edge_u);
        reader.read("edge_v", edge_v);
        reader.read("radiance", radiance, 0, RecipeReader::kHuge);
        if (!(glm::length(glm::cross(edge_u, edge_v)) > 0.0F)) {
            reader.complain("edge_u and edge_v must span an area");
        }
        scene.lights.push_back(rectangle_light(corner, edge_u, edge_v, radiance));
    } else {
        return reader.complain("type", "must be \"directional\", \"point\" or \"rectangle\"");
    }
    reader.finish();
}

// Numbers from 0 to 1 in place of `values`.
void read_shares(RecipeReader& reader, const char* key, std::vector<float>& values) {
    const nlohmann::json* list = reader.child(key);
    if (list == nullptr) return;
    std::vector<float> read;
    for (const nlohmann::json& value : *list) {
        if (!value.is_number() || value.get<double>() < 0 || value.get<double>() > 1) break;
        read.push_back(value.get<float>());
    }
    if (!list->is_array() || read.size() != list->size() || read.size() > ToonStyle::kMostTones) {
        return reader.complain(
            key, "must be a list of at most " + std::to_string(ToonStyle::kMostTones) + " numbers from 0 to 1");
    }
    values = std::move(read);
}

}  // namespace

void read_toon(const nlohmann::json& json, RecipeErrors& errors, ToonStyle& style) {
    RecipeReader reader(json, "toon", errors);
    double angle_deg = 30;
    read_shares(reader, "thresholds", style.thresholds);
    read_shares(reader, "values", style.values);
    reader.read("edge_radius", style.edge_radius, 0, 1);
    reader.read("edge_depth", style.edge_depth, 0, 2);
    reader.read("edge_angle_deg", angle_deg, 1, 180);
    reader.read("edge_colour", style.edge_colour, 0, 1);
    reader.read("shadow_rays", style.shadow_rays, 0, 1024);
    reader.finish();
    style.edge_angle_rad = static_cast<float>(radians(angle_deg));
    if (style.values.size() != style.thresholds.size() + 1) {
        reader.complain("values", "must be one more than \"thresholds\": a tone for what is less than all of them");
    }
    if (!std::ranges::is_sorted(style.thresholds, std::ranges::greater())) {
        reader.complain("thresholds", "must fall: the brightest first");
    }
}

void read_material(const nlohmann::json& json, const std::string& place, RecipeErrors& errors, Material& material) {
    RecipeReader reader(json, place, errors);
    std::string kind;
    reader.read("kind", kind);
    if (reader.has("kind")) {
        const auto* const found =
            std::ranges::find(kSurfaceKinds, kind, [](const auto& entry) { return std::string(entry.first); });
        if (found == kSurfaceKinds.end()) {
            reader.complain("kind", "must be \"diffuse\", \"glossy\", \"metal\", \"mirror\" or \"glass\"");
        } else {
            material.kind = found->second;
        }
    }
    reader.read("colour", material.colour, 0, 1);
    reader.read("roughness", material.roughness, 0, 1);
    reader.read("ior", material.ior, 1, 10);
    reader.read("emission", material.emission, 0, 1e6);
    reader.read("two_sided", material.two_sided);
    reader.read("translucency", material.translucency, 0, 1);
    reader.finish();
}

void read_camera(const nlohmann::json& json, RecipeErrors& errors, CameraRecipe& camera) {
    RecipeReader reader(json, "camera", errors);
    reader.read("distance_radii", camera.distance_radii, 1.001, 1000);
    reader.read("focal_widths", camera.focal_widths, 0.1, 100);
    reader.read("elevation_deg", camera.elevation_deg, -89, 89);
    reader.read("look_at_height", camera.look_at_height, -10, 10);
    reader.read("views", camera.views, 1, kMaxViews);
    reader.read("width", camera.width, 1, kMaxPictureSide_px);
    reader.read("height", camera.height, 1, kMaxPictureSide_px);
    reader.read("spp", camera.samples_per_pixel, 1, 65536);
    reader.read("aperture_radii", camera.aperture_radii, 0, 10);
    reader.read("focus_radii", camera.focus_radii, 0.001, 1000);
    reader.finish();
}

void read_lights(const nlohmann::json& json, RecipeErrors& errors, Scene& scene) {
    if (!json.is_array()) return errors.add("lights", "must be a list [...]");
    for (std::size_t i = 0; i < json.size(); ++i) {
        RecipeReader reader(json[i], "lights[" + std::to_string(i) + "]", errors);
        read_light(reader, scene);
    }
}

void read_environment(const nlohmann::json& json, const std::filesystem::path& folder, RecipeErrors& errors,
                      Environment& environment) {
    RecipeReader reader(json, "environment", errors);
    if (reader.has("file") + reader.has("studio") + reader.has("constant") != 1) {
        return reader.complain("give one of \"file\", \"studio\" and \"constant\"");
    }
    environment = {};
    if (reader.has("file")) read_environment_file(reader, folder, environment);
    if (const nlohmann::json* studio = reader.child("studio")) read_studio(*studio, errors, environment);
    if (reader.has("constant")) {
        glm::vec3 radiance(0.0F);
        reader.read("constant", radiance, 0, 1e6);
        environment.pixels = Image<RgbaF>(1, 1, {radiance.r, radiance.g, radiance.b, 1.0F});
    }
    double turn_deg = 0;
    reader.read("scale", environment.scale, 0, 1e6);
    reader.read("turn_deg", turn_deg, -3600, 3600);
    environment.turn_rad = static_cast<float>(radians(turn_deg));
    reader.child("file");  // known, whichever of the three was given
    reader.finish();
}

}  // namespace rs::capture
