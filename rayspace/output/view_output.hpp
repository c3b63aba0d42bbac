#pragma once
// Where the tools that render put their views: one image, a video, or a folder that is a set of images.

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

// What a name means: FILE.png, FILE.mp4 (in either case of letters), or a folder. Names of other images and videos
// are refused, so that "view.jpg" does not become a folder.
Result<OutputKind> output_kind(const std::string& output);

// "0007.png" for 7.
std::string numbered_image_name(std::size_t number);

// The cameras as the rig of a folder whose images have numbered names.
Rig rig_of_views(const std::vector<Camera>& cameras);

// Renders one view; the image has the camera's size.
using RenderView = std::function<Result<Image<Rgba8>>(const Camera&)>;

// Renders the cameras, of which there is at least one and all have one size, in their order into a video, and advances
// `progress` by one for each.
Status write_view_video(const std::string& output, double frames_per_second, const std::vector<Camera>& cameras,
                        const RenderView& render, Progress& progress);

}  // namespace rs
