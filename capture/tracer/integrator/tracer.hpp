#pragma once
// The tracer: images of a Scene from any camera. Second room of the capture pipeline's synthetic branch:
//
//     mesh file, recipe -> Scene -> Tracer -> images -> capture set (capture_set.hpp)
//
// The same scene, camera and options give the same bytes, whatever the number of threads. Source: J. Kajiya, "The
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
    kPath,       // path.hpp; the only one for objects with surroundings
    kRadiosity,  // radiosity.hpp; each sample of all pixels is a pass
    kWhitted,    // whitted.hpp
    kToon,       // toon.hpp
};

struct RenderOptions {
    RenderMethod method = RenderMethod::kPath;
    int samples_per_pixel = 64;  // 1..65536; powers of two are stratified best
    std::uint64_t seed = 1;
    int max_bounces = 16;           // surfaces that a path may visit after the first
    float filter_radius_px = 0.5F;  // box filter, (0, 0.5]: an image shows no blur of its own
    bool depth = false;
    // Of render() by paths or radiosity: smoothed where surfaces are alike, as far as there is noise
    // (discontinuity_filter.hpp). Images with more samples are smoothed less; they go to where those without it go.
    bool filtered = false;
    // What stands in the image itself; else it is seen in reflections and through glass only.
    bool see_areas = false;
    bool see_environment = false;
    glm::vec3 ambient{
        0.0F};  // whitted, toon: what stands for light that surfaces reflect, as the radiance of white matter
    bool soft_shadows = false;  // whitted: areas light from all over; of toon the style says so
    ToonStyle toon{};
    ThinLens lens{};
    int threads = 0;                     // 0 = as many as the processor has
    std::optional<PixelRectangle> part;  // of accumulate(): other pixels get no samples; these have the bits they have
                                         // without it
};

struct Rendering {
    Image<RgbaF> image;  // linear light, straight alpha = share of camera rays that hit a surface
    // Axial, of the first surface through the pixel's centre at time 0; 0 = none; empty if not requested.
    Image<float> depth;
};

class Integrator;
class LightTransport;

class Tracer {
public:
    // Checks the scene (scene_check.hpp) and builds what rendering needs; a second or so per million triangles.
    static Result<Tracer> create(Scene scene);
    Tracer(Tracer&&) noexcept;
    Tracer& operator=(Tracer&&) noexcept;
    ~Tracer();

    // Advances `progress` (may be null) by step_count(camera) steps. May be called from several threads at once.
    [[nodiscard]] Rendering render(const Camera& camera, const RenderOptions& options,
                                   Progress* progress = nullptr) const;
    [[nodiscard]] static std::int64_t step_count(const Camera& camera);
    // The same for any projection.
    [[nodiscard]] Rendering render(const RayImage& rays, const RenderOptions& options,
                                   Progress* progress = nullptr) const;
    [[nodiscard]] static std::int64_t step_count(const RayImage& rays);

    // Adds `count` samples to each pixel, those that come after the ones it has; an empty accumulation begins anew. Of
    // the options samples_per_pixel and depth count nothing. Advances `progress` by step_count(camera) steps. Once
    // `stop` is true no further tile is begun (virtual lights are finished first) and false is returned: the
    // accumulation then is as it was.
    bool accumulate(const Camera& camera, const RenderOptions& options, int count, Accumulation& into,
                    Progress* progress = nullptr, const std::atomic<bool>* stop = nullptr) const;

    // Other lights than the scene came with; they must be as check_light() requires them. Not while anything is drawn.
    void set_lights(std::vector<Light> lights);
    // Another environment, whose pixels are finite and not negative, or the same one brighter and turned (the fields of
    // Environment), which costs nothing. Not while anything is drawn.
    void set_environment(Environment environment);
    void set_environment(float scale, float turn_rad);

    // Places an instance of the scene anew (scene.hpp, Instance); refused, with nothing changed, where a matrix has no
    // inverse. Seen after commit(), which costs what the tree over the instances costs: no tree of triangles is built
    // again. `instance` < instance_count(). Not while anything is drawn.
    Status move(std::size_t instance, const glm::dmat4& world_from_part,
                const std::optional<glm::dmat4>& at_close = {});
    void commit();
    [[nodiscard]] std::size_t instance_count() const;
    // How often trees of triangles were built, and the tree of instances above them.
    struct Builds {
        std::int64_t of_triangles, of_instances;
    };
    [[nodiscard]] Builds builds() const;

    [[nodiscard]] const std::vector<Light>& lights() const;  // of the scene, not turned
    // Whether nothing stands between a place and what is `distance` away in a direction of unit length, at time 0.
    [[nodiscard]] bool sees(const glm::dvec3& place, const glm::dvec3& direction, double distance) const;

    // Turns the scene's lights and environment, but not surfaces that shine, about Y by `angle_rad` from where the
    // scene has them; positive angles take +Z to +X. Costs nothing. Not while render() runs.
    void turn_lights(double angle_rad);

private:
    struct State;
    struct Frame;
    [[nodiscard]] Frame frame_of(const Camera& camera, const RenderOptions& options) const;
    [[nodiscard]] Rendering render(const RayImage& rays, const Frame& frame, const RenderOptions& options,
                                   Progress* progress) const;
    bool accumulate(const RayImage& rays, const Frame& frame, const RenderOptions& options, int count,
                    Accumulation& into, Progress* progress, const std::atomic<bool>* stop) const;
    [[nodiscard]] std::unique_ptr<const Integrator> make_integrator(const LightTransport& transport,
                                                                    const RayImage& image, std::uint64_t key,
                                                                    const RenderOptions& options, int first,
                                                                    int count) const;
    explicit Tracer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// 8-bit sRGB with straight alpha; radiance above 1 is clipped. Transparent pixels are (0, 0, 0, 0).
Image<Rgba8> to_srgb8(ConstImageView<RgbaF> image);

}  // namespace rs::capture
