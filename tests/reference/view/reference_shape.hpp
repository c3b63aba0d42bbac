#pragma once
// engine/RECONSTRUCTION.md, sections 5 to 8: a ray of a ring with a shape map.

#include "tests/reference/view/reference_view.hpp"

#include <array>
#include <functional>

namespace rs::reference {

/// "Everything linear in d", for one image.
struct ImageOfRay {
    std::size_t index = 0;
    Whole L0 = 0, L1 = 0, Q0 = 0, Q1 = 0;
};

/// Result of section 5.
struct ShapeRay {
    bool has_shape = false;
    Whole r = 0, cosine = 0, sine = 0, p = 0, lambda_foot = 0, inv_r = 0, inv_rho = 0;
    Whole weight = 0, p_part = 0, line_part = 0;
    std::array<Whole, 2> cell_p{}, line{};
    Whole low = 0, step = 0, foot_d = 0;
    ImageOfRay first, second;  // `second` only for a ray with a shape
    Whole lambda0 = 0, lambda1 = 0;
};
std::optional<ShapeRay> shape_ray(const RaySpaceObject& object, const engine::ViewRegisters& view,
                                  const PlaneRay& plane_ray, Branches& branches);

/// Section 6: calls `meets` with the depth (q3) and the lean of each surface until it returns true; `at_end`: the
/// surface is hit at the end of the march.
void march(const ShapeMap& shape, const engine::ViewRegisters& view, const ShapeRay& ray, Whole rise,
           const std::function<bool(Whole d, Whole lean, bool at_end)>& meets, Branches& branches);

/// Sections 5 to 8.
ReferencePixel pixel_with_shape(const RaySpaceObject& object, const engine::ViewRegisters& view, int i, int j,
                                const PlaneRay& plane_ray, Branches& branches);

}  // namespace rs::reference
