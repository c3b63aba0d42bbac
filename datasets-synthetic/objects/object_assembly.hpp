#pragma once
// Collects the meshes, materials and textures of one object and normalises its size for recipes.

#include "capture/tracer/scene/scene.hpp"

#include <string>

namespace rs::synthetic {

class ObjectAssembly {
public:
    explicit ObjectAssembly(std::string name) { scene_.name = std::move(name); }

    // Return the index for references by materials and meshes.
    int add_texture(capture::Texture texture);
    int add_material(capture::Material material);

    // Adds an empty mesh. The reference is valid until the next add_mesh().
    capture::Mesh& add_mesh(const std::string& name, int material);

    // Returns the object with the centre of its bounding box at the origin and its farthest vertex at distance 1. Empty
    // meshes are removed. The tint of glass refers to the unit of length after this normalisation.
    [[nodiscard]] capture::Scene finish() &&;

private:
    capture::Scene scene_;
};

}  // namespace rs::synthetic
