#include "compositor/scene/vrml/node_conversion.hpp"

#include "compositor/scene/vrml/appearance.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>

namespace rs::compositor::vrml {
namespace {

constexpr std::size_t kMaxColours = 16;  // per gradient

// Colours and angles, as many as match.
void take_gradient(const Node& node, const char* colour_field, const char* angle_field, std::vector<glm::vec3>& colours,
                   std::vector<double>& angles_rad) {
    const std::vector<double>& numbers = node.field(colour_field).numbers;
    if (numbers.size() < 3) return;
    colours.clear();
    for (std::size_t i = 0; i + 2 < numbers.size() && colours.size() < kMaxColours; i += 3) {
        colours.push_back(linear_colour({numbers[i], numbers[i + 1], numbers[i + 2]}));
    }
    double before = 0;
    for (const double angle : node.field(angle_field).numbers) {
        if (angles_rad.size() + 1 >= colours.size()) break;
        before = std::clamp(angle, before, kPi);
        angles_rad.push_back(before);
    }
}

}  // namespace

Light light_of(const Node& node, const TraversalState& state) {
    Light light;
    light.name = node.name;
    const glm::vec3 colour = linear_colour(node.triple("color"));
    light.colour = colour * static_cast<float>(std::clamp(node.number("intensity"), 0.0, 1.0));
    light.ambient = colour * static_cast<float>(std::clamp(node.number("ambientIntensity"), 0.0, 1.0));
    if (node.type != "PointLight") {
        const glm::dvec3 towards = glm::dmat3(state.world_from_node) * node.triple("direction");
        if (glm::length(towards) > 0) light.towards = glm::normalize(towards);
    }
    light.everywhere = node.flag("global");
    if (node.type == "DirectionalLight") return light;
    light.kind = node.type == "PointLight" ? LightKind::kPoint : LightKind::kSpot;
    light.location = state.point(node.triple("location"));
    const double scale = state.scale();
    light.radius = std::max(node.number("radius"), 0.0) * scale;
    const glm::dvec3 attenuation = glm::max(node.triple("attenuation"), glm::dvec3(0));
    light.attenuation = glm::vec3(attenuation / glm::dvec3(1, scale, scale * scale));
    if (light.kind == LightKind::kSpot) {
        light.cut_off_rad = std::clamp(node.number("cutOffAngle"), 0.0, kPi / 2);
        light.beam_width_rad = std::clamp(node.number("beamWidth"), 0.0, kPi / 2);
    }
    return light;
}

Viewpoint viewpoint_of(const Node& node, const TraversalState& state) {
    Viewpoint viewpoint;
    viewpoint.description = node.text("description");
    viewpoint.world_from_camera = glm::dmat4(state.rotation()) * rotation_matrix(node.quadruple("orientation"));
    viewpoint.world_from_camera[3] = glm::dvec4(state.point(node.triple("position")), 1);
    viewpoint.field_of_view_rad = std::clamp(node.number("fieldOfView"), radians(1), radians(170));
    return viewpoint;
}

Navigation navigation_of(const Node& node, const TraversalState& state) {
    Navigation navigation;
    const double scale = state.scale();
    navigation.headlight = node.flag("headlight");
    if (!node.field("type").texts.empty()) navigation.types = node.field("type").texts;
    navigation.speed = std::max(node.number("speed"), 0.0) * scale;
    navigation.visibility_limit = std::max(node.number("visibilityLimit"), 0.0) * scale;
    const std::vector<double>& avatar = node.field("avatarSize").numbers;
    for (std::size_t i = 0; i < std::min<std::size_t>(avatar.size(), 3); ++i) {
        if (avatar[i] > 0) navigation.avatar[static_cast<glm::length_t>(i)] = avatar[i];
    }
    navigation.avatar *= scale;
    return navigation;
}

Fog fog_of(const Node& node, const TraversalState& state) {
    Fog fog;
    fog.kind = node.text("fogType") == "EXPONENTIAL" ? FogKind::kExponential : FogKind::kLinear;
    fog.colour = linear_colour(node.triple("color"));
    fog.visibility = std::max(node.number("visibilityRange"), 0.0) * state.scale();
    return fog;
}

Background background_of(const Node& node, const TraversalState& state, const std::filesystem::path& folder,
                         SceneImages& images, std::string& fault) {
    Background background;
    background.sky = {glm::vec3(0)};
    take_gradient(node, "skyColor", "skyAngle", background.sky, background.sky_angles_rad);
    take_gradient(node, "groundColor", "groundAngle", background.ground, background.ground_angles_rad);
    background.world_from_background = state.rotation();
    constexpr const char* kFields[] = {"frontUrl", "backUrl", "leftUrl", "rightUrl", "topUrl", "bottomUrl"};
    for (std::size_t i = 0; i < background.images.size(); ++i) {
        const std::vector<std::string>& urls = node.field(kFields[i]).texts;
        std::string wrong;
        if (!urls.empty()) background.images[i] = images.read(urls, folder, false, false, wrong);
        if (!wrong.empty()) fault = wrong;
    }
    return background;
}

}  // namespace rs::compositor::vrml
