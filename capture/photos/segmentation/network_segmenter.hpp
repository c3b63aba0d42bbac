#pragma once
/// \file
/// Segmenters by a neural network: alone, and fused with the background model.
///
/// The network detects salient objects in each photo independently: it is better in rooms and on white, but keeps the
/// turntable's disc. The background model contains static pixels. Fusion: where the network keeps pixels that never
/// change over the turn, i.e. the disc, the background model is used; the network is used everywhere else.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/masks/segmentation_network.hpp"
#include "capture/photos/segmentation/background_model_segmenter.hpp"
#include "capture/photos/segmentation/segmentation_parameters.hpp"
#include "capture/photos/segmentation/segmenter.hpp"
#include "rayspace/base/progress.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// Foreground probabilities of all photos of a turn, computed once.
class NetworkMasks {
public:
    /// Runs the network over all photos of the folder. Memory: one byte per pixel of a photo reduced to kSampleSide_px.
    /// Errors: photos that cannot be read, the network's.
    static Result<NetworkMasks> compute(const SegmentationNetwork& network, const PhotoFolder& folder,
                                        const FusionParameters& parameters, Progress* progress);

    /// From given probabilities, 0..255, one per photo.
    explicit NetworkMasks(std::vector<Image<std::uint8_t>> probabilities, const FusionParameters& parameters = {})
        : probabilities_(std::move(probabilities)), parameters_(parameters) {}

    [[nodiscard]] std::size_t count() const { return probabilities_.size(); }
    [[nodiscard]] const FusionParameters& parameters() const { return parameters_; }
    /// 255 where the probability is at least one half, resampled to width x height px.
    [[nodiscard]] Image<std::uint8_t> mask(std::size_t photo, int width, int height) const;

private:
    std::vector<Image<std::uint8_t>> probabilities_;  // [photo]
    FusionParameters parameters_;
};

/// Region, in the size of `always_visible`, in which the network keeps static background: the convex hull of the pixels
/// that are static over the turn (`always_visible` is not 0) and foreground in most of the photos. 255 within. Empty
/// where those pixels are less than 3 % of the image.
Image<std::uint8_t> static_foreground_hull(const NetworkMasks& masks, std::span<const std::size_t> photos,
                                           ConstImageView<std::uint8_t> always_visible,
                                           const FusionParameters& parameters = {});

/// The network alone.
class NetworkSegmenter : public Segmenter {
public:
    explicit NetworkSegmenter(NetworkMasks masks) : masks_(std::move(masks)) {}
    [[nodiscard]] std::string name() const override { return "network"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override;

private:
    NetworkMasks masks_;
};

/// The background model within a region, the network elsewhere.
class FusedSegmenter : public Segmenter {
public:
    /// `region`: as static_foreground_hull() gives it; not empty.
    FusedSegmenter(NetworkMasks masks, std::shared_ptr<const BackgroundModelSegmenter> background,
                   Image<std::uint8_t> region);
    [[nodiscard]] std::string name() const override { return "network and background model"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override;
    /// Share of the image in which the background model is used, 0..1.
    [[nodiscard]] double background_share() const;

private:
    NetworkMasks masks_;
    std::shared_ptr<const BackgroundModelSegmenter> background_;
    Image<std::uint8_t> region_;
};

}  // namespace rs::capture
