#include "capture/photos/segmentation/segmenter_choice.hpp"

#include "capture/photos/masks/mask_folder.hpp"
#include "capture/photos/masks/segmentation_network.hpp"
#include "capture/photos/segmentation/background_model_segmenter.hpp"
#include "capture/photos/segmentation/chroma_key_segmenter.hpp"
#include "capture/photos/segmentation/network_segmenter.hpp"
#include "capture/photos/segmentation/provided_masks.hpp"
#include "capture/photos/segmentation/soft_shadow.hpp"
#include "rayspace/api/types/check.hpp"

#include <cmath>
#include <utility>

namespace rs::capture {
namespace {

Status check(const SegmenterRequest& request) {
    const auto kind = request.kind;
    if (!request.masks.empty() && kind != SegmenterKind::kAuto && kind != SegmenterKind::kMasks) {
        return Error{"--masks: has no effect with --segmenter " + to_string(kind) + "; leave one of them out"};
    }
    if (kind == SegmenterKind::kMasks && request.masks.empty()) {
        return Error{"--segmenter masks: needs a folder of masks; give it by --masks"};
    }
    if (request.masks_are_alpha && request.masks.empty()) {
        return Error{"--masks-alpha: needs a folder of masks; give it by --masks"};
    }
    if (kind == SegmenterKind::kModel && request.network.empty()) {
        return Error{
            "--segmenter model: needs a network; give it by --segmentation-model FILE.onnx or "
            "RAYSPACE_SEGMENTATION_MODEL"};
    }
    if (!request.masks.empty() && request.background.kind) {
        return Error{"--backdrop: has no effect with --masks; leave one of them out"};
    }
    if (kind == SegmenterKind::kAlpha && request.background.kind && request.background.kind != BackgroundKind::kAlpha) {
        return Error{"--backdrop: has no effect with --segmenter alpha; leave one of them out"};
    }
    return {};
}

Status refuse_shadow(const SegmenterRequest& request, SegmenterKind kind) {
    if (request.shadow == ShadowHandling::kRemove) return {};
    return Error{"--shadow keep: needs the background model, but the segmenter is " + to_string(kind) +
                 "; give --segmenter background, or leave it out"};
}

Result<ChosenSegmenter> by_masks(const SegmenterRequest& request, const Intake& intake, Progress* progress) {
    RS_TRY(refuse_shadow(request, SegmenterKind::kMasks));
    const MaskKind kind = request.masks_are_alpha ? MaskKind::kAlpha : MaskKind::kBinary;
    RS_ASSIGN_OR_RETURN(MaskFolder masks,
                        request.mask_files.empty()
                            ? MaskFolder::open(request.masks, intake.folder, kind, progress)
                            : MaskFolder::open_files(request.mask_files, request.masks, intake.folder, kind, progress));
    ChosenSegmenter chosen;
    chosen.notes = masks.notes();
    chosen.segmenter = std::make_shared<MaskFolderSegmenter>(std::move(masks), intake.folder);
    chosen.kind = SegmenterKind::kMasks;
    chosen.reason = request.mask_files.empty() ? "--masks" : "mask_path";
    chosen.background_share = 0;
    return chosen;
}

Result<ChosenSegmenter> by_alpha(const SegmenterRequest& request) {
    RS_TRY(refuse_shadow(request, SegmenterKind::kAlpha));
    ChosenSegmenter chosen;
    chosen.segmenter = std::make_shared<AlphaSegmenter>();
    chosen.reason = "the photos have transparent pixels";
    chosen.background_share = 0;
    return chosen;
}

std::string percent(double share) {
    return std::to_string(std::lround(100 * share)) + " %";
}

std::shared_ptr<const BackgroundModelSegmenter> background_segmenter(const BackgroundModel& model,
                                                                     const PhotoFolder& folder,
                                                                     const SegmenterRequest& request) {
    return std::make_shared<const BackgroundModelSegmenter>(model, folder.width, folder.height,
                                                            request.parameters.foreground);
}

// The network, fused with the background model where it keeps something static. `model` may be null: no background
// could be estimated.
Result<ChosenSegmenter> by_network(const SegmenterRequest& request, const Intake& intake, const BackgroundModel* model,
                                   Progress* progress) {
    const bool keeps_shadow = request.shadow == ShadowHandling::kKeep;
    if (model == nullptr && keeps_shadow) {
        return Error{"--shadow keep: the background could not be estimated; leave it out"};
    }
    RS_ASSIGN_OR_RETURN(const SegmentationNetwork network, SegmentationNetwork::load(request.network));
    RS_ASSIGN_OR_RETURN(NetworkMasks masks,
                        NetworkMasks::compute(network, intake.folder, request.parameters.fusion, progress));
    ChosenSegmenter chosen;
    chosen.kind = SegmenterKind::kModel;
    chosen.reason = network.description();
    chosen.background_share = 0;
    Image<std::uint8_t> region;
    if (model != nullptr && !model->always_visible.empty()) {
        std::vector<std::size_t> samples = intake.survey.sample_photos;
        std::erase_if(samples, [&](std::size_t photo) { return photo >= masks.count(); });  // a repeat was dropped
        region = static_foreground_hull(masks, samples, model->always_visible, request.parameters.fusion);
    }
    std::shared_ptr<const BackgroundModelSegmenter> background;
    if (model != nullptr) {
        chosen.background = model->kind;
        chosen.background_colour = model->colour;
        if (keeps_shadow || !region.empty()) background = background_segmenter(*model, intake.folder, request);
    }
    if (region.empty()) {
        chosen.segmenter = std::make_shared<NetworkSegmenter>(std::move(masks));
    } else {
        auto fused = std::make_shared<FusedSegmenter>(std::move(masks), background, std::move(region));
        chosen.background_share = fused->background_share();
        chosen.notes.push_back(
            "the background model is used in " + percent(chosen.background_share) +
            " of the image, where the network keeps static background; the network is used elsewhere");
        chosen.segmenter = std::move(fused);
    }
    if (keeps_shadow) {
        chosen.segmenter = std::make_shared<ShadowKeepingSegmenter>(std::move(chosen.segmenter), background);
    }
    return chosen;
}

Result<ChosenSegmenter> by_background(const SegmenterRequest& request, const Intake& intake,
                                      const BackgroundModel& model) {
    ChosenSegmenter chosen;
    const std::shared_ptr<const BackgroundModelSegmenter> background =
        background_segmenter(model, intake.folder, request);
    chosen.segmenter = background;
    if (request.shadow == ShadowHandling::kKeep) {
        chosen.segmenter = std::make_shared<ShadowKeepingSegmenter>(background, background);
    }
    chosen.kind = SegmenterKind::kBackground;
    chosen.reason = request.kind == SegmenterKind::kBackground ? "--segmenter"
                    : request.network.empty()                  ? "no masks, no alpha, no network given"
                                                               : "networks lose black parts before black";
    chosen.background = model.kind;
    chosen.background_colour = model.colour;
    return chosen;
}

Result<ChosenSegmenter> by_chroma_key(const SegmenterRequest& request, const BackgroundModel& model) {
    RS_TRY(refuse_shadow(request, SegmenterKind::kChromaKey));
    ChosenSegmenter chosen;
    std::vector<Rgba8> keys = model.key_colours;
    if (request.background.colour || keys.empty()) keys.insert(keys.begin(), model.colour);
    chosen.segmenter = std::make_shared<ChromaKeySegmenter>(std::move(keys), request.parameters.foreground);
    chosen.kind = SegmenterKind::kChromaKey;
    chosen.reason = "--segmenter";
    chosen.background = model.kind;
    chosen.background_colour = model.colour;
    chosen.background_share = 0;
    return chosen;
}

}  // namespace

std::string to_string(SegmenterKind kind) {
    switch (kind) {
        case SegmenterKind::kAuto:
            return "auto";
        case SegmenterKind::kAlpha:
            return "alpha";
        case SegmenterKind::kMasks:
            return "masks";
        case SegmenterKind::kChromaKey:
            return "chroma";
        case SegmenterKind::kBackground:
            return "background";
        case SegmenterKind::kModel:
            return "model";
    }
    RS_CHECK(false);
}

Result<ChosenSegmenter> choose_segmenter(const SegmenterRequest& request, const Intake& intake,
                                         const std::string& where, Progress* progress) {
    RS_TRY(check(request));
    if (!request.masks.empty()) return by_masks(request, intake, progress);

    BackgroundRequest background = request.background;
    if (request.kind == SegmenterKind::kAlpha) background.kind = BackgroundKind::kAlpha;
    const bool ignores_alpha = request.kind != SegmenterKind::kAuto && request.kind != SegmenterKind::kAlpha;
    const Result<BackgroundModel> model =
        estimate_background(intake.survey, background, where, ignores_alpha ? AlphaUse::kIgnore : AlphaUse::kPrefer,
                            request.parameters.background);
    const bool wants_network =
        request.kind == SegmenterKind::kModel || (request.kind == SegmenterKind::kAuto && !request.network.empty());
    if (!model) {  // a network needs no background
        return wants_network ? by_network(request, intake, nullptr, progress) : Result<ChosenSegmenter>(model.error());
    }
    if (model->kind == BackgroundKind::kAlpha) return by_alpha(request);
    if (request.kind == SegmenterKind::kChromaKey) return by_chroma_key(request, *model);
    const bool is_black = model->kind == BackgroundKind::kBlack;
    if (wants_network && (request.kind == SegmenterKind::kModel || !is_black)) {
        return by_network(request, intake, &*model, progress);
    }
    return by_background(request, intake, *model);
}

}  // namespace rs::capture
