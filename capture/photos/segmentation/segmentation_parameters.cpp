#include "capture/photos/segmentation/segmentation_parameters.hpp"

#include "rayspace/file/file_output.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

namespace rs::capture {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Alpha, transparent_below, min_transparent_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Estimate, min_frames, tolerance_codes,
                                                always_visible_share, visible_share, min_exposure_change)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Border, min_white_code, max_black_code,
                                                max_lit_black_code, majority, max_bright_share, static_share,
                                                min_static_share, clusters, min_cluster_share, same_colour_delta_e,
                                                same_colour_min_shade, same_colour_max_shade, min_key_chroma)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Black, uniform_delta_e, min_uniform_share,
                                                min_exact_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Shadow, min_shade, explained_delta_e,
                                                edge_log_per_px, max_log_ratio, min_row_share, min_frame_share,
                                                fade_share, edge_dilation_px, max_deviating_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::SweptRegion, max_grid_cells, min_moving_share,
                                                motion_boundary_cost, edge_cost, uniform_cost, edge_delta_e,
                                                same_surface_delta_e, max_band_share, max_rim_cells, max_foot_share,
                                                edge_cells)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Propagation, tolerance_codes,
                                                guess_tolerance_codes, min_support, min_kept_share, front_radius_px,
                                                min_front, min_front_share, patch_radius_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::CoveredParts, boundary_reach_px, edge_delta_e,
                                                min_edge_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::RowInpainting, end_margin_px, end_length_px,
                                                end_rows_px, same_surface_codes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Noise, neighbourhood_px, max_delta_e, min_frames)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Gradient, band_share, min_side_share,
                                                min_row_share, tolerance_codes, min_fit_share, max_slope,
                                                max_slope_residual, visible_delta_e, min_swept_share,
                                                max_share_at_object, max_share_elsewhere, swept_margin_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters::Disc, nominal_focal_widths, coarse_contrast_px,
                                                contrast_px, full_contrast_codes, refinement_contrast_codes,
                                                min_edge_codes, huber_px, min_depth_share, min_contrast,
                                                min_known_share, min_octant_contrast, min_octant_share,
                                                min_clear_octants, min_evenness, rim_blur_px, shadow_reach,
                                                min_visible_circle_share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(BackgroundParameters, alpha, estimate, border, black, shadow,
                                                swept_region, propagation, covered_parts, row_inpainting, noise,
                                                gradient, disc)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(
    ForegroundParameters::Score, background_delta_e, colourful_background_delta_e, noise_factor, near_background_factor,
    near_background_score, min_foreground_delta_e, certain_foreground_delta_e, min_foreground_factor,
    certain_foreground_factor, shadow_tolerance, ambiguous_score, shadow_residual_share, min_shade, colourful_min_shade,
    max_shade, crevice_shade, disc_min_foreground_delta_e, disc_certain_foreground_delta_e, disc_shadow_tolerance,
    disc_min_shade, above_shadows_ambiguous_score, occluded_score, misalignment_px, strong_score, thin_delta_e,
    thin_on_disc_delta_e, thin_width_divisor, thin_noise_factor, thin_score, max_island, island_score)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ForegroundParameters::GraphCut, smoothness, contrast_delta_e,
                                                min_edge_cost, coarse_min_px, refine_band_px, overrule_score)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ForegroundParameters::Cleanup, keep_weak_foreground, min_component,
                                                min_hole_background, hole_rim_px, min_hole_px, min_hole, min_foreground)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ForegroundParameters::Enclosed, max_side_px, edge_dilation_px,
                                                closing_px, min_differing, min_reached, max_spot, min_enclosed)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ForegroundParameters::Grey, min_added, min_explained,
                                                last_ambiguous_score)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ForegroundParameters::Alpha, side_per_band_px, min_band_px, max_band_px,
                                                mixed_weight, colour_sigma, isotropic_share, chroma_sigma, alpha_per_px,
                                                prior_weight, prior_sigma_at_contour, prior_sigma, clear_sigma,
                                                min_profile_sigma, profile_sigma_factors, alpha_noise)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ForegroundParameters, score, graph_cut, cleanup, enclosed, grey, alpha)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(FusionParameters, min_static_share, min_component)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(CheckParameters, max_coverage, max_at_border, max_contradicting,
                                                plate_factor, area_margin)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(SegmentationParameters, background, foreground, fusion, checks)

namespace {

constexpr std::uint64_t kMaxFile_bytes = std::uint64_t{1} << 20;

// The path of the first value in `given` that `known` does not have, or has with another type; empty if none.
std::string first_unknown(const nlohmann::json& given, const nlohmann::json& known, const std::string& path) {
    if (!given.is_object()) return path + " is no object";
    for (const auto& [name, value] : given.items()) {
        const std::string own = path.empty() ? name : path + "." + name;
        if (!known.contains(name)) return own + " is no parameter";
        const nlohmann::json& expected = known.at(name);
        if (expected.is_object()) {
            std::string found = first_unknown(value, expected, own);
            if (!found.empty()) return found;
            continue;
        }
        const bool fits = expected.is_number_integer() ? value.is_number_integer()
                          : expected.is_number()       ? value.is_number()
                          : expected.is_array()        ? value.is_array() && value.size() == expected.size()
                                                       : value.type() == expected.type();
        if (!fits) return own + " must be like " + expected.dump();
    }
    return {};
}

}  // namespace

std::string to_json_text(const SegmentationParameters& parameters) {
    return nlohmann::json(parameters).dump(2);
}

Result<SegmentationParameters> read_segmentation_parameters(const std::filesystem::path& file) {
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(file, kMaxFile_bytes));
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    const nlohmann::json given = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
    if (given.is_discarded()) return Error{file.string() + ": is not JSON; give {\"foreground\": {...}, ...}"};
    const std::string unknown = first_unknown(given, nlohmann::json(SegmentationParameters{}), "");
    if (!unknown.empty()) {
        return Error{file.string() + ": " + unknown +
                     "; capture/photos/segmentation/segmentation_parameters.hpp lists all"};
    }
    try {
        return given.get<SegmentationParameters>();
    } catch (const std::exception& failure) {
        return Error{file.string() + ": " + failure.what()};
    }
}

}  // namespace rs::capture
