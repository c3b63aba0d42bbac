#include "capture/photos/background/background_model.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/background_estimate.hpp"
#include "capture/photos/background/background_gradient.hpp"
#include "capture/photos/background/border_statistics.hpp"
#include "capture/photos/background/clean_plate.hpp"
#include "capture/photos/background/disc_inpainting.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/api/types/check.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rs::capture {
namespace {

constexpr const char* kNoBackground =
    ": the photos' borders have neither few colours nor static pixels; give --backdrop R,G,B or --masks, or photos "
    "with "
    "alpha";

bool has_alpha(const Survey& survey, const BackgroundParameters::Alpha& parameters) {
    std::size_t with_alpha = 0;
    for (const Image<Rgba8>& frame : survey.samples) {
        const auto transparent = std::count_if(frame.pixels().begin(), frame.pixels().end(),
                                               [&](const Rgba8& p) { return p.a < parameters.transparent_below; });
        const double min_transparent = parameters.min_transparent_share * static_cast<double>(frame.pixels().size());
        with_alpha += static_cast<double>(transparent) >= min_transparent ? 1 : 0;
    }
    return 2 * with_alpha > survey.samples.size();
}

bool has_same_colour(const LinearRgb& pixel, const LinearRgb& colour, const BackgroundParameters::Border& parameters) {
    const ShadowFit e = fit_shadow(pixel, colour, parameters.same_colour_min_shade, parameters.same_colour_max_shade);
    return e.shaded < parameters.same_colour_delta_e;
}

// Corrects large changes of exposure, after which no frames would agree, by the border's temporal median.
void normalize_by_border(ExposureNormalizedFrames& frames, float min_change) {
    Image<Rgba8> median(frames.width(), frames.height());
    Image<std::uint8_t> border(frames.width(), frames.height());
    std::vector<Rgba8> values(frames.count());
    for_border(frames.width(), frames.height(), [&](int x, int y) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = frames(i, x, y);
        border(x, y) = 255;
        median(x, y) = median_colour(values);
    });
    frames.normalize(median, border, min_change);
}

// Nominal colour of a kind.
std::optional<Rgba8> nominal_colour(BackgroundKind kind) {
    if (kind == BackgroundKind::kWhite) return Rgba8{255, 255, 255, 255};
    if (kind == BackgroundKind::kBlack) return Rgba8{0, 0, 0, 255};
    return std::nullopt;
}

bool is_uniform_black(const Rgba8& pixel, const Lab& black, const BackgroundParameters::Black& parameters) {
    return delta_e(lab_from_linear(linear_rgb(pixel)), black) <= parameters.uniform_delta_e;
}

// Colour of a grey or white background that most frames show without noise, gradient or change of exposure.
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

// True if more than a small share of the known plate is not `light_at(x, y)` under some illumination.
template <class LightAt>
bool deviates_from(const Image<Rgba8>& plate, const Image<std::uint8_t>& known, const BackgroundParameters& parameters,
                   LightAt light_at) {
    std::int64_t count = 0, deviating = 0;
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            if (known(x, y) == 0) continue;
            ++count;
            deviating += has_same_colour(linear_rgb(plate(x, y)), light_at(x, y), parameters.border) ? 0 : 1;
        }
    }
    return static_cast<double>(deviating) > parameters.shadow.max_deviating_share * static_cast<double>(count);
}

// Uniformity of a black background, from the borders of all frames.
BlackBackground classify_black(const Survey& survey, const Rgba8& colour, const BackgroundParameters& parameters) {
    const Lab black = lab_from_linear(linear_rgb(colour));
    std::int64_t count = 0, uniform = 0;
    for (const Image<Rgba8>& frame : survey.samples) {
        for_border(frame.width(), frame.height(), [&](int x, int y) {
            ++count;
            uniform += is_uniform_black(frame(x, y), black, parameters.black) ? 1 : 0;
        });
    }
    if (static_cast<double>(uniform) < parameters.black.min_uniform_share * static_cast<double>(count)) {
        return BlackBackground::kUnknownOrNoisy;
    }
    // A quarter of the frames suffices: in others, parts of the object fade to black at the border.
    const auto exact = std::ranges::count_if(
        survey.borders, [&](const Border& each) { return each.flat && is_black(each.median, parameters.border); });
    const double min_exact = parameters.black.min_exact_share * static_cast<double>(survey.samples.size());
    return static_cast<double>(exact) >= min_exact ? BlackBackground::kExact : BlackBackground::kUniform;
}

// Colours that the object hardly has.
std::vector<Rgba8> key_colours_of(std::vector<Rgba8> colours, float min_chroma) {
    std::erase_if(colours, [&](const Rgba8& colour) {
        const Lab lab = lab_from_linear(linear_rgb(colour));
        return std::hypot(lab.a, lab.b) < min_chroma;
    });
    return colours;
}

// Estimation of one model: its stages in the order in which they run.
class BackgroundEstimator {
public:
    BackgroundEstimator(const Survey& survey, const BackgroundParameters& parameters)
        : survey_(survey),
          parameters_(parameters),
          shows_motion_(survey.samples.size() >= parameters.estimate.min_frames),
          frames_(survey.samples) {}

    Result<BackgroundModel> estimate(const BackgroundRequest& request, const std::string& where) {
        if (shows_motion_) normalize_by_border(frames_, parameters_.estimate.min_exposure_change);
        estimate_ = temporal_consensus(frames_, parameters_.estimate);
        border_ = border_statistics(estimate_, parameters_.border);
        if (!choose_kind(request)) return Error{where + kNoBackground};
        if (model_.black == BlackBackground::kExact) return exact_black();
        if (shows_motion_) find_always_visible();
        if (shows_motion_ && has_static_border()) {
            find_clean_plate();
        } else {
            find_border_colours();
        }
        complete_plate();
        if (may_have_gradient()) replace_by_gradient();
        if (shows_motion_) measure_noise();
        return std::move(model_);
    }

private:
    [[nodiscard]] bool has_static_border() const {
        return border_.static_pixels >= parameters_.border.min_static_share;
    }

    // Sets the kind and the colours. False if no kind applies.
    bool choose_kind(const BackgroundRequest& request) {
        colours_ = border_colours(estimate_, shows_motion_, parameters_.border);
        const bool is_static = !shows_motion_ || has_static_border();
        if (request.kind) {
            model_.kind = *request.kind;
        } else if (border_.is_white(parameters_.border)) {
            model_.kind = BackgroundKind::kWhite;
        } else if (border_.is_black(shows_motion_, parameters_.border)) {
            model_.kind = BackgroundKind::kBlack;
        } else if (!colours_.empty() && is_static) {
            model_.kind = BackgroundKind::kColour;
        } else {
            return false;
        }
        // A requested colour precedes the border's. White and black have a nominal colour even where nothing along the
        // border is static, as under flickering exposure.
        const std::optional<Rgba8> named = request.colour ? request.colour : nominal_colour(model_.kind);
        if (named && (request.kind || colours_.empty())) colours_.insert(colours_.begin(), *named);
        if (colours_.empty()) return false;
        model_.colour = colours_.front();
        if (model_.kind == BackgroundKind::kColour) {
            model_.key_colours = key_colours_of(colours_, parameters_.border.min_key_chroma);
        }
        if (shows_motion_ && model_.kind == BackgroundKind::kBlack) {
            model_.black = classify_black(survey_, model_.colour, parameters_);
        }
        return true;
    }

    // Needs no plate: every pixel is 0 in every exposure.
    BackgroundModel exact_black() {
        const int width = frames_.width(), height = frames_.height();
        model_.colour = {0, 0, 0, 255};
        model_.plate = Image<Rgba8>(width, height, model_.colour);
        model_.known = Image<std::uint8_t>(width, height, std::uint8_t{255});
        model_.noise_delta_e = Image<float>(width, height);
        return std::move(model_);
    }

    [[nodiscard]] Image<std::uint8_t> agreeing_pixels() const {
        const Image<float>& agreement = estimate_.agreement;
        const float min_share = parameters_.estimate.always_visible_share;
        Image<std::uint8_t> mask(agreement.width(), agreement.height());
        std::transform(agreement.pixels().begin(), agreement.pixels().end(), mask.pixels().begin(),
                       [&](float share) { return share >= min_share ? std::uint8_t{255} : std::uint8_t{0}; });
        return mask;
    }

    // Static pixels, and the exposure correction by them. Those that the object covers are taken out later.
    void find_always_visible() {
        model_.always_visible = agreeing_pixels();
        if (!frames_.normalize(estimate_.colour, model_.always_visible)) return;
        estimate_ = temporal_consensus(frames_, parameters_.estimate);
        model_.always_visible = agreeing_pixels();
    }

    void find_clean_plate() {
        CleanPlate plate = clean_plate_of_turn(frames_, estimate_, model_.always_visible, parameters_);
        plate_ = std::move(plate.colour);
        known_ = std::move(plate.known);
        disc_ = plate.disc;
        model_.always_visible = std::move(plate.always_visible);
        // A white or black background is static through the holes of the object, too.
        if (model_.kind == BackgroundKind::kColour) model_.always_covered = std::move(plate.always_covered);
        if (model_.kind == BackgroundKind::kBlack || disc_) return;
        model_.flat_grey = flat_grey_of(survey_);
        if (!model_.flat_grey) return;
        const LinearRgb grey = linear_rgb(*model_.flat_grey);
        if (deviates_from(plate_, known_, parameters_, [&](int, int) { return grey; })) model_.flat_grey.reset();
    }

    // Without a static border: the plate is known where frequent values have one of the border's colours.
    void find_border_colours() {
        plate_ = std::move(estimate_.colour);
        known_ = Image<std::uint8_t>(plate_.width(), plate_.height());
        for (int y = 0; y < known_.height(); ++y) {
            for (int x = 0; x < known_.width(); ++x) {
                const bool is_frequent =
                    !shows_motion_ || estimate_.agreement(x, y) >= parameters_.estimate.visible_share;
                const bool is_known =
                    is_frequent && std::ranges::any_of(colours_, [&](const Rgba8& colour) {
                        return has_same_colour(linear_rgb(plate_(x, y)), linear_rgb(colour), parameters_.border);
                    });
                known_(x, y) = is_known ? 255 : 0;
            }
        }
    }

    // Fills all gaps.
    void complete_plate() {
        // Before a uniform black everything slightly lighter is the object's: a black strap that turns about its own
        // position is static, too, and would make the background there look noisy.
        if (model_.black == BlackBackground::kUniform) {
            const Lab black = lab_from_linear(linear_rgb(model_.colour));
            std::transform(known_.pixels().begin(), known_.pixels().end(), plate_.pixels().begin(),
                           known_.pixels().begin(), [&](std::uint8_t is_known, const Rgba8& pixel) {
                               const bool is_background = is_uniform_black(pixel, black, parameters_.black);
                               return is_background ? is_known : std::uint8_t{0};
                           });
        }
        if (std::count(known_.pixels().begin(), known_.pixels().end(), 0) == std::ssize(known_.pixels())) {
            plate_ = Image<Rgba8>(known_.width(), known_.height(), model_.colour);
        }
        model_.known = known_;
        // A shadow on black is invisible.
        if (disc_ && model_.black == BlackBackground::kUnknownOrNoisy) {
            model_.ground =
                disc_mask(*disc_, known_.width(), known_.height(), parameters_.disc.shadow_reach, parameters_.disc);
        }
        if (shows_motion_) inpaint_gaps(disc_, plate_, known_, parameters_);
        fill_push_pull(plate_, known_);
        model_.plate = std::move(plate_);
    }

    [[nodiscard]] bool may_have_gradient() const {
        return shows_motion_ && !disc_ && model_.kind != BackgroundKind::kBlack &&
               !is_colourful(linear_rgb(model_.colour));
    }

    void replace_by_gradient() {
        Image<LinearRgb> gradient = fit_background_gradient(model_.plate, model_.always_visible, parameters_);
        if (gradient.empty()) return;
        if (deviates_from(model_.plate, model_.known, parameters_, [&](int x, int y) { return gradient(x, y); })) {
            return;
        }
        std::ranges::transform(gradient.pixels(), model_.plate.pixels().begin(), [](const LinearRgb& light) {
            return rgba8_from_linear({light.r, light.g, light.b}, 255);
        });
        model_.gradient = std::move(gradient);
        model_.shadow_free = shadow_free_rows(frames_, model_.plate, parameters_.shadow);
    }

    void measure_noise() {
        if (model_.gradient.empty()) {
            model_.noise_delta_e = plate_noise(frames_, model_.plate, model_.known, parameters_);
        } else {
            // The mean over the always visible pixels: elsewhere, moving shadows look like noise.
            Image<float> noise = plate_noise(frames_, model_.plate, model_.always_visible, parameters_);
            const cv::Mat1f values(noise.height(), noise.width(), noise.data());
            const auto mean = static_cast<float>(cv::mean(values, mat_view(model_.always_visible))[0]);
            model_.noise_delta_e = Image<float>(values.cols, values.rows, mean);
        }
        if (model_.black == BlackBackground::kUniform) limit_noise_to_border();
    }

    // Limits the noise to its mean along the border.
    void limit_noise_to_border() {
        Image<float>& noise = model_.noise_delta_e;
        double sum = 0;
        std::int64_t count = 0;
        for_border(noise.width(), noise.height(), [&](int x, int y) {
            sum += static_cast<double>(noise(x, y));
            ++count;
        });
        const auto max = static_cast<float>(sum / static_cast<double>(std::max<std::int64_t>(count, 1)));
        for (float& value : noise.pixels()) value = std::min(value, max);
    }

    const Survey& survey_;
    const BackgroundParameters& parameters_;
    bool shows_motion_;  // enough frames to identify static pixels
    ExposureNormalizedFrames frames_;
    BackgroundEstimate estimate_;
    BorderStatistics border_;
    std::vector<Rgba8> colours_;  // of the border, the most frequent or the requested one first
    Image<Rgba8> plate_;
    Image<std::uint8_t> known_;  // including inpainted pixels
    std::optional<TurntableDisc> disc_;
    BackgroundModel model_;
};

}  // namespace

std::string to_string(BackgroundKind kind) {
    switch (kind) {
        case BackgroundKind::kAlpha:
            return "alpha";
        case BackgroundKind::kWhite:
            return "white";
        case BackgroundKind::kBlack:
            return "black";
        case BackgroundKind::kColour:
            return "colour";
    }
    RS_CHECK(false);
}

Result<BackgroundRequest> parse_background(const std::string& text) {
    if (text == "auto") return BackgroundRequest{};
    for (const BackgroundKind kind : {BackgroundKind::kAlpha, BackgroundKind::kWhite, BackgroundKind::kBlack}) {
        if (text == to_string(kind)) return BackgroundRequest{kind, std::nullopt};
    }
    std::array<int, 3> codes{};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const auto [next, error] = std::from_chars(at, end, codes[i]);
        const bool is_separated = i == 2 ? next == end : next != end && *next == ',';
        if (error != std::errc{} || codes[i] < 0 || codes[i] > 255 || !is_separated) {
            return Error{"\"" + text +
                         "\" is not a background; give auto, white, black, alpha or R,G,B with numbers 0..255"};
        }
        at = next + 1;
    }
    const auto code = [&](std::size_t i) { return static_cast<std::uint8_t>(codes[i]); };
    return BackgroundRequest{BackgroundKind::kColour, Rgba8{code(0), code(1), code(2), 255}};
}

Result<BackgroundModel> estimate_background(const Survey& survey, const BackgroundRequest& request,
                                            const std::string& where, AlphaUse alpha_use,
                                            const BackgroundParameters& parameters) {
    if (survey.samples.empty()) {
        return Error{where + ": no photos to estimate the background from; give a folder of photos"};
    }
    const bool alpha = alpha_use == AlphaUse::kPrefer && has_alpha(survey, parameters.alpha);
    if (request.kind == BackgroundKind::kAlpha && !alpha) {
        return Error{where +
                     ": the photos have no transparent pixels; leave out --backdrop alpha or --segmenter alpha"};
    }
    if (request.kind == BackgroundKind::kAlpha || (!request.kind && alpha)) return BackgroundModel{};
    return BackgroundEstimator(survey, parameters).estimate(request, where);
}

}  // namespace rs::capture
