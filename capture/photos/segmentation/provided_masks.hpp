#pragma once
/// \file
/// Segmenters for photos whose object is already segmented: by their own alpha, or by a folder of masks.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/masks/mask_folder.hpp"
#include "capture/photos/segmentation/segmenter.hpp"

#include <utility>

namespace rs::capture {

/// The photos' own alpha, unchanged.
class AlphaSegmenter : public Segmenter {
public:
    [[nodiscard]] std::string name() const override { return "alpha"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override;
};

/// One mask file per photo (mask_folder.hpp), reduced to the working size of the photos.
class MaskFolderSegmenter : public Segmenter {
public:
    MaskFolderSegmenter(MaskFolder masks, PhotoFolder photos) : masks_(std::move(masks)), photos_(std::move(photos)) {}
    [[nodiscard]] std::string name() const override { return "masks"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override;

private:
    MaskFolder masks_;
    PhotoFolder photos_;
};

}  // namespace rs::capture
