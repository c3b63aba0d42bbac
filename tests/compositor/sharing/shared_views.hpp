#pragma once
// Views and messages for tests of sharing.

#include "compositor/sharing/shared_view.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace rs::test {

/// Every field differs from its default.
inline compositor::SharedView full_view() {
    using compositor::SharedView;
    SharedView view;
    view.world_from_camera = glm::rotate(glm::translate(glm::dmat4(1.0), {3, -2, 7}), 0.7, glm::dvec3(0, 1, 0));
    view.field_of_view_rad = 0.8;
    view.room = SharedView::Room{{{1, 2, 3}, 0.4, 1.5}, {{0.1, 1.6, -0.2}, 0.5, -0.1, 0.05}};
    view.renderer = 4;
    view.frame = 17;
    view.weather = compositor::Weather{.rain = true, .fog = true, .seed = 5, .wind = {1, 0, 2}, .visibility = 60};
    view.exposure_ev = -1.5;
    view.shadows = false;
    view.wire_frame = true;
    view.turns_rad = {0, 2.5};
    return view;
}

/// A view that its frame identifies.
inline compositor::SharedView numbered_view(std::uint32_t frame) {
    compositor::SharedView view;
    view.frame = frame;
    return view;
}

inline constexpr std::uint64_t kSharedScene = 0x0123456789abcdef;

}  // namespace rs::test
