#include "engine/core/views/compare.hpp"

#include "rayspace/base/parallel.hpp"
#include "rayspace/geometry/rig_conventions.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "rayspace/image_io/image_io.hpp"

namespace rs::engine {
namespace {

struct MeasuredView {
    ComparedView view;
    ImageDifference difference;
};

Result<MeasuredView> compare_view(const RenderView& render, const std::filesystem::path& folder, const RigView& view) {
    const std::filesystem::path path = image_path(folder, view);
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> truth, read_image(path));
    if (truth.width() != view.camera.width || truth.height() != view.camera.height) {
        return Error{path.string() + ": its size differs from its frame in " + kRigFileName + "; correct one of them"};
    }
    const Result<Image<Rgba8>> rendered = render(view.camera);
    if (!rendered) return Error{path.string() + ": " + rendered.error().message};
    const ImageDifference difference = compare_images(*rendered, truth);
    return MeasuredView{{view.file_path, difference.psnr_db(), difference.ssim}, difference};
}

}  // namespace

Result<Comparison> compare_with_set(const Renderer& renderer, const std::filesystem::path& set, Progress* progress) {
    const RenderView render = [&](const Camera& camera) -> Result<Image<Rgba8>> {
        RS_ASSIGN_OR_RETURN(const MixedView view, prepare_mixed_view(renderer.object(), camera));
        Image<Rgba8> rendered(camera.width, camera.height);
        renderer.render(view, rendered);
        return rendered;
    };
    return compare_with_set(render, set, progress);
}

Result<Comparison> compare_with_set(const RenderView& render, const std::filesystem::path& set, Progress* progress) {
    RS_ASSIGN_OR_RETURN(Rig rig, read_rig(set));
    apply_rig_conventions(rig);  // as for the object, if it was made from this set
    if (rig.views.empty()) return Error{set.string() + ": has no frames to compare with"};
    const std::filesystem::path folder = std::filesystem::is_directory(set) ? set : set.parent_path();

    const int count = static_cast<int>(rig.views.size());
    Comparison comparison;
    comparison.views.resize(rig.views.size());
    std::vector<ImageDifference> differences(rig.views.size());
    RS_TRY(for_each_in_parallel(count, "comparing", progress, [&](int i) -> Status {
        const auto n = static_cast<std::size_t>(i);
        RS_ASSIGN_OR_RETURN(MeasuredView measured, compare_view(render, folder, rig.views[n]));
        comparison.views[n] = std::move(measured.view);
        differences[n] = measured.difference;
        return {};
    }));
    const DifferenceSummary summary = summarise(differences);
    comparison.mean_psnr_db = summary.mean_psnr_db;
    comparison.pooled_psnr_db = summary.pooled_psnr_db;
    comparison.mean_ssim = summary.mean_ssim;
    return comparison;
}

}  // namespace rs::engine
