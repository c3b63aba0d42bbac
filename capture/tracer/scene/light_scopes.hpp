#pragma once
// Scopes of lights that illuminate parts of a scene only (Light::everywhere is false; ISO/IEC 14772-1, 4.6.6: a
// DirectionalLight lights its siblings).
//
// Surfaces belong to groups, and a group lists the scoped lights that illuminate it. The light passes through all other
// surfaces, and through one-sided surfaces from behind, so that it can enter a closed room. In its scope it casts
// shadows if Light::casts_shadows is true.

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::capture {

struct Scene;

inline constexpr std::uint32_t kUnscoped = ~0U;    // a light without scope
inline constexpr std::uint32_t kNoInstance = ~0U;  // Embree's RTC_INVALID_GEOMETRY_ID

struct LightScopes {
    struct Group {
        std::vector<std::uint32_t> lights;  // indices into Scene::lights
        glm::vec3 ambient{0.0F};            // whitted, toon: added to RenderOptions::ambient
    };
    std::vector<Group> groups;               // the first is that of surfaces that no scoped light illuminates
    std::vector<std::uint32_t> of_mesh;      // [Scene::meshes] index into groups
    std::vector<std::uint32_t> of_instance;  // [Scene::instances]

    [[nodiscard]] bool empty() const { return groups.empty(); }
    /// \param instance kNoInstance for static meshes
    [[nodiscard]] std::uint32_t group_of(std::uint32_t mesh, std::uint32_t instance) const {
        if (empty()) return 0;
        return instance == kNoInstance ? of_mesh[mesh] : of_instance[instance];
    }
    /// \param light index into Scene::lights of a scoped light; kUnscoped for any other
    [[nodiscard]] bool illuminates(std::uint32_t light, std::uint32_t group) const;
    [[nodiscard]] glm::vec3 ambient(std::uint32_t group) const {
        return empty() ? glm::vec3(0.0F) : groups[group].ambient;
    }
};

// Surfaces that cast the shadows of a light: all, those that a scoped light illuminates, or none.
struct ShadowCasters {
    bool any = true;
    std::uint32_t scoped_light = kUnscoped;  // index into Scene::lights
};

// Axis-aligned bounds of the surfaces that a scoped light illuminates, at the opening of the shutter.
struct ScopeBounds {
    glm::vec3 lower{1.0F};
    glm::vec3 upper{-1.0F};
    [[nodiscard]] bool empty() const { return lower.x > upper.x; }
    [[nodiscard]] bool contains(const glm::vec3& point) const { return glm::clamp(point, lower, upper) == point; }
};
ScopeBounds bounds_of_scope(const Scene& scene, std::uint32_t light);

}  // namespace rs::capture
