#pragma once
// All light sources of a scene: draws one for next-event estimation, and computes the densities that multiple
// importance sampling needs when a path meets a source by itself.
//
// A source is drawn with probability 1/2 (1/n + its share of the estimated irradiance) where it is needed: n counts the
// sources that may reach the place, so that a lamp among many is found where it shines. Radiance samples carry the
// density over all sources, per steradian; of sources without an area ("delta"), which no path meets by itself,
// `radiance / pdf` is irradiance over the probability of the draw.

#include "capture/tracer/light/environment_map.hpp"
#include "capture/tracer/light/photon.hpp"
#include "capture/tracer/packets/light_lanes.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "rayspace/light/light_model.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace rs::capture {

struct LightSample {
    glm::vec3 direction;  // unit, towards the light
    float distance;       // infinity for the environment and directional lights
    glm::vec3 radiance;
    float pdf;  // > 0
    bool delta;
};
// Lights a lane by it.
void set_lane(std::size_t lane, const LightSample& sample, LightLanes& arrives);

class LightSet {
public:
    // A sphere around all meshes.
    struct Extent {
        glm::vec3 centre{0.0F};
        float radius = 1.0F;
    };
    // `environment` takes the place of the scene's own. Refers to `scene`, which must stay where it is and unchanged.
    LightSet(const Scene& scene, Environment environment, const Extent& extent);

    // In place of those that were there.
    void set_lights(const std::vector<Light>& lights);

    // After instances of the scene have moved: those that shine are gathered anew. What moves while the shutter is open
    // is no source of samples: it shines where drawn directions meet it.
    void update_instances(const Extent& extent);

    // Another environment, or the same one brighter and turned; set_lights() must follow.
    void set_environment(Environment environment);
    void set_environment(float scale, float turn_rad);

    // Turns the lights and the environment about Y, from where they were at construction; positive angles take
    // +Z to +X. Surfaces that shine stay.
    void turn(float angle_rad);

    [[nodiscard]] bool empty() const { return sources_.empty(); }

    // How sources are drawn at a place.
    struct Selection {
        glm::vec3 position{0.0F};
        float total = 0.0F;  // of the estimates of all sources
        float even = 0.0F;   // 1 / n; 0 where no source reaches
    };
    [[nodiscard]] Selection select(const glm::vec3& position) const;
    // That of a place which each source is drawn for, once: by middle() those that is_point() names, by point() the
    // others, by sky() the environment.
    [[nodiscard]] static Selection all(const glm::vec3& position);

    // Nothing where the drawn source does not light the place. u_source picks the source, u the point on it.
    [[nodiscard]] std::optional<LightSample> sample(const Selection& selection, float u_source,
                                                    const glm::vec2& u) const;

    // One of the photons that all sources send into the scene, drawn by about their flux; the mean of what such photons
    // carry is what arrives. Nothing where this one carries nothing. There must be a source.
    [[nodiscard]] std::optional<Photon> emit(float u_source, const glm::vec2& u_place,
                                             const glm::vec2& u_direction) const;

    // How many lights middle() and point() know by their numbers.
    [[nodiscard]] std::size_t light_count() const { return sources_.size() + glows_.size(); }
    // One that is a point or infinitely far away. Not a mesh that shines.
    [[nodiscard]] bool is_point(std::size_t number) const {
        return number < sources_.size() &&
               (sources_[number].kind == SourceKind::local || sources_[number].kind == SourceKind::distant);
    }
    // Each source but the environment as one point that stands for all of it: areas, and each mesh that shines, by
    // their middle. `radiance / pdf` is irradiance. Nothing where it does not light the place.
    [[nodiscard]] std::optional<LightSample> middle(std::size_t number, const glm::vec3& position) const;
    // The same for sixteen surfaces, at their near_start, as far as they are requested; lanes on which the light has no
    // effect may be left out. False where no lane is lit.
    bool middle(std::size_t number, const SurfaceLanes& surfaces, const MaskLanes& wanted, LightLanes& arrives) const;
    // The same, but each area by a point of it, and all meshes that shine by one point together; `draw` chooses where.
    [[nodiscard]] std::optional<LightSample> point(std::size_t number, const glm::vec3& position,
                                                   const std::function<glm::vec2()>& draw) const;

    // Of the environment; nothing where there is none.
    [[nodiscard]] std::optional<LightSample> sky(const glm::vec2& u) const;

    [[nodiscard]] const EnvironmentMap& environment() const { return environment_; }
    // Density with which sample() gives this direction through the environment.
    [[nodiscard]] float environment_pdf(const Selection& selection, const glm::vec3& direction) const;

    // Radiance of a point of material `material`, by its emission and the texture on it.
    [[nodiscard]] glm::vec3 emission(int material, const glm::vec2& uv) const;
    // Density with which sample() gives a point of an emissive triangle that is seen at `distance` under `cos_light`.
    [[nodiscard]] float emitter_pdf(const Selection& selection, int material, float distance, float cos_light) const;

    // Area lights are not part of the ray-tracing scene; a path adds those its segments cross.
    struct Crossing {
        glm::vec3 radiance;
        float pdf;  // with which sample() gives this direction through this light
    };
    [[nodiscard]] std::size_t area_count() const { return areas_.size(); }
    [[nodiscard]] std::optional<Crossing> cross_area(std::size_t index, const Selection& selection,
                                                     const glm::vec3& origin, const glm::vec3& direction,
                                                     float max_distance) const;

private:
    enum class SourceKind { environment, distant, local, area, emitters };
    struct Source {
        SourceKind kind;
        std::size_t index;  // of lights_ or areas_
        float power;        // estimated irradiance: at any place, or at distance 1 of what stands in the scene
    };
    struct Area {
        std::size_t light = 0;   // of lights_
        std::size_t source = 0;  // of sources_
        glm::vec3 middle{0.0F}, half_u{0.0F}, half_v{0.0F}, normal{0.0F};
        glm::vec3 radiance{0.0F};
        float parallelogram = 0.0F;  // of half_u and half_v
        float area = 0.0F;
        const LightModel* model = nullptr;
    };
    // A mesh that shines, for those who take it for a point.
    struct EmissiveMeshProxy {
        glm::vec3 middle{0.0F};
        glm::vec3 mean_normal{0.0F};  // times the area; short where the mesh is closed
        glm::vec3 emission{0.0F};     // mean
        float area = 0.0F;
        float radius = 0.0F;  // around the middle
        bool two_sided = false;
    };

    struct Emitter {
        const Mesh* mesh;
        std::size_t triangle;
        float cumulative;  // share of the power of this and all emitters before it
    };

    struct EmitterPoint {
        glm::vec3 position, normal;
        glm::vec2 uv;
        bool hole;
    };

    [[nodiscard]] static std::optional<LightSample> glow(const EmissiveMeshProxy& glow, const glm::vec3& position);
    void gather_emitters();
    void gather_emitter(const Mesh& mesh);
    void gather_glow(const Mesh& mesh);
    void add_light(const Light& light);
    void place_lights(float turn_rad);
    [[nodiscard]] float estimate(const Source& source, const glm::vec3& position) const;
    [[nodiscard]] static float probability(const Selection& selection, float estimate) {
        return estimate > 0.0F ? 0.5F * (selection.even + estimate / selection.total) : 0.0F;
    }
    [[nodiscard]] std::optional<LightSample> sample_environment(float probability, const glm::vec2& u) const;
    [[nodiscard]] static std::optional<LightSample> sample_light(const Light& light, const glm::vec3& position,
                                                                 float probability);
    // `at` in coordinates along its halves.
    [[nodiscard]] static std::optional<LightSample> sample_area(const Area& area, const glm::vec3& position,
                                                                float probability, const glm::vec2& at);
    [[nodiscard]] std::optional<LightSample> sample_emitter(const Selection& selection, float u_emitter,
                                                            const glm::vec2& u) const;

    [[nodiscard]] float emitters_irradiance() const;  // estimated
    [[nodiscard]] EmitterPoint point_on(const Emitter& emitter, const glm::vec2& u) const;
    [[nodiscard]] float flux_of(const Source& source) const;
    void sum_flux();
    [[nodiscard]] Photon emit_distant(const glm::vec3& direction, const glm::vec3& irradiance,
                                      const glm::vec2& u) const;
    [[nodiscard]] static std::optional<Photon> emit_local(const Light& light, float chance, const glm::vec2& u);
    [[nodiscard]] std::optional<Photon> emit_emitter(float u_emitter, float chance, const glm::vec2& u_place,
                                                     const glm::vec2& u_direction) const;

    const Scene& scene_;
    float environment_turn_rad_;  // at construction
    EnvironmentMap environment_;
    float turn_rad_ = 0.0F;           // since construction
    Extent extent_;                   // nearer than its radius, surfaces that shine are not thought to be brighter
    std::vector<Light> lights_;       // those of the scene that shine, as they are turned now
    std::vector<Light> still_;        // the same as they were at construction
    std::vector<PointLight> points_;  // of lights_; those of areas and directional lights are not used
    std::vector<Area> areas_;
    std::vector<std::unique_ptr<const Mesh>> placed_;  // meshes of instances that shine, in the world
    std::vector<Emitter> emitters_;
    std::vector<EmissiveMeshProxy> glows_;
    std::vector<float> brightness_;  // of each material: luminance of its emission, mean over the texture
    bool instances_shine_ = false;
    double emitter_power_ = 0;  // sum of area * brightness
    std::vector<Source> sources_;
    std::vector<float> flux_;  // share of this and all sources before it
    std::optional<std::size_t> environment_source_;
    std::optional<std::size_t> emitter_source_;
};

}  // namespace rs::capture
