#include "capture/photos/foreground/foreground_parameters.hpp"

#include "capture/photos/background/background_model.hpp"

namespace rs::capture {

ForegroundParameters for_black(ForegroundParameters parameters) {
    ForegroundParameters::Score& score = parameters.score;
    score.min_shade = score.colourful_min_shade = score.max_shade = 1;
    return parameters;
}

ForegroundParameters for_even_black(ForegroundParameters parameters) {
    parameters = for_black(parameters);
    parameters.score.background_delta_e = .4F;
    parameters.score.min_foreground_delta_e = .9F;
    parameters.score.certain_foreground_delta_e = 2;
    return parameters;
}

ForegroundParameters for_exact_black(ForegroundParameters parameters) {
    parameters = for_black(parameters);
    // A grey of code 1 is .27 away.
    parameters.score.background_delta_e = .15F;
    parameters.score.min_foreground_delta_e = .225F;
    parameters.score.certain_foreground_delta_e = 2;
    parameters.graph_cut.contrast_delta_e = .5F;
    // An area in which the object fades to black has no visible rim, so the cut fills it; a true hole has a rim. So
    // larger islands than elsewhere can be left to the cut.
    parameters.score.max_island = .012;
    return parameters;
}

ForegroundParameters for_known_colour(ForegroundParameters parameters) {
    ForegroundParameters::Score& score = parameters.score;
    score.max_island = 0.00002;  // an object rarely matches a known texture by chance
    score.ambiguous_score = -0.1F;
    score.min_foreground_delta_e = 6;
    score.certain_foreground_delta_e = 14;
    score.shadow_tolerance = 0.5F;
    score.thin_delta_e = 3;
    score.thin_on_disc_delta_e = 8;
    parameters.cleanup.min_hole_background = 0.5;
    return parameters;
}

ForegroundParameters for_flat_grey(ForegroundParameters parameters) {
    // A code of white is .36 in all channels and up to .67 in one, which is not significant.
    parameters.score.background_delta_e = .5F;
    // A few codes may also be a faint shadow: the score is almost 0, so that the contrast determines the label.
    parameters.score.near_background_factor = 10;
    parameters.score.near_background_score = -.05F;
    // Most of a grey object is undecided, and noise misleads single pixels: use coarser levels early.
    parameters.graph_cut.coarse_min_px = 30000;
    return parameters;
}

ForegroundParameters parameters_for(const BackgroundModel& model, const ForegroundParameters& parameters) {
    if (model.kind == BackgroundKind::kBlack) {
        if (model.black == BlackBackground::kUniform) return for_even_black(parameters);
        if (model.black == BlackBackground::kExact) return for_exact_black(parameters);
        return for_black(parameters);
    }
    if (model.kind == BackgroundKind::kColour && !model.always_visible.empty()) return for_known_colour(parameters);
    return parameters;
}

}  // namespace rs::capture
