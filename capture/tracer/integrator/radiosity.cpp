#include "capture/tracer/integrator/radiosity.hpp"

#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

namespace {

constexpr float kBound = 8.0F;
constexpr int kCameraPoints = 64;
constexpr int kPilotPhotons = 64;  // at a time
constexpr int kPilotLights = 32;   // that bring something
constexpr int kMostPhotons = 4096;
constexpr float kLeastKept = 0.05F;
constexpr int kMostMirrors = 8;
constexpr int kLightSamples = 8;
// Keys of the random numbers of parts.
constexpr std::uint64_t kOfCameraPoints = 0x63616D657261ULL;
constexpr std::uint64_t kOfPilot = 0x70696C6F74ULL;
constexpr std::uint64_t kOfPasses = 0x706173736573ULL;
constexpr std::uint64_t kOfTimes = 0x74696D6573ULL;

float away_from_zero(float cosine) {
    return std::max(std::abs(cosine), 1e-2F);
}

// Light that is followed forwards meets interpolated normals otherwise than light that is followed backwards
// (E. Veach, thesis, 5.3.2). `in` is where it comes from.
float adjoint_factor(const LightTransport::Vertex& vertex, const glm::vec3& in, const glm::vec3& out) {
    const glm::vec3& smooth = vertex.frame.normal;
    const glm::vec3& facet = vertex.point.geometric_normal;
    return std::abs(glm::dot(in, smooth) * glm::dot(out, facet)) /
           (away_from_zero(glm::dot(in, facet)) * away_from_zero(glm::dot(out, smooth)));
}

}  // namespace

RadiosityTracer::RadiosityTracer(const LightTransport& transport, const RadiosityOptions& options,
                                 const RayPicture& picture, std::uint64_t key, int first, int count)
    : transport_(transport), options_(options), key_(key), first_(first) {
    const glm::vec3 diagonal = transport.rays().upper() - transport.rays().lower();
    bound_ = kBound / std::max(glm::dot(diagonal, diagonal) / 4, 1e-12F);
    passes_.resize(static_cast<std::size_t>(count));
    if (transport_.lights().empty()) return;
    if (options_.importance) find_camera_points(picture);
    plan_photons();
    for_each_index(count, 0, [&](std::int64_t i) {
        passes_[static_cast<std::size_t>(i)] = lights_of(first_ + static_cast<int>(i));
    });
}

std::size_t RadiosityTracer::light_count() const {
    std::size_t count = 0;
    for (const VirtualLights& lights : passes_) count += lights.size();
    return count;
}

void RadiosityTracer::find_camera_points(const RayPicture& picture) {
    for (int i = 0; i < kCameraPoints; ++i) {
        Sampler sampler(mix_bits(key_ ^ kOfCameraPoints), static_cast<std::uint32_t>(i));
        const glm::vec2 at = sampler.next_2d();
        const glm::dvec3 ray =
            picture.ray(at.x * static_cast<float>(picture.width), at.y * static_cast<float>(picture.height));
        auto segment = LightTransport::camera_segment(glm::vec3(picture.centre), glm::vec3(glm::normalize(ray)));
        MediumStack media;
        glm::vec3 throughput(1.0F), ignored(0.0F);
        SurfacePoint point;
        for (int mirrors = 0; mirrors <= kMostMirrors; ++mirrors) {
            if (transport_.meet(segment, media, throughput, ignored, point) != LightTransport::Met::kSurface) break;
            const Vertex vertex = transport_.vertex_at(point, segment.direction);
            if (!vertex.surface.is_specular()) {
                camera_points_.push_back({vertex, throughput});
                break;
            }
            SurfaceSample drawn;
            if (!vertex.surface.sample(sampler.next_2d().x, {}, drawn)) break;
            throughput *= drawn.weight;
            segment = transport_.segment_from(vertex, drawn);
            if (vertex.surface.passes(drawn)) media.cross(transport_.material_of(point), point.front_side);
        }
    }
}

// How many photons give as many virtual lights as are wanted, and what one brings. The same for every pass.
void RadiosityTracer::plan_photons() {
    std::vector<float> importance;
    double sum = 0;
    int photons = 0, useful = 0;
    do {
        VirtualLights found;
        for (const int end = photons + kPilotPhotons; photons < end; ++photons) {
            Sampler sampler(mix_bits(key_ ^ kOfPilot), static_cast<std::uint32_t>(photons));
            follow_photon(0.0F, sampler, found);
        }
        for (const VirtualLight& light : found) {
            importance.push_back(importance_of(light));
            sum += static_cast<double>(importance.back());
            useful += importance.back() > 0.0F;
        }
    } while (!camera_points_.empty() && useful < kPilotLights && photons < kMostPhotons);

    double kept = static_cast<double>(importance.size());
    if (sum > 0) {
        mean_importance_ = static_cast<float>(sum / static_cast<double>(importance.size()));
        kept = 0;
        for (const float c : importance) kept += std::min(static_cast<double>(c / mean_importance_ + kLeastKept), 1.0);
    }
    const double wanted = options_.lights_of_pass * photons / std::max(kept, 1.0);
    photons_ = static_cast<int>(std::clamp(std::ceil(wanted), 1.0, static_cast<double>(kMostPhotons)));
}

void RadiosityTracer::follow_photon(float time, Sampler& sampler, VirtualLights& lights) const {
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
        if (!transport_.rays().intersect(segment.origin, segment.direction, time, point)) return;
        if (transport_.rays().ask_primitives(segment.origin, segment.direction, point.distance)) return;
        if (depth == 1) flux = photon->flux_at(point.position);
        flux *= media.passed(point.distance);
        if (!(max_component(flux) > 0.0F)) return;
        const Material& material = transport_.material_of(point);
        if (!point.front_side && material.is_one_sided()) return;

        const Vertex vertex = transport_.vertex_at(point, segment.direction);
        const glm::vec3 in = -segment.direction;
        if (!vertex.surface.is_specular()) {
            const float bent = std::abs(glm::dot(in, vertex.frame.normal)) /
                               away_from_zero(glm::dot(in, vertex.point.geometric_normal));
            lights.push_back({vertex, flux * bent, depth});
        }
        SurfaceSample drawn;
        if (!vertex.surface.sample(sampler.next_2d().x, sampler.next_2d(), drawn)) return;
        segment = transport_.segment_from(vertex, drawn);
        glm::vec3 weight = drawn.weight;
        if (!drawn.specular) weight *= adjoint_factor(vertex, in, segment.direction);
        if (vertex.surface.passes(drawn)) media.cross(material, point.front_side);
        const float survival = std::min(1.0F, max_component(weight));
        if (!(sampler.next_2d().x < survival)) return;
        flux *= weight / survival;
    }
}

RadiosityTracer::VirtualLights RadiosityTracer::lights_of(int pass) const {
    VirtualLights kept;
    const float time = time_of(pass);
    for (int i = 0; i < photons_; ++i) {
        // One sequence for all passes, so that their photons are stratified together.
        Sampler sampler(mix_bits(key_ ^ kOfPasses), static_cast<std::uint32_t>(pass * photons_ + i));
        VirtualLights found;
        follow_photon(time, sampler, found);
        for (VirtualLight& light : found) {
            light.flux /= static_cast<float>(photons_);
            if (mean_importance_ > 0.0F) {
                // The pilot's photons were whole.
                const float importance = importance_of(light) * static_cast<float>(photons_);
                const float chance = std::min(importance / mean_importance_ + kLeastKept, 1.0F);
                if (!(sampler.next_2d().x < chance)) continue;
                light.flux /= chance;
            }
            kept.push_back(light);
        }
    }
    return kept;
}

float RadiosityTracer::time_of(int pass) const {
    if (!transport_.rays().blurred()) return 0.0F;
    return Sampler(mix_bits(key_ ^ kOfTimes), static_cast<std::uint32_t>(pass)).next_2d().x;
}

float RadiosityTracer::importance_of(const VirtualLight& light) const {
    float sum = 0.0F;
    for (const CameraPoint& point : camera_points_) {
        sum += luminance(point.throughput * light_from(light, point.vertex));
    }
    return sum;
}

glm::vec3 RadiosityTracer::light_from(const VirtualLight& light, const Vertex& vertex) const {
    const glm::vec3 dark(0.0F);
    const Vertex& from = light.vertex;
    const glm::vec3 way = from.point.position - vertex.point.position;
    const float distance2 = glm::dot(way, way);
    if (!(distance2 > 0.0F)) return dark;
    const glm::vec3 direction = way / std::sqrt(distance2);
    const glm::vec3 wi = vertex.frame.to_local(direction);
    const glm::vec3 here = vertex.surface.evaluate(wi).f_cos;
    if (!(max_component(here) > 0.0F)) return dark;

    const float cos_facet = glm::dot(from.point.geometric_normal, -direction);
    if (!from.thin && cos_facet <= 0.0F) return dark;
    const glm::vec3 there = from.surface.sent(from.frame.to_local(-direction));
    if (!(max_component(there) > 0.0F)) return dark;

    // `here` holds a cosine that the geometry term is bounded with.
    float geometry = std::abs(cos_facet) / distance2;
    const float with_cosine = geometry * std::abs(wi.z);
    if (with_cosine > bound_) geometry *= bound_ / with_cosine;

    const glm::vec3 start = vertex.start_of(direction, wi.z > 0.0F);
    const glm::vec3 end = from.start_of(-direction, true);
    const glm::vec3 ray = end - start;
    const float length = glm::length(ray);
    const float reach = length * (1.0F - 1e-4F);
    if (!(length > 0.0F) || transport_.rays().occluded(start, ray / length, reach, vertex.point.time)) return dark;
    return here * there * light.flux * geometry;
}

bool RadiosityTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float /*time*/, Sampler& sampler,
                            glm::vec3& radiance) const {
    using Met = LightTransport::Met;
    const VirtualLights& lights = passes_[sampler.sample() - static_cast<std::uint32_t>(first_)];
    radiance = glm::vec3(0.0F);
    glm::vec3 throughput(1.0F);
    LightTransport::Segment segment =
        LightTransport::camera_segment(origin, direction, time_of(static_cast<int>(sampler.sample())));
    MediumStack media;

    // Where virtual lights stand for what the segment would find on a surface, up to their bound: the cosine at its
    // beginning; else 0.
    float gathered_cos = 0.0F;
    for (int bounce = 0;; ++bounce) {
        SurfacePoint point;
        const Met met = transport_.meet(segment, media, throughput, radiance, point);
        if (met != Met::kSurface || bounce == options_.max_bounces) return bounce > 0 || met != Met::kNothing;
        Vertex vertex = transport_.vertex_at(point, segment.direction);
        const bool specular = vertex.surface.is_specular();
        if (gathered_cos > 0.0F && !specular) {
            // The rest goes on as a path, by roulette.
            const float cos_facet = std::abs(glm::dot(point.geometric_normal, segment.direction));
            const float geometry = gathered_cos * cos_facet / (point.distance * point.distance);
            if (!(geometry > bound_) || sampler.next_2d().x < bound_ / geometry) return true;
        }

        if (!specular) {
            transport_.select_lights(vertex);
            glm::vec3 arrived(0.0F);
            for (int i = 0; i < kLightSamples; ++i) {
                const float source = (static_cast<float>(i) + sampler.next_2d().x) / kLightSamples;
                arrived += transport_.light_sample(vertex, source, sampler.next_2d(), kLightSamples);
            }
            for (const VirtualLight& light : lights) {
                if (bounce + light.depth < options_.max_bounces) arrived += light_from(light, vertex);
            }
            radiance += throughput * arrived;
        }
        SurfaceSample drawn;
        if (!vertex.surface.sample(sampler.next_2d().x, sampler.next_2d(), drawn)) return true;
        gathered_cos = specular ? 0.0F : std::abs(drawn.direction.z);
        throughput *= drawn.weight;
        segment = transport_.segment_from(vertex, drawn, kLightSamples);
        if (vertex.surface.passes(drawn)) media.cross(transport_.material_of(point), point.front_side);
        const float survival = bounce >= kMostMirrors ? std::min(1.0F, max_component(throughput)) : 1.0F;
        if (!(sampler.next_2d().x < survival)) return true;
        throughput /= survival;
    }
}

}  // namespace rs::capture
