#include "capture/posed/posed_import.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/intake.hpp"
#include "capture/photos/segmentation/foreground_image.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/posed/cameras/camera_file.hpp"
#include "capture/posed/consistent_segmenter.hpp"
#include "capture/posed/photo_match.hpp"
#include "capture/posed/posed_set.hpp"
#include "capture/posed/visual_hull.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/file_reference.hpp"
#include "rayspace/geometry/rig.hpp"

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestPosed = 3;

// Photos of one size.
struct PhotoGroup {
    PhotoFolder folder;
    std::vector<std::size_t> photos;  // [photo of the folder]: index in PhotoMatches::photos
};

// Input of all stages.
struct ImportContext {
    const PosedImportOptions& options;
    bool has_uncertain_axes = false;
    Progress* progress = nullptr;
};

std::vector<PhotoGroup> grouped_by_size(const PhotoMatches& matches, const PosedImportOptions& options) {
    std::map<std::tuple<int, int, int>, PhotoGroup> groups;
    for (std::size_t i = 0; i < matches.photos.size(); ++i) {
        const PosedPhoto& photo = matches.photos[i];
        const Camera& camera = photo.camera.camera;
        PhotoGroup& group = groups[{camera.width, camera.height, photo.orientation}];
        PhotoFolder& folder = group.folder;
        folder.has_alpha = photo.has_alpha && (folder.has_alpha || folder.photos.empty());
        folder.photos.push_back(photo.file);
        folder.orientation = photo.orientation;
        folder.shown_width = camera.width;
        folder.shown_height = camera.height;
        group.photos.push_back(i);
    }
    std::vector<PhotoGroup> found;
    for (auto& [size, group] : groups) {
        set_working_size(group.folder, options.max_side_px);
        found.push_back(std::move(group));
    }
    return found;
}

// Files of mask_path; none if the file of cameras has no such key or another segmenter is requested.
Result<std::vector<fs::path>> mask_files_of(const PhotoGroup& group, const PhotoMatches& matches,
                                            const PosedImportOptions& options) {
    const SegmenterRequest& request = options.segmentation;
    const bool wants_masks = request.kind == SegmenterKind::kAuto || request.kind == SegmenterKind::kMasks;
    std::vector<fs::path> files;
    std::string without_mask;  // first photo
    if (!request.masks.empty() || !wants_masks || request.background.kind) return files;
    std::error_code ignored;
    const fs::path beside =
        fs::is_directory(options.cameras, ignored) ? options.cameras : options.cameras.parent_path();
    for (const std::size_t i : group.photos) {
        const std::string& mask = matches.photos[i].camera.mask_path;
        if (mask.empty()) {
            if (without_mask.empty()) without_mask = matches.photos[i].name;
            continue;
        }
        const auto file = resolve_reference(mask, beside);
        if (!file || !fs::is_regular_file(*file, ignored)) {
            return Error{printable(options.cameras.string() + ": mask_path '" + mask +
                                   "' is not a file; add it, or give a folder by --masks")};
        }
        files.push_back(*file);
    }
    if (!files.empty() && files.size() != group.photos.size()) {
        return Error{printable(options.cameras.string() + ": " + std::to_string(group.photos.size() - files.size()) +
                               " of " + std::to_string(group.photos.size()) +
                               " frames have no mask_path, the first is " + without_mask +
                               "; add it, or give --masks")};
    }
    return files;
}

// A folder of masks has one name per photo, so photos of one name in several folders would share a mask.
Status check_mask_names(const PhotoMatches& matches, const PosedImportOptions& options) {
    if (options.segmentation.masks.empty()) return {};
    std::map<std::string, std::string> names;
    for (const PosedPhoto& photo : matches.photos) {
        const auto [same, is_new] = names.try_emplace(photo.file.filename().string(), photo.name);
        if (!is_new) {
            return Error{printable("--masks " + options.segmentation.masks.string() + ": " + same->second + " and " +
                                   photo.name + " have one name; rename them, or give mask_path in transforms.json")};
        }
    }
    return {};
}

Error unknown_background(const PosedImportOptions& options) {
    return Error{options.photos.string() +
                 ": the background differs from photo to photo, and the views do not agree about the object; give "
                 "--segmentation-model FILE.onnx, --masks, or photos with alpha"};
}

// True if the photos have neither alpha nor masks, and nothing else states what the object is.
bool has_photos_alone(const SegmenterRequest& request) {
    const bool is_open = request.kind == SegmenterKind::kAuto || request.kind == SegmenterKind::kBackground;
    return is_open && request.masks.empty() && request.network.empty() && !request.background.kind &&
           !request.masks_are_alpha && request.shadow == ShadowHandling::kRemove;
}

// The segmenter is null if no background model fits a moving camera, and all views must find the object.
Result<ChosenSegmenter> segmenter_of(const PhotoGroup& group, const PhotoMatches& matches,
                                     const PosedImportOptions& options, Progress* progress) {
    SegmenterRequest request = options.segmentation;
    RS_ASSIGN_OR_RETURN(request.mask_files, mask_files_of(group, matches, options));
    if (!request.mask_files.empty()) request.masks = options.cameras;
    Intake intake;
    intake.folder = group.folder;
    RS_ASSIGN_OR_RETURN(intake.survey, survey_photos(intake.folder, progress));
    Result<ChosenSegmenter> chosen = choose_segmenter(request, intake, options.photos.string(), progress);
    const bool is_colour = chosen && chosen->kind == SegmenterKind::kBackground &&
                           chosen->background == BackgroundKind::kColour &&
                           request.background.kind != BackgroundKind::kColour;
    if (chosen && !is_colour) return chosen;
    if (!has_photos_alone(request)) return chosen ? unknown_background(options) : chosen.error();
    ChosenSegmenter none;
    none.kind = SegmenterKind::kBackground;
    return none;
}

// Lens of a photo in the working size of its folder.
PosedCamera in_working_size(PosedCamera posed, const PhotoFolder& folder) {
    Camera& camera = posed.camera;
    const glm::dvec2 centre = folder.in_image({camera.cx, camera.cy});
    camera.cx = centre.x;
    camera.cy = centre.y;
    camera.fl_x /= folder.reduction;
    camera.fl_y /= folder.reduction;
    camera.width = folder.width;
    camera.height = folder.height;
    return posed;
}

// Segments photo `i` of a group, and writes it as image `file` of the set.
Result<PosedImage> import_photo(const PhotoGroup& group, std::size_t i, const PosedCamera& posed,
                                const Segmenter& segmenter, const ForegroundParameters& parameters,
                                const fs::path& file) {
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(group.folder, i));
    RS_ASSIGN_OR_RETURN(const Segmentation segmentation, segmenter.segment({i, photo.view()}));
    return write_posed_image(posed, make_foreground_image(photo, segmentation, parameters),
                             group.folder.photos[i].string(), file);
}

Camera with_opencv_axes(Camera camera) {
    camera.world_from_camera[1] = -camera.world_from_camera[1];
    camera.world_from_camera[2] = -camera.world_from_camera[2];
    return camera;
}

// Point at which the cameras look, after their axes are converted if they are OpenCV's.
Result<glm::dvec3> find_target(std::vector<HullView>& views, bool is_uncertain, const PosedImportOptions& options,
                               PosedImportReport& report) {
    constexpr double kMost = 0.9;
    const double wanted = kMost * static_cast<double>(views.size());
    std::vector<HullView> converted = views;
    for (HullView& view : converted) view.camera = with_opencv_axes(view.camera);
    const std::string where = options.cameras.string() + ": ";
    std::size_t in_front = 0;
    for (const CameraAxes axes : {CameraAxes::kOpenGl, CameraAxes::kOpenCv}) {
        if (!is_uncertain && axes == CameraAxes::kOpenCv) break;
        if (is_uncertain && options.axes != CameraAxes::kAuto && options.axes != axes) continue;
        std::vector<HullView>& tried = axes == CameraAxes::kOpenGl ? views : converted;
        Result<glm::dvec3> target = common_target(tried);
        if (!target) return Error{where + target.error().message};
        in_front = std::max(in_front, count_in_front(tried, *target));
        if (static_cast<double>(count_in_front(tried, *target)) < wanted) continue;
        if (axes == CameraAxes::kOpenCv) {
            if (options.axes == CameraAxes::kAuto) {
                report.notes.push_back(where + "camera axes are OpenCV's (Y down), by the direction to the object");
            }
            views = std::move(converted);
        }
        return target;
    }
    return Error{where + std::to_string(views.size() - in_front) + " of " + std::to_string(views.size()) +
                 " cameras look away from the object; the poses must be camera-to-world, " +
                 (is_uncertain ? "give --camera-axes opengl or opencv, " : "") + "or take these photos out"};
}

// Replaces background models by segmenters that use all views.
Status segment_by_all_views(const std::vector<PhotoGroup>& groups, std::vector<ChosenSegmenter>& chosen,
                            const PhotoMatches& matches, const ImportContext& context, PosedImportReport& report) {
    std::vector<PhotosToSegment> photos;
    std::vector<ChosenSegmenter*> replaced;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (chosen[g].kind != SegmenterKind::kBackground) continue;
        PhotosToSegment& of_group = photos.emplace_back();
        of_group.folder = &groups[g].folder;
        of_group.initial = chosen[g].segmenter;
        for (const std::size_t i : groups[g].photos) {
            of_group.cameras.push_back(in_working_size(matches.photos[i].camera, groups[g].folder));
        }
        replaced.push_back(&chosen[g]);
    }
    if (photos.empty() || context.options.segmentation.shadow == ShadowHandling::kKeep) return {};
    PosedImportReport ignored;
    const auto target = [&](std::vector<HullView>& views) {
        return find_target(views, context.has_uncertain_axes, context.options, ignored);
    };
    Result<ConsistentSegmenters> found = make_consistent_segmenters(photos, target, context.progress);
    if (!found) {
        const auto has_initial = [](const PhotosToSegment& each) { return each.initial != nullptr; };
        if (!std::ranges::all_of(photos, has_initial)) return unknown_background(context.options);
        report.notes.push_back(context.options.photos.string() + ": " + found.error().message +
                               "; each mask is that of the background model alone. Give --masks if they are wrong");
        return {};
    }
    if (found->changed > 0.01) {
        report.notes.push_back(
            "masks are consistent across the views: " + std::to_string(std::lround(100 * found->changed)) +
            " % of their pixels were changed by the other photos");
    }
    for (std::size_t g = 0; g < replaced.size(); ++g) replaced[g]->segmenter = found->segmenters[g];
    return {};
}

Result<std::vector<PosedImage>> import_groups(const PhotoMatches& matches, const ImportContext& context,
                                              const fs::path& set, PosedImportReport& report) {
    const PosedImportOptions& options = context.options;
    const std::vector<PhotoGroup> groups = grouped_by_size(matches, options);
    std::vector<ChosenSegmenter> chosen;
    for (const PhotoGroup& group : groups) {
        RS_ASSIGN_OR_RETURN(chosen.emplace_back(), segmenter_of(group, matches, options, context.progress));
    }
    RS_TRY(segment_by_all_views(groups, chosen, matches, context, report));
    std::vector<PosedImage> imported(matches.photos.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const PhotoGroup& group = groups[g];
        report.sizes.push_back(size_text(group.folder.shown_width, group.folder.shown_height));
        report.segmenter = chosen[g].kind;
        report.notes.insert(report.notes.end(), chosen[g].notes.begin(), chosen[g].notes.end());
        const auto work = [&](std::size_t i) -> Status {
            const std::size_t view = group.photos[i];
            const PosedCamera posed = in_working_size(matches.photos[view].camera, group.folder);
            RS_ASSIGN_OR_RETURN(imported[view],
                                import_photo(group, i, posed, *chosen[g].segmenter,
                                             options.segmentation.parameters.foreground, set / set_image_name(view)));
            return {};
        };
        RS_TRY(for_each_photo(group.folder, kSegmentBytesPerPixel, "segmenting", context.progress, work));
    }
    return imported;
}

Rig rig_of(const PhotoMatches& matches, const std::vector<std::size_t>& kept, std::span<const Camera> cameras,
           const PosedImportReport& report) {
    std::vector<std::string> names;
    for (const std::size_t i : kept) names.push_back(matches.photos[i].name);
    Rig rig = posed_rig(cameras, names, {report.up.direction, report.origin, report.radius});
    nlohmann::json& made = rig.extras["photo_import"];
    made["calibration"] = "posed";
    made["segmenter"] = to_string(report.segmenter);
    made["up_from"] = report.up.from;
    return rig;
}

// Renames the images of the kept photos, so that their numbers have no gaps.
Status close_gaps(const fs::path& set, const std::vector<std::size_t>& kept) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i] == i) continue;
        std::error_code failure;
        fs::rename(set / set_image_name(kept[i]), set / set_image_name(i), failure);
        if (failure) return Error{set.string() + ": cannot be written (" + failure.message() + "); check the disk"};
    }
    return {};
}

// Names the photos whose masks have much that the other photos exclude.
void note_beyond_hull(const std::vector<double>& shares, const std::vector<std::string>& names,
                      PosedImportReport& report) {
    constexpr double kMuch = 0.1;
    std::vector<std::string> found;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (shares[i] > kMuch) found.push_back(names[i]);
    }
    if (found.empty()) return;
    report.notes.push_back(printable("more than a tenth of the object in " + std::to_string(found.size()) +
                                     (found.size() > 1 ? " photos" : " photo") +
                                     " is background by the other photos: " + listed(found, 8) +
                                     "; give --masks, or take the photos out"));
}

// Share of the pixels at the frame's border that are object.
double border_share(const cv::Mat1b& mask) {
    const int last_row = mask.rows - 1, last_column = mask.cols - 1;
    const int object = cv::countNonZero(mask.row(0)) + cv::countNonZero(mask.row(last_row)) +
                       cv::countNonZero(mask.col(0)) + cv::countNonZero(mask.col(last_column));
    return static_cast<double>(object) / (2.0 * (mask.cols + mask.rows));
}

// Refuses masks that a background model found if most fill the frame.
Status check_separation(const std::vector<HullView>& views, const PosedImportOptions& options,
                        const PosedImportReport& report) {
    constexpr double kFilled = 0.7;
    const auto count = std::ranges::count_if(views, [](const HullView& v) { return border_share(v.mask) > kFilled; });
    const bool is_given = report.segmenter == SegmenterKind::kAlpha || report.segmenter == SegmenterKind::kMasks;
    if (options.force || is_given || 2 * count <= std::ssize(views)) return {};
    return Error{options.photos.string() + ": the object fills the frame in " + std::to_string(count) + " of " +
                 std::to_string(views.size()) +
                 " photos, so that the background was not found; give --masks, --segmentation-model FILE.onnx or "
                 "photos with alpha, or --force"};
}

// Refuses masks of which most do not fit the hull of the others: photos with the cameras of other photos.
Status check_agreement(const std::vector<double>& beyond_hull, const std::string& where) {
    constexpr double kTooMuch = 0.3;
    const auto count = std::ranges::count_if(beyond_hull, [](double share) { return share > kTooMuch; });
    if (2 * count <= std::ssize(beyond_hull)) return {};
    return Error{where + "the masks of " + std::to_string(count) + " of " + std::to_string(beyond_hull.size()) +
                 " photos do not agree with those of the others; check that each photo has its own camera, and the "
                 "masks (--masks), or give --force"};
}

// Finds up, origin and radius. `views` are those of the photos `kept`.
Status find_object(std::vector<HullView>& views, bool has_uncertain_axes, const PosedImportOptions& options,
                   const std::vector<std::string>& names, PosedImportReport& report) {
    RS_TRY(check_separation(views, options, report));
    RS_ASSIGN_OR_RETURN(const glm::dvec3 target, find_target(views, has_uncertain_axes, options, report));
    const std::string where = options.cameras.string() + ": ";
    std::vector<Camera> cameras;
    std::vector<std::string> away;
    for (std::size_t i = 0; i < views.size(); ++i) {
        cameras.push_back(views[i].camera);
        if (!(cameras[i].project(target).z > 0)) away.push_back(names[i]);
    }
    if (!away.empty()) {
        return Error{printable(where + listed(away, 3) + (away.size() > 1 ? " look" : " looks") +
                               " away from the object; correct the pose, or take the photo out")};
    }
    const Result<UpAxis> up = find_up(options.up, cameras, target);
    if (!up) return Error{where + up.error().message};
    report.up = *up;
    report.notes.insert(report.notes.end(), up->notes.begin(), up->notes.end());
    const Result<BoundingCylinder> object = carve_bounding_cylinder(views, target, up->direction);
    if (!object) return Error{where + object.error().message};
    if (!object->cameras_inside.empty()) {
        std::vector<std::string> inside;
        for (const std::size_t i : object->cameras_inside) inside.push_back(names[i]);
        return Error{printable(
            where + listed(inside, 3) + (inside.size() > 1 ? " are" : " is") +
            " inside the object's bounding cylinder; check poses and masks (--masks), or take the photos out")};
    }
    if (!options.force) RS_TRY(check_agreement(object->beyond_hull, where));
    note_beyond_hull(object->beyond_hull, names, report);
    report.origin = object->centre;
    report.radius = object->radius;
    report.height = object->height;
    return {};
}

void note_left_out(PosedImportReport& report) {
    const auto note = [&](const std::vector<std::string>& names, const std::string& fault) {
        if (names.empty()) return;
        report.notes.push_back(printable(std::to_string(names.size()) + (names.size() > 1 ? " photos " : " photo ") +
                                         fault + ", left out: " + listed(names, 8)));
    };
    note(report.without_camera, "without a camera");
    note(report.without_photo, "of the cameras' file not found");
    note(report.without_object, "without an object");
}

Result<PosedImportReport> import_posed_checked(const PosedImportOptions& options, Progress* progress) {
    RS_ASSIGN_OR_RETURN(const PosedModel model, read_camera_file(options.cameras));
    if (!model.has_uncertain_axes && options.axes != CameraAxes::kAuto) {
        return Error{"--camera-axes: " + options.cameras.string() + " has OpenCV's axes by definition; leave it out"};
    }
    RS_ASSIGN_OR_RETURN(PhotoMatches matches, match_photos(options.photos, model));
    RS_TRY(check_mask_names(matches, options));
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(options.output, "imported photos", options.force));
    const fs::path set = staged.temporary_path();
    std::error_code failure;
    fs::create_directories(set / "images", failure);
    if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};

    PosedImportReport report;
    report.notes = model.notes;
    report.without_camera = std::move(matches.without_camera);
    report.without_photo = std::move(matches.without_photo);
    const ImportContext context{options, model.has_uncertain_axes, progress};
    RS_ASSIGN_OR_RETURN(std::vector<PosedImage> imported, import_groups(matches, context, set, report));
    std::vector<std::size_t> kept;
    std::vector<HullView> hulls;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < imported.size(); ++i) {
        if (imported[i].hull.mask.empty()) {
            report.without_object.push_back(matches.photos[i].name);
            continue;
        }
        kept.push_back(i);
        names.push_back(matches.photos[i].name);
        hulls.push_back(std::move(imported[i].hull));
        report.undistorted += imported[i].was_distorted ? 1 : 0;
    }
    if (kept.size() < kFewestPosed) {
        return Error{options.photos.string() + ": " + std::to_string(kept.size()) +
                     " photos have a camera and show the object; at least " + std::to_string(kFewestPosed) +
                     " are needed, better 30 or more from all around"};
    }
    RS_TRY(find_object(hulls, model.has_uncertain_axes, options, names, report));
    note_left_out(report);
    RS_TRY(close_gaps(set, kept));
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        cameras.push_back(imported[kept[i]].camera);
        cameras.back().world_from_camera = hulls[i].camera.world_from_camera;  // in OpenGL's axes
    }
    report.views = kept.size();
    RS_TRY(write_rig(set / kRigFileName, rig_of(matches, kept, cameras, report)));
    RS_TRY(staged.commit());
    return report;
}

}  // namespace

Status check_segmenters(const PosedImportOptions& options, Progress* progress) {
    PosedModel sizes;  // cameras without a size take that of their photo
    sizes.where = options.photos.string();
    RS_ASSIGN_OR_RETURN(const std::vector<std::string> names, list_photos(options.photos));
    for (const std::string& name : names) {
        sizes.cameras.emplace_back();
        sizes.cameras.back().photo = name;
    }
    RS_ASSIGN_OR_RETURN(const PhotoMatches matches, match_photos(options.photos, sizes));
    RS_TRY(check_mask_names(matches, options));
    for (const PhotoGroup& group : grouped_by_size(matches, options)) {
        RS_TRY(segmenter_of(group, matches, options, progress));
    }
    return {};
}

Result<PosedImportReport> import_posed_photos(const PosedImportOptions& options, Progress* progress) {
    RS_TRY(refuse_overwriting_inputs(options.output, {options.photos, options.cameras, options.segmentation.masks}));
    cv::setNumThreads(1);  // photos are processed in parallel
    try {
        return import_posed_checked(options, progress);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& escaped) {  // thrown by OpenCV
        return Error{options.photos.string() + ": the images cannot be processed (" + escaped.what() + ")"};
    }
}

}  // namespace rs::capture
