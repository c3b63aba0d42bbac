#include "compositor/traced/traced_renderer.hpp"

#include "capture/tracer/image/discontinuity_filter.hpp"
#include "capture/tracer/integrator/light_probe.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/traced/object_primitive.hpp"
#include "compositor/traced/tracer_scene.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rs::compositor {

namespace {

constexpr int kToonShadowRays = 16;
constexpr capture::LightProbeOptions kObjectProbe{.width = 16, .samples_per_pixel = 32, .max_bounces = 4};
constexpr double kToonLine_px = 1;  // default width of a line from its edge, at the median distance

glm::vec3 ambient_of(const Scene& scene) {
    glm::vec3 ambient = reflected_light(scene);
    for (const Light& light : scene.lights) {
        if (light.everywhere) ambient += light.ambient;
    }
    return ambient;
}

}  // namespace

capture::ThinLens CameraLens::of(const Camera& camera) const {
    constexpr double kFilm_mm = 36;
    const double focal_mm = kFilm_mm * camera.fl_x / camera.width;
    return {units_per_mm * (f_number > 0 ? focal_mm / f_number : aperture_mm), focus};
}

Result<TracedRenderer> TracedRenderer::create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                              const TracedOptions& options) {
    TracerScene room = make_tracer_scene(scene);
    const auto darker = static_cast<float>(std::exp2(-options.exposure_ev));
    std::vector<std::shared_ptr<ObjectPrimitive>> rays;
    for (const PlacedObject& object : objects) {
        rays.push_back(std::make_shared<ObjectPrimitive>(object, darker));
        room.scene.primitives.push_back(rays.back());
    }
    const bool has_emission = std::ranges::any_of(
        room.scene.materials, [](const auto& material) { return material.emission != glm::vec3(0); });
    RS_ASSIGN_OR_RETURN(auto tracer, capture::Tracer::create(std::move(room.scene)));
    TracedRenderer renderer(std::move(tracer), options);
    renderer.background_ = scene.background;
    renderer.render_.method = options.method;
    renderer.render_.max_bounces = options.max_bounces;
    renderer.render_.soft_shadows = options.soft_shadows;
    renderer.render_.toon = options.toon;
    if (options.line_radius) renderer.render_.toon.edge_radius = static_cast<float>(*options.line_radius);
    renderer.render_.toon.shadow_rays = options.soft_shadows ? kToonShadowRays : 0;
    renderer.render_.toon.brightness = darker;  // tones do not depend on the exposure
    renderer.render_.show_areas = true;
    renderer.moving_ = std::move(room.moving);
    renderer.has_emission_ = has_emission;
    renderer.objects_ = std::move(rays);
    renderer.describe_lights(scene);
    renderer.relight_objects();
    return renderer;
}

bool TracedRenderer::move(std::uint32_t id, const glm::dmat4& moved, const std::optional<glm::dmat4>& at_close) {
    std::vector<std::pair<std::size_t, capture::Instance>> changed;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
        if (moving_[i].id != id) continue;
        capture::Instance placed;
        placed.world_from_part = moved * moving_[i].world_from_node;
        if (at_close) placed.at_close = *at_close * moving_[i].world_from_node;
        if (!capture::check_placement(placed)) return false;
        changed.emplace_back(i, placed);
    }
    for (const auto& [i, placed] : changed) {
        if (!tracer_.move(i, placed.world_from_part, placed.at_close)) return false;
    }
    return !changed.empty();
}

void TracedRenderer::describe_lights(const Scene& scene) {
    render_.ambient = ambient_of(scene);
    render_.show_environment = scene.environment && scene.environment->seen;
    headlight_ = scene.navigation.headlight && scene.lights.empty() && !scene.environment && !has_emission_;
    environment_ = scene.environment;
}

// Objects are dark to each other's irradiance, so that the result does not depend on their order.
void TracedRenderer::relight_objects() {
    irradiance_ = nullptr;
    const bool physical = options_.relighting == Relighting::kTraced && render_.method != TracedMethod::kToon;
    const bool relit = (physical || options_.relighting == Relighting::kOn) && !headlight_;
    for (const auto& object : objects_) {
        object->set_gain(relit ? std::optional(IrradianceHarmonics{}) : std::nullopt);
    }
    if (!relit) return;
    tracer_.commit();
    environment_harmonics_ = environment_irradiance_.of(environment_);
    auto irradiance = std::make_shared<LocalIrradiances>(objects_.size());
    for_each_index(static_cast<std::int64_t>(objects_.size()), 0, [&](std::int64_t index) {
        const auto i = static_cast<std::size_t>(index);
        const glm::dvec3 position = middle_of(objects_[i]->placed());
        (*irradiance)[i] = {position, irradiance_at(position)};
    });
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        objects_[i]->set_gain(relighting_gain(objects_[i]->placed(), (*irradiance)[i].irradiance));
    }
    irradiance_ = std::move(irradiance);
}

IrradianceHarmonics TracedRenderer::irradiance_at(const glm::dvec3& position) const {
    const bool by_paths = render_.method == TracedMethod::kPath || render_.method == TracedMethod::kRadiosity;
    IrradianceHarmonics irradiance = by_paths ? capture::trace_irradiance(tracer_, position, kObjectProbe)
                                              : capture::direct_irradiance(tracer_, position);
    if (!by_paths) {
        irradiance.add_ambient(render_.ambient);
        if (environment_harmonics_) irradiance += *environment_harmonics_;
    }
    return irradiance *= static_cast<float>(std::exp2(options_.exposure_ev));
}

void TracedRenderer::set_method(TracedMethod method) {
    if (method == render_.method) return;
    render_.method = method;
    relight_objects();
}

void TracedRenderer::set_lights(const Scene& scene, double exposure_ev) {
    const auto& pixels = scene.environment ? scene.environment->pixels : nullptr;
    if (pixels != (environment_ ? environment_->pixels : nullptr)) {
        tracer_.set_environment(traced_environment(scene));
    } else if (pixels) {
        tracer_.set_environment(scene.environment->scale, scene.environment->turn_rad);
    }
    tracer_.set_lights(traced_lights(scene), traced_scopes(scene));
    options_.exposure_ev = exposure_ev;
    const auto darker = static_cast<float>(std::exp2(-exposure_ev));
    render_.toon.brightness = darker;
    for (const auto& object : objects_) object->set_brightness(darker);
    describe_lights(scene);
    relight_objects();
}

void TracedRenderer::begin(const Camera& camera) {
    tracer_.commit();
    if (headlight_) tracer_.set_lights({headlight_of(camera.forward())});
    if (!options_.line_radius) render_.toon.edge_radius = static_cast<float>(default_line_radius(camera));
}

double TracedRenderer::default_line_radius(const Camera& camera) const {
    if (!options_.panorama) return kToonLine_px * tracer_.median_pixel_size(camera);
    const double fov_x_rad = 2 * std::atan(0.5 * camera.width / camera.fl_x);
    std::array<double, 6> sizes{};
    for (int face = 0; face < 6; ++face) {
        glm::dvec3 axis(0);
        axis[face / 2] = face % 2 == 0 ? 1 : -1;
        sizes[static_cast<std::size_t>(face)] = tracer_.median_pixel_size(
            look_at_camera(camera.centre(), camera.centre() + axis, fov_x_rad, camera.width, camera.height));
    }
    std::ranges::sort(sizes);
    return kToonLine_px * 0.5 * (sizes[2] + sizes[3]);
}

capture::RenderOptions TracedRenderer::render_options(const Camera& camera) const {
    capture::RenderOptions render = render_;
    if (options_.lens) render.lens = options_.lens->of(camera);
    if (render.part && render.method == TracedMethod::kRadiosity)
        render.part = capture::with_filter_margin(*render.part);
    return render;
}

void TracedRenderer::begin_image(const Camera& camera) {
    camera_ = camera;
    sum_ = {};
    begin(camera);
}

bool TracedRenderer::add_pass(Progress* progress, const std::atomic<bool>* stop) {
    return tracer_.accumulate(camera_, render_options(camera_), 1, sum_, progress, stop);
}

std::optional<Image<Rgba8>> TracedRenderer::coarse_image(const Camera& camera, int side,
                                                         const std::atomic<bool>* stop) {
    begin(camera);
    Camera coarse = camera;
    coarse.width = (camera.width + side - 1) / side;
    coarse.height = (camera.height + side - 1) / side;
    coarse.fl_x /= side;
    coarse.fl_y /= side;
    coarse.cx /= side;
    coarse.cy /= side;
    capture::Accumulation sum;
    if (!tracer_.accumulate(coarse, render_options(coarse), 1, sum, nullptr, stop)) return std::nullopt;
    const Image<Rgba8> small = tone_map(sum.mean());
    Image<Rgba8> image(camera.width, camera.height);
    for (int y = 0; y < small.height(); ++y) {
        const int top = y * side, bottom = std::min(top + side, camera.height);
        for (int x = 0; x < small.width(); ++x) {
            const int right = std::min((x + 1) * side, camera.width);
            for (int row = top; row < bottom; ++row)
                std::fill(&image(x * side, row), &image(right - 1, row) + 1, small(x, y));
        }
    }
    return image;
}

Image<RgbaF> TracedRenderer::probe(const glm::dvec3& place, int samples, Progress& progress) const {
    const capture::LightProbeOptions options{.samples_per_pixel = samples, .max_bounces = options_.max_bounces};
    progress.start("probing", capture::light_probe_steps(options));
    Image<RgbaF> map = capture::light_probe(tracer_, place, options, &progress);
    progress.finish();
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            RgbaF& p = map(x, y);
            const glm::dvec3 direction = capture::probe_direction(x + 0.5, y + 0.5, map.width());
            const glm::vec3 behind = (1.0F - p.a) * background_colour(background_, direction);
            p = {p.r * p.a + behind.r, p.g * p.a + behind.g, p.b * p.a + behind.b, 1};
        }
    }
    return map;
}

Image<Rgba8> TracedRenderer::image() const {
    return tone_map(render_.part ? capture::filtered_mean(sum_, *render_.part) : capture::filtered_mean(sum_));
}

Image<Rgba8> TracedRenderer::tone_map(Image<RgbaF> radiance) const {
    const auto brighter = static_cast<float>(std::exp2(options_.exposure_ev));
    for (RgbaF& pixel : radiance.pixels()) {
        pixel.r *= brighter;
        pixel.g *= brighter;
        pixel.b *= brighter;
    }
    return capture::to_srgb8(radiance);
}

}  // namespace rs::compositor
