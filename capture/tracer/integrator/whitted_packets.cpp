// The part of WhittedTracer that takes camera rays sixteen at a time; each step gives the bits of its twin in follow(),
// shade() and shadow_of().
#include "capture/tracer/integrator/whitted.hpp"
#include "capture/tracer/packets/light_lanes.hpp"
#include "capture/tracer/packets/surface_lanes.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"

#include <algorithm>

namespace rs::capture {

struct WhittedTracer::Packet {
    MaskLanes asked;  // lanes that have a ray
    MetLanes met;
    std::array<const PacketMaterial*, kLanes> material{};  // null where nothing is met
    TriangleLanes triangles;
    SurfaceLanes surfaces;
    MaskLanes lit;                       // lanes that meet a surface that lights shine on
    Lanes3 sent;                         // what those send
    std::array<bool, kLanes> goes_on{};  // lanes that mirror or let light pass
    bool some_lit = false, some_go_on = false;
    LightLanes arrives;
    SentLanes shadows;

    void take(std::span<const CameraRay> rays);
};

void WhittedTracer::Packet::take(std::span<const CameraRay> rays) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const CameraRay& from = rays[std::min(lane, rays.size() - 1)];
        asked[lane] = lane < rays.size() ? -1 : 0;
        met.begin(lane, from.origin, from.direction, from.time);
        shadows.ray.time[lane] = from.time;
        shadows.ray.mask[lane] = ~0U;
        lit[lane] = 0;
    }
    material = {};
    goes_on = {};
    some_lit = some_go_on = false;
}

void WhittedTracer::trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const {
    Packet packet;
    for (std::size_t first = 0; first < rays.size(); first += kLanes) {
        const std::size_t count = std::min(kLanes, rays.size() - first);
        trace_packet(rays.subspan(first, count), arrived.subspan(first, count), packet);
    }
}

void WhittedTracer::trace_packet(std::span<CameraRay> rays, std::span<RadianceSample> arrived, Packet& packet) const {
    packet.take(rays);
    meet(rays, arrived, packet);
    if (packet.some_lit) {
        make_ready(packet);
        for (std::size_t i = 0; i < transport_.lights().light_count(); ++i) light_packet(i, rays, packet);
        for (std::size_t lane = 0; lane < rays.size(); ++lane) {
            if (packet.lit[lane] != 0) arrived[lane].radiance += packet.sent.at(lane);
        }
    }
    if (packet.some_go_on) go_on(rays, arrived, packet);
}

// Follows the camera's rays as far as what they meet first.
void WhittedTracer::meet(std::span<const CameraRay> rays, std::span<RadianceSample> arrived, Packet& packet) const {
    const HitLanes& hit = packet.met.hit;
    transport_.rays().intersect(packet.asked, packet.met);
    for (std::size_t lane = 0; lane < rays.size(); ++lane) {
        arrived[lane] = {};
        if (!packet.met.has_met(lane)) {
            Ray followed{LightTransport::camera_segment(rays[lane].origin, rays[lane].direction, rays[lane].time)};
            arrived[lane].met = transport_.arrive(followed.segment, false, followed.media, followed.throughput,
                                                  arrived[lane].radiance, {}) != LightTransport::Met::kNothing;
            continue;
        }
        const Mesh& mesh = transport_.rays().triangle_of(packet.met, lane, packet.triangles);
        const PacketMaterial& material = materials_[mesh.material];
        packet.material[lane] = &material;
        material.fill(lane, packet.surfaces.material);
        glm::vec3 colour = material.colour;
        if (!mesh.colours.empty()) colour *= interpolate_colour(mesh, hit.triangle[lane], hit.u[lane], hit.v[lane]);
        packet.surfaces.colour.set(lane, colour);
    }
    place_surfaces(packet.triangles, packet.met.ray.direction, transport_.rays().step_off(), packet.surfaces);
    for (std::size_t lane = 0; lane < rays.size(); ++lane) {
        if (packet.material[lane] == nullptr || !arrive_at(lane, packet, arrived[lane])) continue;
        const PacketMaterial& material = *packet.material[lane];
        packet.goes_on[lane] = material.goes_on();
        packet.some_go_on = packet.some_go_on || material.goes_on();
        if (material.is_specular()) continue;
        packet.lit[lane] = -1;
        packet.some_lit = true;
    }
}

// LightTransport::arrive() of a camera ray that has met this surface.
bool WhittedTracer::arrive_at(std::size_t lane, const Packet& packet, RadianceSample& arrived) const {
    const PacketMaterial& material = *packet.material[lane];
    const bool front_side = packet.surfaces.front_side[lane] != 0;
    arrived.met = true;
    if (material.shines || !transport_.sees_surfaces_only()) {
        const RayLanes& ray = packet.met.ray;
        SurfacePoint point{};
        point.distance = ray.reach[lane];
        point.material = material.number;
        point.front_side = front_side;
        point.uv = packet.surfaces.uv.at(lane);
        Ray followed{LightTransport::camera_segment(ray.origin.at(lane), ray.direction.at(lane))};
        (void)transport_.arrive(followed.segment, true, followed.media, followed.throughput, arrived.radiance, point);
    }
    return front_side || !material.one_sided;
}

// For light: colours, frames, and what comes from everywhere.
void WhittedTracer::make_ready(Packet& packet) const {
    SurfaceLanes& surfaces = packet.surfaces;
    const RayLanes& ray = packet.met.ray;
    std::array<const Texture*, kLanes> textures{};
    bool textured = false;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (packet.lit[lane] == 0) continue;
        const PacketMaterial& material = *packet.material[lane];
        textures[lane] = material.texture;
        textured = textured || material.texture != nullptr;
        if (!material.relief) continue;
        SurfacePoint point;
        transport_.rays().surface_at(RayScene::hit_of(packet.met, lane), ray.direction.at(lane), ray.time[lane], point);
        surfaces.normal.set(lane, transport_.normal_in_relief(point));
    }
    if (textured) texture_surfaces(textures, surfaces);
    face_viewers(ray.direction, materials_.tables(), surfaces);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        packet.sent.x[lane] = surfaces.colour.x[lane] * ambient_.x;
        packet.sent.y[lane] = surfaces.colour.y[lane] * ambient_.y;
        packet.sent.z[lane] = surfaces.colour.z[lane] * ambient_.z;
    }
    if (irradiance_.is_black() && !packet.some_go_on) return;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (packet.lit[lane] == 0) continue;
        const PacketMaterial& material = *packet.material[lane];
        glm::vec3 sent(0.0F);  // of metals
        if (material.kind != SurfaceKind::metal) {
            sent = surfaces.colour.at(lane) * from_everywhere(surfaces.normal.at(lane), material.translucency);
        }
        packet.sent.set(lane, sent);
    }
}

void WhittedTracer::light_packet(std::size_t light, std::span<CameraRay> rays, Packet& packet) const {
    LightLanes& arrives = packet.arrives;
    if (soft_shadows_) {
        arrives.lit = {};
        for (std::size_t lane = 0; lane < rays.size(); ++lane) {
            if (packet.lit[lane] == 0) continue;
            const auto draw = [&] { return rays[lane].sampler.next_2d(); };
            const auto sample = transport_.lights().point(light, packet.surfaces.near_start.at(lane), draw);
            if (sample) set_lane(lane, *sample, arrives);
        }
    } else if (!transport_.lights().middle(light, packet.surfaces, packet.lit, arrives)) {
        return;
    }
    SentLanes& shadows = packet.shadows;
    if (!send_light(packet.surfaces, arrives, materials_.tables(), shadows)) return;
    transport_.rays().occluded(shadows.asked, shadows.ray);
    add_light(shadows, packet.sent);
}

// Into mirrors and glass.
void WhittedTracer::go_on(std::span<CameraRay> rays, std::span<RadianceSample> arrived, const Packet& packet) const {
    for (std::size_t lane = 0; lane < rays.size(); ++lane) {
        if (!packet.goes_on[lane]) continue;
        CameraRay& from = rays[lane];
        SurfacePoint point;
        transport_.rays().surface_at(RayScene::hit_of(packet.met, lane), from.direction, from.time, point);
        const LightTransport::Vertex vertex = transport_.vertex_at(point, from.direction);
        follow_mirrors({LightTransport::camera_segment(from.origin, from.direction, from.time)}, vertex, from.sampler,
                       arrived[lane].radiance);
    }
}

}  // namespace rs::capture
