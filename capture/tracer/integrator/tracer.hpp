#pragma once
// Renders images of a Scene from any camera. Second stage of the capture pipeline's synthetic branch:
//
//     mesh file, recipe -> Scene -> Tracer -> images -> capture set (capture_set.hpp)
//
// The same scene, camera and options give the same bytes with any number of threads. Source: J. Kajiya, "The
// Rendering Equation", 1986; E. Veach's thesis, 1997, for multiple importance sampling.

#include "capture/tracer/image/accumulation.hpp"
#include "capture/tracer/image/ray_image.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "capture/tracer/scene/toon_style.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rs::capture {

enum class RenderMethod {
    kPath,       // path.hpp; the only method that supports scenes with surroundings
    kRadiosity,  // radiosity.hpp; each sample of all pixels is a pass
    kWhitted,    // whitted.hpp
    kToon,       // toon.hpp
};

struct RenderOptions {
    RenderMethod method = RenderMethod::kPath;
    int samples_per_pixel = 64;  // 1..65536; stratification is best for powers of two
    std::uint64_t seed = 1;
    int max_bounces = 16;           // surfaces on a path after the first
    float filter_radius_px = 0.5F;  // box filter, (0, 0.5]
    bool depth = false;
    // render() by paths or radiosity only: denoises within surfaces (discontinuity_filter.hpp). Smoothing decreases as
    // samples are added, so filtered and unfiltered images converge to the same result.
    bool filtered = false;
    // Visible to camera rays; otherwise visible in reflections and through glass only.
    bool show_areas = false;
    bool show_environment = false;
    glm::vec3 ambient{0.0F};    // whitted, toon: approximates indirect light; radiance of a white diffuse surface
    bool soft_shadows = false;  // whitted: samples area lights; ToonStyle has its own setting
    ToonStyle toon{};
    ThinLens lens{};
    int threads = 0;                     // 0 = one per hardware thread
    std::optional<PixelRectangle> part;  // accumulate() samples these pixels only; their values do not depend on it
};

struct Rendering {
    Image<RgbaF> image;  // linear light, straight alpha = share of camera rays that hit a surface
    // Axial depth of the first surface through the pixel's centre at time 0; 0 = none; empty if not requested.
    Image<float> depth;
};

class Integrator;
class LightTransport;

class Tracer {
public:
    /// Checks the scene (check_scene()) and builds its acceleration structures: about 1 s per million triangles.
    static Result<Tracer> create(Scene scene);
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;
    ~Tracer();

    /// Advances `progress` (may be null) by step_count(camera) steps. Thread-safe.
    [[nodiscard]] Rendering render(const Camera& camera, const RenderOptions& options,
                                   Progress* progress = nullptr) const;
    [[nodiscard]] static std::int64_t step_count(const Camera& camera);
    /// Renders any projection.
    [[nodiscard]] Rendering render(const RayImage& rays, const RenderOptions& options,
                                   Progress* progress = nullptr) const;
    [[nodiscard]] static std::int64_t step_count(const RayImage& rays);

    /// Adds the next `count` samples of the sequence to each pixel of `into`, which may be empty. The options
    /// `samples_per_pixel` and `depth` are ignored. Advances `progress` by step_count(camera) steps.
    /// \param stop when true, no further tile is started (virtual lights are completed first)
    /// \return false if stopped; `into` is unchanged then
    bool accumulate(const Camera& camera, const RenderOptions& options, int count, Accumulation& into,
                    Progress* progress = nullptr, const std::atomic<bool>* stop = nullptr) const;

    /// Replaces the scene's lights, which must satisfy check_light(), and their scopes, which must fit the scene's
    /// meshes and instances. Not thread-safe with rendering.
    void set_lights(std::vector<Light> lights, LightScopes scopes = {});
    /// Replaces the environment (pixels finite and not negative), or only its scale and rotation (fields of
    /// Environment), which is free. Not thread-safe with rendering.
    void set_environment(Environment environment);
    void set_environment(float scale, float turn_rad);

    /// Sets the transform of an instance (scene.hpp, Instance). Takes effect at commit(), which rebuilds the tree over
    /// the instances but no triangle trees. Not thread-safe with rendering.
    /// \param instance < instance_count()
    /// \return an error, with nothing changed, if a matrix has no inverse
    Status move(std::size_t instance, const glm::dmat4& world_from_part,
                const std::optional<glm::dmat4>& at_close = {});
    void commit();
    [[nodiscard]] std::size_t instance_count() const;
    // Number of builds of triangle trees and of the instance tree above them.
    struct Builds {
        std::int64_t triangle_trees, instance_trees;
    };
    [[nodiscard]] Builds builds() const;

    [[nodiscard]] const std::vector<Light>& lights() const;  // without the rotation of turn_lights()
    /// Returns true if no shadow caster lies between `position` and the point at `distance` along a unit direction, at
    /// time 0.
    [[nodiscard]] bool is_unoccluded(const glm::dvec3& position, const glm::dvec3& direction, double distance,
                                     const ShadowCasters& casters = {}) const;
    /// Width of a pixel, in scene units, at the median distance of the visible surfaces. The distance is measured along
    /// 16 x 16 rays that are evenly spaced over the whole image, at time 0; if none hits a surface, it is that of the
    /// centre of the scene's bounds. 0 for scenes without geometry. Deterministic, thread-safe.
    [[nodiscard]] double median_pixel_size(const Camera& camera) const;
    /// Bounds of the surfaces that a scoped light illuminates.
    [[nodiscard]] ScopeBounds scope_bounds(std::uint32_t light) const;

    /// Rotates the lights and the environment, but not emissive surfaces, about Y from their positions in the scene.
    /// Not thread-safe with rendering.
    /// \param angle_rad positive from +Z towards +X
    void turn_lights(double angle_rad);

private:
    struct State;
    struct Frame;
    [[nodiscard]] Frame make_frame(const Camera& camera, const RenderOptions& options) const;
    [[nodiscard]] Rendering render(const Frame& frame, const RenderOptions& options, Progress* progress) const;
    bool accumulate(const Frame& frame, const RenderOptions& options, int count, Accumulation& into, Progress* progress,
                    const std::atomic<bool>* stop) const;
    [[nodiscard]] std::unique_ptr<const Integrator> make_integrator(const LightTransport& transport, const Frame& frame,
                                                                    const RenderOptions& options, int first,
                                                                    int count) const;
    explicit Tracer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// 8-bit sRGB with straight alpha; radiance above 1 is clipped. Transparent pixels are (0, 0, 0, 0).
Image<Rgba8> to_srgb8(ConstImageView<RgbaF> image);

}  // namespace rs::capture
