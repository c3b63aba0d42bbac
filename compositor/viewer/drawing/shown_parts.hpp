#pragma once
// Which parts of an object's image show something, and their outline on the screen: a third or more of an image's
// pixels are empty, and what is opaque need not be blended. Pure; thread-safe.
//
//   image -> bands of kBandRows rows -> in each of them runs of columns, opaque ones and others -> polygons
//
// Polygons that touch share their corners exactly, so no pixel between them is left out or drawn twice.

#include "compositor/viewer/residency/placed_object.hpp"
#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

// What a frame shows of a ray-space node: its object, or while that is being read, a placeholder, or one fading into
// the other.

// A soft upright shape of about the object's size.
struct Placeholder {
    Similarity world_from_object;
    double bottom = -1;  // object radii
    double top = 1;
    float opacity = 1;   // 0 .. 1
    float progress = 0;  // of reading, 0 .. 1: how far the shape is filled
};

struct ShownNode {
    std::optional<PlacedObject> object;
    engine::ObjectHandle handle;  // of the object, in the frame's data module
    float opacity = 1;            // of the object, 0 .. 1
    std::optional<Placeholder> placeholder;
    bool hidden = false;  // nowhere in this frame
};
using ShownNodes = std::vector<ShownNode>;

// For RenderSession::load(): without a copy, and alive for as long as anybody uses it.
engine::PreparedObject prepared(const std::shared_ptr<const ViewableObject>& object);

// All at once, every object loaded into `engine`.
Result<std::shared_ptr<const ShownNodes>> show_all(const std::vector<PlacedObject>& objects,
                                                   engine::RenderSession& engine);

// As many objects as a scene may have; a frame's views go in cycles of the board's size.
engine::RenderSessionLimits limits_of_viewer();

inline constexpr int kBandRows = 16;

// Columns [begin, end) of the image, which may reach beyond it by the margin.
struct ShownRun {
    int begin = 0;
    int end = 0;
    bool opaque = false;  // with everything around it that is nearer than the margin
    bool operator==(const ShownRun&) const = default;
};

// Rows [top, bottom). The runs are in order; what lies between two of them, or is nearer to it than the margin, is
// empty.
struct ShownBand {
    int top = 0;
    int bottom = 0;
    std::vector<ShownRun> runs;
};

// From top to bottom without gaps. `margin_px` >= 0: how far around its place a pixel of the screen reads the image.
std::vector<ShownBand> shown_bands(ConstImageView<Rgba8> image, int margin_px);

// Triangles of the runs. Corners are homogeneous: (x, y, w) is the place (x / w, y / w) on the screen.
struct ShownMesh {
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> opaque;  // three corners each
    std::vector<std::uint32_t> blended;
};
// screen_from_image * (u, v, 1) = w * (x, y, 1).
ShownMesh shown_mesh(const std::vector<ShownBand>& bands, const glm::dmat3& screen_from_image);

}  // namespace rs::compositor
