#pragma once
// A scene as the viewer composites it: flattened to draw lists, whatever file it comes from (VRML97, glTF, OBJ, JSON).
// Colours are linear light. Y is up; the unit of length is the scene's own.

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

// A horizontal disc about the Y axis with a checker that fades into the background towards its rim.
struct Floor {
    double height = 0;
    double radius = 30;  // > 0
    double square = 1;   // side of a square of the checker, > 0
    glm::vec3 colour_a{0.46F, 0.45F, 0.43F};
    glm::vec3 colour_b{0.36F, 0.35F, 0.34F};
};

struct GeometryNode {
    std::shared_ptr<const Mesh> mesh;  // not null; shared where the file does
    Material material;
    glm::dmat4 world_from_node{1.0};    // affine, with an inverse
    std::vector<std::uint32_t> lights;  // those of Scene::lights that shine here only, besides those everywhere
    // Nodes that may be moved, all of the same number together; nothing: it stands still (TracedRenderer::move).
    std::optional<std::uint32_t> moving = {};
};

// An object made of images. In the node's coordinates the unit is the object radius and Y the turntable's axis.
struct RaySpaceNode {
    std::filesystem::path file;  // .rso
    TransformChain chain;
    bool standing = true;  // the origin of the chain is the object's foot instead of the middle of its captured frame
    std::string description;
    bool required = false;                 // without it there is nothing to show; others are left out with a warning
    std::optional<std::size_t> room = {};  // of Scene::rooms, the innermost; objects of no room are kept in memory
};

// A part of the scene whose objects are in memory while a visitor is in it or near.
struct Room {
    std::string description;
    BoundingBox box;  // in scene coordinates; empty where nothing is known of it
};

// How lights and surfaces make a colour.
enum class Shading {
    // ISO/IEC 14772-1, 4.14.4: the highlight about the half vector, ambient light from each light.
    kVrml,
    // B. T. Phong, Illumination for Computer Generated Images, 1975, with one ambient light A, the sum of that of all
    // directional lights: emissive + kd sum f E (N.I) + ks sum f E (I.Os)^g + ka A, where Os is the direction towards
    // the viewer reflected by the surface and f = min(1 / (c0 + c1 r + c2 r^2), 1).
    kPhong
};

// What weather leaves on surfaces that look up.
enum class Cover { kNone = 0, kWet = 1, kSnow = 2 };

// Of lights that came from a list.
struct ListedLights {
    std::vector<LightEntry> entries;  // of the last lights of the scene
    std::optional<EnvironmentEntry> environment;
    // LightEntry::scope -> geometry nodes; filled once the scene's own lights are gone.
    std::map<std::uint32_t, std::vector<std::uint32_t>> scopes;
};

struct Scene {
    Shading shading = Shading::kVrml;  // of raster
    Cover cover = Cover::kNone;        // of raster
    Background background;
    std::optional<Floor> floor;
    std::vector<Light> lights{{.colour = glm::vec3(0.75F),
                               .ambient = glm::vec3(0.4F),
                               .towards = glm::normalize(glm::dvec3(-0.45, -1, -0.6))}};
    std::optional<EnvironmentLight> environment;
    ListedLights listed;  // what is known of them besides
    std::vector<GeometryNode> geometry;
    std::vector<RaySpaceNode> objects;
    std::vector<Room> rooms;
    std::optional<Fog> fog;
    std::vector<Viewpoint> viewpoints;  // the first is where a visit begins
    Navigation navigation;
    std::optional<CameraPath> camera;   // a way through the scene
    std::vector<std::string> warnings;  // what could not be shown, "FILE: line N: ..."
};

// What lights `to` from now on is what lights `from`, another state of the same scene: lights, which of them shine on
// each node, environment and headlight.
void take_lights(const Scene& from, Scene& to);

// Of all geometry, in scene coordinates; empty where there is none.
BoundingBox bounds_of(const Scene& scene);

// Of the geometry and the objects from these numbers on, objects with their radius about them: the box of a room that
// does not show it.
BoundingBox bounds_from(const Scene& scene, std::size_t first_geometry, std::size_t first_object);

}  // namespace rs::compositor
