#include "capture/photos/background/backdrop.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/clean_plate.hpp"
#include "capture/photos/background/disc_bridging.hpp"
#include "capture/photos/background/even_plate.hpp"
#include "capture/photos/background/shadow_ground.hpp"
#include "capture/photos/background/still_border.hpp"
#include "capture/photos/background/still_picture.hpp"
#include "capture/photos/intake/colour_difference.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace rs::capture {
namespace {

constexpr int kTransparent = 128;              // alpha below this is a hole ...
constexpr double kMinTransparentShare = 0.01;  // ... and so many of them are a matte
constexpr double kStillBorder = 0.5;
constexpr float kNeverHidden = 0.95F;
constexpr float kSeenShare = 0.3F;     // of the samples agree: the backdrop, if its colour is right
constexpr double kShadowReach = 0.25;  // of the disc's radius
constexpr float kSameColour_delta_e = 16;
constexpr std::size_t kMinSamplesForStillness = 6;

bool brings_alpha(const Survey& survey) {
    std::size_t matted = 0;
    for (const Image<Rgba8>& sample : survey.samples) {
        const auto holes = std::count_if(sample.pixels().begin(), sample.pixels().end(),
                                         [](const Rgba8& p) { return p.a < kTransparent; });
        matted +=
            static_cast<double>(holes) >= kMinTransparentShare * static_cast<double>(sample.pixels().size()) ? 1 : 0;
    }
    return 2 * matted > survey.samples.size();
}

bool looks_like(const LinearRgb& pixel, const LinearRgb& colour) {
    return explain_by_backdrop(pixel, colour, 0.5F, 1.5F).shaded < kSameColour_delta_e;
}

bool resembles(const Rgba8& pixel, const std::vector<Rgba8>& colours) {
    return std::any_of(colours.begin(), colours.end(),
                       [&](const Rgba8& colour) { return looks_like(linear_rgb(pixel), linear_rgb(colour)); });
}

// Where the exposure changes much from picture to picture, nothing agrees over time: what the border shows at the
// median shows by how much.
void even_out_border(EvenedSamples& samples) {
    constexpr float kMuch = 1.15F;
    Image<Rgba8> median(samples.width(), samples.height());
    Image<std::uint8_t> border(samples.width(), samples.height());
    std::vector<Rgba8> seen(samples.count());
    for_border(samples.width(), samples.height(), [&](int x, int y) {
        for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = samples(i, x, y);
        border(x, y) = 255;
        median(x, y) = median_colour(seen);
    });
    samples.even_out(median, border, kMuch);
}

constexpr const char* kNoColour =
    ": the pictures' borders are neither even nor still; give --backdrop R,G,B, or cut the object out beforehand and "
    "give pictures with alpha";

// The colour that a backdrop of this kind has by its name.
std::optional<Rgba8> own_colour(BackdropKind kind) {
    if (kind == BackdropKind::kWhite) return Rgba8{255, 255, 255, 255};
    if (kind == BackdropKind::kBlack) return Rgba8{0, 0, 0, 255};
    return std::nullopt;
}

template <class Condition>
Image<std::uint8_t> mask_of(const StillPicture& still, Condition condition) {
    Image<std::uint8_t> mask(still.agreement.width(), still.agreement.height());
    std::transform(still.agreement.pixels().begin(), still.agreement.pixels().end(), mask.pixels().begin(),
                   [&](float agreement) { return condition(agreement) ? std::uint8_t{255} : std::uint8_t{0}; });
    return mask;
}

// Where the plate is known because it is of the border's colours and seen often enough.
Image<std::uint8_t> alike(const StillPicture& still, const std::vector<Rgba8>& colours, bool turn) {
    Image<std::uint8_t> known(still.colour.width(), still.colour.height());
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x) {
            const bool seen = !turn || still.agreement(x, y) >= kSeenShare;
            known(x, y) = seen && resembles(still.colour(x, y), colours) ? 255 : 0;
        }
    }
    return known;
}

bool looks_even(const Rgba8& pixel, const Lab& look) {
    constexpr float kEven_delta_e = 1;
    return delta_e(lab_from_linear(linear_rgb(pixel)), look) <= kEven_delta_e;
}

// The one colour of a grey or white backdrop; none where it has noise or a course, or seldom the same exposure.
std::optional<Rgba8> flat_grey_of(const Survey& survey) {
    if (survey.borders.empty()) return std::nullopt;
    std::vector<Rgba8> medians;
    for (const Border& border : survey.borders) medians.push_back(border.median);
    const Rgba8 grey = median_colour(medians);
    const auto flat = std::ranges::count_if(
        survey.borders, [&](const Border& each) { return each.flat && within_codes(each.median, grey, kFlat_codes); });
    if (2 * flat < std::ssize(survey.borders) || is_colourful(linear_rgb(grey))) return std::nullopt;
    return grey;
}

// Where the plate shows other things, too, than `even(x, y)` in some light: a room.
template <class Even>
bool shows_a_room(const Image<Rgba8>& plate, const Image<std::uint8_t>& known, Even even) {
    constexpr double kShare = 0.02;
    std::int64_t seen = 0, other = 0;
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            if (known(x, y) == 0) continue;
            ++seen;
            other += looks_like(linear_rgb(plate(x, y)), even(x, y)) ? 0 : 1;
        }
    }
    return static_cast<double>(other) > kShare * static_cast<double>(seen);
}

// How even the black is that the pictures' borders show.
BlackGround black_ground_of(const Survey& survey, const Lab& look) {
    constexpr double kEvenShare = 0.95;
    constexpr std::ptrdiff_t kFlatOneIn = 4;  // pictures; parts of the object fade to black at the border of others
    std::int64_t border = 0;
    std::int64_t even = 0;
    for (const Image<Rgba8>& picture : survey.samples) {
        for_border(picture.width(), picture.height(), [&](int x, int y) {
            ++border;
            even += looks_even(picture(x, y), look) ? 1 : 0;
        });
    }
    if (static_cast<double>(even) < kEvenShare * static_cast<double>(border)) return BlackGround::kUnknownOrNoisy;
    const auto flat =
        std::ranges::count_if(survey.borders, [](const Border& each) { return each.flat && is_black(each.median); });
    return kFlatOneIn * flat >= std::ssize(survey.samples) ? BlackGround::kExact : BlackGround::kEven;
}

// Nowhere more than along the border, by its mean.
void cap_noise(Image<float>& noise_delta_e) {
    double sum = 0;
    std::int64_t count = 0;
    for_border(noise_delta_e.width(), noise_delta_e.height(), [&](int x, int y) {
        sum += static_cast<double>(noise_delta_e(x, y));
        ++count;
    });
    const auto most = static_cast<float>(sum / static_cast<double>(std::max<std::int64_t>(count, 1)));
    for (float& noise : noise_delta_e.pixels()) noise = std::min(noise, most);
}

// A plate that goes on evenly behind the object.
void take_even_plate(Backdrop& backdrop, const EvenedSamples& samples) {
    Image<LinearRgb> even = even_plate(backdrop.plate, backdrop.untouched);
    if (even.empty() || shows_a_room(backdrop.plate, backdrop.known, [&](int x, int y) { return even(x, y); })) return;
    backdrop.even = std::move(even);
    std::ranges::transform(backdrop.even.pixels(), backdrop.plate.pixels().begin(), [](const LinearRgb& light) {
        return rgba8_from_linear({light.r, light.g, light.b}, 255);
    });
    backdrop.above_shadows = above_shadows(samples, backdrop.plate);
}

// Before an even plate as much everywhere as where the pictures always show it: where a shadow comes and goes it would
// look noisy.
Image<float> noise_of(const EvenedSamples& samples, const Backdrop& backdrop) {
    if (backdrop.even.empty()) return plate_noise(samples, backdrop.plate, backdrop.known);
    Image<float> noise_delta_e = plate_noise(samples, backdrop.plate, backdrop.untouched);
    const cv::Mat1f noise(noise_delta_e.height(), noise_delta_e.width(), noise_delta_e.data());
    return Image<float>(noise.cols, noise.rows, static_cast<float>(cv::mean(noise, mat_over(backdrop.untouched))[0]));
}

// Those of the border's colours that are strong, as objects hardly have them.
std::vector<Rgba8> screen_colours(std::vector<Rgba8> colours) {
    constexpr float kScreenChroma = 30;
    std::erase_if(colours, [](const Rgba8& colour) {
        const Lab lab = lab_from_linear(linear_rgb(colour));
        return std::hypot(lab.a, lab.b) < kScreenChroma;
    });
    return colours;
}

}  // namespace

std::string to_string(BackdropKind kind) {
    switch (kind) {
        case BackdropKind::kAlpha:
            return "alpha";
        case BackdropKind::kWhite:
            return "white";
        case BackdropKind::kBlack:
            return "black";
        case BackdropKind::kColour:
            return "colour";
    }
    RS_CHECK(false);
}

Result<BackdropRequest> parse_backdrop(const std::string& text) {
    if (text == "auto") return BackdropRequest{};
    for (const BackdropKind kind : {BackdropKind::kAlpha, BackdropKind::kWhite, BackdropKind::kBlack}) {
        if (text == to_string(kind)) return BackdropRequest{kind, std::nullopt};
    }
    std::array<int, 3> codes{};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const auto [behind, failure] = std::from_chars(at, end, codes[i]);
        const bool separated = i == 2 ? behind == end : behind != end && *behind == ',';
        if (failure != std::errc{} || codes[i] < 0 || codes[i] > 255 || !separated) {
            return Error{"\"" + text +
                         "\" is no backdrop; give auto, white, black, alpha or R,G,B with numbers 0..255"};
        }
        at = behind + 1;
    }
    const auto code = [&](std::size_t i) { return static_cast<std::uint8_t>(codes[i]); };
    return BackdropRequest{BackdropKind::kColour, Rgba8{code(0), code(1), code(2), 255}};
}

Result<Backdrop> find_backdrop(const Survey& survey, const BackdropRequest& request, const std::string& where) {
    if (survey.samples.empty())
        return Error{where + ": no pictures to find the backdrop in; give a folder of pictures"};
    const bool alpha = brings_alpha(survey);
    if (request.kind == BackdropKind::kAlpha && !alpha) {
        return Error{where + ": the pictures have no transparent pixels; leave --backdrop alpha away"};
    }
    if (request.kind == BackdropKind::kAlpha || (!request.kind && alpha)) {
        return Backdrop{};
    }

    EvenedSamples samples(survey.samples);
    const bool turn = survey.samples.size() >= kMinSamplesForStillness;
    if (turn) even_out_border(samples);
    StillPicture still = agree_over_time(samples);
    const BorderShares shares = border_shares(still);
    Backdrop found;
    std::vector<Rgba8> colours = border_colours(still, turn);
    if (request.kind) {
        found.kind = *request.kind;
    } else if (shares.is_white()) {
        found.kind = BackdropKind::kWhite;
    } else if (shares.is_black(turn)) {
        found.kind = BackdropKind::kBlack;
    } else if (colours.empty() || (turn && shares.still < kStillBorder)) {
        return Error{where + kNoColour};
    } else {
        found.kind = BackdropKind::kColour;
    }
    // A colour that the user names rules out the border's other colours only where the border does not show it at all.
    // White and black are known even where nothing along the border is still, as under a flickering exposure.
    const std::optional<Rgba8> named = request.colour ? request.colour : own_colour(found.kind);
    if (named && (request.kind || colours.empty())) colours.insert(colours.begin(), *named);
    if (colours.empty()) return Error{where + kNoColour};
    found.colour = colours.front();
    if (found.kind == BackdropKind::kColour) found.screen = screen_colours(colours);

    const Lab look = lab_from_linear(linear_rgb(found.colour));
    if (turn && found.kind == BackdropKind::kBlack) found.black = black_ground_of(survey, look);
    if (found.black == BlackGround::kExact) {  // nor does its exposure change: no plate is looked for
        const int width = still.colour.width(), height = still.colour.height();
        found.colour = {0, 0, 0, 255};
        found.plate = Image<Rgba8>(width, height, found.colour);
        found.known = Image<std::uint8_t>(width, height, std::uint8_t{255});
        found.noise_delta_e = Image<float>(width, height);
        return found;
    }

    if (turn) {
        const auto is_untouched = [](float agreement) { return agreement >= kNeverHidden; };
        found.untouched = mask_of(still, is_untouched);
        if (samples.even_out(still.colour, found.untouched)) {
            still = agree_over_time(samples);
            found.untouched = mask_of(still, is_untouched);
        }
    }
    Image<std::uint8_t> known;
    std::optional<TurntableDisc> disc;
    if (turn && shares.still >= kStillBorder) {
        const Behind behind = found.kind == BackdropKind::kColour ? Behind::kAnything : Behind::kStudio;
        CleanPlate plate = clean_plate_of_turn(samples, still, found.untouched, behind);
        still.colour = std::move(plate.colour);
        known = std::move(plate.known);
        disc = plate.disc;
        std::swap(found.untouched, plate.untouched);
        // Through the loops of an object a white or black backdrop looks the same all the time, too.
        if (found.kind == BackdropKind::kColour) {
            found.hidden = std::move(plate.hidden);
            found.still = std::move(plate.untouched);
        }
        if (found.kind != BackdropKind::kBlack && !disc) found.flat_grey = flat_grey_of(survey);
        const auto grey = [&](int, int) { return linear_rgb(*found.flat_grey); };
        if (found.flat_grey && shows_a_room(still.colour, known, grey)) found.flat_grey.reset();
    } else {
        known = alike(still, colours, turn);
    }
    // Before an even black whatever is a little lighter is the object's: a black strap that turns about its own place
    // looks still, too, and where it is seen the backdrop would look noisy.
    if (found.black == BlackGround::kEven) {
        std::transform(known.pixels().begin(), known.pixels().end(), still.colour.pixels().begin(),
                       known.pixels().begin(), [&](std::uint8_t is_known, const Rgba8& pixel) {
                           return looks_even(pixel, look) ? is_known : std::uint8_t{0};
                       });
    }
    if (std::count(known.pixels().begin(), known.pixels().end(), 0) == std::ssize(known.pixels())) {
        still.colour = Image<Rgba8>(known.width(), known.height(), found.colour);
    }
    found.known = known;
    // A shadow on black cannot be seen.
    if (disc && found.black == BlackGround::kUnknownOrNoisy)
        found.ground = disc_mask(*disc, known.width(), known.height(), kShadowReach);
    if (turn) bridge_gaps(disc, still.colour, known);
    fill_unknown(still.colour, known);
    found.plate = std::move(still.colour);
    if (turn && !disc && found.kind != BackdropKind::kBlack && !is_colourful(linear_rgb(found.colour))) {
        take_even_plate(found, samples);
    }
    if (turn) found.noise_delta_e = noise_of(samples, found);
    if (found.black == BlackGround::kEven) cap_noise(found.noise_delta_e);
    return found;
}

}  // namespace rs::capture
