#include "capture/tracer/integrator/radiosity.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::capture {

namespace {

constexpr std::uint64_t kTimesKey = 0x74696D6573ULL;  // key of the random sequence for pass times
// Minimum number of pixels per group; smaller images do not justify the cost of many groups.
constexpr int kPixelsPerGroup = 4096;

}  // namespace

struct RadiosityTracer::Packet {
    Packet(const RayScene& rays, const PacketMaterials& materials) : light(rays, materials) {}

    std::array<PathState, kLanes> paths;
    GatherPacket vertices;
    PacketLight light;
    MaskLanes active;
    RayHitLanes hits;

    [[nodiscard]] bool empty() const {
        return std::ranges::none_of(paths, [](const PathState& path) { return path.ray != nullptr; });
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
    if (image.width * image.height >= kPixelsPerGroup * static_cast<int>(kLanes)) groups_ = kLanes;
    lights_.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(groups_));
    for_each_index(static_cast<std::int64_t>(lights_.size()), 0, [&](std::int64_t i) {
        const int group = first_ * groups_ + static_cast<int>(i);
        lights_[static_cast<std::size_t>(i)] = lights.make_group(group, time_of(group / groups_));
    });
}

std::size_t RadiosityTracer::light_count() const {
    std::size_t count = 0;
    for (const auto& lights : lights_) count += lights.size();
    return count;
}

float RadiosityTracer::time_of(int pass) const {
    if (!transport_.rays().blurred()) return 0.0F;
    return Sampler(mix_bits(key_ ^ kTimesKey), static_cast<std::uint32_t>(pass)).next_2d().x;
}

const std::vector<VirtualLight>& RadiosityTracer::lights_for(const CameraRay& ray) const {
    const auto pass = static_cast<std::size_t>(ray.sampler.sample()) - static_cast<std::size_t>(first_);
    const auto groups = static_cast<std::size_t>(groups_);
    return lights_[pass * groups + ray.in_square % groups];
}

bool RadiosityTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                            glm::vec3& radiance) const {
    CameraRay ray{origin, direction, time, sampler};
    RadianceSample sample;
    trace_many({&ray, 1}, {&sample, 1});
    sampler = ray.sampler;
    radiance = sample.radiance;
    return sample.hit;
}

void RadiosityTracer::PathState::begin(CameraRay& from, RadianceSample& into, float at) {
    ray = &from;
    sample = &into;
    into = {};
    segment = LightTransport::camera_segment(from.origin, from.direction, at);
    media = {};
    throughput = glm::vec3(1.0F);
    gathered_cos = 0.0F;
    distance = 0.0F;
}

void RadiosityTracer::trace_many(std::span<CameraRay> rays, std::span<RadianceSample> samples) const {
    Packet packet(transport_.rays(), materials_);
    std::array<std::vector<std::size_t>, kLanes> by_group;
    for (const CameraRay& ray : rays) RS_CHECK(ray.sampler.sample() == rays.front().sampler.sample());
    for (std::size_t i = 0; i < rays.size(); ++i)
        by_group[rays[i].in_square % static_cast<unsigned>(groups_)].push_back(i);
    for (const auto& all : by_group) {
        for (std::size_t first = 0; first < all.size(); first += kLanes) {
            for (std::size_t lane = 0; lane < kLanes && first + lane < all.size(); ++lane) {
                const std::size_t i = all[first + lane];
                packet.paths[lane].begin(rays[i], samples[i], time_of(static_cast<int>(rays[i].sampler.sample())));
            }
            trace_packet(packet);
        }
    }
}

// Advances all paths by one surface per iteration until the last has ended.
void RadiosityTracer::trace_packet(Packet& packet) const {
    for (int bounce = 0;; ++bounce) {
        trace_to_surfaces(packet, bounce);
        if (packet.empty()) return;
        gather(packet, bounce);
        for (PathState& path : packet.paths) {
            if (path.ray != nullptr) continue_path(path, bounce);
        }
    }
}

void RadiosityTracer::trace_to_surfaces(Packet& packet, int bounce) const {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const PathState& path = packet.paths[lane];
        packet.active[lane] = path.ray != nullptr ? -1 : 0;
        packet.hits.begin(lane, path.segment.origin, path.segment.direction, path.segment.time);
    }
    transport_.rays().intersect(packet.active, packet.hits);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        PathState& path = packet.paths[lane];
        if (path.ray == nullptr) continue;
        const bool hit = packet.hits.has_hit(lane);
        SurfacePoint point{};
        if (hit) {
            transport_.rays().surface_at(RayScene::hit_of(packet.hits, lane), path.segment.direction, path.segment.time,
                                         point);
        }
        finish_hit(path, hit, point, bounce);
    }
}

// Sets path.ray to null if the path ends.
void RadiosityTracer::finish_hit(PathState& path, bool hit, const SurfacePoint& point, int bounce) const {
    using SegmentEnd = LightTransport::SegmentEnd;
    const SegmentEnd end =
        transport_.finish_segment(path.segment, hit, path.media, path.throughput, path.sample->radiance, point);
    path.sample->hit = bounce > 0 || end != SegmentEnd::kNothing;
    CameraRay* const ray = std::exchange(path.ray, nullptr);
    if (end != SegmentEnd::kSurface || bounce == options_.max_bounces) return;
    path.vertex.emplace(transport_.vertex_at(point, path.segment.direction));
    path.distance += point.distance;
    path.vertex->record_guide(path.distance, *path.sample);
    if (path.gathered_cos > 0.0F && !path.vertex->surface.is_specular()) {
        // Continues the part of the light above the bound by Russian roulette.
        const float cos_facet = std::abs(glm::dot(point.geometric_normal, path.segment.direction));
        const float geometry = path.gathered_cos * cos_facet / (point.distance * point.distance);
        if (!(geometry > bound_) || ray->sampler.next_2d().x < bound_ / geometry) return;
    }
    path.ray = ray;
}

void RadiosityTracer::gather(Packet& packet, int bounce) const {
    const LightSet& lights = transport_.lights();
    GatherPacket& vertices = packet.vertices;
    vertices.clear();
    const CameraRay* any_ray = nullptr;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        PathState& path = packet.paths[lane];
        if (path.ray == nullptr) continue;
        any_ray = path.ray;
        if (path.vertex->surface.is_specular()) continue;
        path.vertex->selection = LightSet::select_all(path.vertex->lit_point());
        vertices.set(lane, *path.vertex, materials_);
    }
    if (!vertices.any_lit) return;
    packet.light.begin(vertices);
    for (std::size_t index = 0; index < lights.light_count(); ++index) {
        if (lights.is_point(index)) packet.light.add_centre(index, lights, vertices);
    }
    for (const VirtualLight& light : lights_for(*any_ray)) {
        if (bounce + light.depth < options_.max_bounces) packet.light.add_virtual(light, bound_, vertices);
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        PathState& path = packet.paths[lane];
        if (path.ray == nullptr || vertices.lit[lane] == 0) continue;
        path.sample->radiance +=
            path.throughput * (packet.light.reflected(lane) + gather_areas(*path.vertex, path.ray->sampler));
    }
}

// Direct light of area lights, emissive surfaces and the environment.
glm::vec3 RadiosityTracer::gather_areas(const Vertex& vertex, Sampler& sampler) const {
    const LightSet& lights = transport_.lights();
    glm::vec3 sum(0.0F);
    for (std::size_t index = 0; index < lights.light_count(); ++index) {
        if (lights.is_point(index)) continue;
        const auto light = lights.sample_point(index, vertex.selection.at, [&] { return sampler.next_2d(); });
        if (light) sum += transport_.reflect_light(*light, vertex);
    }
    if (!lights.environment().is_black()) {
        if (const auto light = lights.sample_sky(sampler.next_2d())) sum += transport_.reflect_light(*light, vertex);
    }
    return sum;
}

void RadiosityTracer::continue_path(PathState& path, int bounce) const {
    Sampler& sampler = path.ray->sampler;
    CameraRay* const ray = std::exchange(path.ray, nullptr);
    SurfaceSample drawn;
    if (!path.vertex->surface.sample(sampler.next_2d().x, sampler.next_2d(), drawn)) return;
    path.gathered_cos = path.vertex->surface.is_specular() ? 0.0F : std::abs(drawn.direction.z);
    path.throughput *= drawn.weight;
    path.segment = transport_.make_segment(*path.vertex, drawn);
    const SurfacePoint& point = path.vertex->point;
    if (path.vertex->surface.is_transmission(drawn)) path.media.cross(transport_.material_of(point), point.front_side);
    const float survival = bounce >= kMaxSpecularBounces ? std::min(1.0F, max_component(path.throughput)) : 1.0F;
    if (!(sampler.next_2d().x < survival)) return;
    path.throughput /= survival;
    path.ray = ray;
}

}  // namespace rs::capture
