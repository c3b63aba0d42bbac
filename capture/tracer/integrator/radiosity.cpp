#include "capture/tracer/integrator/radiosity.hpp"

#include "rayspace/base/check.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::capture {

namespace {

constexpr std::uint64_t kOfTimes = 0x74696D6573ULL;  // key of their random numbers
// Smaller images are not worth the photons of many groups.
constexpr int kPixelsOfGroup = 4096;

}  // namespace

struct RadiosityTracer::Packet {
    Packet(const RayScene& rays, const PacketMaterials& materials) : light(rays, materials) {}

    std::array<Way, kLanes> ways;
    GatherPacket vertices;
    PacketLight light;
    MaskLanes asked;
    MetLanes met;

    [[nodiscard]] bool empty() const {
        return std::ranges::none_of(ways, [](const Way& way) { return way.ray != nullptr; });
    }
};

RadiosityTracer::RadiosityTracer(const LightTransport& transport, const VirtualLightOptions& options,
                                 const RayImage& image, std::uint64_t key, int first, int count)
    : transport_(transport),
      materials_(transport.scene(), transport.models()),
      options_(options),
      key_(key),
      first_(first) {
    const VirtualLights lights(transport_, materials_, options, image, key);
    bound_ = lights.bound();
    if (image.width * image.height >= kPixelsOfGroup * static_cast<int>(kLanes)) groups_ = kLanes;
    lights_.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(groups_));
    for_each_index(static_cast<std::int64_t>(lights_.size()), 0, [&](std::int64_t i) {
        const int group = first_ * groups_ + static_cast<int>(i);
        lights_[static_cast<std::size_t>(i)] = lights.group(group, time_of(group / groups_));
    });
}

std::size_t RadiosityTracer::light_count() const {
    std::size_t count = 0;
    for (const auto& lights : lights_) count += lights.size();
    return count;
}

float RadiosityTracer::time_of(int pass) const {
    if (!transport_.rays().blurred()) return 0.0F;
    return Sampler(mix_bits(key_ ^ kOfTimes), static_cast<std::uint32_t>(pass)).next_2d().x;
}

const std::vector<VirtualLight>& RadiosityTracer::lights_for(const CameraRay& ray) const {
    const auto pass = static_cast<std::size_t>(ray.sampler.sample()) - static_cast<std::size_t>(first_);
    const auto groups = static_cast<std::size_t>(groups_);
    return lights_[pass * groups + ray.in_square % groups];
}

bool RadiosityTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                            glm::vec3& radiance) const {
    CameraRay ray{origin, direction, time, sampler};
    RadianceSample arrived;
    trace_many({&ray, 1}, {&arrived, 1});
    sampler = ray.sampler;
    radiance = arrived.radiance;
    return arrived.met;
}

void RadiosityTracer::Way::begin(CameraRay& from, RadianceSample& into, float at) {
    ray = &from;
    arrived = &into;
    into = {};
    segment = LightTransport::camera_segment(from.origin, from.direction, at);
    media = {};
    throughput = glm::vec3(1.0F);
    gathered_cos = 0.0F;
    distance = 0.0F;
}

void RadiosityTracer::trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const {
    Packet packet(transport_.rays(), materials_);
    std::array<std::vector<std::size_t>, kLanes> of_group;
    for (const CameraRay& ray : rays) RS_CHECK(ray.sampler.sample() == rays.front().sampler.sample());
    for (std::size_t i = 0; i < rays.size(); ++i)
        of_group[rays[i].in_square % static_cast<unsigned>(groups_)].push_back(i);
    for (const auto& all : of_group) {
        for (std::size_t first = 0; first < all.size(); first += kLanes) {
            for (std::size_t lane = 0; lane < kLanes && first + lane < all.size(); ++lane) {
                const std::size_t i = all[first + lane];
                packet.ways[lane].begin(rays[i], arrived[i], time_of(static_cast<int>(rays[i].sampler.sample())));
            }
            trace_packet(packet);
        }
    }
}

// All go on together, surface by surface, until the last has ended.
void RadiosityTracer::trace_packet(Packet& packet) const {
    for (int bounce = 0;; ++bounce) {
        follow_to_surfaces(packet, bounce);
        if (packet.empty()) return;
        gather(packet, bounce);
        for (Way& way : packet.ways) {
            if (way.ray != nullptr) go_on(way, bounce);
        }
    }
}

void RadiosityTracer::follow_to_surfaces(Packet& packet, int bounce) const {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Way& way = packet.ways[lane];
        packet.asked[lane] = way.ray != nullptr ? -1 : 0;
        packet.met.begin(lane, way.segment.origin, way.segment.direction, way.segment.time);
    }
    transport_.rays().intersect(packet.asked, packet.met);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        Way& way = packet.ways[lane];
        if (way.ray == nullptr) continue;
        const bool met = packet.met.has_met(lane);
        SurfacePoint point{};
        if (met) {
            transport_.rays().surface_at(RayScene::hit_of(packet.met, lane), way.segment.direction, way.segment.time,
                                         point);
        }
        meet(way, met, point, bounce);
    }
}

// Leaves no ray where the way ends.
void RadiosityTracer::meet(Way& way, bool hit, const SurfacePoint& point, int bounce) const {
    using Met = LightTransport::Met;
    const Met met = transport_.arrive(way.segment, hit, way.media, way.throughput, way.arrived->radiance, point);
    way.arrived->met = bounce > 0 || met != Met::kNothing;
    CameraRay* const ray = std::exchange(way.ray, nullptr);
    if (met != Met::kSurface || bounce == options_.max_bounces) return;
    way.vertex.emplace(transport_.vertex_at(point, way.segment.direction));
    way.distance += point.distance;
    way.vertex->guide(way.distance, *way.arrived);
    if (way.gathered_cos > 0.0F && !way.vertex->surface.is_specular()) {
        // The rest goes on as a path, by roulette.
        const float cos_facet = std::abs(glm::dot(point.geometric_normal, way.segment.direction));
        const float geometry = way.gathered_cos * cos_facet / (point.distance * point.distance);
        if (!(geometry > bound_) || ray->sampler.next_2d().x < bound_ / geometry) return;
    }
    way.ray = ray;
}

void RadiosityTracer::gather(Packet& packet, int bounce) const {
    const LightSet& lights = transport_.lights();
    GatherPacket& vertices = packet.vertices;
    vertices.clear();
    const CameraRay* some = nullptr;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        Way& way = packet.ways[lane];
        if (way.ray == nullptr) continue;
        some = way.ray;
        if (way.vertex->surface.is_specular()) continue;
        const glm::vec3 start = way.vertex->start_of(way.vertex->point.geometric_normal, true);
        way.vertex->selection = LightSet::all(start);
        vertices.set(lane, *way.vertex, materials_);
    }
    if (!vertices.some_lit) return;
    packet.light.begin(vertices);
    for (std::size_t number = 0; number < lights.light_count(); ++number) {
        if (lights.is_point(number)) packet.light.add_middle(number, lights, vertices);
    }
    for (const VirtualLight& light : lights_for(*some)) {
        if (bounce + light.depth < options_.max_bounces) packet.light.add_virtual(light, bound_, vertices);
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        Way& way = packet.ways[lane];
        if (way.ray == nullptr || vertices.lit[lane] == 0) continue;
        way.arrived->radiance += way.throughput * (packet.light.sent(lane) + from_areas(*way.vertex, way.ray->sampler));
    }
}

// And from surfaces that shine and from the sky.
glm::vec3 RadiosityTracer::from_areas(const Vertex& vertex, Sampler& sampler) const {
    const LightSet& lights = transport_.lights();
    glm::vec3 sum(0.0F);
    for (std::size_t number = 0; number < lights.light_count(); ++number) {
        if (lights.is_point(number)) continue;
        const auto light = lights.point(number, vertex.selection.position, [&] { return sampler.next_2d(); });
        if (light) sum += transport_.light_from(*light, vertex);
    }
    if (!lights.environment().is_black()) {
        if (const auto light = lights.sky(sampler.next_2d())) sum += transport_.light_from(*light, vertex);
    }
    return sum;
}

void RadiosityTracer::go_on(Way& way, int bounce) const {
    Sampler& sampler = way.ray->sampler;
    CameraRay* const ray = std::exchange(way.ray, nullptr);
    SurfaceSample drawn;
    if (!way.vertex->surface.sample(sampler.next_2d().x, sampler.next_2d(), drawn)) return;
    way.gathered_cos = way.vertex->surface.is_specular() ? 0.0F : std::abs(drawn.direction.z);
    way.throughput *= drawn.weight;
    way.segment = transport_.segment_from(*way.vertex, drawn);
    const SurfacePoint& point = way.vertex->point;
    if (way.vertex->surface.passes(drawn)) way.media.cross(transport_.material_of(point), point.front_side);
    const float survival = bounce >= kMostMirrors ? std::min(1.0F, max_component(way.throughput)) : 1.0F;
    if (!(sampler.next_2d().x < survival)) return;
    way.throughput /= survival;
    way.ray = ray;
}

}  // namespace rs::capture
