#pragma once
// Hash of a scene's meshes, textures and materials.

#include "capture/tracer/scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace rs::synthetic {

// FNV-1a over the little-endian bytes of meshes, textures and material constants.
class Digest {
public:
    template <class T>
    void add(const std::vector<T>& values) {
        for (const T& value : values) add_bytes(&value, sizeof value);
    }
    void add_bytes(const void* data, std::size_t size_bytes) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size_bytes; ++i) state_ = (state_ ^ bytes[i]) * 0x100000001B3ULL;
    }
    [[nodiscard]] std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xCBF29CE484222325ULL;
};

inline std::uint64_t digest(const capture::Scene& scene) {
    Digest sum;
    for (const capture::Mesh& mesh : scene.meshes) {
        sum.add(mesh.positions);
        sum.add(mesh.normals);
        sum.add(mesh.uvs);
        sum.add(mesh.triangles);
        sum.add_bytes(&mesh.material, sizeof mesh.material);
    }
    for (const capture::Texture& texture : scene.textures)
        sum.add_bytes(texture.pixels.data(), texture.pixels.pixels().size_bytes());
    for (const capture::Material& material : scene.materials) {
        sum.add_bytes(&material.colour, sizeof material.colour);
        sum.add_bytes(&material.roughness, sizeof material.roughness);
        sum.add_bytes(&material.emission, sizeof material.emission);
    }
    return sum.value();
}

}  // namespace rs::synthetic
