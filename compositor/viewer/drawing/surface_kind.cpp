#include "compositor/viewer/drawing/surface_kind.hpp"

#include "compositor/scene/light/prefiltered_reflections.hpp"
#include "compositor/viewer/drawing/shaders.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

namespace rs::compositor {

Reflection reflection_of(const Material& material, Shading shading) {
    constexpr float kRough = 0.6F;  // coats beyond it reflect hardly any image
    if (!material.surface || !material.lit || shading == Shading::kPhong) return Reflection::kNone;
    switch (material.surface->kind) {
        case rs::SurfaceKind::metal:
        case rs::SurfaceKind::mirror:
            return Reflection::kOpaque;
        case rs::SurfaceKind::glossy:
            return material.surface->roughness < kRough ? Reflection::kOpaque : Reflection::kNone;
        case rs::SurfaceKind::glass:
            return Reflection::kGlass;
        case rs::SurfaceKind::diffuse:
            break;
    }
    return Reflection::kNone;
}

void add_lights(const Scene& scene, const ShadowPlan& shadows, const std::vector<std::uint32_t>& lights,
                SurfaceKind& kind) {
    for (const std::uint32_t i : lights) {
        const LightKind light = scene.lights[i].kind;
        ++(light == LightKind::kDirectional ? kind.directional : light == LightKind::kPoint ? kind.points : kind.spots);
        switch (shadows.shape_of(i)) {
            case ShadowShape::kNone:
                break;
            case ShadowShape::kParallel:
                ++kind.shadowed_directional;
                kind.cascades |= shadows.has_cascades(i);
                break;
            case ShadowShape::kCone:
                ++kind.narrow_spots;
                break;
            case ShadowShape::kCube:
                ++(light == LightKind::kPoint ? kind.shadowed_points : kind.wide_spots);
                break;
        }
        kind.fading |= light != LightKind::kDirectional && scene.lights[i].attenuation != glm::vec3(1, 0, 0);
    }
}

SurfaceKind kind_of(const Scene& scene, const ShadowPlan& shadows, const GeometryNode& node, AlphaUse alpha,
                    const std::vector<std::uint32_t>& lights) {
    SurfaceKind kind;
    kind.lit = node.material.lit;
    if (kind.lit) {
        add_lights(scene, shadows, lights, kind);
        kind.headlight = scene.navigation.headlight;
        kind.environment = scene.environment.has_value();
        kind.reflection = reflection_of(node.material, scene.shading);
        kind.shiny = node.material.specular != glm::vec3(0) || kind.reflection != Reflection::kNone;
    }
    kind.image = !node.material.texture ? 0 : node.material.texture->modulates ? 2 : 1;
    kind.image_alpha = alpha;
    kind.colours = node.mesh->has_colours;
    kind.phong = scene.shading == Shading::kPhong;
    kind.cover = kind.lit ? scene.cover : Cover::kNone;
    kind.shiny |= kind.cover == Cover::kWet;
    kind.relief = kind.lit && node.material.normals != nullptr;
    if (scene.fog) kind.fog = scene.fog->kind == FogKind::kLinear ? 1 : 2;
    return kind;
}

std::string constants_of(const SurfaceKind& kind) {
    const int shadows = kind.shadowed_directional + kind.shadowed_points + kind.narrow_spots + kind.wide_spots;
    return "#version 450 core\n" + shaders::shader_constant("kDirectional", kind.directional) +
           shaders::shader_constant("kPoints", kind.points) + shaders::shader_constant("kSpots", kind.spots) +
           shaders::shader_constant("kShadowedDirectional", kind.shadowed_directional) +
           shaders::shader_constant("kShadowedPoints", kind.shadowed_points) +
           shaders::shader_constant("kNarrowSpots", kind.narrow_spots) +
           shaders::shader_constant("kWideSpots", kind.wide_spots) +
           shaders::shader_constant("kShadows", kind.counted && shadows > 0 ? kMaxCountedLights : shadows) +
           shaders::shader_constant("kCascades", kind.cascades ? kCascades : 0) +
           shaders::shader_constant("kMaxCascadedLights", kMaxCascadedLights) +
           "const float kNear = " + std::to_string(kNear) + ";\n" + shaders::shader_constant("kFading", kind.fading) +
           shaders::shader_constant("kHeadlight", kind.headlight) +
           shaders::shader_constant("kEnvironment", kind.environment) + shaders::shader_constant("kLit", kind.lit) +
           shaders::shader_constant("kShiny", kind.shiny) + shaders::shader_constant("kPicture", kind.image) +
           shaders::shader_constant("kPictureAlpha", static_cast<int>(kind.image_alpha)) +
           shaders::shader_constant("kColours", kind.colours) + shaders::shader_constant("kRelief", kind.relief) +
           shaders::shader_constant("kFog", kind.fog) + shaders::shader_constant("kPhong", kind.phong) +
           shaders::shader_constant("kCover", static_cast<int>(kind.cover)) +
           shaders::shader_constant("kReflection", static_cast<int>(kind.reflection)) +
           shaders::shader_constant("kReflectionLevels", kReflectionLevels) +
           shaders::shader_constant("kVeil", kind.fog_only) + shaders::shader_constant("kCounted", kind.counted) +
           shaders::shader_constant("kMostCounted", kMaxCountedLights);
}

}  // namespace rs::compositor
