#pragma once
// Foreground image of one photo by a segmenter, for tests.

#include "capture/photos/segmentation/cutout.hpp"
#include "capture/photos/segmentation/segmenter.hpp"

namespace rs::test {

inline Image<Rgba8> cut_out(const capture::Segmenter& segmenter, const Image<Rgba8>& photo) {
    return capture::make_cutout(photo, *segmenter.segment({0, photo.view()}));
}

}  // namespace rs::test
