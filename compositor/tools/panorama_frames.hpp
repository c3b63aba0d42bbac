#pragma once
// `rs-view render --panorama`: frames that show the full sphere, composited from six frames of the faces of a cube
// (displays/panorama.hpp).

#include "compositor/displays/panorama.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/tools/headless_renderer.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <vector>

namespace rs::compositor {

inline constexpr const char* kPanoramaSize = "2048x1024";  // default of --size

/// Throws CLI::ValidationError if an option of `command` cannot be used with --panorama.
void check_panorama_options(const CLI::App& command);

/// Fails unless the size is twice as wide as high.
Result<PanoramaLayout> panorama_layout(PixelSize size, const RendererOptions& options);

/// Replaces a headlight, whose direction would differ among the faces, by a point light at the viewer without
/// attenuation and shadows. For traced renderers it is left out unless the scene has no other light.
/// \return an error if the cameras have several positions
Status replace_headlight(Scene& scene, const std::vector<Camera>& cameras, bool traced);

/// Limit of each face; --seconds is the time of a whole frame.
PassOptions passes_of_face(PassOptions limit);

/// Renders the panorama around the camera's position. Advances `progress` by one for each face.
Result<Image<Rgba8>> render_panorama(HeadlessRenderer& renderer, const Camera& camera, const PanoramaLayout& layout,
                                     Progress& progress);

}  // namespace rs::compositor
