#pragma once
// What stands behind the object: known to be transparent, one colour, or found in the pictures.
//
// The camera of a turntable stands still, so whatever is behind the object and does not turn with it (the wall, an even
// turntable disc, the black frame of a frame grabber) is the same in every picture. The *clean plate*, plate for short,
// is that still picture: per pixel the value that most pictures agree on, where it is of the colours seen along the
// border; filled in smoothly from around where the object always hides it. In a studio it is an even course instead.

#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

enum class BackdropKind { kAlpha, kWhite, kBlack, kColour };
std::string to_string(BackdropKind kind);  // "alpha", "white", "black", "colour"

// What the user requested. No kind: automatic. `colour` (sRGB) only with kColour.
struct BackdropRequest {
    std::optional<BackdropKind> kind;
    std::optional<Rgba8> colour;
};

// "auto", "white", "black", "alpha" or "R,G,B" (0..255 each).
Result<BackdropRequest> parse_backdrop(const std::string& text);

// Before a black that is even, black parts of an object stand out a little; before one that is black to the code, as in
// renderings and retouched pictures, even parts that fade to black do. Unknown: another kind, or too few pictures.
enum class BlackGround { kUnknownOrNoisy, kEven, kExact };

struct Backdrop {
    BackdropKind kind = BackdropKind::kAlpha;
    BlackGround black = BlackGround::kUnknownOrNoisy;
    // The colour of a grey or a white without noise, as of retouched and overexposed pictures, before which grey parts
    // of an object differ by a few codes. Nothing before black and strong colours, on a turntable's disc, and where
    // `untouched` is empty. Single pictures may be exposed otherwise, and show their own.
    std::optional<Rgba8> flat_grey{};
    Rgba8 colour;                 // the commonest colour along the border (kAlpha: transparent black)
    std::vector<Rgba8> screen{};  // strong colours of the border, as of a chroma key: backdrop wherever they are seen
    Image<Rgba8> plate;           // sRGB, opaque, in the samples' size; empty for kAlpha
    Image<std::uint8_t> known{};  // 255 where the pictures show it; empty for kAlpha
    // 255 where nothing ever covers it; and where the object always does although it stands still there, as the white
    // ground of a painted vase. Empty where there are too few pictures to tell.
    Image<std::uint8_t> untouched{};
    Image<std::uint8_t> hidden{};
    Image<std::uint8_t> still{};  // 255 where nothing ever changes, backdrop or not; empty as `hidden` is
    // 255 on a turntable's disc and around it, where the object's shadow falls; empty where no disc was found.
    Image<std::uint8_t> ground{};
    // The plate's light in a grey or white studio, where it is an even course (even_plate.hpp): right behind the
    // object, too, with none of its shadow, and finer than codes are. Empty for another backdrop.
    Image<LinearRgb> even{};
    Image<std::uint8_t> above_shadows{};  // of a studio: 255 where the object throws none; empty: nobody can tell
    // Mean difference near by between the samples that show the plate and the plate, before an even one everywhere the
    // same; empty where `untouched` is.
    Image<float> noise_delta_e{};
};

// Automatic: the pictures' own alpha where at least 1 % of the pixels are transparent in most of the samples; otherwise
// white or black where most of the border is, and black only where nothing bright stands there; otherwise colour. Fails
// where the border is neither of few colours nor still, where alpha is requested and there is none, and where there are
// no samples. `where` names the folder in errors.
Result<Backdrop> find_backdrop(const Survey& survey, const BackdropRequest& request, const std::string& where);

}  // namespace rs::capture
