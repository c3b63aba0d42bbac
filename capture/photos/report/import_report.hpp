#pragma once
/// \file
/// Results of an import, and the writers of its capture set and of the HTML page about it.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/rig/found_rig.hpp"
#include "capture/photos/rig/rectification.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/photos/segmentation/segmenter_choice.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

/// Results of all stages. `notes` holds the notes of all of them.
struct ImportReport : FoundRig {
    PhotoFolder folder{};  ///< the photos used in calibration
    SegmenterKind segmenter = SegmenterKind::kAlpha;
    std::string segmenter_reason{};
    double background_share = 0;  ///< fraction of the image decided by the background model
    BackgroundKind backdrop = BackgroundKind::kAlpha;
    Rgba8 backdrop_colour{};
    bool backdrop_given = false;
    std::string dropped_repeat{};  ///< name of the last photo if it repeated the first; else empty
    /// Coverage of a photo: fraction of its pixels with an alpha of 128 or more, 0..1. Minimum over all photos.
    double min_coverage = 0;
    double max_coverage = 0;                        ///< maximum over all photos
    std::vector<Image<Rgba8>> small_foregrounds{};  ///< [photo], the longer side at most 512 px

    int views = 0;         ///< of the capture set
    UprightFrame frame{};  ///< of the images in the capture set, if they were rectified
    double fl_px = 0;      ///< focal length of the capture set
    double distance = 0;   ///< from the rig's origin to its first camera, object radii
};

/// Text about the sizes of the photos: "4000x3810 photos reduced to 2048x1950".
std::string sizes_text(const PhotoFolder& folder);

/// File name of a photo, without the folder.
inline std::string source_name(const ImportReport& report, std::size_t photo) {
    return report.folder.photos[photo].filename().string();
}

/// True if the photo is not part of the capture set, see FoundRig::left_out.
inline bool is_left_out(const ImportReport& report, std::size_t photo) {
    return std::find(report.left_out.begin(), report.left_out.end(), source_name(report, photo)) !=
           report.left_out.end();
}

/// Last stage of an import: writes the capture set of a turn with a known rig (import_set.cpp). The images of a
/// calibrated turn are rectified; those of a nominal one are the foreground images, unchanged. Writes the images into
/// `set`/images, which must exist, and transforms.json into `set`. `report` holds the results of the previous stages;
/// returns it with the numbers of the set added. Errors: those of plan_upright_frame(), unreadable foreground images,
/// failures of the disk.
Result<ImportReport> write_import_set(const std::filesystem::path& set, const PhotoFolder& folder,
                                      const SegmentedTurn& turn, const ForegroundCache& foregrounds,
                                      ImportReport report, Progress* progress);

/// Longer side of an annotated photo.
inline constexpr int kAnnotatedSide_px = 560;

/// Reduced photo (its longer side at most kAnnotatedSide_px) with the turntable's axis and the tracked points drawn on
/// it. `view` is an index into the photos of the report.
Image<Rgba8> annotated_photo(ConstImageView<Rgba8> photo, const ImportReport& report, int view);

/// Makes a self-contained HTML page about an import, mostly of figures: estimates and their uncertainty, tracked
/// points, the axis drawn on photos, alpha mattes over magenta. Reads some of the report's photos again to annotate
/// them. `photos` is the name of the turn in the title. Errors: an unreadable photo.
Result<std::string> import_page(const std::filesystem::path& photos, const ImportReport& report);

}  // namespace rs::capture
