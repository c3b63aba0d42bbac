#include "rayspace/geometry/rig.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig_json.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <cmath>
#include <cstdio>
#include <span>

namespace rs {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMaxRigFile_bytes = std::uint64_t{64} << 20;

bool all_finite(const Camera& camera) {
    bool finite = std::isfinite(camera.fl_x) && std::isfinite(camera.fl_y) && std::isfinite(camera.cx) &&
                  std::isfinite(camera.cy);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) finite = finite && std::isfinite(camera.world_from_camera[column][row]);
    }
    return finite;
}

bool is_utf8(const std::string& text) {
    try {
        (void)nlohmann::json(text).dump();
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

}  // namespace

Result<Rig> read_rig(const fs::path& path) {
    std::error_code ignored;
    const fs::path file = fs::is_directory(path, ignored) ? path / kRigFileName : path;
    if (!fs::exists(file, ignored)) {
        return Error{file.string() + ": does not exist; give a capture set's folder or its " + kRigFileName};
    }
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(file, kMaxRigFile_bytes));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return parse_rig(text, file.string(), [&](const RigView& first) -> Result<ImageSize> {
        RS_ASSIGN_OR_RETURN(const auto info, read_image_info(image_path(file.parent_path(), first)));
        return ImageSize{info.width, info.height};
    });
}

Status write_rig(const fs::path& transforms_json, const Rig& rig) {
    const std::string where = transforms_json.string();
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const RigView& view = rig.views[i];
        const std::string place = where + ": frame " + std::to_string(i);
        if (!all_finite(view.camera)) return Error{place + ": its camera holds a number that is not finite"};
        if (!is_utf8(view.file_path) || !is_utf8(view.depth_file_path)) {
            return Error{place + ": its image's name is not valid UTF-8; rename the file"};
        }
    }
    if (!std::isfinite(rig.object_radius)) return Error{where + ": the object radius is not finite"};
    if (!std::isfinite(rig.foot_height.value_or(0))) return Error{where + ": the foot's height is not finite"};
    const std::string text = rig_to_json(rig);
    return write_file(transforms_json, text);
}

fs::path image_path(const fs::path& folder, const RigView& view) {
    fs::path as_given = folder / view.file_path;
    std::error_code ignored;
    if (fs::is_regular_file(as_given, ignored)) return as_given;
    fs::path with_extension = as_given;
    with_extension += ".png";
    // If neither exists, the name that a reader would try, for its error message.
    if (fs::is_regular_file(with_extension, ignored) || !as_given.has_extension()) return with_extension;
    return as_given;
}

Rig make_ring(const RingOptions& options) {
    RS_CHECK(options.count >= 1 && options.count <= kMaxViews);
    RS_CHECK(options.distance > 0 && options.fl_px > 0);
    RS_CHECK(std::abs(options.elevation_rad) < kPi / 2);
    const glm::dvec3 target(0, options.look_at_height, 0);
    const double fov_x_rad = 2 * std::atan(options.width / (2 * options.fl_px));
    Rig rig;
    rig.views.reserve(static_cast<std::size_t>(options.count));
    for (int i = 0; i < options.count; ++i) {
        const double turn_rad = options.first_rad + 2 * kPi * i / options.count;
        const glm::dvec3 direction(std::cos(options.elevation_rad) * std::sin(turn_rad),
                                   std::sin(options.elevation_rad),
                                   std::cos(options.elevation_rad) * std::cos(turn_rad));
        RigView view;
        char name[32];
        std::snprintf(name, sizeof name, "images/%04d.png", i);
        view.file_path = name;
        view.camera =
            look_at_camera(target + options.distance * direction, target, fov_x_rad, options.width, options.height);
        // The given value, without a round trip through the angle.
        view.camera.fl_x = options.fl_px;
        view.camera.fl_y = options.fl_px;
        rig.views.push_back(std::move(view));
    }
    return rig;
}

}  // namespace rs
