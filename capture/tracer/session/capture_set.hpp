#pragma once
// Writes a synthetic capture set: traced images of every camera of a rig, and its transforms.json.

#include "capture/tracer/integrator/tracer.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/light/irradiance_harmonics.hpp"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>

namespace rs::capture {

/// Number of a view in file names: at least three digits, "007". Thread-safe.
inline std::string view_number(std::size_t view) {
    char text[24];
    std::snprintf(text, sizeof text, "%03zu", view);
    return text;
}

enum class ImageFormat { png, exr };

struct CaptureSetOptions {
    RenderOptions render;  // with depth, a NNN.depth.exr is written for each image
    ImageFormat format = ImageFormat::png;
    bool force = false;  // replace an existing folder whatever it holds (StagedFolder)
};

struct CaptureSetSummary {
    int views = 0;
    double render_s = 0;       // wall clock, without writing
    double mean_coverage = 0;  // share of the pixels covered by the object, over all views
    int clipped_views = 0;     // views in which the object touches the image's edge
};

/// Irradiance at the origin without the object: a light probe of the scene's lights, environment and surroundings.
Result<IrradianceHarmonics> capture_irradiance(const Scene& scene);

/// Renders and writes all views of `rig`; file names are 000.png, 001.png, ... (or .exr). The folder is created
/// atomically; an existing one is replaced as StagedFolder states (file_output.hpp).
/// \param rig cameras and top-level keys
/// \param progress covers all views; may be null
/// \return an error also if no view shows the object
Result<CaptureSetSummary> write_capture_set(const Tracer& tracer, Rig rig, const CaptureSetOptions& options,
                                            const std::filesystem::path& folder, Progress* progress = nullptr);

}  // namespace rs::capture
