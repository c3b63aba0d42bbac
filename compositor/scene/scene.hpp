#pragma once
// A scene as the viewer composites it: flattened to draw lists, whatever file it comes from (VRML97, glTF, OBJ, JSON).
// Colours are linear light. Y is up; the unit of length is the scene's own.

#include "compositor/scene/camera_path.hpp"
#include "compositor/scene/light/light_entry.hpp"
#include "compositor/scene/material.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/surroundings.hpp"
#include "compositor/scene/transform.hpp"

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
    std::shared_ptr<const Mesh> mesh;  // not null; shared where the file says so
    Material material;
    glm::dmat4 world_from_node{1.0};    // affine, with an inverse
    std::vector<std::uint32_t> lights;  // those of Scene::lights that shine here only, besides those everywhere
};

// An object made of pictures. In the node's coordinates the unit is the object radius and Y the turntable's axis.
struct RaySpaceNode {
    std::filesystem::path file;  // .rso
    TransformChain chain;
    bool standing = true;  // the origin of the chain is the object's foot instead of the middle of its captured frame
    std::string description;
    bool required = false;  // without it there is nothing to show; others are left out with a warning
    std::optional<std::size_t> room =
        {};  // of Scene::rooms, the innermost; objects of none are always wanted in memory
};

// A part of the scene whose objects are in memory while a visitor is in it or near.
struct Room {
    std::string description;
    BoundingBox box;  // in scene coordinates; empty where nothing is known of it
};

// Of lights that came from a list.
struct ListedLights {
    std::vector<LightEntry> entries;  // of the last lights of the scene
    std::optional<EnvironmentEntry> environment;
    // LightEntry::scope -> geometry nodes; filled once the scene's own lights are gone.
    std::map<std::uint32_t, std::vector<std::uint32_t>> scopes;
};

struct Scene {
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

// Of all geometry, in scene coordinates; empty where there is none.
BoundingBox bounds_of(const Scene& scene);

// Of the geometry and the objects from these numbers on, objects with their radius about them: the box of a room that
// does not tell it.
BoundingBox bounds_from(const Scene& scene, std::size_t first_geometry, std::size_t first_object);

}  // namespace rs::compositor
