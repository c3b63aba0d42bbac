#include "capture/tracer/integrator/tracer.hpp"

#include "capture/tracer/image/discontinuity_filter.hpp"
#include "capture/tracer/integrator/path.hpp"
#include "capture/tracer/integrator/radiosity.hpp"
#include "capture/tracer/integrator/toon.hpp"
#include "capture/tracer/integrator/whitted.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {

namespace {

constexpr int kTileSide_px = 16;
constexpr int kSquare_px = 4;

int tiles_along(int pixels) {
    return (pixels + kTileSide_px - 1) / kTileSide_px;
}

PixelRectangle visible_rectangle(const Camera& camera, const RayScene& rays) {
    const PixelRectangle whole{0, 0, camera.width, camera.height};
    if (rays.empty()) return {0, 0, 0, 0};
    double left = camera.width, top = camera.height, right = 0, bottom = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1U) != 0 ? rays.upper().x : rays.lower().x,
                           (corner & 2U) != 0 ? rays.upper().y : rays.lower().y,
                           (corner & 4U) != 0 ? rays.upper().z : rays.lower().z);
        const glm::dvec3 projected = camera.project(p);
        if (!(projected.z > 1e-6)) return whole;  // behind the camera: the projection bounds nothing
        left = std::min(left, projected.x);
        right = std::max(right, projected.x);
        top = std::min(top, projected.y);
        bottom = std::max(bottom, projected.y);
    }
    // The projection of a box is the hull of its projected corners. One pixel of margin covers rounding.
    const auto clamp = [](double v, int limit) {
        return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(limit)));
    };
    return {clamp(std::floor(left) - 1, camera.width), clamp(std::floor(top) - 1, camera.height),
            clamp(std::ceil(right) + 1, camera.width), clamp(std::ceil(bottom) + 1, camera.height)};
}

// Visible pixels of the tile with this corner, in squares of 4 x 4: one ray packet each.
std::vector<glm::ivec2> pixels_of_tile(int left, int top, const PixelRectangle& visible) {
    std::vector<glm::ivec2> pixels;
    for (int y0 = top; y0 < top + kTileSide_px; y0 += kSquare_px) {
        for (int x0 = left; x0 < left + kTileSide_px; x0 += kSquare_px) {
            for (int y = std::max(y0, visible.y0); y < std::min(y0 + kSquare_px, visible.y1); ++y) {
                for (int x = std::max(x0, visible.x0); x < std::min(x0 + kSquare_px, visible.x1); ++x) {
                    pixels.emplace_back(x, y);
                }
            }
        }
    }
    return pixels;
}

// Hash of seed and camera position, so that neighbouring views do not share a noise pattern.
std::uint64_t image_key(std::uint64_t seed, std::initializer_list<glm::dvec3> placement) {
    std::uint64_t key = mix_bits(seed);
    for (const glm::dvec3& vector : placement) {
        for (int row = 0; row < 3; ++row) {
            // Adding 0 makes -0 and 0 the same.
            key = mix_bits(key ^ std::bit_cast<std::uint64_t>(vector[row] + 0.0));
        }
    }
    return key;
}

std::uint64_t image_key(std::uint64_t seed, const Camera& camera) {
    const glm::dmat4& m = camera.world_from_camera;
    return image_key(seed, {glm::dvec3(m[0]), glm::dvec3(m[1]), glm::dvec3(m[2]), glm::dvec3(m[3])});
}

LightSet::Extent scene_extent(const RayScene& rays) {
    if (rays.empty()) return {};
    return {0.5F * (rays.upper() + rays.lower()), 0.5F * glm::length(rays.upper() - rays.lower())};
}

RayImage make_rays(const Camera& camera) {
    return {camera.width, camera.height, camera.centre(), camera.forward(),
            [camera](double x, double y) { return camera.ray(x, y); }};
}

// Angle between adjacent pixels' rays at the image centre.
float pixel_rad_of(const RayImage& rays) {
    const double x = 0.5 * rays.width, y = 0.5 * rays.height;
    return static_cast<float>(
        glm::distance(glm::normalize(rays.ray(x - 0.5, y)), glm::normalize(rays.ray(x + 0.5, y))));
}

// Axial depth of the first surface through each pixel's centre.
Image<float> first_depths(const RayImage& rays, const PixelRectangle& visible, const RayScene& scene, int threads) {
    Image<float> depths(rays.width, rays.height);
    for_each_index(std::max(visible.y1 - visible.y0, 0), threads, [&](std::int64_t row) {
        const int y = visible.y0 + static_cast<int>(row);
        for (int x = visible.x0; x < visible.x1; ++x) {
            const glm::dvec3 ray = glm::normalize(rays.ray(x + 0.5, y + 0.5));
            SurfacePoint point;
            if (!scene.intersect_visible(glm::vec3(rays.centre), glm::vec3(ray), 0.0F, point)) continue;
            depths(x, y) = static_cast<float>(glm::dot(glm::dvec3(point.position) - rays.centre, rays.forward));
        }
    });
    return depths;
}

}  // namespace

// Pixels that may show the scene, and the key of the image's random numbers.
struct Tracer::Frame {
    RayImage rays;
    PixelRectangle visible;
    std::uint64_t key;
};

// `rays` and `lights` refer to `scene`, so they come after it and the whole never moves. The environment's pixels are
// in `lights` only.
struct Tracer::State {
    Scene scene;
    std::vector<std::size_t> moved;  // instances since the last commit
    std::optional<RayScene> rays;
    std::optional<LightSet> lights;
    std::vector<SurfaceModel> models;
};

Tracer::Tracer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
Tracer::~Tracer() = default;

std::int64_t Tracer::step_count(const Camera& camera) {
    return static_cast<std::int64_t>(tiles_along(camera.width)) * tiles_along(camera.height);
}

std::int64_t Tracer::step_count(const RayImage& rays) {
    return static_cast<std::int64_t>(tiles_along(rays.width)) * tiles_along(rays.height);
}

void Tracer::turn_lights(double angle_rad) {
    state_->lights->turn(static_cast<float>(angle_rad));
}

Tracer::Frame Tracer::make_frame(const Camera& camera, const RenderOptions& options) const {
    // Defocus extends the scene beyond its projected bounds.
    const bool whole = options.show_areas || options.show_environment || options.lens.aperture > 0;
    return {make_rays(camera),
            whole ? PixelRectangle{0, 0, camera.width, camera.height} : visible_rectangle(camera, *state_->rays),
            image_key(options.seed, camera)};
}

std::unique_ptr<const Integrator> Tracer::make_integrator(const LightTransport& transport, const Frame& frame,
                                                          const RenderOptions& options, int first, int count) const {
    constexpr int kWhittedDepth = 8;
    RS_CHECK(options.method == RenderMethod::kPath || !state_->scene.has_surroundings());
    switch (options.method) {
        case RenderMethod::kRadiosity:
            return std::make_unique<RadiosityTracer>(transport, VirtualLightOptions{.max_bounces = options.max_bounces},
                                                     frame.rays, frame.key, first, count);
        case RenderMethod::kWhitted:
            return std::make_unique<WhittedTracer>(transport, IrradianceMap(transport.lights().environment()),
                                                   options.ambient, std::min(options.max_bounces, kWhittedDepth),
                                                   options.soft_shadows);
        case RenderMethod::kToon:
            return std::make_unique<ToonTracer>(transport, IrradianceMap(transport.lights().environment()),
                                                options.ambient, std::min(options.max_bounces, kWhittedDepth),
                                                options.toon, pixel_rad_of(frame.rays));
        case RenderMethod::kPath:
            break;
    }
    return std::make_unique<PathTracer>(transport, options.max_bounces, options.filtered);
}

Rendering Tracer::render(const Camera& camera, const RenderOptions& options, Progress* progress) const {
    return render(make_frame(camera, options), options, progress);
}

Rendering Tracer::render(const RayImage& rays, const RenderOptions& options, Progress* progress) const {
    const PixelRectangle whole{0, 0, rays.width, rays.height};
    return render(Frame{rays, whole, image_key(options.seed, {rays.centre, rays.forward})}, options, progress);
}

Rendering Tracer::render(const Frame& frame, const RenderOptions& options, Progress* progress) const {
    RS_CHECK(options.samples_per_pixel >= 1 && options.samples_per_pixel <= 65536);
    Accumulation sum;
    // Limits the memory for virtual lights; the result does not depend on the grouping of passes.
    constexpr int kPassesAtOnce = 64;
    const int at_once = options.method == RenderMethod::kRadiosity ? kPassesAtOnce : options.samples_per_pixel;
    while (sum.samples < options.samples_per_pixel) {
        const int count = std::min(at_once, options.samples_per_pixel - sum.samples);
        const bool last = sum.samples + count == options.samples_per_pixel;
        accumulate(frame, options, count, sum, last ? progress : nullptr, nullptr);
    }
    Rendering rendering;
    rendering.image = options.filtered ? filtered_mean(sum, frame.visible) : std::move(sum).mean();
    if (options.depth) rendering.depth = first_depths(frame.rays, frame.visible, *state_->rays, options.threads);
    return rendering;
}

bool Tracer::accumulate(const Camera& camera, const RenderOptions& options, int count, Accumulation& into,
                        Progress* progress, const std::atomic<bool>* stop) const {
    return accumulate(make_frame(camera, options), options, count, into, progress, stop);
}

bool Tracer::accumulate(const Frame& frame, const RenderOptions& options, int count, Accumulation& into,
                        Progress* progress, const std::atomic<bool>* stop) const {
    const RayImage& rays = frame.rays;
    RS_CHECK(options.filter_radius_px > 0.0F && options.filter_radius_px <= 0.5F);
    RS_CHECK(options.max_bounces >= 0 && count >= 1);
    RS_CHECK(into.samples == 0 || (into.sum.width() == rays.width && into.sum.height() == rays.height));
    Accumulation sum = into;
    if (into.samples == 0) sum.sum = Image<RgbaF>(rays.width, rays.height);

    const LightTransport transport(state_->scene, *state_->rays, *state_->lights, state_->models,
                                   {options.show_areas, options.show_environment});
    const std::unique_ptr<const Integrator> integrator =
        make_integrator(transport, frame, options, into.samples, count);
    if (into.samples == 0 && integrator->has_guides()) sum.guides = Image<GuideSum>(rays.width, rays.height);
    const PixelRectangle visible = options.part ? overlap(frame.visible, *options.part) : frame.visible;
    const bool blurred = state_->rays->blurred();
    const double filter_width_px = 2.0 * static_cast<double>(options.filter_radius_px);

    const auto camera_ray = [&](int x, int y, int sample) {
        const std::uint64_t pixel_key =
            mix_bits(frame.key ^ (static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint64_t>(x)));
        Sampler sampler(pixel_key, static_cast<std::uint32_t>(sample));
        const glm::dvec2 offset = (glm::dvec2(sampler.next_2d()) - 0.5) * filter_width_px;
        ThinLens::Ray ray{rays.centre, rays.ray(x + 0.5 + offset.x, y + 0.5 + offset.y)};
        const float time = blurred ? sampler.next_2d().x : 0.0F;
        if (options.lens.aperture > 0) {
            ray = options.lens.through(ray.origin, rays.forward, ray.direction, sampler.next_2d());
        }
        const auto in_square = static_cast<unsigned>(y % kSquare_px * kSquare_px + x % kSquare_px);
        return CameraRay{glm::vec3(ray.origin), glm::vec3(glm::normalize(ray.direction)), time, sampler, in_square};
    };
    const auto add_tile = [&](std::int64_t tile) {
        if (stop != nullptr && *stop) return;
        const int across = tiles_along(rays.width);
        const std::vector<glm::ivec2> pixels = pixels_of_tile(static_cast<int>(tile % across) * kTileSide_px,
                                                              static_cast<int>(tile / across) * kTileSide_px, visible);
        std::vector<CameraRay> camera_rays;
        camera_rays.reserve(pixels.size());
        std::vector<RadianceSample> samples(pixels.size());
        for (int s = into.samples; s < into.samples + count && !pixels.empty(); ++s) {
            camera_rays.clear();
            for (const glm::ivec2& p : pixels) camera_rays.push_back(camera_ray(p.x, p.y, s));
            integrator->trace_many(camera_rays, samples);
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                if (samples[i].hit) sum.add(pixels[i].x, pixels[i].y, samples[i]);
            }
        }
        if (progress != nullptr) progress->advance(1);
    };
    for_each_index(step_count(rays), options.threads, add_tile);
    if (stop != nullptr && *stop) return false;
    into = std::move(sum);
    into.samples += count;
    return true;
}

const std::vector<Light>& Tracer::lights() const {
    return state_->scene.lights;
}

ScopeBounds Tracer::scope_bounds(std::uint32_t light) const {
    return bounds_of_scope(state_->scene, light);
}

bool Tracer::is_unoccluded(const glm::dvec3& position, const glm::dvec3& direction, double distance,
                           const ShadowCasters& casters) const {
    constexpr double kShorten = 1 - 1e-4;
    return !state_->rays->occluded(glm::vec3(position), glm::vec3(direction), static_cast<float>(distance * kShorten),
                                   0.0F, casters);
}

double Tracer::median_pixel_size(const Camera& camera) const {
    constexpr int kRaysAcross = 16;
    const RayScene& scene = *state_->rays;
    if (scene.empty()) return 0;
    const RayImage rays = make_rays(camera);
    const glm::vec3 centre(rays.centre);
    std::vector<float> distances;
    for (int row = 0; row < kRaysAcross; ++row) {
        for (int column = 0; column < kRaysAcross; ++column) {
            const double x = (column + 0.5) * rays.width / kRaysAcross, y = (row + 0.5) * rays.height / kRaysAcross;
            SurfacePoint point;
            if (scene.intersect_visible(centre, glm::vec3(glm::normalize(rays.ray(x, y))), 0.0F, point))
                distances.push_back(point.distance);
        }
    }
    float distance = glm::distance(centre, 0.5F * (scene.lower() + scene.upper()));
    if (!distances.empty()) distance = median_of(std::span(distances));
    return static_cast<double>(distance) * static_cast<double>(pixel_rad_of(rays));
}

void Tracer::set_lights(std::vector<Light> lights, LightScopes scopes) {
    state_->scene.lights = std::move(lights);
    state_->scene.scopes = std::move(scopes);
    state_->rays->update_scopes();
    state_->lights->set_lights();
}

std::size_t Tracer::instance_count() const {
    return state_->scene.instances.size();
}

Status Tracer::move(std::size_t instance, const glm::dmat4& world_from_part,
                    const std::optional<glm::dmat4>& at_close) {
    RS_CHECK(instance < state_->scene.instances.size());
    Instance& current = state_->scene.instances[instance];
    const Instance placed{current.part, world_from_part, at_close};
    if (Status status = check_placement(placed); !status) {
        return Error{"instance " + std::to_string(instance + 1) + ": " + status.error().message};
    }
    current = placed;
    state_->moved.push_back(instance);
    return {};
}

void Tracer::commit() {
    if (state_->moved.empty()) return;
    state_->rays->update(state_->moved);
    state_->moved.clear();
    state_->lights->update_instances(scene_extent(*state_->rays));
}

Tracer::Builds Tracer::builds() const {
    const RayScene::Builds builds = state_->rays->builds();
    return {builds.triangle_trees, builds.instance_trees};
}

void Tracer::set_environment(Environment environment) {
    state_->lights->set_environment(std::move(environment));
    state_->lights->set_lights();
}

void Tracer::set_environment(float scale, float turn_rad) {
    state_->lights->set_environment(scale, turn_rad);
    state_->lights->set_lights();
}

Result<Tracer> Tracer::create(Scene scene) {
    RS_TRY(check_scene(scene));
    auto state = std::make_unique<State>();
    state->scene = std::move(scene);
    RS_ASSIGN_OR_RETURN(RayScene rays, RayScene::create(state->scene));
    state->rays = std::move(rays);
    Environment environment = std::exchange(state->scene.environment, Environment{});
    state->lights.emplace(state->scene, std::move(environment), scene_extent(*state->rays));
    state->models = make_surface_models(state->scene.materials);
    return Tracer(std::move(state));
}

Image<Rgba8> to_srgb8(ConstImageView<RgbaF> image) {
    Image<Rgba8> result(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const RgbaF& p = image(x, y);
            const auto alpha = static_cast<std::uint8_t>(std::lround(std::clamp(p.a, 0.0F, 1.0F) * 255.0F));
            if (alpha > 0)
                result(x, y) = {srgb8_from_linear(p.r), srgb8_from_linear(p.g), srgb8_from_linear(p.b), alpha};
        }
    }
    return result;
}

}  // namespace rs::capture
