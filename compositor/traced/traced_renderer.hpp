#pragma once
// Renders scene geometry by ray tracing, one sample per pixel and pass. Objects, blended surfaces and background are
// composited by the frame's compositor.
//
//     Scene -> TracerScene -> Tracer -> passes -> mean -> exposure -> 8-bit sRGB, alpha 0 where no surface was hit
//
// Deterministic: camera and number of passes determine the bytes, independent of the number of threads and of how
// passes are grouped.

#include "capture/tracer/integrator/tracer.hpp"
#include "compositor/scene/light/environment_irradiance.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/traced/tracer_scene.hpp"
#include "compositor/viewer/residency/object_relighting.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

using TracedMethod = capture::RenderMethod;
struct NamedMethod {
    const char* name;
    TracedMethod method;
};
/// In order of increasing cost and accuracy.
inline constexpr std::array kTracedMethods{
    NamedMethod{"toon", TracedMethod::kToon}, NamedMethod{"whitted", TracedMethod::kWhitted},
    NamedMethod{"radiosity", TracedMethod::kRadiosity}, NamedMethod{"path", TracedMethod::kPath}};

/// Camera lens, by aperture or by f-number with respect to a 36 mm wide film.
struct CameraLens {
    double aperture_mm = 0;  // diameter, used if f_number is 0
    double f_number = 0;
    double focus = 1;            // axial distance of the focal plane, scene units
    double units_per_mm = 1e-3;  // of the scene
    [[nodiscard]] capture::ThinLens of(const Camera& camera) const;
};

class ObjectPrimitive;

struct TracedOptions {
    TracedMethod method = TracedMethod::kPath;
    double exposure_ev = 0;  // images are scaled by 2^exposure_ev
    int max_bounces = 16;
    bool soft_shadows = false;  // whitted and toon; other methods always have them
    // toon: width of a line from its edge, scene units; empty: per image, 1 px at the median distance of the surfaces
    // that the whole camera sees (capture::Tracer::median_pixel_size())
    std::optional<double> line_radius{};
    bool panorama = false;      // images are faces of a panorama: the median is that of all directions
    capture::ToonStyle toon{};  // edge_radius, shadow_rays and brightness are ignored: they follow from the above
    std::optional<CameraLens> lens{};
    Relighting relighting = Relighting::kOff;
};

/// Move-only; single-threaded, except `stop`.
class TracedRenderer {
public:
    /// Fails for scenes that the tracer rejects (vertices that are not finite). Objects cast shadows and appear in
    /// reflections, but are invisible to the camera.
    static Result<TracedRenderer> create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                         const TracedOptions& options);

    /// Moves the nodes with this GeometryNode::moving id to `moved` times their transform in the scene, for images that
    /// begin afterwards. With `at_close` they move to that transform while the shutter is open (motion blur).
    /// \return false, with nothing changed, if no node has the id, or a matrix is singular or not finite.
    bool move(std::uint32_t id, const glm::dmat4& moved, const std::optional<glm::dmat4>& at_close = {});

    /// Applies to images that begin afterwards.
    void set_method(TracedMethod method);
    [[nodiscard]] TracedMethod method() const { return render_.method; }
    /// Restricts images that begin afterwards to these pixels, which get the same bytes as in whole images.
    void set_part(const capture::PixelRectangle& part) { render_.part = part; }
    /// Copies lights, environment and headlight from `scene`, which must have the same geometry as the scene passed to
    /// create(), and sets the exposure. Results equal those of a renderer created from `scene`, bit for bit.
    void set_lights(const Scene& scene, double exposure_ev);
    /// Irradiance at the objects for FrameCompositor::set_traced(); null if they are not relit, also in scenes that
    /// only the headlight illuminates. Computed when lights or method change, not when nodes move: by paths for path
    /// and radiosity, otherwise as whitted shades a surface. Light that objects reflect to each other is left out.
    [[nodiscard]] std::shared_ptr<const LocalIrradiances> object_irradiance() const { return irradiance_; }
    /// Starts a new image.
    void begin_image(const Camera& camera);
    /// Adds one sample per pixel.
    /// \return false, with nothing changed, if `stop` became true before.
    bool add_pass(Progress* progress = nullptr, const std::atomic<bool>* stop = nullptr);
    [[nodiscard]] int passes() const { return sum_.samples; }

    /// Image with one sample per side x side pixels, which does not count as a pass.
    /// \return nullopt if `stop` became true.
    std::optional<Image<Rgba8>> coarse_image(const Camera& camera, int side, const std::atomic<bool>* stop = nullptr);

    /// Light probe at a point as by capture::light_probe(), with the scene's background.
    [[nodiscard]] Image<RgbaF> probe(const glm::dvec3& place, int samples, Progress& progress) const;

    /// Mean of all passes: linear light without exposure, straight alpha. Requires at least one pass.
    [[nodiscard]] Image<RgbaF> radiance() const { return sum_.mean(); }
    /// Image for display; filtered for radiosity (discontinuity_filter.hpp).
    [[nodiscard]] Image<Rgba8> image() const;

private:
    TracedRenderer(capture::Tracer tracer, const TracedOptions& options)
        : tracer_(std::move(tracer)), options_(options) {}

    void begin(const Camera& camera);
    [[nodiscard]] double default_line_radius(const Camera& camera) const;
    void describe_lights(const Scene& scene);
    void relight_objects();
    [[nodiscard]] IrradianceHarmonics irradiance_at(const glm::dvec3& position) const;
    [[nodiscard]] capture::RenderOptions render_options(const Camera& camera) const;
    [[nodiscard]] Image<Rgba8> tone_map(Image<RgbaF> radiance) const;

    capture::Tracer tracer_;
    TracedOptions options_;
    capture::RenderOptions render_;
    Background background_;
    std::vector<TracerScene::MovableNode> moving_;  // [tracer instance]
    bool has_emission_ = false;                     // some surface is emissive
    bool headlight_ = false;
    std::optional<EnvironmentLight> environment_;  // source of the tracer's environment light
    EnvironmentIrradiance environment_irradiance_;
    std::optional<IrradianceHarmonics> environment_harmonics_;
    std::shared_ptr<const LocalIrradiances> irradiance_;     // at objects_, in their order
    std::vector<std::shared_ptr<ObjectPrimitive>> objects_;  // of the tracer's scene
    Camera camera_;
    capture::Accumulation sum_;
};

}  // namespace rs::compositor
