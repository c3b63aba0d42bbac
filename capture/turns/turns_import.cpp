#include "capture/turns/turns_import.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/photo_rows.hpp"
#include "capture/posed/posed_set.hpp"
#include "capture/turns/hull_search.hpp"
#include "capture/turns/joint_segmentation.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <exception>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestPhotos = 6;  // of a turn
constexpr double kDoubtfulResidual_px = 2;

// A turn between the stages.
struct WorkingTurn {
    std::string name;
    PreparedTurn prepared;
    ForegroundCache foregrounds;
    FoundRig rig;
    bool is_shifted = false;  // its points agree only if the photos were shifted and scaled individually
};

// Photos of a folder in natural order; its folders.
struct Listing {
    std::vector<fs::path> photos, folders;
};

Result<Listing> list_folder(const fs::path& folder) {
    Listing listing;
    std::error_code failure;
    for (fs::directory_iterator entries(folder, failure), end; !failure && entries != end; entries.increment(failure)) {
        const fs::path& path = entries->path();
        if (path.filename().string().starts_with(".")) continue;
        std::error_code ignored;
        if (entries->is_directory(ignored)) listing.folders.push_back(path);
        if (entries->is_regular_file(ignored) && is_image_name(path)) listing.photos.push_back(path);
    }
    if (failure) {
        return Error{folder.string() + ": cannot be listed (" + failure.message() + "); give a folder of photos"};
    }
    sort_photos(listing.photos);
    sort_photos(listing.folders);
    return listing;
}

std::vector<TurnSource> rows_of(const fs::path& folder, const std::vector<fs::path>& photos) {
    std::vector<std::string> names;
    for (const fs::path& photo : photos) names.push_back(photo.filename().string());
    std::vector<TurnSource> turns;
    for (const PhotoRow& row : rows_by_name(names)) {
        TurnSource turn{folder.string() + " row " + row.label, {}};
        for (const std::size_t i : row.photos) turn.photos.push_back(photos[i]);
        turns.push_back(std::move(turn));
    }
    return turns;
}

// Refuses photos that are too few for a turn beside the folders of turns, such as one of the setup.
Status check_stray_photos(const fs::path& folder, const Listing& listing) {
    if (listing.photos.size() >= kFewestPhotos) return {};
    std::vector<std::string> turns;
    for (const fs::path& inner : listing.folders) {
        RS_ASSIGN_OR_RETURN(const Listing of_turn, list_folder(inner));
        if (of_turn.photos.size() >= kFewestPhotos) turns.push_back(inner.string());
    }
    if (turns.size() < 2) return {};
    return Error{printable(listing.photos.front().string() + ": is beside the folders of turns " + listed(turns, 3) +
                           "; move the photos of " + folder.string() + " elsewhere, or give the turns' folders")};
}

// Refuses folders that by their name hold no photos of a turn: masks would become views.
Status check_turn_names(std::span<const TurnSource> turns) {
    constexpr std::array<std::string_view, 12> kNoTurns = {"mask",  "masks",  "alpha",      "alphas",
                                                           "matte", "mattes", "depth",      "depths",
                                                           "thumb", "thumbs", "thumbnails", "previews"};
    for (const TurnSource& turn : turns) {
        std::string name = fs::path(turn.name).filename().string();
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (std::ranges::find(kNoTurns, name) == kNoTurns.end()) continue;
        return Error{printable(turn.name + ": is no folder of photos, by its name; move or rename it, or give the "
                                           "folders of the turns")};
    }
    return {};
}

Status check_sources(std::span<const TurnSource> sources) {
    for (std::size_t a = 0; a < sources.size(); ++a) {
        if (sources[a].photos.size() < kFewestPhotos) {
            return Error{printable(sources[a].name + ": has " + std::to_string(sources[a].photos.size()) +
                                   (sources[a].photos.size() == 1 ? " photo" : " photos") + "; a turn needs at least " +
                                   std::to_string(kFewestPhotos) + ", better 24; take it out, or photograph the turn")};
        }
        for (std::size_t b = 0; b < a; ++b) {
            std::error_code ignored;
            if (fs::equivalent(sources[a].photos.front(), sources[b].photos.front(), ignored)) {
                return Error{printable(sources[a].name + ": is given twice; leave one out")};
            }
        }
    }
    return {};
}

// True if all foreground images are equal: copies of one turn.
bool has_same_photos(const SegmentedTurn& a, const SegmentedTurn& b) {
    return std::ranges::equal(a.small, b.small, [](const Image<Rgba8>& x, const Image<Rgba8>& y) {
        return x.width() == y.width() && x.height() == y.height() && std::ranges::equal(x.pixels(), y.pixels());
    });
}

// True if the photos were cropped and scaled by more than the noise of the estimate.
bool is_recentred(const std::vector<ImagePlacement>& places, int width) {
    constexpr double kNoise_widths = 0.01, kNoise_scale = 0.02;
    return std::ranges::any_of(places, [&](const ImagePlacement& place) {
        return glm::length(place.shift_px - places.front().shift_px) > kNoise_widths * width ||
               std::abs(place.scale / places.front().scale - 1) > kNoise_scale;
    });
}

// Calibrates a turn alone; without a result, its registration finds the camera.
Status calibrate_alone(WorkingTurn& turn, const ImportOptions& options, CalibrationChoice choice, Progress* progress) {
    RigRequest request = static_cast<const RigRequest&>(options);
    request.calibration = choice;
    Result<FoundRig> found =
        find_rig(request, turn.prepared.intake.folder, turn.prepared.turn, turn.foregrounds, progress);
    if (!found && choice == CalibrationChoice::kNominal) return found.error();
    if (!found) return {};
    if (found->calibration.calibration && !found->calibration.calibration->places.empty()) {
        turn.is_shifted = is_recentred(found->calibration.calibration->places, turn.prepared.intake.folder.width);
        return {};
    }
    turn.rig = std::move(*found);
    return {};
}

Result<WorkingTurn> open_turn(const TurnSource& source, const ImportOptions& options, const fs::path& cut,
                              Progress* progress) {
    std::error_code failure;
    fs::create_directories(cut, failure);
    if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};
    ImportOptions own = options;
    own.photos = source.name;
    RS_ASSIGN_OR_RETURN(PhotoFolder folder, open_photo_files(source.photos, source.name, options.max_side_px));
    RS_ASSIGN_OR_RETURN(PreparedTurn prepared, prepare_turn(own, std::move(folder), cut, progress));
    const ForegroundCache foregrounds(cut, prepared.intake.folder.width, prepared.intake.folder.height);
    return WorkingTurn{source.name, std::move(prepared), foregrounds, {}, false};
}

Result<std::vector<WorkingTurn>> open_turns(std::span<const TurnSource> sources, const ImportOptions& options,
                                            const fs::path& cut, Progress* progress) {
    std::vector<WorkingTurn> turns;
    for (const TurnSource& source : sources) {
        RS_ASSIGN_OR_RETURN(WorkingTurn turn, open_turn(source, options, cut / std::to_string(turns.size()), progress));
        for (const WorkingTurn& other : turns) {
            if (has_same_photos(turn.prepared.turn, other.prepared.turn)) {
                return Error{printable(turn.name + ": has the same photos as " + other.name + "; leave one out")};
            }
        }
        turns.push_back(std::move(turn));
    }
    return turns;
}

bool is_segmented_by_background(const WorkingTurn& turn) {
    return turn.prepared.chosen.kind == SegmenterKind::kBackground;
}

// Completes the masks of background models by the colours of all turns (joint_segmentation.hpp).
Status correct_turns(std::vector<WorkingTurn>& turns, const ImportOptions& options, Progress* progress) {
    if (!std::ranges::all_of(turns, is_segmented_by_background)) return {};
    std::vector<TurnToCorrect> given;
    for (const WorkingTurn& turn : turns) {
        given.push_back({&turn.prepared.intake.folder, &turn.foregrounds, turn.prepared.turn.silhouette.visible()});
    }
    RS_ASSIGN_OR_RETURN(const std::vector<CorrectedTurn> corrected, correct_masks(given, progress));
    for (std::size_t t = 0; t < turns.size(); ++t) {
        if (!corrected[t].segmenter) continue;
        PreparedTurn& prepared = turns[t].prepared;
        RS_ASSIGN_OR_RETURN(
            prepared.turn, segment_turn(prepared.intake.folder, *corrected[t].segmenter, turns[t].foregrounds, progress,
                                        options.segmentation.parameters.foreground));
        prepared.chosen.notes.push_back("the masks grew by " + format_fixed(100 * corrected[t].added, 0) +
                                        " % by the colours of the object in all turns");
    }
    return {};
}

Status calibrate_turns(std::vector<WorkingTurn>& turns, const ImportOptions& options, Progress* progress) {
    for (WorkingTurn& turn : turns) {
        RS_TRY(calibrate_alone(turn, options, CalibrationChoice::kNominal, progress));
        RS_TRY(calibrate_alone(turn, options, CalibrationChoice::kTracks, progress));
    }
    // If only some turns are, too few points may be the reason.
    if (std::ranges::all_of(turns, &WorkingTurn::is_shifted)) {
        return Error{printable(turns.front().name +
                               ": its photos were shifted and scaled individually, as those of the other turns, so "
                               "that turns cannot be registered; give the original photos")};
    }
    return {};
}

bool is_calibrated(const WorkingTurn& turn) {
    return turn.rig.calibration.calibration.has_value();
}

// The registration needs a calibrated turn: one by its silhouettes, if none is by its points.
Status calibrate_reference(std::vector<WorkingTurn>& turns, const ImportOptions& options, Progress* progress) {
    if (std::ranges::any_of(turns, is_calibrated)) return {};
    for (WorkingTurn& turn : turns) {
        RS_TRY(calibrate_alone(turn, options, CalibrationChoice::kSilhouettes, progress));
        if (is_calibrated(turn)) return {};
    }
    return {};
}

TurntableModel nominal_model(const WorkingTurn& turn) {
    const PhotoFolder& folder = turn.prepared.intake.folder;
    const NominalTurn& nominal = turn.rig.nominal;
    TurntableModel model;
    model.lens = {folder.width,
                  folder.height,
                  0.5 * folder.width / std::tan(0.5 * radians(nominal.fov_deg)),
                  0.5 * folder.width,
                  0.5 * folder.height,
                  0,
                  0};
    model.pose.pan_rad = std::atan((model.lens.cx - nominal.axis_x_px) / model.lens.f_px);
    const double step_rad = radians(nominal.step_deg) * (nominal.turning == Turning::kCounterClockwise ? 1 : -1);
    for (std::size_t i = 0; i < folder.photos.size(); ++i) {
        model.angles_rad.push_back(static_cast<double>(i) * step_rad);
    }
    return model;
}

Result<std::vector<RegisteredTurn>> register_all(const std::vector<WorkingTurn>& turns, Progress* progress) {
    std::vector<TurnToRegister> inputs;
    for (const WorkingTurn& turn : turns) {
        TurnToRegister input{turn.name, {}, turn.rig.calibration.calibration, nominal_model(turn)};
        RS_ASSIGN_OR_RETURN(input.images, read_turn_images(turn.prepared.intake.folder, turn.foregrounds, progress));
        inputs.push_back(std::move(input));
    }
    return register_turns(inputs, progress);
}

// Images and cameras of all turns, in the common frame.
struct WrittenViews {
    std::vector<Camera> cameras;
    std::vector<HullView> hulls;
    std::vector<std::string> names;
    std::vector<std::size_t> turns;  // [view]
};

// JSON has no infinity.
nlohmann::json finite_number(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

PosedCamera posed_camera(const PlacedTurn& turn, std::size_t view) {
    PosedCamera posed;
    posed.camera = common_camera(turn, view);
    posed.distortion.coefficients = {turn.model.lens.k1, turn.model.lens.k2};
    return posed;
}

Result<WrittenViews> write_images(const std::vector<WorkingTurn>& turns, const std::vector<RegisteredTurn>& registered,
                                  const fs::path& set, Progress* progress) {
    WrittenViews written;
    for (std::size_t t = 0; t < turns.size(); ++t) {
        const PhotoFolder& folder = turns[t].prepared.intake.folder;
        const std::vector<std::string>& left_out = turns[t].rig.left_out;
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < folder.photos.size(); ++i) {
            if (std::ranges::find(left_out, folder.photos[i].filename().string()) == left_out.end()) kept.push_back(i);
        }
        const std::size_t first = written.cameras.size();
        std::vector<PosedImage> images(kept.size());
        const auto work = [&](std::size_t i) -> Status {
            const auto at = std::ranges::find(kept, i);
            if (at == kept.end()) return {};
            const auto k = static_cast<std::size_t>(at - kept.begin());
            RS_ASSIGN_OR_RETURN(Image<Rgba8> foreground, turns[t].foregrounds.get(i));
            RS_ASSIGN_OR_RETURN(images[k],
                                write_posed_image(posed_camera(registered[t].turn, i), std::move(foreground),
                                                  folder.photos[i].string(), set / set_image_name(first + k)));
            return {};
        };
        RS_TRY(for_each_photo(folder, kReadBytesPerPixel, "writing the images", progress, work));
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const fs::path& photo = folder.photos[kept[k]];
            if (images[k].hull.mask.empty()) return Error{photo.string() + ": shows no object; take it out"};
            written.cameras.push_back(images[k].camera);
            written.hulls.push_back(std::move(images[k].hull));
            written.names.push_back((photo.parent_path().filename() / photo.filename()).string());
            written.turns.push_back(t);
        }
    }
    return written;
}

TurnsImportReport report_on(const std::vector<WorkingTurn>& turns, const std::vector<RegisteredTurn>& registered,
                            const BoundingCylinder& object, const WrittenViews& written) {
    TurnsImportReport report;
    report.views = written.cameras.size();
    report.segmenter = turns.front().prepared.chosen.kind;
    report.radius = object.radius;
    report.height = object.height;
    const double first_rad = azimuth_rad(registered.front().turn.placement);
    for (std::size_t t = 0; t < turns.size(); ++t) {
        ImportedTurn turn{turns[t].name, 0, registered[t]};
        turn.views = static_cast<std::size_t>(std::ranges::count(written.turns, t));
        if (is_calibrated(turns[t])) turn.calibration = turns[t].rig.calibration.calibration->method;
        const PlacedTurn& placed = registered[t].turn;
        turn.elevation_deg = elevation_deg(placed, object.centre);
        turn.axis_tilt_deg = placed.placement.is_upright() ? 0 : axis_tilt_deg(placed.placement);
        turn.azimuth_deg = degrees(std::remainder(azimuth_rad(placed.placement) - first_rad, 2 * kPi));
        turn.distance = glm::length(common_camera(placed, 0).centre() - object.centre) / object.radius;
        report.turns.push_back(std::move(turn));
        for (const auto* notes : {&turns[t].prepared.intake.notes, &turns[t].prepared.chosen.notes}) {
            for (const std::string& note : *notes) report.notes.push_back(turns[t].name + ": " + note);
        }
        if (registered[t].rms_px > kDoubtfulResidual_px) {
            report.notes.push_back(turns[t].name + ": fits the other turns to " +
                                   format_fixed(registered[t].rms_px, 1) +
                                   " px only, so that views between the turns are blurred; look at the images in the "
                                   "set, and give photos with alpha if masks lack parts or hold shadows");
        }
        if (!turns[t].rig.left_out.empty()) {
            report.notes.push_back(turns[t].name +
                                   ": repeated photos are left out: " + listed(turns[t].rig.left_out, 4));
        }
    }
    return report;
}

std::vector<std::string> mask_size_notes(const WrittenViews& written) {
    const DoubtfulMasks doubtful = find_doubtful_masks(written.hulls);
    std::vector<std::string> notes;
    const auto add = [&](const std::vector<std::size_t>& views, const std::string& which) {
        std::vector<std::string> names;
        for (const std::size_t view : views) names.push_back(written.names[view]);
        if (names.empty()) return;
        notes.push_back("masks that are " + which + " than the other photos predict: " + listed(names, 4) +
                        "; look at their images in the set, and give photos with alpha if they are wrong");
    };
    add(doubtful.small, "smaller");
    add(doubtful.large, "larger");
    return notes;
}

Status write_turns_rig(const fs::path& set, const WrittenViews& written, const BoundingCylinder& object,
                       const TurnsImportReport& report) {
    Rig rig = posed_rig(written.cameras, written.names, {{0, 1, 0}, object.centre, object.radius});
    nlohmann::json& made = rig.extras["photo_import"];
    made["calibration"] = "turns";
    made["segmenter"] = to_string(report.segmenter);
    made["up_from"] = "axis";
    for (const ImportedTurn& turn : report.turns) made["turns"].push_back(turn_json(turn));
    for (std::size_t i = 0; i < rig.views.size(); ++i) rig.views[i].extras["turn"] = written.turns[i];
    return write_rig(set / kRigFileName, rig);
}

Result<BoundingCylinder> find_turned_object(const WrittenViews& written, const fs::path& output) {
    const auto located = [&](const Error& error) { return Error{output.string() + ": " + error.message}; };
    const Result<glm::dvec3> target = common_target(written.hulls);
    if (!target) return located(target.error());
    Result<BoundingCylinder> object = carve_bounding_cylinder(written.hulls, *target, {0, 1, 0});
    if (!object) return located(object.error());
    return object;
}

Result<TurnsImportReport> import_turns_checked(std::span<const TurnSource> sources, const ImportOptions& options,
                                               Progress* progress) {
    RS_TRY(check_sources(sources));
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(options.output, "imported photos", options.force));
    const fs::path set = staged.temporary_path();
    std::error_code failure;
    fs::create_directories(set / "images", failure);
    if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};
    RS_ASSIGN_OR_RETURN(std::vector<WorkingTurn> turns, open_turns(sources, options, set / "cut", progress));
    RS_TRY(correct_turns(turns, options, progress));
    RS_TRY(calibrate_turns(turns, options, progress));
    RS_TRY(calibrate_reference(turns, options, progress));
    RS_ASSIGN_OR_RETURN(const std::vector<RegisteredTurn> registered, register_all(turns, progress));
    RS_ASSIGN_OR_RETURN(const WrittenViews written, write_images(turns, registered, set, progress));
    RS_ASSIGN_OR_RETURN(const BoundingCylinder object, find_turned_object(written, options.output));
    TurnsImportReport report = report_on(turns, registered, object, written);
    for (std::string& note : mask_size_notes(written)) report.notes.push_back(std::move(note));
    RS_TRY(write_turns_rig(set, written, object, report));
    fs::remove_all(set / "cut", failure);
    if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};
    RS_TRY(staged.commit());
    return report;
}

}  // namespace

nlohmann::json turn_json(const ImportedTurn& turn) {
    const RegisteredTurn& found = turn.registered;
    const Lens& lens = found.turn.model.lens;
    nlohmann::json json;
    json["name"] =
        nlohmann::json::parse(nlohmann::json(turn.name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    json["views"] = turn.views;
    json["calibration"] = turn.calibration == CalibrationMethod::kNominal ? "joint" : to_string(turn.calibration);
    json["registration"] = to_string(found.method);
    json["elevation_deg"] = turn.elevation_deg;
    json["axis_tilt_deg"] = turn.axis_tilt_deg;
    json["azimuth_deg"] = turn.axis_tilt_deg > 0 ? nlohmann::json() : nlohmann::json(turn.azimuth_deg);
    json["distance"] = turn.distance;
    json["f_px"] = lens.f_px;
    json["k1"] = lens.k1;
    json["k2"] = lens.k2;
    json["shared_points"] = found.pairs;
    json["observations"] = found.observations;
    json["rms_px"] = finite_number(found.rms_px);
    json["silhouette_overlap"] = found.overlap;
    return json;
}

Result<std::vector<TurnSource>> find_turns(std::span<const fs::path> folders) {
    std::vector<TurnSource> turns;
    if (folders.size() > 1) {
        for (const fs::path& folder : folders) {
            RS_ASSIGN_OR_RETURN(Listing listing, list_folder(folder));
            if (listing.photos.empty()) {
                return Error{folder.string() + ": holds no photos; each folder must have the photos of one turn"};
            }
            turns.push_back({folder.string(), std::move(listing.photos)});
        }
        return turns;
    }
    const fs::path& folder = folders.front();
    RS_ASSIGN_OR_RETURN(Listing listing, list_folder(folder));
    if (!listing.photos.empty()) {
        RS_TRY(check_stray_photos(folder, listing));
        turns = rows_of(folder, listing.photos);
        if (turns.empty()) turns.push_back({folder.string(), std::move(listing.photos)});
        return turns;
    }
    for (const fs::path& inner : listing.folders) {
        RS_ASSIGN_OR_RETURN(Listing of_turn, list_folder(inner));
        if (!of_turn.photos.empty()) turns.push_back({inner.string(), std::move(of_turn.photos)});
    }
    if (turns.size() > 1) RS_TRY(check_turn_names(turns));
    if (turns.empty()) turns.push_back({folder.string(), {}});
    return turns;
}

Result<TurnsImportReport> import_turns(std::span<const TurnSource> sources, const ImportOptions& options,
                                       Progress* progress) {
    RS_TRY(check_import_options(options));
    std::vector<fs::path> inputs;
    for (const TurnSource& source : sources) {
        if (!source.photos.empty()) inputs.push_back(source.photos.front().parent_path());
    }
    RS_TRY(refuse_overwriting_inputs(options.output, inputs));
    cv::setNumThreads(1);  // photos are processed in parallel
    try {
        return import_turns_checked(sources, options, progress);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& escaped) {  // thrown by OpenCV
        return Error{sources.front().name + ": the images cannot be processed (" + escaped.what() + ")"};
    }
}

}  // namespace rs::capture
