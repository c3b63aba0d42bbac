#include "capture/tracer/integrator/virtual_lights.hpp"

#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::capture {

namespace {

constexpr float kBound = 4.0F;
constexpr int kCameraPoints = 64;
constexpr int kPilotPhotons = 64;  // per iteration
constexpr int kPilotLights = 32;   // minimum number with importance > 0
constexpr int kMaxPhotons = 4096;
constexpr float kMinKeepProbability = 0.05F;
// Keys of independent random sequences.
constexpr std::uint64_t kCameraPointsKey = 0x63616D657261ULL;
constexpr std::uint64_t kPilotKey = 0x70696C6F74ULL;
constexpr std::uint64_t kGroupsKey = 0x706173736573ULL;

float away_from_zero(float cosine) {
    return std::max(std::abs(cosine), 1e-2F);
}

// Correction for light traced forwards: interpolated normals make the BSDF non-symmetric (E. Veach, thesis, 5.3.2).
// `in` points to the photon's origin.
float adjoint_factor(const LightTransport::Vertex& vertex, const glm::vec3& in, const glm::vec3& out) {
    const glm::vec3& smooth = vertex.frame.normal;
    const glm::vec3& facet = vertex.point.geometric_normal;
    return std::abs(glm::dot(in, smooth) * glm::dot(out, facet)) /
           (away_from_zero(glm::dot(in, facet)) * away_from_zero(glm::dot(out, smooth)));
}

}  // namespace

VirtualLights::VirtualLights(const LightTransport& transport, const PacketMaterials& materials,
                             const VirtualLightOptions& options, const RayImage& image, std::uint64_t key)
    : transport_(transport), materials_(materials), options_(options), key_(key) {
    if (transport_.lights().empty()) return;
    find_camera_points(image);
    plan_photons();
}

void VirtualLights::find_camera_points(const RayImage& image) {
    std::vector<float> distances;
    int found = 0;
    for (int i = 0; i < kCameraPoints; ++i) {
        Sampler sampler(mix_bits(key_ ^ kCameraPointsKey), static_cast<std::uint32_t>(i));
        const glm::vec2 at = sampler.next_2d();
        const glm::dvec3 ray =
            image.ray(at.x * static_cast<float>(image.width), at.y * static_cast<float>(image.height));
        auto segment = LightTransport::camera_segment(glm::vec3(image.centre), glm::vec3(glm::normalize(ray)));
        MediumStack media;
        glm::vec3 throughput(1.0F), ignored(0.0F);
        SurfacePoint point;
        for (int mirrors = 0; mirrors <= kMaxSpecularBounces; ++mirrors) {
            if (transport_.trace_segment(segment, media, throughput, ignored, point) !=
                LightTransport::SegmentEnd::kSurface)
                break;
            const Vertex vertex = transport_.vertex_at(point, segment.direction);
            const bool specular = vertex.surface.is_specular();
            if (!specular) {
                const auto lane = static_cast<std::size_t>(found++) % kLanes;
                if (lane == 0) camera_points_.emplace_back();
                camera_points_.back().packet.set(lane, vertex, materials_);
                camera_points_.back().throughput[lane] = throughput;
            }
            SurfaceSample drawn;
            const float lobe = sampler.next_2d().x;
            if (!vertex.surface.sample(lobe, specular ? glm::vec2(0.0F) : sampler.next_2d(), drawn)) break;
            throughput *= drawn.weight;
            segment = transport_.make_segment(vertex, drawn);
            if (!specular) {
                if (transport_.rays().intersect(segment.origin, segment.direction, 0.0F, point)) {
                    distances.push_back(point.distance);
                }
                break;
            }
            if (vertex.surface.is_transmission(drawn)) media.cross(transport_.material_of(point), point.front_side);
        }
    }
    find_bound(std::move(distances));
}

void VirtualLights::find_bound(std::vector<float> distances) {
    const glm::vec3 diagonal = transport_.rays().upper() - transport_.rays().lower();
    float reach = glm::length(diagonal) / 2;
    if (!distances.empty()) reach = std::min(reach, median(std::move(distances)));
    bound_ = kBound / std::max(reach * reach, 1e-12F);
}

// Estimates the number of photons that yields the requested number of virtual lights, and their mean importance, from
// a pilot sequence. The same for every group.
void VirtualLights::plan_photons() {
    std::vector<Candidate> found;
    double sum = 0;
    int photons = 0, useful = 0;
    do {
        for (const Candidate& light : trace_photons(kPilotKey, photons, kPilotPhotons, 0.0F)) {
            sum += static_cast<double>(light.importance);
            useful += light.importance > 0.0F;
            found.push_back(light);
        }
        photons += kPilotPhotons;
    } while (uses_importance() && useful < kPilotLights && photons < kMaxPhotons);

    double kept = static_cast<double>(found.size());
    if (sum > 0) {
        mean_importance_ = static_cast<float>(sum / static_cast<double>(found.size()));
        kept = 0;
        for (const Candidate& light : found) {
            kept += std::min(static_cast<double>(light.importance / mean_importance_ + kMinKeepProbability), 1.0);
        }
    }
    const double photons_needed = options_.lights_per_group * photons / std::max(kept, 1.0);
    photons_ = static_cast<int>(std::clamp(std::ceil(photons_needed), 1.0, static_cast<double>(kMaxPhotons)));
}

std::vector<VirtualLights::Candidate> VirtualLights::trace_photons(std::uint64_t sequence, std::int64_t first,
                                                                   int count, float time) const {
    constexpr int kChunkSize = 32;
    const int chunks = (count + kChunkSize - 1) / kChunkSize;
    std::vector<std::vector<Candidate>> of_chunk(static_cast<std::size_t>(chunks));
    for_each_index(chunks, [&](int chunk) {
        PacketLight scratch(transport_.rays(), materials_);
        std::vector<VirtualLight> lights;
        for (int i = chunk * kChunkSize; i < std::min((chunk + 1) * kChunkSize, count); ++i) {
            Sampler sampler(mix_bits(key_ ^ sequence), static_cast<std::uint32_t>(first + i));
            lights.clear();
            follow_photon(time, sampler, lights);
            for (const VirtualLight& light : lights) {
                const float importance = uses_importance() ? estimate_importance(light, scratch) : 0.0F;
                of_chunk[static_cast<std::size_t>(chunk)].push_back({light, importance, sampler.next_2d().x});
            }
        }
    });
    std::vector<Candidate> all;
    for (const auto& found : of_chunk) all.insert(all.end(), found.begin(), found.end());
    return all;
}

void VirtualLights::follow_photon(float time, Sampler& sampler, std::vector<VirtualLight>& lights) const {
    const glm::vec2 source = sampler.next_2d();
    const glm::vec2 place = sampler.next_2d();
    const auto photon = transport_.lights().emit(source.x, place, sampler.next_2d());
    if (!photon) return;
    LightTransport::Segment segment{photon->origin + photon->normal * transport_.rays().step_off(), photon->direction,
                                    time};
    MediumStack media;
    glm::vec3 flux(0.0F);
    for (int depth = 1; depth < options_.max_bounces; ++depth) {
        SurfacePoint point;
        const bool in_scope = depth == 1 && photon->scoped_light != kUnscoped;
        if (in_scope ? !transport_.rays().intersect_in_scope(photon->scoped_light, segment.origin, segment.direction,
                                                             time, point)
                     : !transport_.rays().intersect(segment.origin, segment.direction, time, point))
            return;
        if (!in_scope && transport_.rays().intersect_primitives(segment.origin, segment.direction, point.distance))
            return;
        if (depth == 1) flux = photon->flux_at(point.position);
        flux *= media.transmittance(point.distance);
        if (!(max_component(flux) > 0.0F)) return;
        const Material& material = transport_.material_of(point);
        if (!point.front_side && material.is_one_sided()) return;

        const Vertex vertex = transport_.vertex_at(point, segment.direction);
        const glm::vec3 in = -segment.direction;
        if (!vertex.surface.is_specular()) {
            const float bent = std::abs(glm::dot(in, vertex.frame.normal)) /
                               away_from_zero(glm::dot(in, vertex.point.geometric_normal));
            lights.push_back(materials_.make_virtual_light(vertex, flux * bent, depth));
        }
        SurfaceSample drawn;
        if (!vertex.surface.sample(sampler.next_2d().x, sampler.next_2d(), drawn)) return;
        segment = transport_.make_segment(vertex, drawn);
        glm::vec3 weight = drawn.weight;
        if (!drawn.specular) weight *= adjoint_factor(vertex, in, segment.direction);
        if (vertex.surface.is_transmission(drawn)) media.cross(material, point.front_side);
        const float survival = std::min(1.0F, max_component(weight));
        if (!(sampler.next_2d().x < survival)) return;
        flux *= weight / survival;
    }
}

std::vector<VirtualLight> VirtualLights::make_group(int number, float time) const {
    std::vector<VirtualLight> kept;
    if (transport_.lights().empty()) return kept;
    // One sequence for all groups stratifies their photons together.
    for (Candidate& found : trace_photons(kGroupsKey, static_cast<std::int64_t>(number) * photons_, photons_, time)) {
        if (mean_importance_ > 0.0F) {
            const float probability = std::min(found.importance / mean_importance_ + kMinKeepProbability, 1.0F);
            if (!(found.u_keep < probability)) continue;
            found.light.flux /= probability;
        }
        found.light.flux /= static_cast<float>(photons_);
        kept.push_back(found.light);
    }
    return kept;
}

float VirtualLights::estimate_importance(const VirtualLight& light, PacketLight& scratch) const {
    float sum = 0.0F;
    for (const CameraPoints& points : camera_points_) {
        scratch.begin(points.packet);
        scratch.add_virtual(light, bound_, points.packet);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            if (points.packet.lit[lane] != 0) sum += luminance(points.throughput[lane] * scratch.reflected(lane));
        }
    }
    return sum;
}

}  // namespace rs::capture
