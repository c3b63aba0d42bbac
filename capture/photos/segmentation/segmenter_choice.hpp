#pragma once
/// \file
/// Chooses the segmenter of a turn, by request or from the photos, and states which and why.
///
/// Automatic choice: mask files if given; the photos' alpha if they have one; the network fused with the background
/// model if a network is configured and the background is not black (networks lose black on black); else the background
/// model. Runs between run_intake() and segment_turn().

#include "capture/photos/background/background_model.hpp"
#include "capture/photos/intake/intake.hpp"
#include "capture/photos/segmentation/segmentation_parameters.hpp"
#include "capture/photos/segmentation/segmenter.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

enum class SegmenterKind { kAuto, kAlpha, kMasks, kChromaKey, kBackground, kModel };

/// "auto", "alpha", "masks", "chroma", "background", "model", as `--segmenter` takes them.
std::string to_string(SegmenterKind kind);

/// Handling of the object's shadow on the floor.
enum class ShadowHandling { kRemove, kKeep };

struct SegmenterRequest {
    SegmenterKind kind = SegmenterKind::kAuto;
    BackgroundRequest background;  ///< --backdrop
    std::filesystem::path masks;   ///< folder of mask files; empty: none
    /// [photo]: mask files, instead of a folder; `masks` then names the file that lists them. Empty: none.
    std::vector<std::filesystem::path> mask_files{};
    bool masks_are_alpha = false;   ///< the masks' grey is the final opacity
    std::filesystem::path network;  ///< ONNX file; empty: none
    ShadowHandling shadow = ShadowHandling::kRemove;
    SegmentationParameters parameters{};
};

struct ChosenSegmenter {
    std::shared_ptr<const Segmenter> segmenter;
    SegmenterKind kind = SegmenterKind::kAlpha;          ///< not kAuto
    std::string reason;                                  ///< why, for people: "the photos have transparent pixels"
    BackgroundKind background = BackgroundKind::kAlpha;  ///< as estimated; kAlpha if none was needed
    Rgba8 background_colour{};
    double background_share = 1;     ///< share of the image in which the background model is used, 0..1
    std::vector<std::string> notes;  ///< one line each
};

/// Errors: contradicting requests (option: what is wrong; remedy), and those of estimate_background(),
/// MaskFolder::open(), SegmentationNetwork::load() and the network itself.
Result<ChosenSegmenter> choose_segmenter(const SegmenterRequest& request, const Intake& intake,
                                         const std::string& where, Progress* progress);

}  // namespace rs::capture
