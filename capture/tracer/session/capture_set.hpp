#pragma once
// Writes a synthetic capture set: traced images of every camera of a rig, and the transforms.json beside them.

#include "capture/tracer/integrator/tracer.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>

namespace rs::capture {

// The number of a view in the names of a capture set's files: three digits or more, "007". Thread-safe.
inline std::string view_number(std::size_t view) {
    char text[24];
    std::snprintf(text, sizeof text, "%03zu", view);
    return text;
}

enum class ImageFormat { png, exr };

struct CaptureSetOptions {
    RenderOptions render;  // with depth, a NNN.depth.exr stands beside each image
    ImageFormat format = ImageFormat::png;
};

struct CaptureSetSummary {
    int views = 0;
    double render_s = 0;       // wall clock, without writing
    double mean_coverage = 0;  // share of the pixels that show the object, over all views
    int clipped_views = 0;     // views where the object touches the image's edge
};

// Cameras and top-level keys come from `rig`; file names become 000.png, 001.png, ... (or .exr). The folder appears
// when all is written; an existing one is replaced only if it is a capture set (file_output.hpp). A set in
// which no view shows anything is an error. `progress` counts all views.
Result<CaptureSetSummary> write_capture_set(const Tracer& tracer, Rig rig, const CaptureSetOptions& options,
                                            const std::filesystem::path& folder, Progress* progress = nullptr);

}  // namespace rs::capture
