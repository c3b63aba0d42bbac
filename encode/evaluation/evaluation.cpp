#include "encode/evaluation/evaluation.hpp"

#include "encode/posed/posed_rings.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/image/image_metrics.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace rs::encode {
namespace {

constexpr Method kMethods[] = {Method::kPhoto, Method::kPlane, Method::kShape};

// Renders a view of the rig by one method.
using RenderFunction = std::function<Result<Image<Rgba8>>(int view)>;

// The kept views as a set of rings.
struct KeptViews {
    CaptureSet set;
    double seconds = 0;  // for synthesizing the rings of posed photos
};

double seconds_since(std::chrono::steady_clock::time_point begun) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

Result<KeptViews> rings_of_kept(const CaptureSet& set, const HoldOut& hold_out, Progress* progress) {
    const auto begun = std::chrono::steady_clock::now();
    RS_ASSIGN_OR_RETURN(CaptureSet kept, with_rings(select_views(set, hold_out.kept), {}, progress));
    return KeptViews{std::move(kept), seconds_since(begun)};
}

Result<engine::Renderer> renderer_of_kept(const CaptureSet& kept, MapKind kind, int planes, Progress* progress) {
    BuildOptions options;
    options.map = default_plane_map(kind);
    options.map.planes = planes;
    options.raymap = kind;
    options.name = "kept views";
    RS_ASSIGN_OR_RETURN(BuiltObject built, build_object(kept, options, progress));
    // The renderer requires a validated object, which a file reader would return.
    RS_TRY(validate_object(built.object, kept.folder.string()));
    return engine::Renderer::create(std::move(built.object));
}

Result<Image<Rgba8>> render_view(const engine::Renderer& renderer, const CaptureSet& set, int view) {
    const RigView& wanted = set.upright.views[static_cast<std::size_t>(view)];
    const Result<engine::MixedView> prepared = engine::prepare_mixed_view(renderer.object(), wanted.camera);
    if (!prepared) return Error{image_path(set.folder, wanted).string() + ": " + prepared.error().message};
    Image<Rgba8> image(wanted.camera.width, wanted.camera.height);
    renderer.render(*prepared, image);
    return image;
}

Result<MethodScores> score(const CaptureSet& set, const HoldOut& hold_out, Method method, const RenderFunction& render,
                           const EvaluationSink& sink, Progress* progress) {
    MethodScores scores;
    scores.method = to_string(method);
    scores.views.resize(hold_out.held.size());
    std::vector<ImageDifference> differences(hold_out.held.size());
    const int count = static_cast<int>(hold_out.held.size());
    RS_TRY(for_each_in_parallel(count, "scoring " + scores.method, progress, [&](int i) -> Status {
        const auto n = static_cast<std::size_t>(i);
        const int view = hold_out.held[n];
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> truth, read_upright_image(set, view));
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> rendering, render(view));
        differences[n] = compare_images(truth, rendering);
        scores.views[n] = {view, set.upright.views[static_cast<std::size_t>(view)].file_path, differences[n].psnr_db(),
                           differences[n].ssim};
        return sink ? sink({method, n, view, truth, rendering, scores.views[n].psnr_db}) : Status{};
    }));
    const DifferenceSummary summary = summarise(differences);
    scores.mean_psnr_db = summary.mean_psnr_db;
    scores.pooled_psnr_db = summary.pooled_psnr_db;
    scores.mean_ssim = summary.mean_ssim;
    return scores;
}

Result<MethodScores> score_photo(const CaptureSet& set, const HoldOut& hold_out, const EvaluationSink& sink,
                                 Progress* progress) {
    const RenderFunction nearest = [&](int view) -> Result<Image<Rgba8>> {
        if (!set.posed) return read_upright_image(set, nearest_kept_view(set.upright, hold_out, view));
        const int kept = nearest_kept_direction(set.upright, hold_out, view);
        RS_ASSIGN_OR_RETURN(Image<Rgba8> image, read_upright_image(set, kept));
        const Camera& wanted = set.upright.views[static_cast<std::size_t>(view)].camera;
        if (image.width() == wanted.width && image.height() == wanted.height) return image;
        return Error{image_path(set.folder, set.upright.views[static_cast<std::size_t>(kept)]).string() +
                     ": its size differs from that of a held-out photo; use --methods shape"};
    };
    return score(set, hold_out, Method::kPhoto, nearest, sink, progress);
}

Result<MethodScores> score_object(const CaptureSet& set, const HoldOut& hold_out, const KeptViews& kept, Method method,
                                  int planes, const EvaluationSink& sink, Progress* progress) {
    const auto begun = std::chrono::steady_clock::now();
    const MapKind kind = method == Method::kPlane ? MapKind::kPlane : MapKind::kShape;
    RS_ASSIGN_OR_RETURN(const engine::Renderer renderer, renderer_of_kept(kept.set, kind, planes, progress));
    const double seconds = kept.seconds + seconds_since(begun);
    const RenderFunction render = [&](int view) { return render_view(renderer, set, view); };
    Result<MethodScores> scores = score(set, hold_out, method, render, sink, progress);
    if (scores) scores->build_seconds = seconds;
    return scores;
}

}  // namespace

std::string to_string(Method method) {
    switch (method) {
        case Method::kPhoto:
            return "photo";
        case Method::kPlane:
            return "plane";
        case Method::kShape:
            break;
    }
    return "shape";
}

Result<std::vector<Method>> parse_methods(const std::string& text) {
    std::vector<Method> methods;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        const auto* const known = std::find_if(std::begin(kMethods), std::end(kMethods),
                                               [&](Method method) { return to_string(method) == name; });
        const std::string problem = known == std::end(kMethods) ? "\"" + name + "\" is not a method"
                                    : std::find(methods.begin(), methods.end(), *known) != methods.end()
                                        ? "\"" + name + "\" is repeated"
                                        : "";
        if (!problem.empty()) {
            return Error{"--methods " + text + ": " + problem + "; use some of photo,plane,shape"};
        }
        methods.push_back(*known);
        begin = end + 1;
    }
    return methods;
}

Result<std::vector<MethodScores>> evaluate(const CaptureSet& set, const HoldOut& hold_out,
                                           const EvaluationOptions& options, const EvaluationSink& sink,
                                           Progress* progress) {
    std::vector<MethodScores> all;
    std::optional<KeptViews> kept;
    if (std::ranges::any_of(options.methods, [](Method method) { return method != Method::kPhoto; })) {
        RS_ASSIGN_OR_RETURN(KeptViews made, rings_of_kept(set, hold_out, progress));
        kept = std::move(made);
    }
    for (const Method method : options.methods) {
        RS_ASSIGN_OR_RETURN(MethodScores scores,
                            method == Method::kPhoto
                                ? score_photo(set, hold_out, sink, progress)
                                : score_object(set, hold_out, *kept, method, options.planes, sink, progress));
        all.push_back(std::move(scores));
    }
    return all;
}

}  // namespace rs::encode
