#pragma once
/// \file
/// Thresholds of background subtraction and alpha estimation, with their defaults, and their variants by kind of
/// background.
///
/// One struct per stage: Score (foreground_mask.hpp), GraphCut (graph_cut.hpp), Cleanup (foreground_mask.hpp), Enclosed
/// (enclosed_regions.cpp), Grey (flat_grey_foreground.hpp), Alpha (alpha_estimation.hpp). Colour differences are CIE
/// 1976 delta E (colour_difference.hpp), shades are factors of linear light, shares are 0..1. Foreground scores are
/// -kCertainScore..kCertainScore.

#include <array>

namespace rs::capture {

struct BackgroundModel;

/// Scores of certain foreground, and with the opposite sign of certain background.
inline constexpr float kCertainScore = 4;

struct ForegroundParameters {
    /// Foreground score of a pixel against the background.
    struct Score {
        /// Up to this difference from an achromatic background a pixel is certainly background, delta E.
        float background_delta_e = 2.5F;
        /// The same for a colourful background, whose colour objects seldom share, delta E.
        float colourful_background_delta_e = 6;
        /// The background threshold is at least this multiple of the background's noise.
        float noise_factor = 2;
        /// Pixels up to this multiple of the background threshold are probably background.
        float near_background_factor = 2;
        /// Score at the background threshold; rises linearly to 0 at near_background_factor times the threshold.
        float near_background_score = -0.4F;

        /// Residual of the shadow model from which a pixel is probably foreground, at full light, delta E.
        float min_foreground_delta_e = 10;
        /// Residual from which it is certainly foreground, delta E.
        float certain_foreground_delta_e = 22;
        /// min_foreground_delta_e is raised to at least this multiple of the background threshold.
        float min_foreground_factor = 1.5F;
        /// certain_foreground_delta_e is raised to at least this multiple of the former.
        float certain_foreground_factor = 2;
        /// Both grow by this share of the light that a shadow removes: interreflections tint shadows.
        float shadow_tolerance = 1;

        /// Score where a shadow on an achromatic background and a grey part of the object look the same. Close to 0, so
        /// that the contrast determines the label; above 0, so that a closed edge around a grey patch can hold it.
        float ambiguous_score = 0.08F;
        /// A shadow explains a pixel up to this share of min_foreground_delta_e.
        float shadow_residual_share = 0.8F;
        /// Least factor of light in a shadow on an achromatic background.
        float min_shade = 0.25F;
        /// The same on a colourful background.
        float colourful_min_shade = 0.08F;
        /// Largest factor of light: reflections.
        float max_shade = 1.15F;
        /// Below this factor a pixel is rather a crevice of the object than a shadow.
        float crevice_shade = 0.3F;

        /// On the turntable's disc these replace min_foreground_delta_e, certain_foreground_delta_e, shadow_tolerance,
        /// and both min_shade and crevice_shade: reflections of the object fall there, and next to no light is left
        /// between its feet.
        float disc_min_foreground_delta_e = 12;      ///< delta E
        float disc_certain_foreground_delta_e = 26;  ///< delta E
        float disc_shadow_tolerance = 1;             ///< share
        float disc_min_shade = 0.1F;                 ///< factor of light, both of the last two
        /// ambiguous_score above the region in which shadows fall.
        float above_shadows_ambiguous_score = 0.3F;

        /// Least score where the object always occludes the background, whose colour is a guess there.
        float occluded_score = 2;
        /// A pixel is also compared with the background at this distance to all four sides, px: cameras shake.
        int misalignment_px = 2;
        /// From this score on a pixel is clearly foreground.
        float strong_score = 1;

        /// Difference beyond the noise from which a thin structure is foreground, because shadows are broad, delta E.
        /// 0 disables the test.
        float thin_delta_e = 0;
        /// The same on the turntable's disc, where slivers of shadow lie; at least thin_delta_e.
        float thin_on_disc_delta_e = 0;
        /// A structure is thin up to the image's longer side divided by this.
        int thin_width_divisor = 45;
        /// The difference must exceed this multiple of the noise.
        float thin_noise_factor = 1.2F;
        /// Least score of thin structures.
        float thin_score = 2;

        /// Achromatic background components cut off from the image border, smaller than this share of the image, become
        /// undecided: they may be parts of the object in the background's colour.
        double max_island = 0.003;
        /// Score of these.
        float island_score = -0.1F;
    };

    /// Energy of the graph cut.
    struct GraphCut {
        /// Cost of a label change between neighbours of one colour.
        float smoothness = 6;
        /// Standard deviation of the contrast term, delta E: label changes get cheap at larger differences.
        float contrast_delta_e = 3.5F;
        /// Least cost of a label change: short contours are preferred.
        float min_edge_cost = 0.05F;
        /// Number of undecided pixels from which a coarser level is cut first; at least 2.
        int coarse_min_px = 400000;
        /// Half width of the band around the coarse contour that is cut again in full resolution, px; even.
        int refine_band_px = 6;
        /// Outside the band, pixels with at least this score for the other label are cut again, too.
        float overrule_score = 1;
    };

    /// Connected components of the mask.
    struct Cleanup {
        /// Keep the largest component where none has a pixel of Score::strong_score.
        bool keep_weak_foreground = false;
        /// Components smaller than this share of the largest are removed.
        double min_component = 0.01;
        /// A hole stays open if at least this share of its inner part looks like the background. Measured on a shoe
        /// before white: loops of its straps 0.94 to 1.00, white insoles 0.74 to 0.85.
        double min_hole_background = 0.9;
        /// Width of a hole's blurred rim that does not belong to its inner part, px.
        int hole_rim_px = 2;
        /// Smaller holes are filled: area in px, and share of the image.
        double min_hole_px = 8;     ///< px
        double min_hole = 0.00004;  ///< share
        /// Least area of what segment_by_edges() and add_flat_grey_foreground() add, share of the image; less is dust.
        double min_foreground = 0.002;
    };

    /// Foreground enclosed by edges.
    struct Enclosed {
        /// Edges are detected in an image reduced to this longer side, px: they are a pixel or two wide there.
        int max_side_px = 1024;
        /// Dilation of the edges, px: closes gaps of twice this width.
        int edge_dilation_px = 2;
        /// Diameter of the closing that joins neighbouring regions of the object, px.
        int closing_px = 9;
        /// An enclosed region is foreground if at least this share of it differs from the background.
        double min_differing = 0.3;
        /// At least this share of the remaining image must be reached from the border; less means noise.
        double min_reached = 0.5;
        /// Enclosed regions that look like the background count as foreground up to this share of the certain
        /// foreground.
        double max_spot = 0.01;
        /// The enclosed area must exceed this share of the certain foreground. Measured: a white car 0.48 to 0.90, a
        /// suede shoe up to 0.15.
        double min_enclosed = 0.3;
    };

    /// Foreground before a flat grey or white without noise.
    struct Grey {
        /// Least area of a component that is added to the mask, share of the second mask.
        double min_added = 0.02;
        /// Below this share of the differing pixels the mask is taken to lack the object: not everything is shadow.
        double min_explained = 0.2;
        /// Score::ambiguous_score of the last attempt, in which shadows are included.
        float last_ambiguous_score = 0.5F;
    };

    /// Alpha along the mask's contour.
    struct Alpha {
        /// The band is 1 px wide on either side for every so many px of the image's longer side, within the two limits.
        int side_per_band_px = 450;  ///< px of the longer side per px of the band
        int min_band_px = 2;         ///< px
        int max_band_px = 8;         ///< px
        /// Least weight of a pixel in the colour statistics of its side: thin structures have no unmixed pixels.
        float mixed_weight = 0.02F;
        /// Standard deviation of colours that the local covariance does not contain, linear light.
        float colour_sigma = 0.02F;
        /// Share of the total variance that is added in every direction.
        float isotropic_share = 0.05F;
        /// Standard deviation of alpha measured by chroma alone: photos store chroma at half resolution.
        float chroma_sigma = 0.2F;
        /// Slope of the prior of alpha over the distance from the contour, 1/px; that of an edge without blur.
        float alpha_per_px = 0.75F;
        /// Weight of the prior, in measurements.
        double prior_weight = 50;
        /// Standard deviation of the prior within 1 px of the contour, and beyond.
        double prior_sigma_at_contour = 0.25;  ///< within 1 px
        double prior_sigma = 0.1;              ///< beyond
        /// Measurements of a smaller standard deviation shape the edge profile.
        double clear_sigma = 0.05;
        /// Least standard deviation of the edge profile.
        double min_profile_sigma = 0.03;
        /// Factors on the standard deviation of the edge profile, one per pass. The mask's contour lies up to a pixel
        /// outside the object, because a pixel with little of the object no longer looks like the background: colour
        /// counts more in the first pass.
        std::array<float, 2> profile_sigma_factors{3.0F, 1.5F};
        /// Alpha below this becomes 0, above 1 minus this 1: noise.
        float alpha_noise = 0.03F;
    };

    Score score{};
    GraphCut graph_cut{};
    Cleanup cleanup{};
    Enclosed enclosed{};
    Grey grey{};
    Alpha alpha{};
};

/// Black with noise: no shadow is visible on black, so none is modelled.
ForegroundParameters for_black(ForegroundParameters parameters);

/// Black within two codes, BlackBackground::kUniform.
ForegroundParameters for_even_black(ForegroundParameters parameters);

/// Black to the code, BlackBackground::kExact: parts of the object that fade to black are closed by the graph cut.
ForegroundParameters for_exact_black(ForegroundParameters parameters);

/// A background of any other colour that is known per pixel, with its noise, from a turn.
ForegroundParameters for_known_colour(ForegroundParameters parameters);

/// A white or grey without noise, from which white and grey objects differ by a few codes.
ForegroundParameters for_flat_grey(ForegroundParameters parameters);

/// The variant for this background: one of the above except for_flat_grey(), or `parameters` unchanged.
ForegroundParameters parameters_for(const BackgroundModel& model, const ForegroundParameters& parameters);

}  // namespace rs::capture
