#pragma once
// The page of a build: what was made from what, how good it is on views held out, and what was found on the way.

#include "encode/hold_out.hpp"
#include "encode/report/stage_clock.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/page/page_images.hpp"

#include <string>
#include <vector>

namespace rs::encode {

struct ReportFact {
    std::string name;
    std::string value;
};

struct ImageRow {
    std::string caption;
    std::vector<CaptionedImage> images;
};

// What is empty is not shown.
struct BuildReport {
    std::string name;                          // of the object
    std::vector<ReportFact> facts;             // views, sizes, options
    std::vector<StageTime> stages;             // of the build
    std::vector<ChunkSummary> chunks;          // of the file
    std::vector<std::string> warnings;         // one line each
    Rig rig;                                   // the upright cameras; the plan of the rings is drawn of them
    std::vector<CaptionedImage> captured;      // some of the images
    std::string hold_out;                      // which views were held out, in words
    std::vector<MethodScores> scores;          // all of the same views, in the same order
    std::string why_no_scores;                 // where there are none
    std::vector<ImageRow> held_out;            // of some views: truth, answers, error maps
    std::vector<CaptionedImage> hull_images;   // of the visual hull
    std::vector<CaptionedImage> depth_images;  // depth found, as depth_image() colours it
};

// The text of the page. Fails only where an image cannot be encoded.
Result<std::string> build_report_page(const BuildReport& report);

}  // namespace rs::encode
