#pragma once
// Working views of the drawn balls, and a plain implementation of the visual hull.

#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "tests/support/drawn_set.hpp"

#include <algorithm>
#include <vector>

namespace rs::encode {

inline Rig drawn_ring(int count, double first_deg = 0, double distance = 3.5) {
    Rig rig = make_ring({.count = count,
                         .distance = distance,
                         .fl_px = 180,
                         .width = 128,
                         .height = 112,
                         .first_rad = radians(first_deg)});
    rig.object_radius = 0.9;
    return rig;
}

inline std::vector<WorkView> drawn_views(const Rig& rig) {
    std::vector<WorkView> views;
    for (const RigView& view : rig.views) {
        Camera camera = view.camera;
        const Image<Rgba8> image = test::draw_image(camera);
        camera.world_from_camera[3] = glm::dvec4(camera.centre() / rig.object_radius, 1);
        views.push_back(make_work_view(camera, image, 1));
    }
    return views;
}

inline std::vector<const WorkView*> pointers(const std::vector<WorkView>& views) {
    std::vector<const WorkView*> found;
    for (const WorkView& view : views) found.push_back(&view);
    return found;
}

/// Plain version of heights_above: tests one point against every silhouette.
inline bool is_allowed(const std::vector<WorkView>& views, const glm::dvec2& place, double y, int margin) {
    for (const WorkView& view : views) {
        const ProjectedColumn seen = view.see(place);
        if (seen.axial <= 0 || seen.column < 0 || seen.column >= view.width) continue;
        const double row = view.row_of(y, seen.axial);
        if (row < 0 || row >= view.height) continue;
        bool near_object = false;
        const int middle = static_cast<int>(seen.column);
        for (int c = std::max(0, middle - margin); c <= std::min(view.width - 1, middle + margin); ++c) {
            for (int r = 0; r < view.height; ++r) {
                near_object |= view.at(c, r).a >= 128 && row >= r - margin && row < r + 1 + margin;
            }
        }
        if (!near_object) return false;
    }
    return true;
}

}  // namespace rs::encode
