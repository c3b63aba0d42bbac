#pragma once
// Material data for packet shading (packets/surface_lanes.hpp).

#include "capture/tracer/integrator/transport.hpp"
#include "capture/tracer/packets/light_lanes.hpp"
#include "capture/tracer/packets/surface_lanes.hpp"
#include "capture/tracer/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {

struct PacketMaterial {
    int index;  // index into Scene::materials
    SurfaceKind kind;
    glm::vec3 colour;
    const Texture* texture;  // null: none
    float alpha, ior, translucency;
    float base;          // see MaterialLanes
    std::int32_t table;  // offset into PacketMaterials::tables()
    bool emissive, has_relief;
    bool one_sided;  // invisible from behind

    // Unique directions: light sampling does not apply.
    [[nodiscard]] bool is_specular() const { return kind == SurfaceKind::mirror || kind == SurfaceKind::glass; }
    // Returns true if Whitted ray tracing continues with specular rays.
    [[nodiscard]] bool has_specular_rays() const { return is_specular() || kind == SurfaceKind::metal; }
    void fill(std::size_t lane, MaterialLanes& lanes) const;
};

// Thread-safe.
class PacketMaterials {
public:
    /// Keeps references to the textures of `scene`.
    PacketMaterials(const Scene& scene, const std::vector<SurfaceModel>& models);

    [[nodiscard]] const PacketMaterial& operator[](int number) const {
        return materials_[static_cast<std::size_t>(number)];
    }
    // Copies a vertex to a lane. `uv`, `front_side` and `position` are not set.
    void set_lane(std::size_t lane, const LightTransport::Vertex& vertex, SurfaceLanes& surfaces) const;
    // Virtual light at a vertex, for `flux` that arrives from the vertex's viewer direction after `depth` surfaces.
    [[nodiscard]] VirtualLight make_virtual_light(const LightTransport::Vertex& vertex, const glm::vec3& flux,
                                                  int depth) const;

    // Concatenated albedo tables.
    [[nodiscard]] const float* tables() const { return tables_.data(); }

private:
    std::vector<PacketMaterial> materials_;
    std::vector<float> tables_;
};

}  // namespace rs::capture
