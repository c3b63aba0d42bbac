#pragma once
// All light sources of a scene: draws one for next-event estimation, and tells the densities that multiple importance
// sampling needs when a path meets a source by itself.
//
// A source is drawn with probability 1/2 (1/n + its share of the estimated irradiance at the scene's centre). Radiance
// samples carry the density over all sources, per steradian; of directional and point lights ("delta"), which no path
// meets by itself, `radiance / pdf` is irradiance over the probability of the draw.

#include "capture/tracer/light/environment_map.hpp"
#include "capture/tracer/scene/scene.hpp"

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

class LightSet {
public:
    // `environment` takes the place of the scene's own. `centre` and `radius` bound the meshes. Refers to `scene`,
    // which must stay where it is and unchanged.
    LightSet(const Scene& scene, Environment environment, const glm::vec3& centre, float radius);

    // Turns directional, point and rectangle lights and the environment about Y, from where they were at construction;
    // positive angles take +Z to +X. Surfaces that shine stay.
    void turn(float angle_rad);

    [[nodiscard]] bool empty() const { return sources_.empty(); }

    // Nothing where the drawn source does not light `position`. u_source picks the source, u the point on it.
    [[nodiscard]] std::optional<LightSample> sample(const glm::vec3& position, float u_source,
                                                    const glm::vec2& u) const;

    [[nodiscard]] const EnvironmentMap& environment() const { return environment_; }
    // Density with which sample() gives this direction through the environment.
    [[nodiscard]] float environment_pdf(const glm::vec3& direction) const {
        return environment_probability_ > 0.0F ? environment_probability_ * environment_.pdf(direction) : 0.0F;
    }

    // Radiance of a point of material `material`, by its emission and the texture on it.
    [[nodiscard]] glm::vec3 emission(int material, const glm::vec2& uv) const;
    // Density with which sample() gives a point of an emissive triangle that is seen at `distance` under `cos_light`.
    [[nodiscard]] float emitter_pdf(int material, float distance, float cos_light) const;

    // Rectangle lights are not part of the ray-tracing scene; a path adds those its segments cross.
    struct Crossing {
        glm::vec3 radiance;
        float pdf;  // with which sample() gives this direction through this light
    };
    [[nodiscard]] std::size_t rectangle_count() const { return rectangles_.size(); }
    [[nodiscard]] std::optional<Crossing> cross_rectangle(std::size_t index, const glm::vec3& origin,
                                                          const glm::vec3& direction, float max_distance) const;

private:
    enum class SourceKind { environment, directional, point, rectangle, emitters };
    struct Source {
        SourceKind kind;
        std::size_t index;  // of its kind
        float probability;
    };
    struct Rectangle {
        RectangleLight light;
        glm::vec3 normal;
        float area;
        std::size_t index;  // in the scene
        float probability = 0.0F;
    };
    struct Emitter {
        const Mesh* mesh;
        std::size_t triangle;
        float cumulative;  // share of the power of this and all emitters before it
    };

    void gather_emitters();
    [[nodiscard]] std::optional<LightSample> sample_environment(float probability, const glm::vec2& u) const;
    [[nodiscard]] std::optional<LightSample> sample_rectangle(const Rectangle& rectangle, const glm::vec3& position,
                                                              const glm::vec2& u) const;
    [[nodiscard]] std::optional<LightSample> sample_emitter(const glm::vec3& position, float u_emitter,
                                                            const glm::vec2& u) const;

    const Scene& scene_;
    float environment_turn_rad_;  // at construction
    EnvironmentMap environment_;
    std::vector<DirectionalLight> directional_;
    std::vector<PointLight> points_;
    std::vector<Rectangle> rectangles_;
    std::vector<Emitter> emitters_;
    std::vector<float> brightness_;  // of each material: luminance of its emission, mean over the texture
    double emitter_power_ = 0;       // sum of area * brightness
    float environment_probability_ = 0.0F;
    float emitter_probability_ = 0.0F;
    std::vector<Source> sources_;
};

}  // namespace rs::capture
