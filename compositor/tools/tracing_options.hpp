#pragma once
// Options of rs-view that choose how geometry is lit: rasterized, or traced by one of several methods.

#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>

namespace rs::compositor {

struct RendererOptions {
    std::string renderer = "raster";
    double exposure_ev = 0;
    bool soft_shadows = false;
    std::optional<double> toon_line_length;  // scene units; by default 1 px at the median distance
    std::optional<std::string> toon_style;   // file, toon_file.hpp
    bool toon_objects = false;               // objects are drawn as cartoons, too
    bool panorama = false;                   // images are faces of a panorama
    std::optional<std::string> lens;         // diameter in mm, or f/N
    std::optional<double> focus;             // scene units
    Relighting relighting = Relighting::kTraced;
    /// The method of a traced renderer; nullopt for raster.
    [[nodiscard]] std::optional<TracedMethod> method() const;
};

/// When the tracing of a frame ends; with neither, after 64 passes.
struct PassOptions {
    std::optional<int> passes;
    std::optional<double> seconds;
};

/// Adds --renderer, --exposure, --relight, --soft-shadows, --toon-style, --toon-lines and --toon-objects. The help
/// shows the last two in the line of --toon-style, and --relight in that of --exposure, because the help of `render`
/// and `walls` would not fit on a screen otherwise.
void add_renderer_options(CLI::App& command, RendererOptions& options);
/// Adds --lens and --focus.
void add_lens_options(CLI::App& command, RendererOptions& options);
/// Same, but describes --focus in the text of --lens, for commands whose options would not fit on a screen.
void add_lens_options_in_one_line(CLI::App& command, RendererOptions& options);
/// Throws CLI::ValidationError for --focus without --lens; for add_lens_options_in_one_line().
void check_focus_option(const CLI::App& command);
/// Restricts --renderer to the traced methods, with path as the default.
void require_traced_renderer(CLI::App& command, RendererOptions& options);
/// Adds --passes and --seconds.
void add_pass_options(CLI::App& command, PassOptions& options);
/// Throws CLI::ValidationError if an option of `command` needs toon or a traced renderer and --renderer is another one.
void check_renderer_options(const CLI::App& command, const RendererOptions& options);

/// Options of the tracer; for raster those that a window uses when the user switches to traced light, with radiosity,
/// whose first images have less noise than those of path tracing. Fails on a lens that cannot be parsed or has no
/// focus, and on a file of a toon style that cannot be read.
Result<TracedOptions> traced_options(const RendererOptions& options);

/// Traces one frame, at least one pass. `progress` counts the passes unless the time is limited.
std::shared_ptr<const Image<Rgba8>> trace_frame(TracedRenderer& tracer, const PassOptions& limit, const Camera& camera,
                                                Progress& progress);

}  // namespace rs::compositor
