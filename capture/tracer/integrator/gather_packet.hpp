#pragma once
// Up to sixteen vertices of paths, on which light falls.

#include "capture/tracer/integrator/packet_materials.hpp"
#include "capture/tracer/integrator/transport.hpp"

namespace rs::capture {

struct GatherPacket {
    SurfaceLanes surfaces;
    MaskLanes lit{};  // lanes that hold a vertex
    Lanes time;
    bool some_lit = false;

    void clear() {
        lit = {};
        some_lit = false;
    }
    void set(std::size_t lane, const LightTransport::Vertex& vertex, const PacketMaterials& materials) {
        materials.set_lane(lane, vertex, surfaces);
        time[lane] = vertex.point.time;
        lit[lane] = -1;
        some_lit = true;
    }
};

// Light on the vertices of one packet. Not thread-safe.
class PacketLight {
public:
    // Refers to all of them.
    PacketLight(const RayScene& rays, const PacketMaterials& materials) : rays_(rays), materials_(materials) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) shadows_.ray.mask[lane] = ~0U;
    }

    void begin(const GatherPacket& packet) {
        sent_ = {};
        shadows_.ray.time = packet.time;
    }
    // LightSet::middle() of this number.
    void add_middle(std::size_t number, const LightSet& lights, const GatherPacket& packet) {
        if (lights.middle(number, packet.surfaces, packet.lit, arrives_)) add(packet);
    }
    void add_virtual(const VirtualLight& light, float bound, const GatherPacket& packet) {
        if (light_from_virtual(light, bound, materials_.tables(), packet.surfaces, packet.lit, arrives_)) add(packet);
    }
    // What a lane's vertex sends of all that was added.
    [[nodiscard]] glm::vec3 sent(std::size_t lane) const { return sent_.at(lane); }

private:
    void add(const GatherPacket& packet) {
        if (!send_light(packet.surfaces, arrives_, materials_.tables(), shadows_)) return;
        rays_.occluded(shadows_.asked, shadows_.ray);
        add_light(shadows_, sent_);
    }

    const RayScene& rays_;
    const PacketMaterials& materials_;
    LightLanes arrives_;
    SentLanes shadows_;
    Lanes3 sent_{};
};

}  // namespace rs::capture
