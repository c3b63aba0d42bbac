#pragma once
/// \file
/// Interface of the segmenters: which pixels of a photo show the object.
///
/// One segmenter is chosen per turn (segmenter_choice.hpp), segment_turn() runs it over all photos, and the edge of a
/// binary mask is refined by estimate_alpha() and unmix(). A new segmenter is a class here and a branch of
/// choose_segmenter().

#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace rs::capture {

/// One photo of the turn.
struct TurnPhoto {
    std::size_t index = 0;        ///< in PhotoFolder::photos
    ConstImageView<Rgba8> image;  ///< sRGB, straight alpha, in the working size of the folder
};

/// Result for one photo, in its size.
struct Segmentation {
    Image<std::uint8_t> mask;  ///< 255 = object
    /// True: `mask` is the final opacity, 0..255. False: it is binary, 0 or 255, and the soft edge is still to be
    /// estimated.
    bool is_alpha = false;
    /// Opacity 0..255 of a black layer below the object: its shadow on the floor. Empty: none.
    Image<std::uint8_t> shadow{};
};

class Segmenter {
public:
    Segmenter() = default;
    Segmenter(const Segmenter&) = delete;
    Segmenter& operator=(const Segmenter&) = delete;
    virtual ~Segmenter() = default;

    /// For messages and reports: "background model", "mask folder".
    [[nodiscard]] virtual std::string name() const = 0;

    /// Segments one photo. Thread-safe. Errors: what the segmenter reads from outside (mask files, the network).
    [[nodiscard]] virtual Result<Segmentation> segment(const TurnPhoto& photo) const = 0;
};

}  // namespace rs::capture
