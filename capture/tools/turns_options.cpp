#include "capture/tools/turns_options.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <system_error>

namespace rs::capture {
namespace {

void print_turns_json(const std::string& output, const TurnsImportReport& report) {
    nlohmann::json json = {{"set", output},           {"method", "turns"},
                           {"views", report.views},   {"segmenter", to_string(report.segmenter)},
                           {"radius", report.radius}, {"height", report.height},
                           {"notes", report.notes}};
    for (const ImportedTurn& turn : report.turns) json["turns"].push_back(turn_json(turn));
    std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

void print_turns_summary(const std::string& output, const TurnsImportReport& report) {
    std::printf("%s: %zu views of %zu turns, segmented by %s\n", output.c_str(), report.views, report.turns.size(),
                to_string(report.segmenter).c_str());
    for (const ImportedTurn& turn : report.turns) {
        const RegisteredTurn& found = turn.registered;
        std::printf(
            "  %s: %zu views, %.2f degrees above, %s by %.2f degrees, %.2f radii away, focal length %.1f px; "
            "registered by %s",
            printable(turn.name).c_str(), turn.views, turn.elevation_deg,
            turn.axis_tilt_deg > 0 ? "laid over" : "turned",
            turn.axis_tilt_deg > 0 ? turn.axis_tilt_deg : turn.azimuth_deg, turn.distance, found.turn.model.lens.f_px,
            to_string(found.method).c_str());
        if (found.observations > 0) std::printf(", %zu observations of shared points", found.observations);
        std::printf(", %.2f px RMS, silhouettes overlap by %.0f %%\n", found.rms_px, 100 * found.overlap);
    }
}

}  // namespace

Result<std::vector<TurnSource>> several_turns(const std::vector<std::filesystem::path>& folders) {
    std::error_code ignored;
    if (folders.size() == 1 && !std::filesystem::is_directory(folders.front(), ignored)) {
        return std::vector<TurnSource>{};
    }
    for (const std::filesystem::path& folder : folders) {
        if (folders.size() > 1 && std::filesystem::is_regular_file(folder, ignored)) {
            return Error{folder.string() + ": is a file; several turns are given as a folder of photos each"};
        }
    }
    RS_ASSIGN_OR_RETURN(std::vector<TurnSource> turns, find_turns(folders));
    if (turns.size() < 2) turns.clear();
    return turns;
}

Status run_turns_import(const std::vector<TurnSource>& turns, const ImportOptions& options,
                        const std::vector<std::string>& unused, bool json, bool quiet) {
    if (!unused.empty()) {
        return Error{printable(listed(unused, unused.size()) + ": only for photos of one turn, not for the turns " +
                               turns.front().name + " and " + turns[1].name + (turns.size() > 2 ? " and more" : "") +
                               "; leave it out, or import one turn")};
    }
    ProgressBar bar(quiet);
    RS_ASSIGN_OR_RETURN(const TurnsImportReport report, import_turns(turns, options, &bar));
    bar.finish();
    for (const std::string& note : report.notes) {
        if (!quiet) std::fprintf(stderr, "rs-capture: %s\n", printable(note).c_str());
    }
    if (json) {
        print_turns_json(options.output.string(), report);
    } else {
        print_turns_summary(options.output.string(), report);
    }
    return {};
}

}  // namespace rs::capture
