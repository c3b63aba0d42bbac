#pragma once
// Output of the rendering tools: an image, a video, or a folder with a set of images.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rs {

enum class OutputKind { image, video, folder };

/// Determines the kind from the name: FILE.png, FILE.mp4 (case-insensitive), or a folder. Names with other image and
/// video extensions are errors, so that "view.jpg" does not become a folder.
Result<OutputKind> output_kind(const std::string& output);

/// "0007.png" for 7.
std::string numbered_image_name(std::size_t number);

/// The rig of a folder whose images have numbered names.
Rig make_rig_of_views(const std::vector<Camera>& cameras);

/// Renders one view; the image has the camera's size.
using RenderView = std::function<Result<Image<Rgba8>>(const Camera&)>;

/// Renders the cameras (at least one, all of one size) in order into a video, and advances `progress` by one for each.
Status write_view_video(const std::string& output, double frames_per_second, const std::vector<Camera>& cameras,
                        const RenderView& render, Progress& progress);

}  // namespace rs
