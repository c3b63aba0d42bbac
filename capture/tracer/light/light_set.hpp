#pragma once
// All light sources of a scene: samples one for next-event estimation, and computes the densities for multiple
// importance sampling when a path hits a source.
//
// A source is selected with probability 1/2 (1/n + its share of the estimated irradiance at the shaded position); n is
// the number of sources that may reach the position, so that a lamp among many is found where it shines. Samples carry
// the density over all sources, per steradian. For sources without an area ("delta"), which paths cannot hit,
// `radiance / pdf` is the irradiance over the selection probability.

#include "capture/tracer/light/environment_map.hpp"
#include "capture/tracer/packets/light_lanes.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "rayspace/light/light.hpp"
#include "rayspace/light/light_model.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <map>
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
    ShadowCasters casters = {};
};

// A point of a surface to be lit.
struct LitPoint {
    glm::vec3 position{0.0F};
    std::uint32_t light_group = 0;  // index into LightScopes::groups
};
// Copies a sample to a lane.
void set_lane(std::size_t lane, const LightSample& sample, LightLanes& incident);

// Photon emitted by a light source, for forward tracing.
struct Photon {
    glm::vec3 origin;
    glm::vec3 direction;     // unit
    glm::vec3 normal{0.0F};  // of the emitting surface; 0 for point and distant lights
    // Flux over sampling density. Unused for point lights: their attenuation is arbitrary, so the flux depends on the
    // distance.
    glm::vec3 flux{0.0F};
    const Light* point = nullptr;            // the point light, if it is one
    float inverse_pdf = 0.0F;                // the flux at distance d is irradiance * d^2 * inverse_pdf
    std::uint32_t scoped_light = kUnscoped;  // its first hit is in the scope of this light

    [[nodiscard]] glm::vec3 flux_at(const glm::vec3& position) const {
        if (point == nullptr) return flux;
        const glm::vec3 way = position - origin;
        return irradiance_at(*point, position) * (glm::dot(way, way) * inverse_pdf);
    }
};

class LightSet {
public:
    // Bounding sphere of all meshes.
    struct Extent {
        glm::vec3 centre{0.0F};
        float radius = 1.0F;
    };
    /// `environment` replaces the scene's own. Keeps a reference to `scene`, which must outlive the set unchanged.
    LightSet(const Scene& scene, Environment environment, const Extent& extent);

    // Replaces all lights by those of the scene.
    void set_lights();

    // Updates emissive instances after instances of the scene have moved. Instances that move while the shutter is open
    // are not sampled; paths find their light by hitting them.
    void update_instances(const Extent& extent);

    // Replaces the environment, or its scale and rotation. A call of set_lights() must follow.
    void set_environment(Environment environment);
    void set_environment(float scale, float turn_rad);

    // Sets the rotation of lights and environment about Y, relative to construction; positive from +Z towards +X.
    // Emissive surfaces are not rotated.
    void turn(float angle_rad);

    [[nodiscard]] bool empty() const { return sources_.empty(); }

    // Selection probabilities at a position.
    struct Selection {
        LitPoint at{};
        float total = 0.0F;    // sum of the estimates of all sources
        float uniform = 0.0F;  // 1 / n; 0 if no source reaches the position
    };
    [[nodiscard]] Selection select(const LitPoint& at) const;
    // Selection for sampling every source once: with sample_centre() if is_point(), otherwise with sample_point(), and
    // sample_sky() for the environment.
    [[nodiscard]] static Selection select_all(const LitPoint& at);

    /// \param u_source selects the source
    /// \param u selects the point on it
    /// \return empty if the selected source does not light the position
    [[nodiscard]] std::optional<LightSample> sample(const Selection& selection, float u_source,
                                                    const glm::vec2& u) const;

    // Samples a photon, with sources selected approximately in proportion to flux. There must be a source. Empty if the
    // photon carries no flux.
    [[nodiscard]] std::optional<Photon> emit(float u_source, const glm::vec2& u_place,
                                             const glm::vec2& u_direction) const;

    // Number of lights with an index for sample_centre() and sample_point().
    [[nodiscard]] std::size_t light_count() const { return sources_.size() + proxies_.size(); }
    // Returns true for point and directional lights.
    [[nodiscard]] bool is_point(std::size_t index) const {
        return index < sources_.size() &&
               (sources_[index].kind == SourceKind::local || sources_[index].kind == SourceKind::distant);
    }
    // A source other than the environment as one point: area lights and emissive meshes by their centre. `radiance /
    // pdf` is irradiance. Empty if the light does not reach the position.
    [[nodiscard]] std::optional<LightSample> sample_centre(std::size_t index, const LitPoint& at) const;
    // The same for sixteen surfaces at their near_start. Lanes on which the light has no effect may be unlit. Returns
    // false if no lane is lit.
    bool sample_centre(std::size_t index, const SurfaceLanes& surfaces, const MaskLanes& active,
                       LightLanes& incident) const;
    // The same, but area lights by a random point, and all emissive meshes by one random point together. `draw` returns
    // random numbers in [0, 1).
    [[nodiscard]] std::optional<LightSample> sample_point(std::size_t index, const LitPoint& at,
                                                          const std::function<glm::vec2()>& draw) const;

    // Samples the environment; empty if there is none.
    [[nodiscard]] std::optional<LightSample> sample_sky(const glm::vec2& u) const;

    [[nodiscard]] const EnvironmentMap& environment() const { return environment_; }
    // Density of sample() for a direction through the environment, per steradian.
    [[nodiscard]] float environment_pdf(const Selection& selection, const glm::vec3& direction) const;

    // Emitted radiance of a material at texture coordinates.
    [[nodiscard]] glm::vec3 emission(int material, const glm::vec2& uv) const;
    // Density of sample() for a point of an emissive triangle at `distance` and emission cosine `cos_light`, per
    // steradian.
    [[nodiscard]] float emitter_pdf(const Selection& selection, int material, float distance, float cos_light) const;

    // Area lights are not part of the ray-tracing scene; paths test their segments with cross_area().
    struct Crossing {
        glm::vec3 radiance;
        float pdf;  // density of sample() for this direction through this light
    };
    [[nodiscard]] std::size_t area_count() const { return areas_.size(); }
    [[nodiscard]] std::optional<Crossing> cross_area(std::size_t index, const Selection& selection,
                                                     const glm::vec3& origin, const glm::vec3& direction,
                                                     float max_distance) const;

private:
    enum class SourceKind { environment, distant, local, area, emitters };
    struct Source {
        SourceKind kind;
        std::size_t index;  // into lights_ or areas_
        float power;        // estimated irradiance; of local sources at distance 1
        ShadowCasters casters = {};
    };
    struct Area {
        std::size_t light = 0;   // index into lights_
        std::size_t source = 0;  // index into sources_
        glm::vec3 centre{0.0F}, half_u{0.0F}, half_v{0.0F}, normal{0.0F};
        glm::vec3 radiance{0.0F};
        float parallelogram = 0.0F;  // of half_u and half_v
        float area = 0.0F;
        const LightModel* model = nullptr;
    };
    // Emissive mesh approximated as a point light.
    struct EmissiveMeshProxy {
        glm::vec3 centre{0.0F};
        glm::vec3 mean_normal{0.0F};  // times the area; short for closed meshes
        glm::vec3 emission{0.0F};     // mean
        float area = 0.0F;
        float radius = 0.0F;  // around the centre
        bool two_sided = false;
    };

    struct Emitter {
        const Mesh* mesh;
        std::size_t triangle;
        float cumulative;  // power of this and all previous emitters, as a share
    };

    struct EmitterPoint {
        glm::vec3 position, normal;
        glm::vec2 uv;
        bool hole;
    };

    [[nodiscard]] static std::optional<LightSample> sample_proxy(const EmissiveMeshProxy& proxy,
                                                                 const glm::vec3& position);
    void gather_emitters();
    void gather_emitter(const Mesh& mesh);
    void add_proxy(const Mesh& mesh);
    void add_light(std::size_t index_in_scene);
    void place_lights(float turn_rad);
    [[nodiscard]] float estimate(const Source& source, const LitPoint& at) const;
    [[nodiscard]] bool illuminates(const Source& source, std::uint32_t light_group) const {
        return scene_.scopes.illuminates(source.casters.scoped_light, light_group);
    }
    [[nodiscard]] static float selection_probability(const Selection& selection, float estimate) {
        return estimate > 0.0F ? 0.5F * (selection.uniform + estimate / selection.total) : 0.0F;
    }
    [[nodiscard]] std::optional<LightSample> sample_environment(float probability, const glm::vec2& u) const;
    [[nodiscard]] std::optional<LightSample> sample_light(const Source& source, const glm::vec3& position,
                                                          float probability) const;
    // `at`: coordinates along half_u and half_v.
    [[nodiscard]] std::optional<LightSample> sample_area(const Source& source, const glm::vec3& position,
                                                         float probability, const glm::vec2& at) const;
    [[nodiscard]] std::optional<LightSample> sample_emitter(const Selection& selection, float u_emitter,
                                                            const glm::vec2& u) const;

    [[nodiscard]] float emitters_irradiance() const;  // estimated
    [[nodiscard]] EmitterPoint emitter_point(const Emitter& emitter, const glm::vec2& u) const;
    [[nodiscard]] float flux_of(const Source& source) const;
    void sum_flux();
    void find_scope_extents();
    // From a disc outside the extent, in `direction`.
    [[nodiscard]] static Photon emit_distant(const Extent& extent, const glm::vec3& direction,
                                             const glm::vec3& irradiance, const glm::vec2& u);
    // Extent that the light of a distant source must cover.
    [[nodiscard]] const Extent& extent_of(const Source& source) const;
    [[nodiscard]] std::optional<Photon> emit_local(const Source& source, float probability, const glm::vec2& u) const;
    [[nodiscard]] std::optional<Photon> emit_emitter(float u_emitter, float probability, const glm::vec2& u_place,
                                                     const glm::vec2& u_direction) const;

    const Scene& scene_;
    float environment_turn_rad_;  // without turn_rad_
    EnvironmentMap environment_;
    float turn_rad_ = 0.0F;              // rotation set by turn()
    Extent extent_;                      // its radius is the distance in the irradiance estimate of emissive meshes
    std::vector<Light> lights_;          // lights with a positive intensity, rotated
    std::vector<Light> initial_lights_;  // the same without rotation
    std::vector<PointLight> points_;     // [index of lights_]; unused for area and directional lights
    std::vector<Area> areas_;
    std::vector<std::unique_ptr<const Mesh>> placed_;  // emissive meshes of instances, in world coordinates
    std::vector<Emitter> emitters_;
    std::vector<EmissiveMeshProxy> proxies_;
    std::vector<float> brightness_;  // [material] luminance of its emission, mean over the texture
    bool has_emissive_instances_ = false;
    double emitter_power_ = 0;  // sum of area * brightness
    std::vector<Source> sources_;
    std::map<std::uint32_t, Extent> scope_extents_;  // by index into Scene::lights of a scoped light
    std::vector<float> flux_;                        // flux of this and all previous sources, as a share
    std::optional<std::size_t> environment_source_;
    std::optional<std::size_t> emitter_source_;
};

}  // namespace rs::capture
