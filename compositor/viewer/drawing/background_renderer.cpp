#include "compositor/viewer/drawing/background_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/drawing/background_shaders.hpp"
#include "compositor/viewer/drawing/shaders.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

// Appends the colours with their angles (the first is 0) and returns their number.
int append_stops(const std::vector<glm::vec3>& colours, const std::vector<double>& angles_rad,
                 std::vector<glm::vec4>& stops) {
    const std::size_t count = std::min(colours.size(), angles_rad.size() + 1);
    for (std::size_t i = 0; i < count; ++i) {
        stops.emplace_back(colours[i], i == 0 ? 0.0F : static_cast<float>(angles_rad[i - 1]));
    }
    return static_cast<int>(count);
}

// Limited to half floats.
gl::Texture upload_map(const Image<RgbaF>& pixels) {
    constexpr float kMaxHalf = 65504;
    Image<RgbaF> texels(pixels.width(), pixels.height());
    for (int y = 0; y < pixels.height(); ++y) {
        for (int x = 0; x < pixels.width(); ++x) {
            const RgbaF& p = pixels(x, y);
            texels(x, y) = {std::min(p.r, kMaxHalf), std::min(p.g, kMaxHalf), std::min(p.b, kMaxHalf), 1};
        }
    }
    return {texels.view(), gl::TextureWrap{true, false}};
}

}  // namespace

Result<BackgroundRenderer> BackgroundRenderer::create(const Background& background) {
    RS_CHECK(!background.sky.empty());
    std::vector<glm::vec4> stops;
    const int sky_stops = append_stops(background.sky, background.sky_angles_rad, stops);
    const int ground_stops = append_stops(background.ground, background.ground_angles_rad, stops);
    int shown_images = 0;
    for (std::size_t i = 0; i < background.images.size(); ++i) {
        if (background.images[i]) shown_images |= 1 << i;
    }
    const std::string constants = "#version 450 core\n" + shaders::shader_constant("kSkyStops", sky_stops) +
                                  shaders::shader_constant("kGroundStops", ground_stops) +
                                  shaders::shader_constant("kShownPictures", shown_images);
    RS_ASSIGN_OR_RETURN(auto program, gl::Program::create("background", shaders::kWholeFrameVertex,
                                                          constants + shaders::kBackgroundFragment));
    BackgroundRenderer renderer(std::move(program));
    renderer.stops_.emplace(std::as_bytes(std::span(stops)));
    for (std::size_t i = 0; i < background.images.size(); ++i) {
        if (!background.images[i]) continue;
        renderer.images_[i].emplace(background.images[i]->image.view(), gl::TextureWrap{false, false});
    }
    renderer.background_from_world_ = glm::transpose(background.world_from_background);
    renderer.zenith_ = background.sky.front();
    renderer.plain_ = sky_stops == 1 && ground_stops <= 1 && shown_images == 0;
    return renderer;
}

Status BackgroundRenderer::set_environment(const std::optional<EnvironmentLight>& environment) {
    if (!environment || !environment->seen) {
        environment_.reset();
        return {};
    }
    if (!environment_ || environment_->pixels != environment->pixels) {
        RS_ASSIGN_OR_RETURN(auto program, gl::Program::create("environment", shaders::kWholeFrameVertex,
                                                              shaders::kEnvironmentFragment));
        environment_.emplace(
            Environment{std::move(program), upload_map(*environment->pixels), environment->pixels, 1, 0});
    }
    environment_->scale = environment->scale;
    environment_->turn_rad = environment->turn_rad;
    return {};
}

void BackgroundRenderer::draw(const Camera& camera, BackgroundArea area) const {
    const glm::dvec3 along_x = camera.right() / camera.fl_x;
    const glm::dvec3 along_y = -camera.up() / camera.fl_y;
    const glm::dmat3 world_from_pixel(along_x, along_y, camera.ray(0, 0));
    const gl::DrawState state{.depth_test = area == BackgroundArea::kBehindGeometry, .depth_write = false};
    if (environment_) {
        environment_->program.set("direction_from_pixel", glm::mat3(world_from_pixel));
        environment_->program.set("scale_turn", glm::vec2(environment_->scale, environment_->turn_rad));
        environment_->map.bind(1);
        gl::draw(environment_->program, rectangle_, state);
        return;
    }
    // The shader of a uniform background has no direction.
    if (!plain_) program_.set("direction_from_pixel", glm::mat3(background_from_world_ * world_from_pixel));
    stops_->bind_storage(3);
    for (std::size_t i = 0; i < images_.size(); ++i) {
        if (images_[i]) images_[i]->bind(static_cast<unsigned>(i) + 1);
    }
    gl::draw(program_, rectangle_, state);
}

}  // namespace rs::compositor
