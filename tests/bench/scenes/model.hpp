#pragma once
// Benchmark scene for renderers: groups of triangles with one or more instances, a list of lights, and viewpoints.
// Metres, Y up.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rs::synthetic {

struct ModelMaterial {
    std::string name;
    glm::vec3 colour{0.8F};  // linear
    float roughness = 0.9F;
    std::string image = {};  // key of Model::images; repeating texture, multiplied by the colour
};

/// Mesh::material is an index into Model::materials.
struct ModelGroup {
    std::string name;
    std::vector<capture::Mesh> meshes;
};

struct ModelNode {
    std::size_t group = 0;
    glm::mat4 world_from_group{1.0F};
};

struct ModelView {
    std::string name;
    glm::vec3 eye{0.0F};
    glm::vec3 at{0.0F};
};

struct Model {
    std::string name;
    std::vector<ModelMaterial> materials;
    std::map<std::string, Image<Rgba8>> images;  // file name -> image
    std::vector<ModelGroup> groups;
    std::vector<ModelNode> nodes;
    std::vector<ModelView> views;                   // the first is the initial one
    std::string lights;                             // a light list in JSON
    std::map<std::string, std::string> luminaires;  // file name -> IES text
};

/// Triangles of all nodes; every instance of a group counts.
std::int64_t triangle_count(const Model& model);
std::int64_t triangle_count(const ModelGroup& group);

}  // namespace rs::synthetic
