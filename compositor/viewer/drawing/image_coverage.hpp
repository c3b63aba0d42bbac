#pragma once
// Parts of an image that are visible, as polygons on the screen: a third or more of an object's image is transparent,
// and opaque parts need no blending. Pure; thread-safe.
//
//     image -> bands of kBandRows rows -> runs of columns per band, opaque or blended -> polygons
//
// Adjacent polygons share their corners exactly, so that no pixel between them is skipped or drawn twice.

#include "compositor/gpu/visible_area.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rs::compositor {

inline constexpr int kBandRows = 16;

/// Columns [begin, end) of the image; may extend beyond it by the margin.
struct CoverageRun {
    int begin = 0;
    int end = 0;
    bool opaque = false;  // with all pixels within the margin
    bool operator==(const CoverageRun&) const = default;
};

/// Rows [top, bottom). Runs are in order; the image is transparent between them, margin included.
struct CoverageBand {
    int top = 0;
    int bottom = 0;
    std::vector<CoverageRun> runs;
};

/// Bands from top to bottom without gaps.
/// \param margin_px >= 0; distance at which a screen pixel may sample the image.
std::vector<CoverageBand> coverage_bands(ConstImageView<Rgba8> image, int margin_px);

/// The same of an image that is transparent outside of rectangles without overlap; no run is opaque.
std::vector<CoverageBand> coverage_bands(std::span<const PixelRect> visible, int margin_px);

/// Triangles of the runs. Corners are homogeneous: (x, y, w) is the position (x / w, y / w) on the screen.
struct CoverageMesh {
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> opaque;  // three corners each
    std::vector<std::uint32_t> blended;
};
/// \param screen_from_image maps (u, v, 1) to w * (x, y, 1).
CoverageMesh coverage_mesh(const std::vector<CoverageBand>& bands, const glm::dmat3& screen_from_image);

}  // namespace rs::compositor
