// Reading and writing of rigs as transforms.json.

#include "rayspace/geometry/rig.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/base/utf8.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig_text.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace rs {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::uint64_t kMaxRigFile_bytes = std::uint64_t{64} << 20;
constexpr std::size_t kMaxPath_bytes = 4096;
constexpr double kMinFocal_px = 1e-3;
constexpr double kMaxFocal_px = 1e7;
constexpr double kMinAngle_rad = 1e-9;  // allows the angle of every possible focal length
constexpr double kMaxPrincipal_px = 1e6;
constexpr double kMaxLength = 1e12;
constexpr double kRigidTolerance = 1e-3;

struct ImageSize {
    int width = 0;  // px
    int height = 0;
};

// Called for the frames whose image size neither the file nor the frame states.
using FindImageSize = std::function<Result<ImageSize>(const RigView& view)>;

// Intrinsics stated by one JSON object, the file or a frame.
struct Intrinsics {
    std::optional<int> w, h;
    std::optional<double> fl_x, fl_y, cx, cy, angle_x_rad, angle_y_rad;
};

// Reads an optional number.
std::optional<double> number_of(JsonObject& object, const char* key, double lowest, double highest) {
    const auto found = object.find(key);
    return found ? std::optional(found->number(lowest, highest)) : std::nullopt;
}

// Reads an optional image side; some tools write integers as 800.0.
std::optional<int> side_of(JsonObject& object, const char* key) {
    const auto found = object.find(key);
    return found ? std::optional(found->whole_number(1, kMaxImageSide_px)) : std::nullopt;
}

std::string path_of(const JsonValue& value) {
    std::string path = value.text_or_empty();
    if (path.size() > kMaxPath_bytes) throw value.wrong("is too long");
    return path;
}

Intrinsics take_intrinsics(JsonObject& object) {
    Intrinsics found;
    found.w = side_of(object, "w");
    found.h = side_of(object, "h");
    found.fl_x = number_of(object, "fl_x", kMinFocal_px, kMaxFocal_px);
    found.fl_y = number_of(object, "fl_y", kMinFocal_px, kMaxFocal_px);
    found.cx = number_of(object, "cx", -kMaxPrincipal_px, kMaxPrincipal_px);
    found.cy = number_of(object, "cy", -kMaxPrincipal_px, kMaxPrincipal_px);
    found.angle_x_rad = number_of(object, "camera_angle_x", kMinAngle_rad, kPi - kMinAngle_rad);
    found.angle_y_rad = number_of(object, "camera_angle_y", kMinAngle_rad, kPi - kMinAngle_rad);
    return found;
}

double focal_from_angle(int side_px, double angle_rad) {
    return side_px / (2 * std::tan(angle_rad / 2));
}

// Precedence: focal length before angle, frame before file.
std::optional<double> choose_focal(const std::optional<double>& frame_focal, const std::optional<double>& frame_angle,
                                   const std::optional<double>& file_focal, const std::optional<double>& file_angle,
                                   int side_px) {
    if (frame_focal) return frame_focal;
    if (frame_angle) return focal_from_angle(side_px, *frame_angle);
    if (file_focal) return file_focal;
    if (file_angle) return focal_from_angle(side_px, *file_angle);
    return std::nullopt;
}

void apply_intrinsics(const Intrinsics& frame, const Intrinsics& file, const JsonValue& place, Camera& camera) {
    camera.width = frame.w.value_or(file.w.value_or(0));
    camera.height = frame.h.value_or(file.h.value_or(0));
    if (camera.width == 0 || camera.height == 0) {
        throw place.wrong("has no w and h; add the images' width and height in pixels");
    }
    const auto fl_x = choose_focal(frame.fl_x, frame.angle_x_rad, file.fl_x, file.angle_x_rad, camera.width);
    const auto fl_y = choose_focal(frame.fl_y, frame.angle_y_rad, file.fl_y, file.angle_y_rad, camera.height);
    if (!fl_x && !fl_y) throw place.wrong("has no fl_x or camera_angle_x; add the focal length in pixels");
    camera.fl_x = fl_x ? *fl_x : *fl_y;
    camera.fl_y = fl_y ? *fl_y : *fl_x;
    if (!(std::min(camera.fl_x, camera.fl_y) >= kMinFocal_px && std::max(camera.fl_x, camera.fl_y) <= kMaxFocal_px)) {
        throw place.wrong("its angle of view makes a focal length that is out of range");
    }
    camera.cx = frame.cx.value_or(file.cx.value_or(camera.width / 2.0));
    camera.cy = frame.cy.value_or(file.cy.value_or(camera.height / 2.0));
}

// Reads a matrix of three rows, or of four with 0 0 0 1 as the last.
glm::dmat4 matrix_of(const JsonValue& rows) {
    glm::dmat4 matrix(1.0);
    const std::size_t count = rows.list_size(3, 4);
    for (std::size_t row = 0; row < count; ++row) {
        const JsonValue numbers = rows.item(row);
        numbers.list_size(4, 4);
        for (std::size_t column = 0; column < 4; ++column) {
            matrix[static_cast<int>(column)][static_cast<int>(row)] =
                numbers.item(column).number(-kMaxLength, kMaxLength);
        }
    }
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1) {
        throw rows.wrong("must have 0 0 0 1 as its last row");
    }
    return matrix;
}

// `assumed`: size of the frames without an image; 0 for the first frame, which sets it and needs its image.
RigView parse_frame(JsonObject frame, const FindImageSize& find_size, const Intrinsics& file, ImageSize& assumed) {
    RigView view;
    view.file_path = path_of(frame.take("file_path"));
    if (view.file_path.empty()) throw frame.wrong("file_path is empty; a frame needs the name of its image");
    if (const auto depth = frame.find("depth_file_path")) view.depth_file_path = path_of(*depth);
    const JsonValue matrix = frame.take("transform_matrix");
    view.camera.world_from_camera = matrix_of(matrix);
    const double error = rotation_error(view.camera);
    if (!(error <= kRigidTolerance)) {
        throw matrix.wrong(
            "is not a rotation and a translation (it scales, shears or mirrors); remove the scale or the mirroring");
    }
    Intrinsics own = take_intrinsics(frame);
    if (find_size && !((own.w || file.w) && (own.h || file.h))) {
        const auto size = find_size(view);
        if (!size && assumed.width == 0) {
            throw frame.wrong("has no w and h, and they cannot be read from its image: " + size.error().message);
        }
        if (assumed.width == 0) assumed = *size;
        own.w = size ? size->width : assumed.width;
        own.h = size ? size->height : assumed.height;
    }
    apply_intrinsics(own, file, frame, view.camera);
    view.extras = frame.take_rest();
    return view;
}

void put_intrinsics(ordered_json& object, const Camera& camera) {
    object["w"] = camera.width;
    object["h"] = camera.height;
    object["fl_x"] = camera.fl_x;
    object["fl_y"] = camera.fl_y;
    object["cx"] = camera.cx;
    object["cy"] = camera.cy;
    // Redundant, but the only intrinsics that old NeRF loaders read.
    object["camera_angle_x"] = 2 * std::atan(camera.width / (2 * camera.fl_x));
}

bool same_intrinsics(const Camera& a, const Camera& b) {
    return a.width == b.width && a.height == b.height && a.fl_x == b.fl_x && a.fl_y == b.fl_y && a.cx == b.cx &&
           a.cy == b.cy;
}

// Keys of this project take precedence over extras of the same name.
void put_extras(ordered_json& object, const json& extras) {
    if (!extras.is_object()) return;
    for (const auto& [key, value] : extras.items()) {
        if (!object.contains(key)) object[key] = value;
    }
}

ordered_json frame_to_json(const RigView& view, bool own_intrinsics) {
    ordered_json frame = ordered_json::object();
    frame["file_path"] = view.file_path;
    if (!view.depth_file_path.empty()) frame["depth_file_path"] = view.depth_file_path;
    if (own_intrinsics) put_intrinsics(frame, view.camera);
    ordered_json rows = ordered_json::array();
    for (int row = 0; row < 4; ++row) {
        ordered_json numbers = ordered_json::array();
        for (int column = 0; column < 4; ++column) numbers.push_back(view.camera.world_from_camera[column][row]);
        rows.push_back(std::move(numbers));
    }
    frame["transform_matrix"] = std::move(rows);
    put_extras(frame, view.extras);
    return frame;
}

std::string dump_json(const ordered_json& value) {
    // Names that are not UTF-8 must not throw here; write_rig() rejects them before.
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Result<Rig> parse_rig(const std::string& text, const std::string& where, const FindImageSize& find_size) {
    return read_json(text, where, [&](JsonObject& top) {
        if (!top.has("frames")) throw top.wrong("frames is missing; is this a transforms.json?");
        const Intrinsics file = take_intrinsics(top);
        Rig rig;
        top.read("object_radius", rig.object_radius, 0, kMaxLength);
        rig.foot_height = number_of(top, "foot_height", -kMaxLength, kMaxLength);
        const JsonValue frames = top.take("frames");
        rig.views.resize(frames.list_size(1, kMaxViews));
        ImageSize assumed;
        for (std::size_t i = 0; i < rig.views.size(); ++i) {
            rig.views[i] = parse_frame(JsonObject(frames.item(i)), find_size, file, assumed);
        }
        rig.extras = top.take_rest();
        return rig;
    });
}

bool all_finite(const Camera& camera) {
    bool finite = std::isfinite(camera.fl_x) && std::isfinite(camera.fl_y) && std::isfinite(camera.cx) &&
                  std::isfinite(camera.cy);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) finite = finite && std::isfinite(camera.world_from_camera[column][row]);
    }
    return finite;
}

}  // namespace

fs::path rig_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored) ? path / kRigFileName : path;
}

Result<Rig> read_rig(const fs::path& path) {
    std::error_code ignored;
    const fs::path file = rig_file(path);
    if (!fs::exists(file, ignored)) {
        // NeRF's data has one file for each use of its images.
        const fs::path training = path / "transforms_train.json";
        if (fs::exists(training, ignored)) {
            return Error{file.string() + ": does not exist; give " + training.string() + ", which does"};
        }
        return Error{file.string() + ": does not exist; give a capture set's folder or its " + kRigFileName};
    }
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(file, kMaxRigFile_bytes));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return parse_rig(text, file.string(), [&](const RigView& first) -> Result<ImageSize> {
        RS_ASSIGN_OR_RETURN(const auto info, read_image_info(image_path(file.parent_path(), first)));
        return ImageSize{info.width, info.height};
    });
}

Result<Rig> rig_from_json(const std::string& text, const std::string& where) {
    return parse_rig(text, where, nullptr);
}

Status check_rig_text(const std::string& json, std::size_t views) {
    RS_ASSIGN_OR_RETURN(const Rig rig, rig_from_json(json, "rig"));
    if (rig.views.size() != views) return Error{"its rig does not have as many frames as views"};
    return {};
}

// One line per key and per frame, which is compact and easy to compare.
std::string rig_to_json(const Rig& rig) {
    const bool shared = !rig.views.empty() && std::all_of(rig.views.begin(), rig.views.end(), [&](const RigView& view) {
        return same_intrinsics(view.camera, rig.views.front().camera);
    });
    ordered_json top = ordered_json::object();
    if (shared) put_intrinsics(top, rig.views.front().camera);
    if (rig.object_radius > 0) top["object_radius"] = rig.object_radius;
    if (rig.foot_height) top["foot_height"] = *rig.foot_height;
    put_extras(top, rig.extras);
    top.erase("frames");

    std::string text = "{\n";
    for (const auto& [key, value] : top.items()) text += "  " + dump_json(key) + ": " + dump_json(value) + ",\n";
    text += "  \"frames\": [";
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        text += (i == 0 ? "\n    " : ",\n    ") + dump_json(frame_to_json(rig.views[i], !shared));
    }
    return text + "\n  ]\n}\n";
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

}  // namespace rs
