#pragma once
// A scene as the viewer composites it: the nodes of the graph with their chains of transforms, lights and a camera
// path. Colours are linear light, 0..1 (lights may exceed 1). Y is up; the unit of length is the scene's own.

#include "compositor/scene/camera_path.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/transform.hpp"

#include <glm/glm.hpp>

#include <filesystem>
#include <optional>
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
    Mesh mesh;
    glm::vec3 colour{0.5F};
    TransformChain chain;
};

// An object made of pictures. In the node's coordinates the unit is the object radius and Y the turntable's axis.
struct RaySpaceNode {
    std::filesystem::path file;  // .rso
    TransformChain chain;
    bool standing = true;  // the origin of the chain is the object's foot instead of the middle of its captured frame
};

struct Lights {
    glm::dvec3 towards{-0.45, -1.0, -0.6};  // the direction in which the light travels, of any length but 0
    glm::vec3 directional{0.75F};
    glm::vec3 ambient{0.4F};
};

struct Scene {
    glm::vec3 background{0.62F, 0.68F, 0.74F};
    std::optional<Floor> floor;
    Lights lights;
    std::vector<GeometryNode> geometry;
    std::vector<RaySpaceNode> objects;
    std::optional<CameraPath> camera;
};

}  // namespace rs::compositor
