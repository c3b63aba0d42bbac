#pragma once
// What the tracer renders: triangle meshes with materials, textures, lights and an environment.
//
// Units and axes as in rayspace/base/conventions.hpp: Y up, the turntable's axis is Y. Colours are linear-light RGB.

#include "rayspace/image/image.hpp"
#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

enum class SurfaceKind {
    diffuse,  // Lambert
    glossy,   // a GGX dielectric coat (ior, roughness) over a Lambert base of `colour`
    metal,    // GGX conductor, reflectance at normal incidence `colour`, roughness
    mirror,   // perfectly smooth, reflectance `colour`
    // Smooth dielectric interface (ior); inside, light is absorbed to `colour` per unit length. Glass inside of glass
    // absorbs by the innermost one (up to 4 deep), but each surface refracts as against air.
    glass,
};

struct Material {
    std::string name;
    SurfaceKind kind = SurfaceKind::diffuse;
    glm::vec3 colour{0.8F};  // linear; multiplied by the texture where there is one
    int texture = -1;        // index into Scene::textures, -1 = none
    float roughness = 0.3F;  // GGX alpha = roughness^2; 0..1
    float ior = 1.5F;
    glm::vec3 emission{0.0F};   // radiance, W/(m^2 sr) in arbitrary units; multiplied by emission_texture
    int emission_texture = -1;  // index into Scene::textures, -1 = none; its alpha counts nothing
    int relief = -1;            // index into Scene::reliefs, -1 = none
    bool two_sided = true;      // thin surfaces (petals, leaves): shaded the same from both sides
    float translucency = 0.0F;  // diffuse only: share of the light that leaves on the other side (petals), 0..1

    // From behind such a surface is not there; glass is, for its rays come from within.
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

// sRGB-decoded to linear when it was made; bilinear.
struct Texture {
    std::string name;
    Image<RgbaF> pixels;   // alpha below 0.5 = a hole in the surface
    bool repeat_u = true;  // else the border goes on
    bool repeat_v = true;
};

// Latitude-longitude map: row 0 is +Y, the image's middle column is -Z, u grows towards +X from there. Empty = black.
struct Environment {
    Image<RgbaF> pixels;
    float scale = 1.0F;
    float turn_rad = 0.0F;  // about Y
};

// What is no mesh but answers rays by itself: a ray-space object. It shines with what it answers, whatever the light on
// it, and hides what is behind. Called from several threads at once.
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
    // Holds whatever it may answer.
    [[nodiscard]] virtual Box bounds() const = 0;
    // The first that the ray meets, or nothing. `direction` has unit length.
    [[nodiscard]] virtual std::optional<Answer> answer(const glm::vec3& origin, const glm::vec3& direction) const = 0;
};

// Meshes that stay together, in coordinates of their own. Nothing is seen of a part but through instances.
struct Part {
    std::string name;
    std::vector<Mesh> meshes;
};

// A part as it stands in the scene, as often as one likes. Matrices are affine, finite and have an inverse; they may
// mirror and stretch.
struct Instance {
    std::size_t part = 0;  // index into Scene::parts
    glm::dmat4 world_from_part{1.0};
    // Where it moves while the shutter is open: its place at the end (ray time 1). Between them the matrix goes evenly,
    // element by element: what turns by more than half a radian meanwhile becomes visibly smaller on its way.
    std::optional<glm::dmat4> at_close = {};
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;  // what stands still
    std::vector<Part> parts;
    std::vector<Instance> instances;
    std::vector<Material> materials;
    // From this number on they are of what surrounds the object: it lights and shades, and is seen in reflections and
    // through glass, but rays of the camera pass it (surroundings.hpp).
    int first_surrounding_material = std::numeric_limits<int>::max();
    std::vector<Texture> textures;
    // Normal maps: a texel's r, g, b are a direction of any length along u, v and the normal; (0, 0, 1) leaves the
    // normal as it is.
    std::vector<Texture> reliefs;
    std::vector<Light> lights;  // ambient parts count nothing here; areas are not seen by the camera
    Environment environment;
    std::vector<std::shared_ptr<const RayPrimitive>> primitives;  // not seen by the camera itself

    [[nodiscard]] bool surrounds(int material) const { return material >= first_surrounding_material; }
    [[nodiscard]] bool has_surroundings() const { return surrounds(static_cast<int>(materials.size()) - 1); }
};

}  // namespace rs::capture
