#include "rayspace/output/view_output.hpp"

#include "rayspace/file/input_file.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace rs {

Result<OutputKind> output_kind(const std::string& output) {
    const std::string extension = lower_case_extension(output);
    if (extension == ".png") return OutputKind::image;
    if (extension == ".mp4") return OutputKind::video;
    for (const char* other :
         {".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".exr", ".bmp", ".gif", ".avi", ".mov", ".mkv", ".webm"}) {
        if (extension == other) {
            return Error{output + ": views are written as .png or .mp4; use such a name, or a folder"};
        }
    }
    return OutputKind::folder;
}

std::string numbered_image_name(std::size_t number) {
    char name[32];
    std::snprintf(name, sizeof name, "%04zu.png", number);
    return name;
}

Rig make_rig_of_views(const std::vector<Camera>& cameras) {
    Rig rig;
    for (const Camera& camera : cameras) {
        RigView view;
        view.file_path = numbered_image_name(rig.views.size());
        view.camera = camera;
        rig.views.push_back(view);
    }
    return rig;
}

Status write_view_video(const std::string& output, double frames_per_second, const std::vector<Camera>& cameras,
                        const RenderView& render, Progress& progress) {
    // H.264 at 4:2:0 requires even sizes: the last odd row or column is dropped.
    const int width = cameras.front().width & ~1;
    const int height = cameras.front().height & ~1;
    RS_ASSIGN_OR_RETURN(VideoWriter video, VideoWriter::open(output, width, height, frames_per_second));
    for (const Camera& camera : cameras) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> frame, render(camera));
        if ((frame.width() & ~1) != width || (frame.height() & ~1) != height) {
            return Error{output + ": a video needs views of one size; use --size"};
        }
        RS_TRY(video.add(frame.view().crop(0, 0, width, height)));
        progress.advance();
    }
    return video.finish();
}

}  // namespace rs
