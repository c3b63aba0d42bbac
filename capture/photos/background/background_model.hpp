#pragma once
/// \file
/// Background model of a turn: what is behind the object, estimated from the survey's frames.
///
/// The camera is fixed, so everything behind the object that does not turn with it (a wall, a uniform turntable disc,
/// the black frame of a frame grabber) is the same in all photos. This static image is the *clean plate*, short plate.
/// Stages of estimate_background(): exposure correction (exposure_normalized_frames.hpp), temporal consensus
/// (background_estimate.hpp), kind by the border's colours (border_statistics.hpp), clean plate (clean_plate.hpp),
/// inpainting (disc_inpainting.hpp), background gradient in a studio (background_gradient.hpp), noise. The model is the
/// input of BackgroundModelSegmenter.

#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

/// kAlpha: the photos have an alpha channel of their own. kColour: any other background, textured or not.
enum class BackgroundKind { kAlpha, kWhite, kBlack, kColour };
std::string to_string(BackgroundKind kind);  ///< "alpha", "white", "black", "colour"

/// Request of the user. No kind: automatic choice. `colour` (sRGB) only with kColour.
struct BackgroundRequest {
    std::optional<BackgroundKind> kind;
    std::optional<Rgba8> colour;
};

/// Parses "auto", "white", "black", "alpha" or "R,G,B" (0..255 each).
Result<BackgroundRequest> parse_background(const std::string& text);

/// Uniformity of a black background. Before a uniform one, black parts of the object differ slightly. Before an exact
/// one, all pixels are code 0, as in renderings and retouched photos, and even parts that fade to black differ.
/// kUnknownOrNoisy: also for other kinds, and with too few frames.
enum class BlackBackground { kUnknownOrNoisy, kUniform, kExact };

/// Images have the size of the frames (Survey::samples) or are empty; masks hold 255 or 0. Colours are sRGB.
struct BackgroundModel {
    BackgroundKind kind = BackgroundKind::kAlpha;
    BlackBackground black = BlackBackground::kUnknownOrNoisy;
    /// Colour of a grey or white background without noise, as in retouched and overexposed photos, before which grey
    /// parts of the object differ by a few codes. Nullopt before black and colourful backgrounds, on a turntable disc,
    /// and where `always_visible` is empty. Single photos may be exposed differently and have their own.
    std::optional<Rgba8> flat_grey{};
    Rgba8 colour;                          ///< most frequent colour of the border; kAlpha: transparent black
    std::vector<Rgba8> key_colours{};      ///< strong colours of the border, for a chroma key
    Image<Rgba8> plate;                    ///< clean plate, opaque; empty for kAlpha
    Image<std::uint8_t> known{};           ///< some frames show the plate, it is not inpainted; empty for kAlpha
    Image<std::uint8_t> always_visible{};  ///< the object never covers the background; empty with too few frames
    /// A static part of the object covers the background in all frames, such as the white ground of a painted vase.
    /// Empty where unknown.
    Image<std::uint8_t> always_covered{};
    Image<std::uint8_t> ground{};  ///< a turntable disc and its surroundings, where shadows fall; empty without a disc
    /// Linear light of the plate by the background gradient model, free of shadows and finer than codes. Empty where
    /// the model does not apply.
    Image<LinearRgb> gradient{};
    Image<std::uint8_t> shadow_free{};  ///< rows without a shadow, before a gradient; empty: unknown
    /// Mean difference between the frames that show the plate and the plate, over a neighbourhood; before a gradient
    /// one value everywhere. Empty where `always_visible` is.
    Image<float> noise_delta_e{};
};

/// Handling of an alpha channel of the photos.
enum class AlphaUse { kPrefer, kIgnore };

/// Estimates the background of a turn. Automatic choice of its kind: alpha where at least 1 % of the pixels are
/// transparent in most of the frames (unless ignored); else white or black where most of the border is, black only if
/// nothing bright is static there; else colour. Errors, `where` names the folder in them: a border that is neither of
/// few colours nor static, alpha requested where there is none, no frames.
Result<BackgroundModel> estimate_background(const Survey& survey, const BackgroundRequest& request,
                                            const std::string& where, AlphaUse alpha = AlphaUse::kPrefer,
                                            const BackgroundParameters& parameters = {});

}  // namespace rs::capture
