// Rate-distortion benchmark: PSNR over rate of Rayspace objects, ASTC, JPEG, WebP and x265, measured in one run on the
// same images.
//
//     bench_rd --work DIR --csv rd.csv --svg rd.svg [--only anchors|ours|NAME]... [--encoder rs-encode] SET...
//
// Rate: bits per pixel of the 8x8 blocks (of the upright images, counted from the top left) that the object touches,
// so that empty background does not count. Quality: PSNR over object pixels (alpha >= 128) of straight sRGB, the
// squared error pooled over all views. rd_ratios.csv gets the rates relative to ASTC at equal PSNR.

#include "rayspace/file/file_output.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/rd/anchors/anchors.hpp"
#include "tests/bench/rd/ours.hpp"
#include "tests/bench/rd/rate_plot.hpp"
#include "tests/bench/rd/report.hpp"

#include <algorithm>
#include <cstdio>
#include <span>

namespace rs::bench {
namespace {

struct Arguments {
    std::string work;
    std::string csv;
    std::string svg;
    std::vector<std::string> only;
    std::string encoder;
    std::vector<std::string> sets;
};

// Requested curves.
struct CurveNames {
    std::set<std::string> anchors;
    std::set<std::string> profiles;
};

bool contains(const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

Result<CurveNames> parse_curve_names(const std::vector<std::string>& only) {
    // Default: everything except raw images.
    const std::vector<std::string> words = only.empty() ? std::vector<std::string>{"anchors", "ours"} : only;
    CurveNames wanted;
    for (const std::string& word : words) {
        if (word == "anchors") {
            wanted.anchors.insert(anchor_names().begin(), anchor_names().end());
        } else if (word == "ours") {
            wanted.profiles.insert({"dense", "board"});
        } else if (contains(anchor_names(), word)) {
            wanted.anchors.insert(word);
        } else if (contains(profile_names(), word)) {
            wanted.profiles.insert(word);
        } else {
            std::string known = "anchors, ours";
            for (const auto* names : {&anchor_names(), &profile_names()}) {
                for (const std::string& name : *names) known += ", " + name;
            }
            return Error{"--only " + word + ": there is no such curve; give one of " + known};
        }
    }
    return wanted;
}

std::string about(const ReferenceImages& images) {
    return std::to_string(images.views.size()) + " views of " + std::to_string(images.width) + "x" +
           std::to_string(images.height) + ", " + std::to_string(images.touched_blocks) + " touched blocks";
}

Result<SetResult> measure_set(const std::string& folder, const CurveNames& wanted, const std::string& encoder,
                              const WorkFolder& work, Progress& progress) {
    const Result<ReferenceImages> images = read_reference_images(folder, &progress);
    if (!images) return images.error();
    std::vector<Measurement> measured;
    if (!wanted.profiles.empty()) {
        const auto ours = measure_ours(*images, wanted.profiles, encoder, work, progress);
        if (!ours) return ours.error();
        measured = *ours;
    }
    if (!wanted.anchors.empty()) {
        const auto anchors = measure_anchors(*images, wanted.anchors, work, progress);
        if (!anchors) return anchors.error();
        measured.insert(measured.end(), anchors->begin(), anchors->end());
    }
    return SetResult{images->name, about(*images), best_variants(measured)};
}

Status run(const Arguments& arguments) {
    const Result<CurveNames> wanted = parse_curve_names(arguments.only);
    if (!wanted) return wanted.error();
    if (Status status = check_encoder(arguments.encoder, wanted->profiles); !status) return status;
    const Result<WorkFolder> work = WorkFolder::open(arguments.work);
    if (!work) return work.error();
    ProgressBar progress;
    std::vector<SetResult> results;
    for (const std::string& set : arguments.sets) {
        Result<SetResult> result = measure_set(set, *wanted, arguments.encoder, *work, progress);
        if (!result) return result.error();
        results.push_back(std::move(*result));
        // Written after every set, so that results survive a failure of a later one.
        if (Status status = write_file(arguments.csv, points_csv(results)); !status) return status;
        if (Status status = write_file(ratios_path(arguments.csv), ratios_csv(results)); !status) return status;
    }
    std::fputs(summary_text(results).c_str(), stdout);
    return arguments.svg.empty() ? Status{} : write_file(arguments.svg, rate_plot_svg(results));
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    rs::bench::Arguments arguments;
    // Default encoder: the one of the same build, in the same folder.
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    arguments.encoder = error ? "rs-encode" : (self.parent_path() / "rs-encode").string();

    CLI::App app("PSNR over rate of Rayspace's image coding and of established codecs.", "bench_rd");
    app.add_option("--work", arguments.work, "folder for temporary files and for the anchors' results")->required();
    app.add_option("--csv", arguments.csv, "points to write; the comparison goes to NAME_ratios.csv beside it")
        ->required();
    app.add_option("--svg", arguments.svg, "plot to write");
    app.add_option("--only", arguments.only, "anchors, ours, or the name of a curve; may be given several times")
        ->take_all()
        ->expected(1);
    app.add_option("--encoder", arguments.encoder, "the rs-encode to measure")->capture_default_str();
    app.add_option("SET", arguments.sets, "capture sets")->required();
    app.footer("Example:\n  bench_rd --work work --csv rd.csv --svg rd.svg vase-set shoe-set");
    std::function<rs::Status()> run = [&] { return rs::bench::run(arguments); };
    return rs::tool_main(app, argc, argv, run);
}
