#pragma once
/// \file
/// Masks of posed photos without alpha, made consistent across the views. Each round:
///
///   1. The visual hull of all masks is carved, and projected into each photo.
///   2. Colours: the object's, a histogram over all photos; the background's, one of each photo, beyond the hull.
///   3. Graph cut of each photo by both colours, the distance from the hull's contour, and the given mask.
///
/// The first round tolerates many masks without a part of the object (white before white); the following ones
/// remove what few photos show (background). Source: Campbell, Vogiatzis, Hernandez and Cipolla, "Automatic 3D object
/// segmentation in multiple views using volumetric graph-cuts" (IVC 28, 2010), with cuts in the photos.

#include "capture/posed/visual_hull.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace rs::capture {

/// Reduced photo of a pinhole camera.
struct SilhouetteView {
    HullView hull;       ///< with the mask to start from; an empty one: none
    Image<Rgba8> photo;  ///< as large as hull.camera states; alpha 0: not in the photo
};

/// Density of sRGB colours: 2^bits levels per channel, smoothed.
class ColourHistogram {
public:
    explicit ColourHistogram(int bits = 5);
    void add(const Rgba8& colour) { density_[index_of(colour)] += 1; }
    /// Adds the counts of another one of as many levels; before smooth() and normalize().
    void add(const ColourHistogram& other, float weight = 1);
    /// Spreads each count over the neighbouring levels.
    void smooth();
    /// Smooths and scales to a sum of 1.
    void normalize();
    [[nodiscard]] float operator()(const Rgba8& colour) const { return density_[index_of(colour)]; }

private:
    [[nodiscard]] std::size_t index_of(const Rgba8& colour) const {
        const auto level = [&](std::uint8_t code) { return static_cast<std::size_t>(code >> (8 - bits_)); };
        return (((level(colour.r) << bits_) + level(colour.g)) << bits_) + level(colour.b);
    }
    int bits_;
    std::vector<float> density_;
};

struct ConsistentSilhouettes {
    std::vector<cv::Mat1b> masks;  ///< [view], 255 = object
    ColourHistogram object;        ///< of all photos
    /// Mean over the views of the overlap (intersection over union) of mask and projected hull.
    double overlap = 0;
};

/// Photos with given masks and photos without may mix. Where no mask is given, it starts from the colours that are
/// frequent in the volume that nine of ten photos have in their frame, and rare beyond it. `target`: common_target().
/// Errors: the masks have no common volume.
Result<ConsistentSilhouettes> make_consistent(std::vector<SilhouetteView> views, const glm::dvec3& target,
                                              Progress* progress);

/// Mask of the photo in full size: `mask`, of the photo's size, cut again within `band_px` of its contour.
Image<std::uint8_t> refine_silhouette(ConstImageView<Rgba8> photo, const cv::Mat1b& mask, const ColourHistogram& object,
                                      int band_px);

}  // namespace rs::capture
