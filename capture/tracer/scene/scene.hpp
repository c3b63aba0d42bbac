#pragma once
// Scene description for the tracer: triangle meshes with materials, textures, lights and an environment.
//
// Units and axes as in rayspace/base/conventions.hpp: Y up, the turntable's axis is Y. Colours are linear-light RGB.

#include "capture/tracer/scene/light_scopes.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/light/light.hpp"
#include "rayspace/light/surface_properties.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

using rs::SurfaceKind;

struct Material {
    std::string name;
    SurfaceKind kind = SurfaceKind::diffuse;
    glm::vec3 colour{0.8F};  // linear; multiplied by the texture where there is one
    int texture = -1;        // index into Scene::textures, -1 = none
    float roughness = 0.3F;  // GGX alpha = roughness^2; 0..1
    float ior = 1.5F;
    glm::vec3 emission{0.0F};   // radiance, W/(m^2 sr) in arbitrary units; multiplied by emission_texture
    int emission_texture = -1;  // index into Scene::textures, -1 = none; its alpha is ignored
    int relief = -1;            // index into Scene::reliefs, -1 = none
    bool two_sided = true;      // thin surfaces (petals, leaves): shaded the same from both sides
    float translucency = 0.0F;  // diffuse only: share of the light that leaves on the other side (petals), 0..1

    // Returns true if the surface is invisible from behind. Glass is not one-sided, since rays hit it from inside.
    [[nodiscard]] bool is_one_sided() const { return !two_sided && kind != SurfaceKind::glass; }
};

struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // per vertex, unit length; empty = flat shading
    std::vector<glm::vec2> uvs;      // per vertex, (0, 0) = the texture's lower left corner; empty = none
    std::vector<glm::vec3> colours;  // per vertex, linear; multiply the material's colour; empty = none
    std::vector<glm::uvec3> triangles;
    int material = 0;
};

// Linear-light pixels, bilinear look-up.
struct Texture {
    std::string name;
    Image<RgbaF> pixels;   // alpha below 0.5 = a hole in the surface
    bool repeat_u = true;  // otherwise clamped to the border
    bool repeat_v = true;
};

// Latitude-longitude map: row 0 is +Y, the central column is -Z, u grows towards +X from there. Empty = black.
struct Environment {
    Image<RgbaF> pixels;
    float scale = 1.0F;
    float turn_rad = 0.0F;  // about Y
};

// Object with its own ray intersection instead of a mesh, e.g. a ray-space object. It emits the radiance that it
// returns, does not reflect light, and occludes. Must be thread-safe.
class RayPrimitive {
public:
    struct Answer {
        float distance;      // from the origin, > 0
        glm::vec3 radiance;  // towards the origin
    };
    struct Box {
        glm::vec3 lower, upper;
    };

    RayPrimitive() = default;
    RayPrimitive(const RayPrimitive&) = delete;
    RayPrimitive& operator=(const RayPrimitive&) = delete;
    virtual ~RayPrimitive() = default;
    // Contains all intersections.
    [[nodiscard]] virtual Box bounds() const = 0;
    // First intersection with a ray, or nothing. `direction` has unit length.
    [[nodiscard]] virtual std::optional<Answer> answer(const glm::vec3& origin, const glm::vec3& direction) const = 0;
};

// Rigid group of meshes in local coordinates; visible through its instances only.
struct Part {
    std::string name;
    std::vector<Mesh> meshes;
};

// Placement of a part in the scene. Matrices are affine, finite and invertible; they may mirror and stretch.
struct Instance {
    std::size_t part = 0;  // index into Scene::parts
    glm::dmat4 world_from_part{1.0};
    // For motion while the shutter is open: the matrix at ray time 1. Matrices are interpolated linearly by element, so
    // rotations of more than half a radian visibly shrink the object in between.
    std::optional<glm::dmat4> at_close = {};
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;  // static
    std::vector<Part> parts;
    std::vector<Instance> instances;
    std::vector<Material> materials;
    // Materials from this index on belong to the surroundings of the object: they emit, reflect and occlude light and
    // are visible in reflections and through glass, but not to camera rays (add_surroundings()).
    int first_surrounding_material = std::numeric_limits<int>::max();
    std::vector<Texture> textures;
    // Normal maps: a texel's r, g, b are a direction of any length along u, v and the normal; (0, 0, 1) is neutral.
    std::vector<Texture> reliefs;
    std::vector<Light> lights;  // ambient terms are ignored; area lights are not visible to camera rays
    LightScopes scopes;
    Environment environment;
    std::vector<std::shared_ptr<const RayPrimitive>> primitives;  // not visible to camera rays
    std::vector<std::string> warnings;                            // of the reader: contents that are ignored

    /// \param mesh index into `meshes`, or into the meshes of the instance's part
    /// \param instance kNoInstance for static meshes
    [[nodiscard]] const Mesh& mesh_of(std::uint32_t mesh, std::uint32_t instance) const {
        return instance == kNoInstance ? meshes[mesh] : parts[instances[instance].part].meshes[mesh];
    }
    [[nodiscard]] bool surrounds(int material) const { return material >= first_surrounding_material; }
    [[nodiscard]] bool has_surroundings() const { return surrounds(static_cast<int>(materials.size()) - 1); }
};

/// Checks a scene (scene_check.cpp): every index valid, every number finite and within its stated range. Environment
/// and texture pixels must be finite and not negative. A scene without triangles is valid. \return an error that names
/// the scene and the mesh, material, texture or light
Status check_scene(const Scene& scene);

/// Checks an instance's matrices (Instance); the error does not name the instance.
Status check_placement(const Instance& instance);

}  // namespace rs::capture
