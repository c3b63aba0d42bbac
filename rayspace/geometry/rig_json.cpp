#include "rayspace/geometry/rig_json.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/json_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kMaxPath_bytes = 4096;
constexpr double kMinFocal_px = 1e-3;
constexpr double kMaxFocal_px = 1e7;
constexpr double kMinAngle_rad =
    1e-9;  // so small, and so near to pi, that the angle of every possible focal length passes
constexpr double kMaxPrincipal_px = 1e6;
constexpr double kMaxLength = 1e12;
constexpr double kRigidTolerance = 1e-3;

// Every number a camera needs; thrown inside this file only, so that the parser reads straight through.
struct Malformed {
    std::string message;
};

// An object whose known keys are taken one by one; what is left over are the extras.
class Keys {
public:
    Keys(json object, std::string place) : object_(std::move(object)), place_(std::move(place)) {
        if (!object_.is_object()) throw Malformed{place_ + ": must be an object { ... }"};
    }

    [[nodiscard]] const std::string& place() const { return place_; }
    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] Malformed wrong(const char* key, const std::string& what) const {
        return Malformed{place_ + ": " + key + " " + what};
    }

    json take(const char* key) {
        json value = std::move(object_[key]);
        object_.erase(key);
        return value;
    }

    std::optional<double> take_number(const char* key, double lowest, double highest) {
        if (!has(key)) return std::nullopt;
        const json value = take(key);
        if (!value.is_number()) throw wrong(key, "must be a number");
        const double number = value.get<double>();
        // NaN fails this comparison too.
        if (!(number >= lowest && number <= highest)) throw wrong(key, "is out of range");
        return number;
    }

    // Some tools write whole numbers as 800.0.
    std::optional<int> take_side(const char* key) {
        const auto number = take_number(key, 1, kMaxPictureSide_px);
        if (!number) return std::nullopt;
        if (*number != std::floor(*number)) throw wrong(key, "must be a whole number of pixels");
        return static_cast<int>(*number);
    }

    std::optional<std::string> take_path(const char* key) {
        if (!has(key)) return std::nullopt;
        const json value = take(key);
        if (!value.is_string()) throw wrong(key, "must be a string");
        auto path = value.get<std::string>();
        if (path.size() > kMaxPath_bytes) throw wrong(key, "is too long");
        if (path.find('\0') != std::string::npos) throw wrong(key, "holds a zero character");
        return path;
    }

    json rest() && { return std::move(object_); }

private:
    json object_;
    std::string place_;
};

// What one object, the file or a frame, states about the lens.
struct Intrinsics {
    std::optional<int> w, h;
    std::optional<double> fl_x, fl_y, cx, cy, angle_x_rad, angle_y_rad;
};

Intrinsics take_intrinsics(Keys& keys) {
    Intrinsics found;
    found.w = keys.take_side("w");
    found.h = keys.take_side("h");
    found.fl_x = keys.take_number("fl_x", kMinFocal_px, kMaxFocal_px);
    found.fl_y = keys.take_number("fl_y", kMinFocal_px, kMaxFocal_px);
    found.cx = keys.take_number("cx", -kMaxPrincipal_px, kMaxPrincipal_px);
    found.cy = keys.take_number("cy", -kMaxPrincipal_px, kMaxPrincipal_px);
    found.angle_x_rad = keys.take_number("camera_angle_x", kMinAngle_rad, kPi - kMinAngle_rad);
    found.angle_y_rad = keys.take_number("camera_angle_y", kMinAngle_rad, kPi - kMinAngle_rad);
    return found;
}

double focal_from_angle(int side_px, double angle_rad) {
    return side_px / (2 * std::tan(angle_rad / 2));
}

// A focal length outranks an angle, and a frame outranks the file.
std::optional<double> choose_focal(const std::optional<double>& frame_focal, const std::optional<double>& frame_angle,
                                   const std::optional<double>& file_focal, const std::optional<double>& file_angle,
                                   int side_px) {
    if (frame_focal) return frame_focal;
    if (frame_angle) return focal_from_angle(side_px, *frame_angle);
    if (file_focal) return file_focal;
    if (file_angle) return focal_from_angle(side_px, *file_angle);
    return std::nullopt;
}

void apply_intrinsics(const Intrinsics& frame, const Intrinsics& file, const std::string& place, Camera& camera) {
    camera.width = frame.w.value_or(file.w.value_or(0));
    camera.height = frame.h.value_or(file.h.value_or(0));
    if (camera.width == 0 || camera.height == 0) {
        throw Malformed{place + ": has no w and h; add the pictures' width and height in pixels"};
    }
    const auto fl_x = choose_focal(frame.fl_x, frame.angle_x_rad, file.fl_x, file.angle_x_rad, camera.width);
    const auto fl_y = choose_focal(frame.fl_y, frame.angle_y_rad, file.fl_y, file.angle_y_rad, camera.height);
    if (!fl_x && !fl_y) throw Malformed{place + ": has no fl_x or camera_angle_x; add the focal length in pixels"};
    camera.fl_x = fl_x ? *fl_x : *fl_y;
    camera.fl_y = fl_y ? *fl_y : *fl_x;
    if (!(std::min(camera.fl_x, camera.fl_y) >= kMinFocal_px && std::max(camera.fl_x, camera.fl_y) <= kMaxFocal_px)) {
        throw Malformed{place + ": its angle of view makes a focal length that is out of range"};
    }
    camera.cx = frame.cx.value_or(file.cx.value_or(camera.width / 2.0));
    camera.cy = frame.cy.value_or(file.cy.value_or(camera.height / 2.0));
}

glm::dmat4 take_matrix(Keys& keys) {
    constexpr const char* kKey = "transform_matrix";
    if (!keys.has(kKey)) throw keys.wrong(kKey, "is missing; a frame needs its camera-to-world matrix");
    const json rows = keys.take(kKey);
    const auto four_numbers = [](const json& row) {
        return row.is_array() && row.size() == 4 &&
               std::all_of(row.begin(), row.end(), [](const json& n) { return n.is_number(); });
    };
    if (!rows.is_array() || (rows.size() != 4 && rows.size() != 3) ||
        !std::all_of(rows.begin(), rows.end(), four_numbers)) {
        throw keys.wrong(kKey, "must be 4 rows of 4 numbers");
    }
    glm::dmat4 matrix(1.0);
    for (std::size_t row = 0; row < rows.size(); ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            const double number = rows[row][column].get<double>();
            if (!(std::abs(number) <= kMaxLength)) throw keys.wrong(kKey, "holds a number that is out of range");
            matrix[static_cast<int>(column)][static_cast<int>(row)] = number;
        }
    }
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1) {
        throw keys.wrong(kKey, "must have 0 0 0 1 as its last row");
    }
    return matrix;
}

RigView parse_frame(json frame, const std::string& place, const FindPictureSize& find_size, bool first,
                    Intrinsics& file) {
    Keys keys(std::move(frame), place);
    RigView view;
    const auto path = keys.take_path("file_path");
    if (!path || path->empty()) throw keys.wrong("file_path", "is missing; a frame needs the name of its picture");
    view.file_path = *path;
    view.depth_file_path = keys.take_path("depth_file_path").value_or("");
    view.camera.world_from_camera = take_matrix(keys);
    const double error = rotation_error(view.camera);
    if (!(error <= kRigidTolerance)) {
        throw keys.wrong("transform_matrix",
                         "is not a rotation and a translation (it scales, shears or mirrors); remove the scale");
    }
    const Intrinsics own = take_intrinsics(keys);
    if (first && find_size && !((own.w || file.w) && (own.h || file.h))) {
        const auto size = find_size(view);
        if (!size)
            throw Malformed{place + ": has no w and h, and its picture does not tell them: " + size.error().message};
        file.w = size->width;
        file.h = size->height;
    }
    apply_intrinsics(own, file, place, view.camera);
    view.extras = std::move(keys).rest();
    return view;
}

void put_intrinsics(ordered_json& object, const Camera& camera) {
    object["w"] = camera.width;
    object["h"] = camera.height;
    object["fl_x"] = camera.fl_x;
    object["fl_y"] = camera.fl_y;
    object["cx"] = camera.cx;
    object["cy"] = camera.cy;
    // Redundant, but all that the oldest NeRF loaders look at.
    object["camera_angle_x"] = 2 * std::atan(camera.width / (2 * camera.fl_x));
}

bool same_intrinsics(const Camera& a, const Camera& b) {
    return a.width == b.width && a.height == b.height && a.fl_x == b.fl_x && a.fl_y == b.fl_y && a.cx == b.cx &&
           a.cy == b.cy;
}

// Keys of ours win over extras of the same name.
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

std::string dumped(const ordered_json& value) {
    // Names that are no UTF-8 must not throw here; write_rig() refuses them beforehand.
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

Result<Rig> parse_rig(const std::string& text, const std::string& where, const FindPictureSize& find_size) {
    try {
        Result<json> parsed = parse_json(text, where);
        if (!parsed) return parsed.error();
        Keys keys(std::move(*parsed), where);
        if (!keys.has("frames")) throw keys.wrong("frames", "is missing; is this a transforms.json?");
        Intrinsics file = take_intrinsics(keys);
        Rig rig;
        rig.object_radius = keys.take_number("object_radius", 0, kMaxLength).value_or(0);
        rig.foot_height = keys.take_number("foot_height", -kMaxLength, kMaxLength);
        json frames = keys.take("frames");
        if (!frames.is_array() || frames.empty()) throw keys.wrong("frames", "must be a list with at least one frame");
        if (frames.size() > kMaxViews) {
            throw keys.wrong("frames", "holds " + std::to_string(frames.size()) + " frames; at most " +
                                           std::to_string(kMaxViews) + " are read");
        }
        rig.views.reserve(frames.size());
        for (json& frame : frames) {
            const std::string place = where + ": frame " + std::to_string(rig.views.size());
            rig.views.push_back(parse_frame(std::move(frame), place, find_size, rig.views.empty(), file));
        }
        rig.extras = std::move(keys).rest();
        return rig;
    } catch (const Malformed& malformed) {
        return Error{malformed.message};
    }
}

Result<Rig> rig_from_json(const std::string& text, const std::string& where) {
    return parse_rig(text, where, nullptr);
}

// One line per key and per frame: short, and still good to read and to compare.
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
    for (const auto& [key, value] : top.items()) text += "  " + dumped(key) + ": " + dumped(value) + ",\n";
    text += "  \"frames\": [";
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        text += (i == 0 ? "\n    " : ",\n    ") + dumped(frame_to_json(rig.views[i], !shared));
    }
    return text + "\n  ]\n}\n";
}

}  // namespace rs
