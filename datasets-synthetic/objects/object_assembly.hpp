#pragma once
// Collects the meshes, materials and textures of one object and brings it to the size that recipes count on.

#include "capture/tracer/scene/scene.hpp"

#include <string>

namespace rs::synthetic {

class ObjectAssembly {
public:
    explicit ObjectAssembly(std::string name) { scene_.name = std::move(name); }

    // Return the index that materials and meshes refer to.
    int add_texture(capture::Texture texture);
    int add_material(capture::Material material);

    // An empty mesh of that material to append to. The reference is good until the next add_mesh.
    capture::Mesh& add_mesh(const std::string& name, int material);

    // The object with the middle of its bounding box at the origin and its farthest vertex at distance 1 from there.
    // Meshes that stayed empty are dropped. Glass is tinted per unit of length *after* this.
    [[nodiscard]] capture::Scene finish() &&;

private:
    capture::Scene scene_;
};

}  // namespace rs::synthetic
