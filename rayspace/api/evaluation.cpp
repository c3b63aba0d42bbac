#include "rayspace/api/evaluation.hpp"

#include "encode/evaluation/evaluation.hpp"
#include "encode/hold_out.hpp"
#include "engine/core/views/compare.hpp"
#include "rayspace/api/internal/type_conversion.hpp"
#include "rayspace/base/result.hpp"

namespace rs::api {

Result<Evaluation> compare_with_photos(const Renderer& renderer, const std::filesystem::path& set,
                                       const RenderOptions& options) {
    const RenderView render = [&](const rs::Camera& camera) -> Result<Image<Rgba8>> {
        RS_ASSIGN_OR_RETURN(RenderedView view, renderer.render(to_public(camera), {.filter = options.filter}));
        return std::move(view.image);
    };
    RS_ASSIGN_OR_RETURN(const engine::Comparison comparison, engine::compare_with_set(render, set));
    Evaluation evaluation{{}, comparison.mean_psnr_db, comparison.pooled_psnr_db, comparison.mean_ssim};
    for (const engine::ComparedView& view : comparison.views) {
        evaluation.views.push_back({view.image, {view.psnr_db, view.ssim}});
    }
    return evaluation;
}

Result<Evaluation> evaluate_held_out(const std::filesystem::path& set, const HoldOutOptions& options) {
    if (options.every < 2) return Error{"every: " + std::to_string(options.every) + "; give 2 or more"};
    ProgressAdapter progress(options.progress);
    RS_ASSIGN_OR_RETURN(const encode::CaptureSet opened, encode::open_capture_set(set, &progress));
    RS_ASSIGN_OR_RETURN(const encode::HoldOut hold_out,
                        encode::choose_hold_out(opened.upright, options.every, set.string()));
    encode::EvaluationOptions evaluated;
    evaluated.methods = {options.map == MapKind::kPlane ? encode::Method::kPlane : encode::Method::kShape};
    evaluated.planes = options.planes;
    RS_ASSIGN_OR_RETURN(const auto scores, encode::evaluate(opened, hold_out, evaluated, {}, &progress));
    const encode::MethodScores& method = scores.front();
    Evaluation evaluation{{}, method.mean_psnr_db, method.pooled_psnr_db, method.mean_ssim};
    for (const encode::HeldOutScore& view : method.views) {
        evaluation.views.push_back({view.image, {view.psnr_db, view.ssim}});
    }
    return evaluation;
}

}  // namespace rs::api
