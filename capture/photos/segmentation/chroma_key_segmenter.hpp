#pragma once
/// \file
/// Segmenter for a background of one known colour, as a green screen: every photo by itself.
///
/// Unlike the background model it needs neither a static camera nor several photos. Shadows on the screen are part of
/// it: the same colour with less light.

#include "capture/photos/foreground/foreground_mask.hpp"
#include "capture/photos/segmentation/segmenter.hpp"

#include <vector>

namespace rs::capture {

class ChromaKeySegmenter : public Segmenter {
public:
    /// `keys`: the screen's colours, sRGB, the commonest first; at least one.
    explicit ChromaKeySegmenter(std::vector<Rgba8> keys, const ForegroundParameters& parameters = {});

    [[nodiscard]] std::string name() const override { return "chroma key"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override;

private:
    std::vector<Rgba8> keys_;
    ForegroundParameters parameters_;
};

}  // namespace rs::capture
