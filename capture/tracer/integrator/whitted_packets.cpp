// WhittedTracer for packets of sixteen camera rays. Each step gives bit-identical results to its scalar counterpart in
// follow(), shade() and make_shadow_ray().
#include "capture/tracer/integrator/whitted.hpp"
#include "capture/tracer/packets/light_lanes.hpp"
#include "capture/tracer/packets/surface_lanes.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"

#include <algorithm>

namespace rs::capture {

struct WhittedTracer::Packet {
    MaskLanes active;  // lanes that have a ray
    RayHitLanes hits;
    std::array<const PacketMaterial*, kLanes> material{};  // null: no hit
    TriangleLanes triangles;
    SurfaceLanes surfaces;
    MaskLanes lit;     // lanes whose surface reflects light samples
    Lanes3 reflected;  // radiance of those
    std::array<bool, kLanes> has_specular_rays{};
    bool any_lit = false, any_specular_rays = false;
    LightLanes incident;
    ShadowLanes shadows;

    void load(std::span<const CameraRay> rays);
};

void WhittedTracer::Packet::load(std::span<const CameraRay> rays) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const CameraRay& from = rays[std::min(lane, rays.size() - 1)];
        active[lane] = lane < rays.size() ? -1 : 0;
        hits.begin(lane, from.origin, from.direction, from.time);
        shadows.ray.time[lane] = from.time;
        shadows.ray.mask[lane] = ~0U;
        lit[lane] = 0;
    }
    material = {};
    has_specular_rays = {};
    any_lit = any_specular_rays = false;
}

void WhittedTracer::trace_many(std::span<CameraRay> rays, std::span<RadianceSample> samples) const {
    Packet packet;
    for (std::size_t first = 0; first < rays.size(); first += kLanes) {
        const std::size_t count = std::min(kLanes, rays.size() - first);
        trace_packet(rays.subspan(first, count), samples.subspan(first, count), packet);
    }
}

void WhittedTracer::trace_packet(std::span<CameraRay> rays, std::span<RadianceSample> samples, Packet& packet) const {
    packet.load(rays);
    intersect_packet(rays, samples, packet);
    if (packet.any_lit) {
        prepare_shading(packet);
        for (std::size_t i = 0; i < transport_.lights().light_count(); ++i) add_light_samples(i, rays, packet);
        for (std::size_t lane = 0; lane < rays.size(); ++lane) {
            if (packet.lit[lane] != 0) samples[lane].radiance += packet.reflected.at(lane);
        }
    }
    if (packet.any_specular_rays) trace_specular_rays(rays, samples, packet);
}

// Intersects the camera rays and computes their surfaces' positions and materials.
void WhittedTracer::intersect_packet(std::span<const CameraRay> rays, std::span<RadianceSample> samples,
                                     Packet& packet) const {
    const HitLanes& hit = packet.hits.hit;
    transport_.rays().intersect(packet.active, packet.hits);
    for (std::size_t lane = 0; lane < rays.size(); ++lane) {
        samples[lane] = {};
        if (!packet.hits.has_hit(lane)) {
            Ray followed{LightTransport::camera_segment(rays[lane].origin, rays[lane].direction, rays[lane].time)};
            samples[lane].hit =
                transport_.finish_segment(followed.segment, false, followed.media, followed.throughput,
                                          samples[lane].radiance, {}) != LightTransport::SegmentEnd::kNothing;
            continue;
        }
        const Mesh& mesh = transport_.rays().gather_triangle(packet.hits, lane, packet.triangles);
        const PacketMaterial& material = materials_[mesh.material];
        packet.material[lane] = &material;
        material.fill(lane, packet.surfaces.material);
        glm::vec3 colour = material.colour;
        if (!mesh.colours.empty()) colour *= interpolate_colour(mesh, hit.triangle[lane], hit.u[lane], hit.v[lane]);
        packet.surfaces.colour.set(lane, colour);
        packet.surfaces.light_group[lane] = transport_.scene().scopes.group_of(hit.mesh[lane], hit.instance[lane]);
    }
    place_surfaces(packet.triangles, packet.hits.ray.direction, transport_.rays().step_off(), packet.surfaces);
    for (std::size_t lane = 0; lane < rays.size(); ++lane) {
        if (packet.material[lane] == nullptr || !finish_camera_ray(lane, packet, samples[lane])) continue;
        const PacketMaterial& material = *packet.material[lane];
        packet.has_specular_rays[lane] = material.has_specular_rays();
        packet.any_specular_rays = packet.any_specular_rays || material.has_specular_rays();
        if (material.is_specular()) continue;
        packet.lit[lane] = -1;
        packet.any_lit = true;
    }
}

// LightTransport::finish_segment() for a camera ray that hit a surface. Returns false if the path ends there.
bool WhittedTracer::finish_camera_ray(std::size_t lane, const Packet& packet, RadianceSample& sample) const {
    const PacketMaterial& material = *packet.material[lane];
    const bool front_side = packet.surfaces.front_side[lane] != 0;
    sample.hit = true;
    if (material.emissive || transport_.has_visible_areas()) {
        const RayLanes& ray = packet.hits.ray;
        SurfacePoint point{};
        point.distance = ray.reach[lane];
        point.material = material.index;
        point.front_side = front_side;
        point.uv = packet.surfaces.uv.at(lane);
        Ray followed{LightTransport::camera_segment(ray.origin.at(lane), ray.direction.at(lane))};
        (void)transport_.finish_segment(followed.segment, true, followed.media, followed.throughput, sample.radiance,
                                        point);
    }
    return front_side || !material.one_sided;
}

// Computes textured colours, shading frames and ambient light of the lit lanes.
void WhittedTracer::prepare_shading(Packet& packet) const {
    SurfaceLanes& surfaces = packet.surfaces;
    const RayLanes& ray = packet.hits.ray;
    std::array<const Texture*, kLanes> textures{};
    bool textured = false;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (packet.lit[lane] == 0) continue;
        const PacketMaterial& material = *packet.material[lane];
        textures[lane] = material.texture;
        textured = textured || material.texture != nullptr;
        if (!material.has_relief) continue;
        SurfacePoint point;
        transport_.rays().surface_at(RayScene::hit_of(packet.hits, lane), ray.direction.at(lane), ray.time[lane],
                                     point);
        surfaces.normal.set(lane, transport_.mapped_normal(point));
    }
    if (textured) texture_surfaces(textures, surfaces);
    orient_surfaces(ray.direction, materials_.tables(), surfaces);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        packet.reflected.x[lane] = surfaces.colour.x[lane] * ambient_.x;
        packet.reflected.y[lane] = surfaces.colour.y[lane] * ambient_.y;
        packet.reflected.z[lane] = surfaces.colour.z[lane] * ambient_.z;
    }
    const LightScopes& scopes = transport_.scene().scopes;
    if (irradiance_.is_black() && !packet.any_specular_rays && scopes.empty()) return;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (packet.lit[lane] == 0) continue;
        const PacketMaterial& material = *packet.material[lane];
        glm::vec3 reflected(0.0F);  // metals: no ambient light
        if (material.kind != SurfaceKind::metal) {
            reflected = surfaces.colour.at(lane) * (ambient_radiance(surfaces.normal.at(lane), material.translucency) +
                                                    scopes.ambient(surfaces.light_group[lane]));
        }
        packet.reflected.set(lane, reflected);
    }
}

void WhittedTracer::add_light_samples(std::size_t light, std::span<CameraRay> rays, Packet& packet) const {
    LightLanes& incident = packet.incident;
    if (soft_shadows_) {
        incident.lit = {};
        for (std::size_t lane = 0; lane < rays.size(); ++lane) {
            if (packet.lit[lane] == 0) continue;
            const auto draw = [&] { return rays[lane].sampler.next_2d(); };
            const LitPoint at{packet.surfaces.near_start.at(lane), packet.surfaces.light_group[lane]};
            const auto sample = transport_.lights().sample_point(light, at, draw);
            if (sample) set_lane(lane, *sample, incident);
        }
    } else if (!transport_.lights().sample_centre(light, packet.surfaces, packet.lit, incident)) {
        return;
    }
    ShadowLanes& shadows = packet.shadows;
    if (!reflect_light(packet.surfaces, incident, materials_.tables(), shadows)) return;
    transport_.rays().occluded(shadows.active, shadows.ray, incident.casters);
    add_light(shadows, packet.reflected);
}

// Traces the specular rays of the packet.
void WhittedTracer::trace_specular_rays(std::span<CameraRay> rays, std::span<RadianceSample> samples,
                                        const Packet& packet) const {
    for (std::size_t lane = 0; lane < rays.size(); ++lane) {
        if (!packet.has_specular_rays[lane]) continue;
        CameraRay& from = rays[lane];
        SurfacePoint point;
        transport_.rays().surface_at(RayScene::hit_of(packet.hits, lane), from.direction, from.time, point);
        const LightTransport::Vertex vertex = transport_.vertex_at(point, from.direction);
        trace_specular({LightTransport::camera_segment(from.origin, from.direction, from.time)}, vertex, from.sampler,
                       samples[lane].radiance);
    }
}

}  // namespace rs::capture
