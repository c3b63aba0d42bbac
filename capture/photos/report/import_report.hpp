#pragma once
// What an import found and wrote, for messages, the page and the rig's own record.

#include "capture/photos/rig/found_rig.hpp"
#include "capture/photos/rig/rectification.hpp"
#include "capture/photos/segmentation/segmenter_choice.hpp"
#include "rayspace/image/image.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace rs::capture {

// With the notes of all stages.
struct ImportReport : FoundRig {
    PhotoFolder folder{};  // the photographs that took part in calibration
    SegmenterKind segmenter = SegmenterKind::kAlpha;
    std::string segmenter_reason{};
    double background_share = 0;  // share of the image in which the background model decided
    BackgroundKind backdrop = BackgroundKind::kAlpha;
    Rgba8 backdrop_colour{};
    bool backdrop_given = false;
    std::string dropped_repeat{};  // name of the last photograph where it repeated the first; empty otherwise
    double min_coverage = 0;       // share of a photograph's pixels with alpha of 128 and more: smallest of all, ...
    double max_coverage = 0;       // ... largest
    std::vector<Image<Rgba8>> small_cut_outs{};  // [photograph], the longer side at most 512 px

    // Of the set written.
    int views = 0;
    UprightFrame frame{};  // of its pictures, where they were rectified
    double fl_px = 0;
    double distance = 0;  // object radii
};

// "4000x3810 photographs taken as 2048x1950".
std::string sizes_text(const PhotoFolder& folder);

inline std::string source_name(const ImportReport& report, std::size_t photo) {
    return report.folder.photos[photo].filename().string();
}

inline bool is_left_out(const ImportReport& report, std::size_t photo) {
    return std::find(report.left_out.begin(), report.left_out.end(), source_name(report, photo)) !=
           report.left_out.end();
}

}  // namespace rs::capture
