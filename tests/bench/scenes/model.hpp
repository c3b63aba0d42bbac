#pragma once
// A room to measure renderers with: groups of triangles, of which each stands in the room once or many times, a list of
// lights, and places to look from. Metres, Y up.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rs::synthetic {

struct ModelLook {
    std::string name;
    glm::vec3 colour{0.8F};  // linear
    float roughness = 0.9F;
    std::string image = {};  // of Model::images; multiplies the colour, which it repeats over
};

// Meshes name their look as their material.
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
    std::vector<ModelLook> looks;
    std::map<std::string, Image<Rgba8>> images;  // file name -> image
    std::vector<ModelGroup> groups;
    std::vector<ModelNode> nodes;
    std::vector<ModelView> views;                   // the first is where a visit begins
    std::string lights;                             // a light list in JSON
    std::map<std::string, std::string> luminaires;  // file name -> IES text
};

// Of all nodes: a group that stands twice counts twice.
std::int64_t triangle_count(const Model& model);
std::int64_t triangle_count(const ModelGroup& group);

}  // namespace rs::synthetic
