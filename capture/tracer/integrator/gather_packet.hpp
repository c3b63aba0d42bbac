#pragma once
// Direct light on up to sixteen path vertices at a time.

#include "capture/tracer/integrator/packet_materials.hpp"
#include "capture/tracer/integrator/transport.hpp"

namespace rs::capture {

struct GatherPacket {
    SurfaceLanes surfaces;
    MaskLanes lit{};  // lanes that hold a vertex
    Lanes time;
    bool any_lit = false;

    void clear() {
        lit = {};
        any_lit = false;
    }
    void set(std::size_t lane, const LightTransport::Vertex& vertex, const PacketMaterials& materials) {
        materials.set_lane(lane, vertex, surfaces);
        time[lane] = vertex.point.time;
        lit[lane] = -1;
        any_lit = true;
    }
};

// Sums the light that the vertices of one packet reflect. Not thread-safe.
class PacketLight {
public:
    /// Keeps references to both.
    PacketLight(const RayScene& rays, const PacketMaterials& materials) : rays_(rays), materials_(materials) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) shadows_.ray.mask[lane] = ~0U;
    }

    void begin(const GatherPacket& packet) {
        reflected_ = {};
        shadows_.ray.time = packet.time;
    }
    // Adds LightSet::sample_centre() of this light.
    void add_centre(std::size_t index, const LightSet& lights, const GatherPacket& packet) {
        if (lights.sample_centre(index, packet.surfaces, packet.lit, incident_)) add(packet);
    }
    void add_virtual(const VirtualLight& light, float bound, const GatherPacket& packet) {
        if (light_from_virtual(light, bound, materials_.tables(), packet.surfaces, packet.lit, incident_)) {
            incident_.casters = {};
            add(packet);
        }
    }
    // Radiance that a lane's vertex reflects to its viewer.
    [[nodiscard]] glm::vec3 reflected(std::size_t lane) const { return reflected_.at(lane); }

private:
    void add(const GatherPacket& packet) {
        if (!reflect_light(packet.surfaces, incident_, materials_.tables(), shadows_)) return;
        rays_.occluded(shadows_.active, shadows_.ray, incident_.casters);
        add_light(shadows_, reflected_);
    }

    const RayScene& rays_;
    const PacketMaterials& materials_;
    LightLanes incident_;
    ShadowLanes shadows_;
    Lanes3 reflected_{};
};

}  // namespace rs::capture
