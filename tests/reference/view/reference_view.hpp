#pragma once
// Second implementation of engine/RECONSTRUCTION.md, written from its text only, in its order and with its names,
// without regard to speed. Integers have 128 bits, and the bounds of the section "Ranges" are checked.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/object/ray_space_object.hpp"
#include "tests/reference/view/reference_whole.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace rs::reference {

/// Branches of the text, counted when taken.
enum class Branch {
    plane_behind_or_edge_on,  // section 2
    misses_or_too_far,
    no_image,
    shown_on_plane,  // 3, 4
    outside_on_plane,
    too_near_on_plane,
    too_large_on_plane,
    too_steep_on_plane,
    foot_too_far,  // 5
    no_lines,
    not_found,
    gap_before,
    gap_behind,
    looks_twice,
    looks_thrice,
    line_before,
    line_before_has_none,
    line_behind,
    line_behind_has_none,
    line_between,
    no_cell_of_two,  // 6
    first_cell_alone,
    second_cell_alone,
    lines_jump_to_first,
    lines_jump_to_second,
    lines_interpolated,
    first_shows_alone,
    second_shows_alone,
    band_does_not_exist,
    nothing_of_four,
    nothing_has_weight,
    one_group,
    nearer_group,
    nearer_group_of_equals,
    farther_group,
    one_step,
    many_steps,
    most_steps,
    band_drift_clamped,
    not_met_nothing,
    not_met_behind_the_step,
    not_met_ends_before,
    met_within_the_step,
    met_at_the_step,
    end_is_nothing,
    second_look,
    second_look_is_nothing,
    met_behind,
    nothing_behind,
    met_farthest,
    one_of_eight_lacks,
    met_after_another,
    too_near,  // 7
    beside_the_image,
    transparent,
    seen,
    at_a_border,
    bilinear,
    sharp,
    smooth,
    no_detail_at_a_border,
    no_detail_beside_transparency,
    detail,
    detail_clamped,
    behind_the_viewer,  // 8
    transparent_hides,
    both_images,
    first_image_alone,
    second_image_alone,
    both_outside,
    no_shape,
    weight_is_0,
    weight_is_256,
    blended,
    on_line_without_surface,
    leans_to_second,
    over_nothing,
    over_what_does_not_cover,
    over_and_nearer,
    over_and_farther,
    none_shows_something,
    alpha_rounds_to_0,
    detail_leaves_the_codes,
    shown,
    count
};

struct Branches {
    std::array<std::int64_t, static_cast<std::size_t>(Branch::count)> taken{};
    void take(Branch branch) { ++taken[static_cast<std::size_t>(branch)]; }
    [[nodiscard]] std::int64_t of(Branch branch) const { return taken[static_cast<std::size_t>(branch)]; }
};

struct ReferencePixel {
    std::uint8_t R = 0;
    std::uint8_t G = 0;
    std::uint8_t B = 0;
    std::uint8_t A = 0;
    std::int32_t lambda_q20 = 0;
    bool operator==(const ReferencePixel&) const = default;
};

/// Section 2: a valid ray.
struct PlaneRay {
    std::size_t k = 0;
    Whole n = 0, T = 0, u = 0, x = 0, lambda = 0;
    std::size_t image = 0;
};
std::optional<PlaneRay> plane_ray(const RaySpaceObject& object, const engine::ViewRegisters& view, int i, int j,
                                  Branches& branches);

/// Section 4: colour of a stored pixel.
struct Colour {
    Whole R = 0, G = 0, B = 0, A = 0;
};
Colour stored_colour(const PlanarImage& image, Whole column, Whole row);

/// Renders pixel (i, j). `object` has passed validate_object and has all its images; `view` has passed check_registers.
ReferencePixel reference_pixel(const RaySpaceObject& object, const engine::ViewRegisters& view, int i, int j,
                               Branches& branches);

}  // namespace rs::reference
