#include "capture/photos/report/import_set.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/report/import_rig.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <mutex>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

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
