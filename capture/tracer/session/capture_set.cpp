#include "capture/tracer/session/capture_set.hpp"

#include "capture/tracer/integrator/light_probe.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace rs::capture {

namespace {

double coverage(ConstImageView<RgbaF> image) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (const RgbaF& p : image.row_span(y)) sum += static_cast<double>(p.a);
    }
    return sum / (static_cast<double>(image.width()) * image.height());
}

bool touches_edge(ConstImageView<RgbaF> image) {
    const auto is_covered = [](const RgbaF& p) { return p.a > 0.0F; };
    if (std::ranges::any_of(image.row_span(0), is_covered)) return true;
    if (std::ranges::any_of(image.row_span(image.height() - 1), is_covered)) return true;
    for (int y = 0; y < image.height(); ++y) {
        if (is_covered(image(0, y)) || is_covered(image(image.width() - 1, y))) return true;
    }
    return false;
}

// The scene's surroundings, visible to all rays.
Scene without_object(const Scene& scene) {
    Scene empty = scene;
    const auto is_object = [&](const Mesh& mesh) { return !scene.surrounds(mesh.material); };
    std::erase_if(empty.meshes, is_object);
    for (Part& part : empty.parts) std::erase_if(part.meshes, is_object);
    empty.scopes = {};  // refer to the erased meshes
    empty.first_surrounding_material = std::numeric_limits<int>::max();
    return empty;
}

}  // namespace

Result<IrradianceHarmonics> capture_irradiance(const Scene& scene) {
    RS_ASSIGN_OR_RETURN(const Tracer empty, Tracer::create(without_object(scene)));
    return trace_irradiance(empty, {0, 0, 0}, {.width = 64, .samples_per_pixel = 16});
}

Result<CaptureSetSummary> write_capture_set(const Tracer& tracer, Rig rig, const CaptureSetOptions& options,
                                            const std::filesystem::path& folder, Progress* progress) {
    using Clock = std::chrono::steady_clock;
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(folder, "traced images", options.force));
    if (progress != nullptr) {
        std::int64_t steps = 0;
        for (const RigView& view : rig.views) steps += Tracer::step_count(view.camera);
        progress->start("tracing " + std::to_string(rig.views.size()) + " views", steps);
    }

    CaptureSetSummary summary;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        RigView& view = rig.views[i];
        const Clock::time_point begun = Clock::now();
        const Rendering rendering = tracer.render(view.camera, options.render, progress);
        summary.render_s += std::chrono::duration<double>(Clock::now() - begun).count();
        summary.mean_coverage += coverage(rendering.image) / static_cast<double>(rig.views.size());
        summary.clipped_views += touches_edge(rendering.image) ? 1 : 0;
        ++summary.views;

        view.file_path = view_number(i) + (options.format == ImageFormat::png ? ".png" : ".exr");
        view.depth_file_path = options.render.depth ? view_number(i) + ".depth.exr" : "";
        const std::filesystem::path& where = staged.temporary_path();
        Status written = options.format == ImageFormat::png
                             ? write_png(where / view.file_path, to_srgb8(rendering.image).view())
                             : write_exr(where / view.file_path, rendering.image);
        if (written && options.render.depth) {
            written = write_exr_channel(where / view.depth_file_path, rendering.depth.view());
        }
        if (!written) return written.error();
    }
    if (!(summary.mean_coverage > 0.0)) {
        return Error{folder.string() + ": no view shows the object; check the poses or the mesh"};
    }
    RS_TRY(write_rig(staged.temporary_path() / kRigFileName, rig));
    RS_TRY(staged.commit());
    if (progress != nullptr) progress->finish();
    return summary;
}

}  // namespace rs::capture
