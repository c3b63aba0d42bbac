#pragma once
// Scene of the viewer: flattened draw lists, independent of the file format (VRML97, glTF, OBJ, PLY, JSON). Colours are
// linear light. Y is up; lengths are in scene units.

#include "compositor/scene/camera_path.hpp"
#include "compositor/scene/material.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/surroundings.hpp"
#include "compositor/scene/transform.hpp"
#include "rayspace/light/light_entry.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

/// Horizontal checkered disc about the Y axis that fades into the background towards its rim.
struct Floor {
    double height = 0;
    double radius = 30;  // > 0
    double square = 1;   // side of a checker square, > 0
    glm::vec3 colour_a{0.46F, 0.45F, 0.43F};
    glm::vec3 colour_b{0.36F, 0.35F, 0.34F};
};

struct GeometryNode {
    std::shared_ptr<const Mesh> mesh;  // not null; shared as in the file
    Material material;
    glm::dmat4 world_from_node{1.0};    // affine, invertible
    std::vector<std::uint32_t> lights;  // indices into Scene::lights: scoped lights that apply to this node
    /// Id of movable nodes, which move together if equal (TracedRenderer::move); nullopt: static.
    std::optional<std::uint32_t> moving = {};
};

/// True for nodes that traced renderers draw: triangles that are not blended, and closed meshes of glass. All others
/// are drawn over the traced image by raster renderers.
bool is_traced(const GeometryNode& node);

/// Image-based object. In node coordinates the unit is the object radius and Y the turntable's axis.
struct RaySpaceNode {
    std::filesystem::path file;  // .rso
    TransformChain chain;
    bool standing = true;  // the chain's origin is the object's foot instead of the centre of its capture
    std::string description;
    bool required = false;  // a missing file is an error; otherwise a warning
    std::optional<std::size_t> room =
        {};  // index into Scene::rooms, the innermost; objects without room are always in memory
};

/// Part of the scene whose objects are in memory while a visitor is inside or near.
struct Room {
    std::string description;
    BoundingBox box;  // scene coordinates; empty if unknown
};

/// Lighting formula.
enum class Shading {
    // ISO/IEC 14772-1, 4.14.4: highlight by the half vector, ambient light per light.
    kVrml,
    // B. T. Phong, Illumination for Computer Generated Images, 1975, with one ambient light A, the sum over all
    // directional lights: emissive + kd sum f E (N.I) + ks sum f E (I.Os)^g + ka A, where Os is the view direction
    // mirrored at the surface and f = min(1 / (c0 + c1 r + c2 r^2), 1).
    kPhong
};

/// Effect of weather on surfaces facing up.
enum class Cover { kNone = 0, kWet = 1, kSnow = 2 };

/// Light list entries of the scene's lights.
struct ListedLights {
    std::vector<LightEntry> entries;  // of the last lights of the scene
    std::optional<EnvironmentEntry> environment;
    // LightEntry::scope -> geometry nodes; set when the scene's own lights are removed.
    std::map<std::uint32_t, std::vector<std::uint32_t>> scopes;
};

struct Scene {
    Shading shading = Shading::kVrml;  // raster only
    Cover cover = Cover::kNone;        // raster only
    Background background;
    std::optional<Floor> floor;
    std::vector<Light> lights{{.colour = glm::vec3(0.75F),
                               .ambient = glm::vec3(0.4F),
                               .towards = glm::normalize(glm::dvec3(-0.45, -1, -0.6))}};
    std::optional<EnvironmentLight> environment;
    ListedLights listed;  // entries that lights and environment came from
    std::vector<GeometryNode> geometry;
    std::vector<RaySpaceNode> objects;
    std::vector<Room> rooms;
    std::optional<Fog> fog;
    std::vector<Viewpoint> viewpoints;  // the first is the initial one
    Navigation navigation;
    std::optional<CameraPath> camera;   // camera animation
    std::vector<std::string> warnings;  // unsupported parts, "FILE: line N: ..."
};

/// Copies the lighting of another state of the same scene: lights, their scopes, environment and headlight.
void copy_lights(const Scene& from, Scene& to);

/// Bounds of all geometry in scene coordinates; empty if there is none.
BoundingBox bounds_of(const Scene& scene);

/// Bounds of the geometry and objects from these indices on, objects as spheres of their radius; for rooms without a
/// box.
BoundingBox bounds_from(const Scene& scene, std::size_t first_geometry, std::size_t first_object);

}  // namespace rs::compositor
