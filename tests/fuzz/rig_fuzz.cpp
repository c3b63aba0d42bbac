#include "capture/posed/cameras/camera_file.hpp"
#include "rayspace/geometry/rig_conventions.hpp"
#include "tests/fuzz/entries.hpp"

#include <cmath>

namespace rs::fuzz {

int fuzz_rig(const std::uint8_t* data, std::size_t size) {
    const auto rig = rig_from_json(std::string(reinterpret_cast<const char*>(data), size), "input");
    if (!rig) {
        RS_CHECK(rig.error().message.find('\n') == std::string::npos);
        return 0;
    }
    // Accepted rigs must survive a round trip without loss.
    const auto again = rig_from_json(rig_to_json(*rig), "again");
    RS_CHECK(again.ok());
    RS_CHECK(again->views.size() == rig->views.size());
    RS_CHECK(again->object_radius == rig->object_radius);
    RS_CHECK(again->extras == rig->extras);
    for (std::size_t i = 0; i < rig->views.size(); ++i) {
        const RigView& a = rig->views[i];
        const RigView& b = again->views[i];
        RS_CHECK(a.file_path == b.file_path && a.depth_file_path == b.depth_file_path && a.extras == b.extras);
        RS_CHECK(a.camera.width == b.camera.width && a.camera.height == b.camera.height);
        RS_CHECK(a.camera.fl_x == b.camera.fl_x && a.camera.fl_y == b.camera.fl_y);
        RS_CHECK(a.camera.cx == b.camera.cx && a.camera.cy == b.camera.cy);
        RS_CHECK(a.camera.world_from_camera == b.camera.world_from_camera);
        const auto lens = capture::lens_distortion_of(rig->extras, a.extras, "input");
        RS_CHECK(lens.ok() || lens.error().message.find('\n') == std::string::npos);
    }
    Rig converted = *rig;
    apply_rig_conventions(converted);
    for (const RigView& view : converted.views) {
        constexpr double kMaxRotationError = 5e-3;  // files may have 1e-3
        RS_CHECK(rotation_error(view.camera) < kMaxRotationError);
        const glm::dvec3 centre = view.camera.centre();
        RS_CHECK(std::isfinite(centre.x) && std::isfinite(centre.y) && std::isfinite(centre.z));
    }
    return 0;
}

}  // namespace rs::fuzz
