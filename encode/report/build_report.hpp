#pragma once
// HTML report of a build: its input and output, its quality on held-out views, and intermediate results.

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

/// Contents of the report. Empty members are omitted.
struct BuildReport {
    std::string name;                          // object name
    std::vector<ReportFact> facts;             // views, sizes, options
    std::vector<StageTime> stages;             // build stages
    std::vector<ChunkSummary> chunks;          // chunks of the file
    std::vector<std::string> warnings;         // one line each
    Rig rig;                                   // the upright cameras, for the plan of the rings
    std::vector<CaptionedImage> captured;      // some of the photos
    std::string hold_out;                      // sentence about the held-out views
    std::vector<MethodScores> scores;          // all for the same views, in the same order
    std::string why_no_scores;                 // reason if `scores` is empty
    std::vector<ImageRow> held_out;            // some views: ground truth, renderings, error maps
    std::vector<CaptionedImage> hull_images;   // depth maps of the visual hull
    std::vector<CaptionedImage> depth_images;  // estimated depth, coloured by depth_image()
};

/// A sector of a ring without cameras; angles from +Z towards +X.
struct MissingSector {
    double from_rad = 0;
    double to_rad = 0;  // > from_rad; beyond 2 pi where the sector crosses +Z
};

/// Finds the steps between neighbouring views of one ring that exceed 1.75 times their median, so that a single missing
/// photo of a uniform turn is found. Empty for fewer than three views.
/// \param azimuths_rad  in turning order, 0 <= a < 2 pi.
std::vector<MissingSector> find_missing_sectors(const std::vector<double>& azimuths_rad);

/// Draws the plan of a rig's rings as inline SVG, camera positions and sectors without cameras: +Z, where a turn
/// begins, at the bottom, +X to the right, as seen from above from behind the first camera. Missing sectors have the
/// colour --bad of HtmlPage's style; a disc shows the object's radius.
std::string draw_ring_plan(const Rig& rig);

/// One line per missing sector of each ring: "from 120.0 to 150.0 degrees (ring 1)".
std::vector<std::string> describe_missing_sectors(const Rig& rig);

/// Returns the HTML text. Fails only if an image cannot be encoded.
Result<std::string> build_report_page(const BuildReport& report);

}  // namespace rs::encode
