#include "capture/tracer/integrator/path.hpp"

#include "capture/tracer/light/directions.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rs::capture {

namespace {

constexpr int kRouletteFrom = 3;

// Interpolated normals may face away from the viewer near silhouettes: the normal is bent just far enough to face them.
glm::vec3 facing_normal(const glm::vec3& normal, const glm::vec3& to_viewer) {
    constexpr float kLeastCos = 0.01F;
    const float cos_viewer = glm::dot(normal, to_viewer);
    if (cos_viewer >= kLeastCos) return normal;
    return glm::normalize(normal + to_viewer * (kLeastCos - cos_viewer));
}

glm::vec3 surface_colour(const Scene& scene, const Material& material, const SurfacePoint& point) {
    if (material.texture < 0) return material.colour * point.colour;
    const RgbaF texel = sample_texture(scene.textures[static_cast<std::size_t>(material.texture)], point.uv);
    return material.colour * point.colour * glm::vec3(texel.r, texel.g, texel.b);
}

// The glass that a path is inside of, the innermost last. Glass may overlap: what is left is the last entry of its
// kind.
class MediumStack {
public:
    // What the path runs in now; null outside of all glass.
    [[nodiscard]] const Material* innermost() const { return size_ > 0 ? media_[size_ - 1] : nullptr; }

    // Where all places are taken, the outermost glass is forgotten.
    void enter(const Material& glass) {
        if (size_ == kMost) drop(0);
        media_[size_++] = &glass;
    }
    // Leaving what was never entered (the camera stood inside, or the surface is open) changes nothing.
    void leave(const Material& glass) {
        for (std::size_t i = size_; i-- > 0;) {
            if (media_[i] == &glass) return drop(i);
        }
    }

private:
    static constexpr std::size_t kMost = 4;

    void drop(std::size_t index) {
        for (--size_; index < size_; ++index) media_[index] = media_[index + 1];
    }

    std::array<const Material*, kMost> media_{};
    std::size_t size_ = 0;
};

}  // namespace

struct PathTracer::Shading {
    const SurfacePoint& point;
    Frame frame;
    Surface surface;
    bool thin;  // light passes to the far side
    float step_off;
    LightSet::Selection selection{};

    // Where rays in `direction` start. Opaque surfaces send all light from the near side, even what goes below the
    // facet but above the curved surface it stands for.
    [[nodiscard]] glm::vec3 start_of(const glm::vec3& direction, bool near_side) const {
        if (thin) near_side = glm::dot(point.geometric_normal, direction) > 0.0F;
        if (!near_side) return point.position - point.geometric_normal * step_off;
        return (thin ? point.position : point.lifted_position) + point.geometric_normal * step_off;
    }
};

bool PathTracer::trace(glm::vec3 origin, glm::vec3 direction, Sampler& sampler, glm::vec3& radiance) const {
    radiance = glm::vec3(0.0F);
    glm::vec3 throughput(1.0F);
    Segment segment{origin, direction};
    MediumStack media;  // that the segment runs in

    for (int bounce = 0;; ++bounce) {
        SurfacePoint point;
        const bool hit = rays_.intersect(segment.origin, segment.direction, point);
        const float reach = hit ? point.distance : std::numeric_limits<float>::infinity();
        if (bounce > 0) {
            if (const auto shown = rays_.ask_primitives(segment.origin, segment.direction, reach)) {
                // It is drawn by no light sample, so it counts in full; of the light that passes before it, too.
                radiance += throughput * (shown->radiance + areas_on_the_way(segment, shown->distance));
                return true;
            }
        }
        if (const Material* medium = media.innermost(); hit && medium != nullptr) {
            throughput *= glm::pow(medium->colour, glm::vec3(point.distance));
        }
        if (bounce > 0 || seen_.areas) radiance += throughput * areas_on_the_way(segment, reach);
        if (!hit && (bounce > 0 || seen_.environment)) radiance += throughput * environment_behind(segment);
        if (!hit) return bounce > 0 || max_component(radiance) > 0.0F;

        const Material& material = scene_.materials[static_cast<std::size_t>(point.material)];
        radiance += throughput * emission_of(material, point, segment);
        if (bounce == max_bounces_) return true;
        if (!point.front_side && !material.two_sided && material.kind != SurfaceKind::glass) return true;

        const glm::vec3 to_viewer = -segment.direction;
        const Frame frame(facing_normal(point.shading_normal, to_viewer));
        const SurfaceModel& model = models_[static_cast<std::size_t>(point.material)];
        Shading shading{
            point, frame,
            Surface(model, surface_colour(scene_, material, point), frame.to_local(to_viewer), !point.front_side),
            model.translucency > 0.0F, rays_.step_off()};

        const glm::vec2 choices = sampler.next_2d();
        if (!shading.surface.is_specular()) {
            shading.selection = lights_.select(shading.start_of(point.geometric_normal, true));
            radiance += throughput * light_sample(shading, choices.y, sampler.next_2d());
        }
        SurfaceSample drawn;
        if (!shading.surface.sample(choices.x, sampler.next_2d(), drawn)) return true;
        throughput *= drawn.weight;
        segment = segment_from(shading, drawn);
        if (material.kind == SurfaceKind::glass && drawn.direction.z < 0.0F) {
            if (point.front_side) {
                media.enter(material);
            } else {
                media.leave(material);
            }
        }

        if (bounce >= kRouletteFrom) {
            const float survival = std::min(1.0F, max_component(throughput));
            if (!(sampler.next_2d().x < survival)) return true;
            throughput /= survival;
        }
    }
}

glm::vec3 PathTracer::areas_on_the_way(const Segment& segment, float distance) const {
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < lights_.area_count(); ++i) {
        const auto crossing = lights_.cross_area(i, segment.selection, segment.origin, segment.direction, distance);
        if (crossing) sum += crossing->radiance * (segment.specular ? 1.0F : mis_weight(segment.pdf, crossing->pdf));
    }
    return sum;
}

glm::vec3 PathTracer::environment_behind(const Segment& segment) const {
    if (lights_.environment().is_black()) return glm::vec3(0.0F);
    const float pdf = lights_.environment_pdf(segment.selection, segment.direction);
    return lights_.environment().radiance(segment.direction) * (segment.specular ? 1.0F : mis_weight(segment.pdf, pdf));
}

glm::vec3 PathTracer::emission_of(const Material& material, const SurfacePoint& point, const Segment& segment) const {
    if (max_component(material.emission) <= 0.0F || (!point.front_side && !material.two_sided)) return glm::vec3(0.0F);
    const glm::vec3 emission = lights_.emission(point.material, point.uv);
    if (segment.specular || max_component(emission) <= 0.0F) return emission;
    const float cos_light = std::max(-glm::dot(point.geometric_normal, segment.direction), 1e-6F);
    return emission *
           mis_weight(segment.pdf, lights_.emitter_pdf(segment.selection, point.material, point.distance, cos_light));
}

glm::vec3 PathTracer::light_sample(const Shading& shading, float u_source, const glm::vec2& u) const {
    const glm::vec3 dark(0.0F);
    const auto light = lights_.sample(shading.selection, u_source, u);
    if (!light) return dark;
    const glm::vec3 wi = shading.frame.to_local(light->direction);
    const Surface::Value value = shading.surface.evaluate(wi);
    if (max_component(value.f_cos) <= 0.0F) return dark;
    const glm::vec3 start = shading.start_of(light->direction, wi.z > 0.0F);
    // Just short of the light, which may be a surface itself.
    if (rays_.occluded(start, light->direction, light->distance * (1.0F - 1e-4F))) return dark;
    const float weight = light->delta ? 1.0F : mis_weight(light->pdf, value.pdf);
    return value.f_cos * light->radiance * (weight / light->pdf);
}

PathTracer::Segment PathTracer::segment_from(const Shading& shading, const SurfaceSample& drawn) const {
    Segment segment;
    segment.direction = glm::normalize(shading.frame.to_world(drawn.direction));
    segment.pdf = drawn.pdf;
    segment.specular = drawn.specular;
    segment.selection = shading.selection;
    const bool near_side = drawn.direction.z > 0.0F;
    if (drawn.specular) {
        // A reflection must leave the facet and a refraction must enter it; interpolated normals may say otherwise near
        // silhouettes, where the direction is mirrored at the facet.
        const float cos_facet = glm::dot(shading.point.geometric_normal, segment.direction);
        if ((cos_facet > 0.0F) != near_side) segment.direction -= 2.0F * cos_facet * shading.point.geometric_normal;
    }
    segment.origin = shading.start_of(segment.direction, near_side);
    return segment;
}

}  // namespace rs::capture
