#include "compositor/tools/panorama_frames.hpp"

#include "capture/tracer/image/discontinuity_filter.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

namespace rs::compositor {
namespace {

// True if a traced surface emits light, so that traced renderers use no headlight.
bool emits_light(const Scene& scene) {
    return std::ranges::any_of(scene.geometry, [](const GeometryNode& node) {
        const Material& material = node.material;
        const glm::vec3 emission = material.lit ? surface_of(material).emission : material.diffuse;
        return is_traced(node) && emission != glm::vec3(0);
    });
}

}  // namespace

void check_panorama_options(const CLI::App& command) {
    struct Refused {
        const char* option;
        const char* reason;
    };
    constexpr std::array kRefused{Refused{"--fov", "a panorama shows all directions"},
                                  Refused{"--lens", "a panorama has no lens"},
                                  Refused{"--focus", "a panorama has no lens"},
                                  Refused{"--streaming", "a panorama waits for all objects that it shows"},
                                  Refused{"--stats", "a panorama is composited from six frames"}};
    for (const Refused& refused : kRefused) {
        if (command.count(refused.option) == 0) continue;
        throw CLI::ValidationError(std::string(refused.option) + " cannot be used with --panorama: " + refused.reason +
                                   "; leave it out");
    }
}

Result<PanoramaLayout> panorama_layout(PixelSize size, const RendererOptions& options) {
    constexpr int kMinWidth_px = 8;
    if (size.width != 2 * size.height || size.width < kMinWidth_px) {
        return Error{"--size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                     ": a panorama is twice as wide as high; give " +
                     std::to_string(std::max(size.width / 2 * 2, kMinWidth_px)) + "x" +
                     std::to_string(std::max(size.width / 2, kMinWidth_px / 2))};
    }
    PanoramaLayout layout{.width = size.width};
    // Images of radiosity are filtered: at the borders with the pixels of both sides.
    if (options.method() == TracedMethod::kRadiosity) layout.margin_px = capture::kFilterRadius_px;
    return layout;
}

Status replace_headlight(Scene& scene, const std::vector<Camera>& cameras, bool traced) {
    if (!std::exchange(scene.navigation.headlight, false)) return {};
    if (traced && (!scene.lights.empty() || scene.environment || emits_light(scene))) return {};
    const glm::dvec3 eye = cameras.front().centre();
    const bool moves = std::ranges::any_of(cameras, [&](const Camera& camera) { return camera.centre() != eye; });
    if (moves) {
        return Error{
            "--panorama with several positions: the scene is lit by a headlight, which cannot follow; add --lights "
            "FILE.json with \"replace\": true, or set headlight FALSE in the scene"};
    }
    Light light;
    light.kind = LightKind::kPoint;
    light.location = eye;
    light.radius = std::numeric_limits<double>::infinity();
    light.casts_shadows = false;
    light.name = "headlight";
    scene.lights.push_back(light);
    return {};
}

PassOptions passes_of_face(PassOptions limit) {
    if (limit.seconds) *limit.seconds /= static_cast<double>(kPanoramaFaces);
    return limit;
}

Result<Image<Rgba8>> render_panorama(HeadlessRenderer& renderer, const Camera& camera, const PanoramaLayout& layout,
                                     Progress& progress) {
    const std::array<Camera, kPanoramaFaces> cameras = panorama_cameras(camera, layout);
    std::array<Image<Rgba8>, kPanoramaFaces> faces;
    for (std::size_t face = 0; face < kPanoramaFaces; ++face) {
        RS_ASSIGN_OR_RETURN(faces[face], renderer.render(cameras[face]));
        progress.advance();
    }
    return panorama_from_faces(faces, layout);
}

}  // namespace rs::compositor
