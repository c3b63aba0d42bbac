#include "capture/calibration/known/known_files.hpp"

#include "capture/calibration/model/turntable_fit.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/geometry/rig_lens.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

namespace rs::capture {

Result<double> common_focal_length(double fx_px, double fy_px, const std::string& where) {
    if (!(fx_px > 1e-3 && fy_px > 1e-3 && fx_px < 1e7 && fy_px < 1e7)) {
        return Error{where + ": its focal length is out of range; check that it is in pixels"};
    }
    const double f_px = (fx_px + fy_px) / 2;
    if (std::abs(fx_px - fy_px) > kSquarePixels * f_px) {
        return Error{where + ": its focal lengths " + std::to_string(fx_px) + " and " + std::to_string(fy_px) +
                     " differ by more than 1 %; scale the images to square pixels, and calibrate those"};
    }
    return f_px;
}

Status set_turntable(KnownInputs& known, std::span<const glm::dmat4> world_from_camera, const std::string& where) {
    RS_ASSIGN_OR_RETURN(const auto turn, fit_turn_to_cameras(world_from_camera, where));
    known.pose = turn.pose;
    known.angles_rad = turn.angles_rad;
    known.counter_clockwise = median_step(turn.angles_rad) > 0;
    return {};
}

namespace {

constexpr std::uint64_t kMaxMiddlebury_bytes = std::uint64_t{16} << 20;
constexpr std::size_t kMaxName_bytes = 4096;
constexpr std::size_t kNumbersPerView = 21;
constexpr double kMaxNumber = 1e9;
constexpr double kRigidTolerance = 1e-3;
constexpr double kSameIntrinsics = 1e-4;  // relative to f

// Splits a line at blanks; a line ends at '
// ' or "\r
// ".
class Words {
public:
    explicit Words(std::string_view line) : rest_(line) {}
    std::string_view next() {
        constexpr std::string_view kBlanks = " \t\r";
        const std::size_t first = rest_.find_first_not_of(kBlanks);
        if (first == std::string_view::npos) {
            rest_ = {};
            return {};
        }
        rest_.remove_prefix(first);
        const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
        rest_.remove_prefix(word.size());
        return word;
    }

private:
    std::string_view rest_;
};

std::optional<double> number_from(std::string_view word) {
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    // NaN fails the comparison too.
    if (error != std::errc{} || end != word.data() + word.size() || !(std::abs(number) <= kMaxNumber)) return {};
    return number;
}

std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

Result<MiddleburyView> view_from(std::string_view line, const std::string& place) {
    Words words(line);
    MiddleburyView view;
    view.name = std::string(words.next());
    if (view.name.empty()) return Error{place + " is empty; a view's name and 21 numbers are expected"};
    if (view.name.size() > kMaxName_bytes) return Error{place + ": the image's name is too long"};
    std::array<double, kNumbersPerView> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::string_view word = words.next();
        const auto number = number_from(word);
        if (!number) {
            return Error{place + ": number " + std::to_string(i + 1) +
                         (word.empty() ? " is missing" : " is not a finite number") +
                         "; a view's name, k11..k33, r11..r33 and t1..t3 are expected"};
        }
        numbers[i] = *number;
    }
    if (!words.next().empty()) return Error{place + " has more than a name and 21 numbers"};

    std::copy_n(numbers.begin(), 9, view.k.begin());
    // p_in_camera = R p + t with y down and z forward: rows right, down, forward. The camera axes here are right, up,
    // back.
    const auto row = [&](std::size_t r) {
        return glm::dvec3(numbers[9 + 3 * r], numbers[10 + 3 * r], numbers[11 + 3 * r]);
    };
    const glm::dvec3 t(numbers[18], numbers[19], numbers[20]);
    view.world_from_camera[0] = glm::dvec4(row(0), 0);
    view.world_from_camera[1] = glm::dvec4(-row(1), 0);
    view.world_from_camera[2] = glm::dvec4(-row(2), 0);
    view.world_from_camera[3] = glm::dvec4(-(row(0) * t.x + row(1) * t.y + row(2) * t.z), 1);
    Camera rotation;
    rotation.world_from_camera = view.world_from_camera;
    if (!(rotation_error(rotation) <= kRigidTolerance)) return Error{place + ": r11..r33 is not a rotation"};
    return view;
}

Status set_lens(KnownInputs& known, const MiddleburyView& first, const std::string& where) {
    const auto& k = first.k;
    RS_TRY(check_middlebury_lens(first, where));
    RS_ASSIGN_OR_RETURN(const auto f_px, common_focal_length(k[0], k[4], where));
    known.f_px = f_px;
    known.principal_point = glm::dvec2(k[2] + 0.5, k[5] + 0.5);
    known.distortion = glm::dvec2(0);
    return {};
}

// Distortion coefficients as NeRF tools write them beside the intrinsics.
Result<glm::dvec2> distortion_of(const nlohmann::json& extras, const std::string& where) {
    if (const StatedLens lens = stated_lens(extras, nlohmann::json::object()); lens.kind != LensKind::kPinhole) {
        const std::string posed = lens.kind == LensKind::kFisheye ? "give --posed, or " : "";
        return Error{where + ": " + lens.stated + " is not a pinhole with k1 and k2; " + posed +
                     "undistort the images"};
    }
    const auto coefficient = [&](const char* key) -> Result<double> {
        if (!extras.contains(key)) return 0.0;
        if (!extras[key].is_number()) return Error{where + ": " + key + " must be a number"};
        return extras[key].get<double>();
    };
    for (const char* key : {"k3", "k4", "k5", "k6", "p1", "p2"}) {
        RS_ASSIGN_OR_RETURN(const auto value, coefficient(key));
        if (value != 0) {
            return Error{where + ": distortion " + key + " = " + std::to_string(value) +
                         " is not supported, only k1 and k2; calibrate with those alone or undistort the images"};
        }
    }
    RS_ASSIGN_OR_RETURN(const double k1, coefficient(extras.contains("k1") ? "k1" : "k"));
    RS_ASSIGN_OR_RETURN(const double k2, coefficient("k2"));
    return glm::dvec2(k1, k2);
}

}  // namespace

Status check_middlebury_lens(const MiddleburyView& view, const std::string& where) {
    const auto& k = view.k;
    if (std::abs(k[8] - 1) > 1e-9 || k[3] != 0 || k[6] != 0 || k[7] != 0) {
        return Error{where + ": K is not of the form fx s cx, 0 fy cy, 0 0 1"};
    }
    if (std::abs(k[1]) > 1e-3 * std::abs(k[0])) return Error{where + ": K has skew, which is not supported"};
    return {};
}

Result<std::vector<MiddleburyView>> middlebury_views_from(const std::string& text, const std::string& where) {
    std::string_view rest = text;
    Words head(take_line(rest));
    const auto count = number_from(head.next());
    if (!count || !(*count >= 1 && *count <= kMaxViews) || *count != std::floor(*count) || !head.next().empty()) {
        return Error{where + ": line 1 must be the number of views, 1 to " + std::to_string(kMaxViews)};
    }
    std::vector<MiddleburyView> views;
    for (int i = 0; i < static_cast<int>(*count); ++i) {
        RS_ASSIGN_OR_RETURN(auto view, view_from(take_line(rest), where + ": line " + std::to_string(i + 2)));
        views.push_back(std::move(view));
    }
    if (rest.find_first_not_of(" \t\r\n") != std::string_view::npos) {
        return Error{where + ": has more lines than the " + std::to_string(views.size()) + " views that line 1 states"};
    }
    return views;
}

Result<KnownFile> middlebury_parameters_from(const std::string& text, const std::string& where) {
    RS_ASSIGN_OR_RETURN(std::vector<MiddleburyView> views, middlebury_views_from(text, where));
    for (std::size_t i = 1; i < views.size(); ++i) {
        for (std::size_t k = 0; k < 9; ++k) {
            if (std::abs(views[i].k[k] - views[0].k[k]) > kSameIntrinsics * std::abs(views[0].k[0])) {
                return Error{where + ": line " + std::to_string(i + 2) +
                             ": K differs from the first view's; all views of a turn must have one lens"};
            }
        }
    }
    KnownFile file;
    RS_TRY(set_lens(file.known, views[0], where));
    std::vector<glm::dmat4> cameras;
    for (MiddleburyView& view : views) {
        cameras.push_back(view.world_from_camera);
        file.images.push_back(std::move(view.name));
    }
    RS_TRY(set_turntable(file.known, cameras, where));
    return file;
}

Result<std::vector<MiddleburyView>> read_middlebury_views(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxMiddlebury_bytes));
    return middlebury_views_from({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

Result<KnownFile> read_middlebury_parameters(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxMiddlebury_bytes));
    return middlebury_parameters_from({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

Result<KnownFile> read_known_rig(const std::filesystem::path& path, ImagePixels images) {
    RS_ASSIGN_OR_RETURN(const auto rig, read_rig(path));
    const std::string where = path.string();
    if (rig.views.empty()) return Error{where + ": has no views"};
    const Camera& first = rig.views[0].camera;
    RS_ASSIGN_OR_RETURN(const auto f_px, common_focal_length(first.fl_x, first.fl_y, where));
    if (images.width > 0 && (first.width != images.width || first.height != images.height)) {
        return Error{where + ": is for images of " + std::to_string(first.width) + " x " +
                     std::to_string(first.height) + " pixels, these have " + std::to_string(images.width) + " x " +
                     std::to_string(images.height) + "; use images of the size it was made for"};
    }
    RS_ASSIGN_OR_RETURN(const auto distortion, distortion_of(rig.extras, where));

    KnownFile file;
    std::vector<glm::dmat4> cameras;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const RigView& view = rig.views[i];
        const Camera& camera = view.camera;
        const double limit = kSameIntrinsics * f_px;
        const bool same = camera.width == first.width && camera.height == first.height &&
                          std::abs(camera.fl_x - first.fl_x) <= limit && std::abs(camera.fl_y - first.fl_y) <= limit &&
                          std::abs(camera.cx - first.cx) <= limit && std::abs(camera.cy - first.cy) <= limit;
        RS_ASSIGN_OR_RETURN(const auto own, distortion_of(view.extras, where));
        if (!same || own != glm::dvec2(0)) {
            return Error{where + ": view " + std::to_string(i + 1) +
                         " has a lens of its own; all views of a turn must have one lens"};
        }
        cameras.push_back(camera.world_from_camera);
        file.images.push_back(view.file_path);
    }
    file.known.f_px = f_px;
    file.known.principal_point = glm::dvec2(first.cx, first.cy);
    file.known.distortion = distortion;
    RS_TRY(set_turntable(file.known, cameras, where));
    return file;
}

bool is_opencv_intrinsics(const std::filesystem::path& path) {
    const std::string ending = lower_case_extension(path);
    return ending == ".yml" || ending == ".yaml" || ending == ".xml";
}

Result<KnownFile> read_known_file(const std::filesystem::path& path, ImagePixels images) {
    const std::string ending = lower_case_extension(path);
    std::error_code failure;
    if (ending == ".json" || std::filesystem::is_directory(path, failure)) return read_known_rig(path, images);
    if (is_opencv_intrinsics(path)) return read_opencv_intrinsics(path, images);
    if (ending == ".txt") return read_middlebury_parameters(path);
    return Error{path.string() +
                 ": unknown file type; give a transforms.json, a *_par.txt (Middlebury) or a *.yml, *.yaml or "
                 "*.xml (OpenCV)"};
}

Result<KnownInputs> known_inputs_of(const KnownFile& file, const std::vector<std::string>& photos) {
    KnownInputs known = file.known;
    if (!known.angles_rad || file.images.empty()) return known;
    std::map<std::string, double> angle_of;
    for (std::size_t i = 0; i < file.images.size() && i < known.angles_rad->size(); ++i) {
        angle_of[std::filesystem::path(file.images[i]).stem().string()] = (*known.angles_rad)[i];
    }
    std::vector<double> angles;
    for (const std::string& photo : photos) {
        const auto found = angle_of.find(std::filesystem::path(photo).stem().string());
        if (found == angle_of.end()) {
            return Error{photo + ": is not among the " + std::to_string(angle_of.size()) +
                         " images of the given rig; remove it from the folder, or give its rig"};
        }
        angles.push_back(found->second);
    }
    // Angles are relative to the first photo; the pose of the camera in the table frame does not change.
    for (double& angle : angles) angle -= angle_of.at(std::filesystem::path(photos.front()).stem().string());
    known.angles_rad = std::move(angles);
    return known;
}

}  // namespace rs::capture
