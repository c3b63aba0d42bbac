#include "capture/posed/cameras/camera_file.hpp"

#include "capture/calibration/known/known_files.hpp"
#include "capture/posed/cameras/colmap_model.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/geometry/rig_lens.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// In the order of LensDistortion::coefficients.
constexpr std::array kRadialTangentialKeys = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
constexpr std::array kFisheyeKeys = {"k1", "k2", "k3", "k4"};

Result<double> coefficient_of(const json& file, const json& frame, const char* key, const std::string& place) {
    const json value = stated_key(file, frame, key);
    if (value.is_null()) return 0.0;
    if (!value.is_number()) return Error{place + ": " + key + " must be a number"};
    return value.get<double>();
}

// Keeps the first of frames that repeat each other.
Status add_camera(PosedModel& model, std::map<std::string, std::size_t>& index_of, PosedCamera camera,
                  const std::string& place) {
    const auto [known, is_new] = index_of.try_emplace(camera.photo, model.cameras.size());
    if (!is_new) {
        const glm::dmat4& first = model.cameras[known->second].camera.world_from_camera;
        if (first == camera.camera.world_from_camera) return {};
        return Error{place + " has the image of an earlier one (" + printable(camera.photo) +
                     ") and another camera; correct one of them"};
    }
    model.cameras.push_back(std::move(camera));
    return {};
}

Status add_transforms(const fs::path& path, PosedModel& model, std::map<std::string, std::size_t>& index_of) {
    RS_ASSIGN_OR_RETURN(const Rig rig, read_rig(path));
    const std::string where = rig_file(path).string();
    if (model.cameras.size() + rig.views.size() > kMaxViews) {
        return Error{where + ": more than " + std::to_string(kMaxViews) + " frames; split the set"};
    }
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const RigView& view = rig.views[i];
        const std::string place = where + ": frame " + std::to_string(i);
        PosedCamera camera{view.file_path, {}, view.camera, {}};
        std::ranges::replace(camera.photo, '\\', '/');
        if (const json mask = stated_key({}, view.extras, "mask_path"); mask.is_string()) camera.mask_path = mask;
        RS_ASSIGN_OR_RETURN(camera.distortion, lens_distortion_of(rig.extras, view.extras, place));
        RS_TRY(check_lens(camera, place));
        RS_TRY(add_camera(model, index_of, std::move(camera), place));
    }
    return {};
}

Result<PosedModel> read_transforms(const std::vector<fs::path>& paths, const fs::path& path) {
    PosedModel model{path.string(), {}, true};
    std::map<std::string, std::size_t> index_of;
    for (const fs::path& file : paths) RS_TRY(add_transforms(file, model, index_of));
    return model;
}

Result<PosedModel> read_middlebury_cameras(const fs::path& path) {
    RS_ASSIGN_OR_RETURN(const std::vector<MiddleburyView> views, read_middlebury_views(path));
    PosedModel model{path.string(), {}, false};
    std::map<std::string, std::size_t> index_of;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const MiddleburyView& view = views[i];
        const std::string place = path.string() + ": line " + std::to_string(i + 2);
        RS_TRY(check_middlebury_lens(view, place));
        PosedCamera camera;
        camera.photo = view.name;
        // The file has no image size; the origin is the centre of the first pixel.
        camera.camera = {0, 0, view.k[0], view.k[4], view.k[2] + 0.5, view.k[5] + 0.5, view.world_from_camera};
        PosedCamera sized = camera;
        sized.camera.width = sized.camera.height = 1;
        RS_TRY(check_lens(sized, place));
        RS_TRY(add_camera(model, index_of, std::move(camera), place));
    }
    return model;
}

Result<PosedModel> read_camera_folder(const fs::path& folder) {
    std::error_code failure;
    if (fs::exists(folder / kRigFileName, failure)) return read_transforms({folder}, folder);
    if (const auto model = find_colmap_model(folder)) return read_colmap_model(*model);
    std::vector<fs::path> splits, parameters;
    for (const char* const split : {"transforms_train.json", "transforms_val.json", "transforms_test.json"}) {
        if (fs::exists(folder / split, failure)) splits.push_back(folder / split);
    }
    if (!splits.empty()) return read_transforms(splits, folder);
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure)) {
        if (entry->path().filename().string().ends_with("_par.txt")) parameters.push_back(entry->path());
    }
    if (parameters.size() == 1) return read_middlebury_cameras(parameters.front());
    return Error{folder.string() +
                 ": has no cameras; give a folder with a transforms.json, a COLMAP model (sparse/0) or one *_par.txt"};
}

}  // namespace

Result<LensDistortion> lens_distortion_of(const json& file, const json& frame, const std::string& place) {
    const StatedLens stated = stated_lens(file, frame);
    if (stated.kind == LensKind::kOther) {
        return Error{place + ": " + stated.stated + " is not supported; undistort the photos to pinhole cameras first"};
    }
    LensDistortion lens;
    if (stated.kind == LensKind::kFisheye) lens.model = LensDistortion::Model::kFisheye;
    const bool is_fisheye = lens.model == LensDistortion::Model::kFisheye;
    const std::size_t count = is_fisheye ? kFisheyeKeys.size() : kRadialTangentialKeys.size();
    for (std::size_t i = 0; i < count; ++i) {
        RS_ASSIGN_OR_RETURN(
            lens.coefficients[i],
            coefficient_of(file, frame, is_fisheye ? kFisheyeKeys[i] : kRadialTangentialKeys[i], place));
    }
    if (lens.coefficients[0] == 0) {
        RS_ASSIGN_OR_RETURN(lens.coefficients[0], coefficient_of(file, frame, "k", place));
    }
    return lens;
}

Result<PosedModel> read_camera_file(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return read_camera_folder(path);
    if (const auto model = find_colmap_model(path)) return read_colmap_model(*model);
    const std::string ending = lower_case_extension(path);
    if (ending == ".json") return read_transforms({path}, path);
    if (ending == ".txt") return read_middlebury_cameras(path);
    return Error{path.string() +
                 ": unknown file type; give a transforms.json, a COLMAP model (cameras and images, .txt or .bin) or a "
                 "*_par.txt (Middlebury)"};
}

}  // namespace rs::capture
