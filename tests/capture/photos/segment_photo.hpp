#pragma once
// Foreground image of one photo by a segmenter, for tests.

#include "capture/photos/segmentation/foreground_image.hpp"
#include "capture/photos/segmentation/segmenter.hpp"

namespace rs::test {

inline Image<Rgba8> segment_photo(const capture::Segmenter& segmenter, const Image<Rgba8>& photo) {
    return capture::make_foreground_image(photo, *segmenter.segment({0, photo.view()}));
}

}  // namespace rs::test
