#include "capture/photos/report/import_report.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <cmath>
#include <mutex>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

// Replaces invalid UTF-8, which JSON does not allow but file names may contain.
std::string utf8(const std::string& name) {
    return nlohmann::json::parse(nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

// JSON has no infinity: an unknown value (not finite) becomes null.
nlohmann::json finite(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

void describe(const ImportReport& report, nlohmann::json& made) {
    made["calibration"] = to_string(report.method);
    made["segmenter"] = to_string(report.segmenter);
    const bool is_masks = report.segmenter == SegmenterKind::kMasks;
    made["backdrop"] = is_masks ? "masks" : to_string(report.backdrop);
    made["backdrop_from"] = report.backdrop_given || is_masks ? "given" : "pictures";
    const Rgba8& colour = report.backdrop_colour;
    if (report.backdrop != BackgroundKind::kAlpha) made["backdrop_srgb"] = {colour.r, colour.g, colour.b};
    made["turning"] = to_string(report.turning);
    made["degrees_per_view"] = report.step_deg;
    if (!report.dropped_repeat.empty()) made["dropped_repeat"] = utf8(report.dropped_repeat);
    const PhotoFolder& folder = report.folder;
    if (folder.reduction > 1) made["reduced_from"] = {folder.shown_width, folder.shown_height};
    for (const std::string& name : report.left_out) made["left_out"].push_back(utf8(name));
}

void name_views(const ImportReport& report, Rig& rig) {
    std::size_t view = 0;
    for (std::size_t i = 0; i < report.folder.photos.size(); ++i) {
        if (is_left_out(report, i)) continue;
        rig.views[view].file_path = set_image_name(view);
        rig.views[view].extras["source_file"] = utf8(source_name(report, i));
        ++view;
    }
}

// Height of the turntable's surface in the table frame, from a board on it. Nullopt without a level board.
std::optional<double> ground_height(const PhotoCalibration& calibration) {
    constexpr double kLevel = 0.9;
    if (!calibration.board || calibration.board->plane_normal.y < kLevel) return std::nullopt;
    return calibration.board->plane_offset / calibration.board->plane_normal.y;  // on the axis
}

// Makes the nominal rig: equal steps, a level camera, images that are not resampled. `visible` is in px of the photos
// in working size.
Rig nominal_import_rig(const ImportReport& report, const TurnSilhouette::Box& visible) {
    NominalRigOptions nominal;
    nominal.width = report.folder.width;
    nominal.height = report.folder.height;
    nominal.views = report.views;
    nominal.fov_deg = report.nominal.fov_deg;
    nominal.step_deg = report.nominal.step_deg;
    nominal.axis_x_px = report.nominal.axis_x_px;
    nominal.turning = report.nominal.turning;
    Rig rig = make_nominal_rig(nominal, visible);
    name_views(report, rig);
    rig.extras["axis_note"] =
        "Y is the turntable's axis; it appears in the column cx (" + report.nominal.axis_from + ")";
    nlohmann::json& made = rig.extras["photo_import"];
    describe(report, made);
    made["axis_column_px"] = report.nominal.axis_x_px;
    made["axis_from"] = report.nominal.axis_from;
    made["turning_from"] = report.nominal.turning_from;
    made["field_of_view_deg"] = nominal.fov_deg;
    made["field_of_view_from"] = report.nominal.fov_from;
    return rig;
}

// Makes the calibrated rig, without the views of photos that are left out. `visible` is in px of the rectified images.
Rig calibrated_import_rig(const ImportReport& report, const TurnSilhouette::Box& visible) {
    const Calibration& calibration = *report.calibration.calibration;
    const TurntableModel& model = calibration.model;
    Rig rig = make_rig(model, report.frame, visible, ground_height(report.calibration));
    std::vector<RigView> kept;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        if (!is_left_out(report, i)) kept.push_back(std::move(rig.views[i]));
    }
    rig.views = std::move(kept);
    name_views(report, rig);
    rig.extras["axis_note"] = "Y is the turntable's axis; it appears in the column cx";
    nlohmann::json& made = rig.extras["photo_import"];
    describe(report, made);
    made["rms_px"] = calibration.rms_px;
    if (calibration.held_out_rms_px) made["held_out_rms_px"] = *calibration.held_out_rms_px;
    // Camera of the original photos, in the convention of capture/calibration/model/turntable_model.hpp.
    const ModelDeviations& off = calibration.deviations;
    nlohmann::json& camera = made["photograph_camera"];
    camera["f_px"] = model.lens.f_px;
    camera["cx"] = model.lens.cx;
    camera["cy"] = model.lens.cy;
    camera["k1"] = model.lens.k1;
    camera["k2"] = model.lens.k2;
    camera["pan_deg"] = degrees(model.pose.pan_rad);
    camera["tilt_deg"] = degrees(model.pose.tilt_rad);
    camera["roll_deg"] = degrees(model.pose.roll_rad);
    for (const ImagePlacement& place : calibration.places) {
        made["places"].push_back({{"scale", place.scale}, {"shift_px", {place.shift_px.x, place.shift_px.y}}});
    }
    nlohmann::json& deviations = made["standard_deviations"];
    deviations["f_px"] = finite(off.f_px);
    deviations["k1"] = finite(off.k1);
    deviations["tilt_deg"] = finite(degrees(off.tilt_rad));
    deviations["roll_deg"] = finite(degrees(off.roll_rad));
    deviations["axis_direction_deg"] = finite(degrees(off.axis_direction_rad));
    deviations["axis_position_px"] = finite(off.axis_position_px);
    for (std::size_t i = 0; i < model.angles_rad.size(); ++i) {
        made["angles_deg"].push_back(degrees(model.angles_rad[i]));
        deviations["angles_deg"].push_back(i < off.angles_rad.size() ? finite(degrees(off.angles_rad[i]))
                                                                     : nlohmann::json());
    }
    return rig;
}

// Maps `boxes` from the photos to the images of the fixed camera.
std::vector<TurnSilhouette::Box> boxes_put_back(std::vector<TurnSilhouette::Box> boxes,
                                                const Calibration& calibration) {
    const Lens& lens = calibration.model.lens;
    const glm::dvec2 middle(lens.width / 2.0, lens.height / 2.0);
    for (std::size_t i = 0; i < calibration.places.size(); ++i) {
        TurnSilhouette::Box& box = boxes[i];
        if (box.empty()) continue;
        const glm::dvec2 low = glm::floor(calibration.places[i].undone({box.left, box.top}, middle));
        const glm::dvec2 high = glm::ceil(calibration.places[i].undone({box.right, box.bottom}, middle));
        box = {static_cast<int>(low.x), static_cast<int>(high.x), static_cast<int>(low.y), static_cast<int>(high.y)};
    }
    return boxes;
}

// Writes the rectified images of all views that are not left out. Returns the box of the object over all of them.
Result<TurnSilhouette::Box> write_rectified(const fs::path& set, const PhotoFolder& folder,
                                            const ForegroundCache& foregrounds, const ImportReport& report,
                                            Progress* progress) {
    std::vector<std::size_t> number(folder.photos.size(), 0);  // index in the set
    for (std::size_t i = 0, next = 0; i < folder.photos.size(); ++i) number[i] = is_left_out(report, i) ? 0 : next++;
    const Calibration& calibration = *report.calibration.calibration;
    TurnSilhouette silhouette(report.frame.lens.width, report.frame.lens.height);
    std::mutex mutex;
    const auto work = [&](std::size_t i) -> Status {
        if (is_left_out(report, i)) return {};
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, foregrounds.get(i));
        const Image<Rgba8> upright = rectified(calibration.model, report.frame, image,
                                               calibration.places.empty() ? ImagePlacement{} : calibration.places[i]);
        RS_TRY(write_png(set / set_image_name(number[i]), upright));
        TurnSilhouette own(upright.width(), upright.height());
        own.add(upright);
        const std::lock_guard lock(mutex);
        silhouette.merge(own);
        return {};
    };
    constexpr int kRectifyBytesPerPixel = kReadBytesPerPixel + 40;
    RS_TRY(for_each_photo(folder, kRectifyBytesPerPixel, "rectifying", progress, work));
    return silhouette.visible();
}

Status write_unchanged(const fs::path& set, const PhotoFolder& folder, const ForegroundCache& foregrounds,
                       Progress* progress) {
    const auto write = [&](std::size_t i) -> Status {
        const Result<Image<Rgba8>> image = foregrounds.get(i);
        return image ? write_png(set / set_image_name(i), *image) : Status(image.error());
    };
    return for_each_photo(folder, kReadBytesPerPixel, "writing the images", progress, write);
}

}  // namespace

Result<ImportReport> write_import_set(const fs::path& set, const PhotoFolder& folder, const SegmentedTurn& turn,
                                      const ForegroundCache& foregrounds, ImportReport report, Progress* progress) {
    report.views = static_cast<int>(report.folder.photos.size() - report.left_out.size());
    Rig rig;
    if (const auto& calibration = report.calibration.calibration) {
        RS_ASSIGN_OR_RETURN(const UprightFrame frame,
                            plan_upright_frame(calibration->model, boxes_put_back(turn.boxes, *calibration)));
        report.frame = frame;
        RS_ASSIGN_OR_RETURN(const TurnSilhouette::Box visible,
                            write_rectified(set, folder, foregrounds, report, progress));
        rig = calibrated_import_rig(report, visible);
    } else {
        RS_TRY(write_unchanged(set, folder, foregrounds, progress));
        rig = nominal_import_rig(report, turn.silhouette.visible());
    }
    report.fl_px = rig.views.front().camera.fl_x;
    report.distance = glm::length(rig.views.front().camera.centre());
    RS_TRY(write_rig(set / kRigFileName, rig));
    return report;
}

}  // namespace rs::capture
