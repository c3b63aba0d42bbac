#pragma once
// What of a scene's materials shading by packets (packets/surface_lanes.hpp) needs, material by material.

#include "capture/tracer/integrator/transport.hpp"
#include "capture/tracer/packets/light_lanes.hpp"
#include "capture/tracer/packets/surface_lanes.hpp"
#include "capture/tracer/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {

struct PacketMaterial {
    int number;  // of the scene
    SurfaceKind kind;
    glm::vec3 colour;
    const Texture* texture;  // null: none
    float alpha, ior, translucency;
    float base;          // as MaterialLanes has it
    std::int32_t table;  // within PacketMaterials::tables()
    bool shines, relief;
    bool one_sided;  // from behind it is not there

    // Their directions are unique: no light shines on them.
    [[nodiscard]] bool is_specular() const { return kind == SurfaceKind::mirror || kind == SurfaceKind::glass; }
    // Whether Whitted's rays go on from there.
    [[nodiscard]] bool goes_on() const { return is_specular() || kind == SurfaceKind::metal; }
    void fill(std::size_t lane, MaterialLanes& lanes) const;
};

// Thread-safe.
class PacketMaterials {
public:
    // Refers to the textures of `scene`.
    PacketMaterials(const Scene& scene, const std::vector<SurfaceModel>& models);

    [[nodiscard]] const PacketMaterial& operator[](int number) const {
        return materials_[static_cast<std::size_t>(number)];
    }
    // A lane that stands for a vertex. `uv`, `front_side` and `position` are not filled.
    void set_lane(std::size_t lane, const LightTransport::Vertex& vertex, SurfaceLanes& surfaces) const;
    // What a vertex sends of `flux` that has come from its viewer, over `depth` surfaces.
    [[nodiscard]] VirtualLight virtual_light(const LightTransport::Vertex& vertex, const glm::vec3& flux,
                                             int depth) const;

    // Tables of albedo, one after the other.
    [[nodiscard]] const float* tables() const { return tables_.data(); }

private:
    std::vector<PacketMaterial> materials_;
    std::vector<float> tables_;
};

}  // namespace rs::capture
