#pragma once
// Draws a scene's geometry by light that is traced, a sample of each pixel at a time. What it leaves out (objects,
// blended surfaces, background) the frame's compositor draws over and under it.
//
//     Scene -> traced_room -> Tracer -> passes -> mean -> exposure -> 8-bit sRGB, alpha where nothing was met
//
// The same camera and number of passes give the same bytes, however the passes are grouped and on however many threads.

#include "capture/tracer/integrator/tracer.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/traced/traced_room.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

using TracedMethod = capture::RenderMethod;
struct NamedMethod {
    const char* name;
    TracedMethod method;
};
// In the order from quick to true.
inline constexpr std::array kTracedMethods{
    NamedMethod{"toon", TracedMethod::kToon}, NamedMethod{"whitted", TracedMethod::kWhitted},
    NamedMethod{"radiosity", TracedMethod::kRadiosity}, NamedMethod{"path", TracedMethod::kPath}};

// A camera's lens: either its opening, or how many times that goes into a focal length on 36 mm wide film.
struct CameraLens {
    double aperture_mm = 0;  // diameter, where f_number is 0
    double f_number = 0;
    double focus = 1;            // axial distance of what is sharp, scene units
    double units_per_mm = 1e-3;  // of the scene
    [[nodiscard]] capture::ThinLens of(const Camera& camera) const;
};

class ObjectRays;

struct TracedOptions {
    TracedMethod method = TracedMethod::kPath;
    double exposure_ev = 0;  // images are 2^_ times as bright
    int max_bounces = 16;
    bool soft_shadows = false;            // whitted, toon; the others have no others
    std::optional<double> line_radius{};  // toon: how far from an edge its line reaches; a share of the scene if empty
    std::optional<CameraLens> lens{};
};

// Move-only; one thread, but for `stop`.
class TracedRenderer {
public:
    // Refuses scenes that the tracer cannot take (vertices that are not finite). Objects throw shadows and stand in
    // what walls reflect; the camera does not see them.
    static Result<TracedRenderer> create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                         const TracedOptions& options);

    // Takes the nodes of this number (GeometryNode::moving) from where the scene has them to `moved` times there; with
    // `at_close`, they move on to that while the shutter is open, and images show it. Seen in images that begin
    // after this. False, with nothing changed, where no node has the number, or a matrix has no inverse or is not
    // finite.
    bool move(std::uint32_t id, const glm::dmat4& moved, const std::optional<glm::dmat4>& at_close = {});

    // For images that begin after this.
    void set_method(TracedMethod method) { render_.method = method; }
    [[nodiscard]] TracedMethod method() const { return render_.method; }
    // Only these pixels of images that begin after this are traced; they have the bytes that they have in whole ones.
    void set_part(const capture::PixelRectangle& part) { render_.part = part; }
    // The lights, environment and headlight of `scene`, whose geometry is that of the scene that this was made of, and
    // another exposure. What is traced then is what a renderer made of `scene` would trace, bit for bit.
    void set_lights(const Scene& scene, double exposure_ev);
    // Begins an image anew.
    void look(const Camera& camera);
    // One more sample of each pixel. False, with nothing changed, where `stop` became true before it was there.
    bool add_pass(Progress* progress = nullptr, const std::atomic<bool>* stop = nullptr);
    [[nodiscard]] std::int64_t steps_of_pass() const { return capture::Tracer::step_count(camera_); }
    [[nodiscard]] int passes() const { return sum_.samples; }

    // The camera's image with one sample for each side x side pixels, without which look() goes on. Nothing where
    // `stop` became true.
    std::optional<Image<Rgba8>> coarse_image(const Camera& camera, int side, const std::atomic<bool>* stop = nullptr);

    // What reaches a place, as capture::light_probe() has it, with the scene's background behind all.
    [[nodiscard]] Image<RgbaF> probe(const glm::dvec3& place, int samples, Progress& progress) const;

    // The mean of all passes: linear light without exposure, straight alpha. There must have been a pass.
    [[nodiscard]] Image<RgbaF> radiance() const { return sum_.mean(); }
    // What a screen shows of it; of radiosity, filtered (discontinuity_filter.hpp).
    [[nodiscard]] Image<Rgba8> image() const;

    // What could not be taken along, for people.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

private:
    TracedRenderer(capture::Tracer tracer, const TracedOptions& options)
        : tracer_(std::move(tracer)), options_(options) {}

    void begin(const Camera& camera);
    void describe_lights(const Scene& scene, std::vector<Light> lights);
    [[nodiscard]] capture::RenderOptions render_options(const Camera& camera) const;
    [[nodiscard]] Image<Rgba8> shown(Image<RgbaF> radiance) const;

    capture::Tracer tracer_;
    TracedOptions options_;
    capture::RenderOptions render_;
    Background background_;
    std::vector<TracedRoom::Moving> moving_;  // of each of the tracer's instances
    bool glows_ = false;                      // something of the scene's surfaces shines
    bool headlight_ = false;
    std::vector<Light> lights_;                         // without the headlight
    std::shared_ptr<const Image<RgbaF>> environment_;   // whose light it is
    std::vector<std::shared_ptr<ObjectRays>> objects_;  // of the tracer's scene
    std::vector<std::string> warnings_;
    Camera camera_;
    capture::Accumulation sum_;
};

}  // namespace rs::compositor
