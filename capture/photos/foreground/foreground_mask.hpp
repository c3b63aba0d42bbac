#pragma once
/// \file
/// Binary foreground mask of one photo by background subtraction, segment_foreground(). The soft edge follows in
/// alpha_estimation.hpp.
///
/// 1. foreground_score(): pixels that equal the clean plate are certain background, pixels that no shadow on the plate
///    explains are certain foreground. Shadows, and grey or glossy parts of the object, remain undecided.
/// 2. Where the plate's noise is known from a turn, thin structures are favoured: shadows are broad.
/// 3. Small isolated background components become undecided.
/// 4. Graph cut (graph_cut.hpp): a soft shadow fades into the background without an edge, the object has one all
/// around.
/// 5. Clean-up: removes components without certain foreground and specks, fills holes that do not show the background.
///
/// segment_by_edges() is the variant for white and grey objects in a studio (enclosed_regions.cpp).
///
/// All functions are pure and thread-safe.

#include "capture/photos/foreground/foreground_parameters.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

#include <vector>

namespace rs::capture {

/// A photo with its CIELAB image, which is computed once. Does not own the photo. Converts implicitly from an image.
struct LabPhoto {
    ConstImageView<Rgba8> image;
    Image<Lab> lab;
    LabPhoto(ConstImageView<Rgba8> photo) : image(photo), lab(lab_image(photo)) {}
    LabPhoto(const Image<Rgba8>& photo) : LabPhoto(ConstImageView<Rgba8>(photo)) {}
    LabPhoto(Image<Rgba8>&&) = delete;
    [[nodiscard]] int width() const { return image.width(); }
    [[nodiscard]] int height() const { return image.height(); }
};

/// An image of linear light, clipped to 1, with its CIELAB image.
struct LinearLabImage {
    Image<LinearRgb> light;
    Image<Lab> lab;
    LinearLabImage() = default;
    explicit LinearLabImage(Image<LinearRgb> unclipped);
    [[nodiscard]] int width() const { return light.width(); }
    [[nodiscard]] int height() const { return light.height(); }
};

/// The background behind the object in one photo, in its size.
struct CleanPlateView {
    LinearLabImage background;     ///< exposed like the photo
    Image<std::uint8_t> occluded;  ///< 255 where the object always occludes the background; empty: unknown
    Image<std::uint8_t> visible;   ///< 255 where the background is visible, lit or in shadow; empty: unknown
    Image<std::uint8_t> disc;      ///< 255 on the turntable's disc and around it; empty: no disc
    /// 255 where no shadow falls; empty: unknown. Ignored if there is a disc: shadows fall on it alone.
    Image<std::uint8_t> above_shadows;
    std::vector<LinearRgb> screen_colours;  ///< colours that are background everywhere, lit or in shadow
    Image<float> noise_delta_e;             ///< mean difference of the photo from `background` where visible; empty: 0
};

/// Foreground score of every pixel, -kCertainScore..kCertainScore; positive: rather foreground.
Image<float> foreground_score(const LabPhoto& photo, const CleanPlateView& plate,
                              const ForegroundParameters::Score& parameters);

/// All five steps.
/// \return 255 = object, 0 = background
Image<std::uint8_t> segment_foreground(const LabPhoto& photo, const CleanPlateView& plate,
                                       const ForegroundParameters& parameters);

/// Foreground mask by enclosing edges, for white and grey objects before the light gradient of a studio.
///
/// The sides of such objects have the colour of a shadow on the background, and the contrast at their contour vanishes
/// in places, so that neither colour nor graph cut separate them. But a soft shadow fades into the background, while an
/// object has an edge all around: a flood fill from the image border that stops at edges reaches the shadow and no part
/// of the object. What it reaches becomes certain background, what edges enclose certain foreground, and
/// segment_foreground() labels the rest.
///
/// \param plate of the photo's size; must be right behind the object, too, as a fitted gradient is
///   (background_gradient.hpp). Its `visible` and `occluded` are ignored.
/// \return 255 = object. Empty where the enclosed area is small relative to the object, because a shadow within a loop
///   is enclosed, too, and where noise causes edges everywhere. Thread-safe.
Image<std::uint8_t> segment_by_edges(const LabPhoto& photo, const CleanPlateView& plate,
                                     const ForegroundParameters& parameters);

}  // namespace rs::capture
