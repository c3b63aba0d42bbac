#include "capture/photos/segmentation/chroma_key_segmenter.hpp"

#include "rayspace/api/types/check.hpp"

#include <utility>

namespace rs::capture {

ChromaKeySegmenter::ChromaKeySegmenter(std::vector<Rgba8> keys, const ForegroundParameters& parameters)
    : keys_(std::move(keys)), parameters_(parameters) {
    RS_CHECK(!keys_.empty());
}

Result<Segmentation> ChromaKeySegmenter::segment(const TurnPhoto& photo) const {
    CleanPlateView screen;
    screen.background =
        LinearLabImage(Image<LinearRgb>(photo.image.width(), photo.image.height(), linear_rgb(keys_.front())));
    for (const Rgba8& key : keys_) screen.screen_colours.push_back(linear_rgb(key));
    return Segmentation{segment_foreground(LabPhoto(photo.image), screen, parameters_), false};
}

}  // namespace rs::capture
