#pragma once
// What all ways of following light have in common: segments between surfaces, what is met at their ends and on their
// way, light samples, and the weights of multiple importance sampling.
//
// Radiance is not scaled by the squared index of refraction inside glass: all lights are outside, where it cancels.

#include "capture/tracer/image/accumulation.hpp"
#include "capture/tracer/integrator/medium_stack.hpp"
#include "capture/tracer/integrator/sampler.hpp"
#include "capture/tracer/integrator/surface.hpp"
#include "capture/tracer/light/light_set.hpp"
#include "capture/tracer/rays/ray_scene.hpp"
#include "rayspace/light/directions.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rs::capture {

// By the camera itself; else in reflections and through glass only. Primitives it never sees.
struct Seen {
    bool areas = false;
    bool environment = false;
};

// A ray of an image.
struct CameraRay {
    glm::vec3 origin;
    glm::vec3 direction;  // unit length
    float time;           // 0..1 as ray_scene.hpp has it
    Sampler sampler;
    unsigned in_square = 0;  // number of its pixel within a square of 4 x 4, row by row
};

// The light that arrives along one ray of an image.
class Integrator {
public:
    Integrator() = default;
    Integrator(const Integrator&) = default;
    Integrator& operator=(const Integrator&) = delete;
    virtual ~Integrator() = default;
    // False where the ray meets nothing; then `radiance` is 0. `direction` has unit length, `time` is 0..1 as
    // ray_scene.hpp has it. Thread-safe.
    virtual bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                       glm::vec3& radiance) const = 0;
    // The same bits for many rays, as many results; neighbours in the list should be neighbours in the image.
    virtual void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const {
        trace_one_by_one(rays, arrived);
    }

    // Whether it describes what the first rough surface of each ray is.
    [[nodiscard]] virtual bool gives_guides() const { return false; }

protected:
    void trace_one_by_one(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            arrived[i].met =
                trace(rays[i].origin, rays[i].direction, rays[i].time, rays[i].sampler, arrived[i].radiance);
        }
    }
};

// Thread-safe.
class LightTransport {
public:
    // Refers to all of them.
    LightTransport(const Scene& scene, const RayScene& rays, const LightSet& lights,
                   const std::vector<SurfaceModel>& models, Seen seen = {})
        : scene_(scene), rays_(rays), lights_(lights), models_(models), seen_(seen) {}

    // A straight piece of a path, and how it was drawn.
    struct Segment {
        glm::vec3 origin;
        glm::vec3 direction;
        float time = 0.0F;  // the same for all of a path
        float pdf = 0.0F;
        bool specular = true;  // no light sample could have given it
        bool of_camera = false;
        LightSet::Selection selection{};  // of the light samples at its beginning
    };
    [[nodiscard]] static Segment camera_segment(const glm::vec3& origin, const glm::vec3& direction,
                                                float time = 0.0F) {
        Segment segment{origin, direction, time};
        segment.of_camera = true;
        return segment;
    }

    // Where a segment ends and light is scattered.
    struct Vertex {
        SurfacePoint point;
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

        // Notes it as what a ray has met after so long a way, where it is the first that is rough.
        void guide(float distance, RadianceSample& arrived) const {
            if (arrived.guided || surface.is_specular()) return;
            arrived.guided = true;
            arrived.guide = {point.position, frame.normal, surface.colour(), distance};
        }
    };

    enum class Met {
        kNothing,
        kLight,  // and the path ends: a primitive, lights before nothing, the side of a surface that is not there
        kSurface,
    };
    // Follows a segment: dims `throughput` by the glass on the way, adds to `radiance` what shines there, throughput
    // included, and gives where it ends.
    Met meet(const Segment& segment, const MediumStack& media, glm::vec3& throughput, glm::vec3& radiance,
             SurfacePoint& point) const;

    // The same where `hit` states whether `point` is what the segment meets first.
    Met arrive(const Segment& segment, bool hit, const MediumStack& media, glm::vec3& throughput, glm::vec3& radiance,
               const SurfacePoint& point) const;

    [[nodiscard]] Vertex vertex_at(const SurfacePoint& point, const glm::vec3& direction) const;
    // Makes ready for light samples.
    void select_lights(Vertex& vertex) const {
        vertex.selection = lights_.select(vertex.start_of(vertex.point.geometric_normal, true));
    }
    // Light of one source that arrives at a vertex and leaves where the segment before came from, with its weight
    // beside one drawn direction.
    [[nodiscard]] glm::vec3 light_sample(const Vertex& vertex, float u_source, const glm::vec2& u) const;
    // The same of a sample that is given.
    [[nodiscard]] glm::vec3 light_from(const LightSample& light, const Vertex& vertex) const;
    [[nodiscard]] Segment segment_from(const Vertex& vertex, const SurfaceSample& drawn) const;

    // The shading normal where the material has relief. Sides that are seen from behind have the front's, turned over.
    [[nodiscard]] glm::vec3 normal_in_relief(const SurfacePoint& point) const;

    [[nodiscard]] const Material& material_of(const SurfacePoint& point) const {
        return scene_.materials[static_cast<std::size_t>(point.material)];
    }
    [[nodiscard]] const SurfaceModel& model_of(const SurfacePoint& point) const {
        return models_[static_cast<std::size_t>(point.material)];
    }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const std::vector<SurfaceModel>& models() const { return models_; }
    // Whether a camera ray brings nothing but what the surface sends that it meets, unless the surface itself shines.
    [[nodiscard]] bool sees_surfaces_only() const { return !seen_.areas || lights_.area_count() == 0; }
    [[nodiscard]] const RayScene& rays() const { return rays_; }
    [[nodiscard]] const LightSet& lights() const { return lights_; }

private:
    [[nodiscard]] glm::vec3 areas_on_the_way(const Segment& segment, float distance) const;
    [[nodiscard]] glm::vec3 environment_behind(const Segment& segment) const;
    [[nodiscard]] glm::vec3 emission_of(const SurfacePoint& point, const Segment& segment) const;
    // Of what a drawn segment met, beside the light samples at its beginning.
    [[nodiscard]] static float weight_of(const Segment& segment, float light_pdf) {
        return mis_weight(segment.pdf, light_pdf);
    }

    const Scene& scene_;
    const RayScene& rays_;
    const LightSet& lights_;
    const std::vector<SurfaceModel>& models_;
    Seen seen_;
};

}  // namespace rs::capture
