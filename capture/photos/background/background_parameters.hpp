#pragma once
/// \file
/// Tuning parameters of the background estimate: every threshold between the survey of a turn and its BackgroundModel.
///
/// estimate_background() passes them down. Colours are sRGB codes 0..255 or CIELAB differences (CIE 1976 delta E), px
/// are pixels of the frames (Survey::samples, longer side at most kSampleSide_px), shares are 0..1. The defaults were
/// tuned on studio, chroma-key, turntable and rendered photo sets.

#include <cstddef>

namespace rs::capture {

struct BackgroundParameters {
    /// Photos with an alpha channel of their own.
    struct Alpha {
        int transparent_below = 128;          ///< alpha 0..255 below which a pixel is transparent
        double min_transparent_share = 0.01;  ///< of a frame's pixels; more make it a photo with alpha
    };

    /// Temporal consensus over the frames.
    struct Estimate {
        std::size_t min_frames = 6;          ///< fewer do not show which pixels are static
        int tolerance_codes = 14;            ///< frames agree at a pixel if no channel differs by more
        float always_visible_share = 0.95F;  ///< of the frames must agree where the object never covers the background
        float visible_share = 0.3F;          ///< of the frames must agree for a value to be the background's
        float min_exposure_change = 1.15F;   ///< ratio of two frames' gains above which the border corrects exposure
    };

    /// Colours along the image border, and the choice of the background's kind by them.
    struct Border {
        int min_white_code = 225;            ///< of the darkest channel of white
        int max_black_code = 40;             ///< of the brightest channel of black
        int max_lit_black_code = 110;        ///< of the brightest channel of a black background under strong light
        double majority = 0.6;               ///< of the border: the background is white or black
        double max_bright_share = 0.1;       ///< of the border: static pixels above max_lit_black_code before black
        float static_share = 0.6F;           ///< of the frames must agree at a static pixel
        double min_static_share = 0.5;       ///< of the border must be static for a background that is found over time
        int clusters = 4;                    ///< of colours, by k-means
        double min_cluster_share = 0.02;     ///< of the pixels; smaller clusters are ignored
        float same_colour_delta_e = 16;      ///< pixels within this of a border colour, shaded or lit, are background
        float same_colour_min_shade = 0.5F;  ///< least factor of linear light at which colours are compared
        float same_colour_max_shade = 1.5F;  ///< greatest such factor
        float min_key_chroma = 30;           ///< CIELAB chroma from which a border colour serves as a chroma key
    };

    /// Uniformity of a black background.
    struct Black {
        float uniform_delta_e = 1;        ///< pixels of a uniform black differ at most by this from its colour
        double min_uniform_share = 0.95;  ///< of all frames' border pixels
        double min_exact_share = 0.25;    ///< of the frames whose border is black to the code, for an exact black
    };

    /// Shadows on the background.
    struct Shadow {
        float min_shade = 0.25F;        ///< light left in the deepest shadow, factor of linear light
        float explained_delta_e = 6;    ///< pixels within this of the (shaded) background are explained by it
        float edge_log_per_px = 0.02F;  ///< gradient of the log light ratio at an edge, natural logarithm per px
        float max_log_ratio = -0.1F;    ///< log light ratio below which a pixel is in a shadow
        double min_row_share = 0.01;    ///< of a row's pixels in a soft shadow make it a row with shadow
        double min_frame_share = 0.25;  ///< of the frames must show a shadow in the row; leaks are rarer
        double fade_share = 0.02;       ///< of the image height above the highest such row, where a shadow fades out
        int edge_dilation_px = 4;       ///< radius that closes gaps of edges up to twice as wide
        /// Share of the known plate that is neither one colour nor gradient, shaded or not.
        double max_deviating_share = 0.02;
    };

    /// Clean plate: region that the object sweeps, in cells of a grid.
    struct SweptRegion {
        int max_grid_cells = 256;           ///< per side
        float min_moving_share = 0.4F;      ///< of a cell's pixels that change, for a moving cell
        float motion_boundary_cost = 0.5F;  ///< of the contour, per cell, where motion ends
        float edge_cost = 1;                ///< along an edge of the background estimate
        float uniform_cost = 20;            ///< added through a uniform surface
        float edge_delta_e = 3.5F;          ///< scale of the contrast between cells, by which that falls to 0
        float same_surface_delta_e = 4;     ///< between neighbouring cells of one surface
        /// Share of the image height: static bands up to this between moving ones are closed.
        double max_band_share = 1.0 / 16;
        int max_rim_cells = 4;        ///< width of a static rim beside moving cells
        double max_foot_share = 0.5;  ///< of the body's width: wider lower ends get no foot
        int edge_cells = 2;           ///< width of a blurred edge
    };

    /// Clean plate: growth from the always visible pixels.
    struct Propagation {
        int tolerance_codes = 8;         ///< between a frame and the plate that it supports
        int guess_tolerance_codes = 16;  ///< between the plate and an inpainted guess
        int min_support = 3;             ///< frames that must show the background at a pixel
        double min_kept_share = 0.7;     ///< of the neighbour's support must remain at the next pixel
        int front_radius_px = 4;         ///< of the square that is searched for a broad front
        int min_front = 4;               ///< pixels of the front
        double min_front_share = 0.5;    ///< of the square's plate pixels
        int patch_radius_px = 2;         ///< of the square patches that confirm an inpainted guess
    };

    /// Clean plate: static pixels within the swept region that belong to the object.
    struct CoveredParts {
        int boundary_reach_px = 3;    ///< distance from a part's boundary at which its surroundings are read
        float edge_delta_e = 6;       ///< across the boundary, for a clear edge
        double min_edge_share = 0.6;  ///< of the boundary to the static background must be clear
    };

    /// Inpainting along image rows.
    struct RowInpainting {
        int end_margin_px = 3;        ///< between a gap and the pixels that its ends are averaged over
        int end_length_px = 8;        ///< of the averaged end, along the row
        int end_rows_px = 1;          ///< rows above and below that are averaged, too
        int same_surface_codes = 40;  ///< ends that differ by more are different surfaces; the gap stays
    };

    /// Noise of the frames about the clean plate.
    struct Noise {
        int neighbourhood_px = 15;    ///< side of the square that it is averaged over
        float max_delta_e = 4;        ///< upper limit of the result
        std::size_t min_frames = 12;  ///< frames are skipped regularly down to this number
    };

    /// Background gradient model (background_gradient.hpp).
    struct Gradient {
        double band_share = 0.15;         ///< width of the fitted border band, of the shorter side of the image
        double min_side_share = 0.3;      ///< of the band on each side of the image that must be always visible
        double min_row_share = 0.04;      ///< of a row's pixels; rows with fewer are interpolated
        double tolerance_codes = 3;       ///< between band and model
        double min_fit_share = 0.8;       ///< of the band within that tolerance
        double max_slope = 0.07;          ///< of a horizon, px/px, when the camera is rolled
        double max_slope_residual = 0.5;  ///< of a sloped horizon, relative to that of a level one
        float visible_delta_e = 2.5F;     ///< pixels that differ by more from the gradient are marks or another surface
        double min_swept_share = 0.01;    ///< of the image: a part with more swept pixels is connected to the object
        /// Share of the image: unshaded pixels of parts connected to the object above which there is no gradient.
        /// Measured: studios 0, with steep shadows up to 0.0015; turntables 0.0012 to 0.02.
        double max_share_at_object = 0.002;
        double max_share_elsewhere = 0.05;  ///< the same for isolated marks
        int swept_margin_px = 4;            ///< the swept region ends at cell boundaries; ignored around it
    };

    /// Turntable disc.
    struct Disc {
        double nominal_focal_widths = 1.4;       ///< assumed focal length, in image widths
        double coarse_contrast_px = 4;           ///< distance from the rim at which its contrast is read, coarse search
        double contrast_px = 2;                  ///< the same for the fine search and the acceptance test
        double full_contrast_codes = 24;         ///< Euclidean colour distance that counts as full contrast
        double refinement_contrast_codes = 120;  ///< the same for the fine search, where contrast is not to saturate
        double min_edge_codes = 12;              ///< Euclidean colour distance of an edge that the rim is fitted to
        double huber_px = 1;                     ///< distance to an edge from which Huber's weight falls
        double min_depth_share = 0.05;           ///< of the image width: smaller radius of the rim's ellipse
        double min_contrast = 0.7;               ///< mean contrast of the rim, 0..1
        double min_known_share = 0.4;            ///< of the rim must be known
        double min_octant_contrast = 0.5;        ///< mean contrast of a clear octant, 0..1
        double min_octant_share = 1.0 / 3;       ///< of the octant that must be known
        int min_clear_octants = 4;               ///< of the rim's 8
        /// Share of the known rim whose contrast is at least a third of the median. Measured: discs from 0.94, a white
        /// foot before blue without a disc 0.78.
        double min_evenness = 0.86;
        double rim_blur_px = 2;      ///< width of the blurred rim around the disc
        double shadow_reach = 0.25;  ///< of the disc's radius, beyond its rim, where the object's shadow falls
        double min_visible_circle_share = 0.6;  ///< of a circle: the object does not hide the rest of it
    };

    Alpha alpha{};
    Estimate estimate{};
    Border border{};
    Black black{};
    Shadow shadow{};
    SweptRegion swept_region{};
    Propagation propagation{};
    CoveredParts covered_parts{};
    RowInpainting row_inpainting{};
    Noise noise{};
    Gradient gradient{};
    Disc disc{};
};

}  // namespace rs::capture
