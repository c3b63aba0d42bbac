// validate_object(): the bounds that the renderer's arithmetic rests on; encode/FORMAT.md, section "Ranges".
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/format/shape_validate.hpp"
#include "rayspace/geometry/rig.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs {

using namespace object_ranges;

namespace {

constexpr std::int64_t kMaxColumnOffset_q16 = 32768 * kOne_q16;
constexpr std::int32_t kMaxElevation_udeg = 90'000'000;

bool is_printable_utf8(const std::string& text) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    if (std::any_of(text.begin(), text.end(), is_control)) return false;
    try {
        (void)nlohmann::json(text).dump();  // throws on what is no UTF-8
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

Status check_view(const CapturedView& view) {
    if (!below(view.cx_q16, kMaxPixels_q16) || !below(view.cy_q16, kMaxPixels_q16)) {
        return Error{"its principal point lies 16384 px or more from the corner"};
    }
    if (view.fl_y_q16 <= 0 || view.fl_y_q16 >= kMaxPixels_q16) {
        return Error{"its focal length is not between 0 and 16384 px"};
    }
    if (!below(view.height_q20, kMaxDistance_q20)) return Error{"its height is 256 object radii or more"};
    for (const CapturedLine& line : view.lines) {
        // |l1| <= 1: it is the cosine of an angle.
        if (!below(line.l0_q20, kMaxDistance_q20) || !below(line.l1_q30, kOne_q30 + 1)) {
            return Error{"the depth of one of its lines is out of range"};
        }
        if (!below(line.q0_q16, kMaxColumnOffset_q16) || !below(line.q1_q16, kMaxPixels_q16)) {
            return Error{"the columns of one of its lines are out of range"};
        }
    }
    return {};
}

Status check_ring_geometry(const Ring& ring) {
    if (std::abs(std::int64_t{ring.elevation_udeg}) > kMaxElevation_udeg)
        return Error{"its elevation is beyond 90 degrees"};
    if (ring.planes < kMinPlanes || ring.planes > kMaxPlanes) {
        return Error{"it has " + std::to_string(ring.planes) + " planes; " + std::to_string(kMinPlanes) + ".." +
                     std::to_string(kMaxPlanes) + " are possible"};
    }
    const auto is_side = [](int side) { return side >= 1 && side <= kMaxMapSide; };
    if (!is_side(ring.x_cells) || !is_side(ring.u_cells)) {
        return Error{"its map is " + std::to_string(ring.x_cells) + "x" + std::to_string(ring.u_cells) +
                     " cells; each side must be 1.." + std::to_string(kMaxMapSide)};
    }
    if (ring.x_half_q20 < kOne_q20 || ring.x_half_q20 >= kMaxHalf_q20) {
        return Error{"its map's half width along x is not within 1 and 2 + 1/16"};
    }
    const std::int64_t squarest_q28 = std::llround(std::ldexp(std::tan(kPi / ring.planes), 28));
    if (ring.u_half_q28 <= squarest_q28 || ring.u_half_q28 > 2 * squarest_q28) {
        return Error{"its map's half width along u is not between tan(pi / planes) and twice that"};
    }
    if (!is_consistent(ring.x_cells_per_unit_q12, ring.x_cells, std::ldexp(ring.x_half_q20, -20)) ||
        !is_consistent(ring.u_cells_per_unit_q12, ring.u_cells, std::ldexp(ring.u_half_q28, -28))) {
        return Error{"its map's cells per unit contradict its size"};
    }
    return {};
}

// Depth of `line` at the ends of column xi of the map, the larger of the two, q50.
std::int64_t larger_depth_q50(const CapturedLine& line, const Ring& ring, int xi) {
    const auto depth_at = [&](int column) {
        const std::int64_t x_q20 = 2 * std::int64_t{ring.x_half_q20} * column / ring.x_cells - ring.x_half_q20;
        return std::int64_t{line.l0_q20} * kOne_q30 + x_q20 * line.l1_q30;
    };
    return std::max(depth_at(xi), depth_at(xi + 1));
}

// Every cell is empty or names a view of the ring that has some of the cell before it. (Where a point comes closer to
// the camera than the arithmetic can say, the renderer itself takes the ray for empty.)
Status check_cells(const RaySpaceObject& object, const Ring& ring) {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    const auto x_cells = static_cast<std::size_t>(ring.x_cells);
    const auto u_cells = static_cast<std::size_t>(ring.u_cells);
    const std::size_t rows = static_cast<std::size_t>(ring.planes) * x_cells;
    if (ring.cells.size() != rows * u_cells) return Error{"its map does not have as many cells as its sizes say"};
    std::vector<bool> is_of_ring(object.views.size());
    for (const std::uint16_t view : ring.views) is_of_ring[view] = true;
    std::vector<std::size_t> checked_in_row(object.views.size(), kNone);
    for (std::size_t row = 0; row < rows; ++row) {
        for (const std::uint16_t view : std::span(ring.cells).subspan(row * u_cells, u_cells)) {
            if (view == kNoPicture) continue;
            const auto place = [&] {
                return "plane " + std::to_string(row / x_cells) + ", row " + std::to_string(row % x_cells) +
                       " of its map names view " + std::to_string(view) + ", which ";
            };
            if (view >= object.views.size() || !is_of_ring[view]) return Error{place() + "is not one of the ring's"};
            if (std::exchange(checked_in_row[view], row) == row) continue;
            const CapturedLine& line = object.views[view].lines[row / x_cells];
            if (larger_depth_q50(line, ring, static_cast<int>(row % x_cells)) < 0) {
                return Error{place() + "looks away from it"};
            }
        }
    }
    return {};
}

Status check_ring(const RaySpaceObject& object, const Ring& ring, std::vector<bool>& is_taken) {
    if (Status status = check_ring_geometry(ring); !status) return status;
    if (ring.views.empty()) return Error{"it has no views"};
    for (const std::uint16_t view : ring.views) {
        if (view >= object.views.size()) return Error{"view " + std::to_string(view) + " does not exist"};
        if (is_taken[view]) return Error{"view " + std::to_string(view) + " is in a ring already"};
        is_taken[view] = true;
        if (object.views[view].lines.size() != static_cast<std::size_t>(ring.planes)) {
            return Error{"view " + std::to_string(view) + " does not have one line per plane"};
        }
    }
    if (Status status = check_cells(object, ring); !status) return status;
    const Status shape = check_shape(ring);
    return shape ? Status{} : Status{Error{"its shape map: " + shape.error().message}};
}

bool has_size(const Image<std::uint8_t>& plane, int width, int height) {
    return plane.width() == width && plane.height() == height;
}

Status check_picture(const PlanarPicture& picture, int width, int height) {
    const bool none = picture.y.empty() && picture.u.empty() && picture.v.empty() && picture.a.empty();
    const int chroma_width = picture.chroma_shift == 0 ? width : half_size(width);
    const int chroma_height = picture.chroma_shift == 0 ? height : half_size(height);
    const bool whole = has_size(picture.y, width, height) && has_size(picture.a, width, height) &&
                       has_size(picture.u, chroma_width, chroma_height) &&
                       has_size(picture.v, chroma_width, chroma_height);
    if (none || whole) return {};
    return Error{"its planes do not have the object's picture size"};
}

Status check_head(const RaySpaceObject& object) {
    const auto is_side = [](int side) { return side >= 1 && side <= kMaxPictureSide_px; };
    if (!is_side(object.width) || !is_side(object.height)) {
        return Error{"pictures of " + std::to_string(object.width) + "x" + std::to_string(object.height) +
                     " pixels; each side must be 1.." + std::to_string(kMaxPictureSide_px)};
    }
    if (object.views.empty() || object.views.size() > kMaxViews) {
        return Error{std::to_string(object.views.size()) + " views; 1.." + std::to_string(kMaxViews) + " are possible"};
    }
    if (object.rings.empty() || object.rings.size() > kMaxRings) {
        return Error{std::to_string(object.rings.size()) + " rings; 1.." + std::to_string(kMaxRings) + " are possible"};
    }
    if (object.pictures.size() != object.views.size()) return Error{"not as many pictures as views"};
    if (object.coded &&
        (object.coded->width != object.width || object.coded->height != object.height ||
         object.coded->pictures.size() != object.views.size() || object.coded->levels.size() != object.views.size())) {
        return Error{"its coded pictures do not have the object's size and number"};
    }
    if (object.name.size() > object_chunks::kMaxName_bytes || !is_printable_utf8(object.name)) {
        return Error{"its name is longer than " + std::to_string(object_chunks::kMaxName_bytes) +
                     " bytes or no printable UTF-8"};
    }
    if (!(object.units_per_radius >= 1e-12 && object.units_per_radius <= 1e12)) {
        return Error{"its units per radius are not within 1e-12..1e12"};
    }
    if (object.foot_q20 && !below(*object.foot_q20, kMaxDistance_q20)) {
        return Error{"its foot is 256 object radii or more from the height 0"};
    }
    return {};
}

Status check_rig(const RaySpaceObject& object, const std::string& where) {
    if (object.rig_json.empty()) return {};
    if (object.rig_json.size() > object_chunks::kMaxRigJson_bytes)
        return Error{where + ": its rig is larger than 16 MiB"};
    const Result<Rig> rig = rig_from_json(object.rig_json, where + ": rig");
    if (!rig) return rig.error();
    if (rig->views.size() != object.views.size())
        return Error{where + ": its rig does not have as many frames as views"};
    return {};
}

}  // namespace

Status validate_object(const RaySpaceObject& object, const std::string& where) {
    const auto at = [&](const std::string& place, const Status& status) {
        return Error{where + ": " + place + status.error().message};
    };
    if (Status status = check_head(object); !status) return at("", status);
    if (Status status = check_rig(object, where); !status) return status;
    for (std::size_t i = 0; i < object.views.size(); ++i) {
        if (const Status status = check_view(object.views[i]); !status)
            return at("view " + std::to_string(i) + ": ", status);
    }
    std::vector<bool> is_taken(object.views.size());
    for (std::size_t r = 0; r < object.rings.size(); ++r) {
        const Status status = check_ring(object, object.rings[r], is_taken);
        if (!status) return at("ring " + std::to_string(r) + ": ", status);
    }
    const auto free_view = std::find(is_taken.begin(), is_taken.end(), false);
    if (free_view != is_taken.end()) {
        return Error{where + ": view " + std::to_string(free_view - is_taken.begin()) + " belongs to no ring"};
    }
    for (std::size_t i = 0; i < object.pictures.size(); ++i) {
        const Status status = check_picture(object.pictures[i], object.width, object.height);
        if (!status) return at("picture " + std::to_string(i) + ": ", status);
    }
    return {};
}

}  // namespace rs
