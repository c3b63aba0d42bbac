#include "encode/tools/commands.hpp"

#include "encode/evaluation/evaluation.hpp"
#include "encode/tools/report_contents.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/page/page_images.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace rs::encode {
namespace {

struct EvaluateArguments {
    std::string set;
    std::string hold_out = "every-2nd";
    std::string methods = "photo,plane,shape";
    std::string output;
    std::string report;
    int planes = EvaluationOptions{}.planes;
    bool views = false;
    bool quiet = false;
    bool json = false;
    bool force = false;
};

// Writes FOLDER/truth/0001.png, FOLDER/plane/0001.png and FOLDER/plane-error/0001.png, named by the view's index in the
// set.
class EvaluationFolder {
public:
    static Result<EvaluationFolder> create(const std::string& path, bool force, const std::vector<Method>& methods) {
        RS_ASSIGN_OR_RETURN(StagedFolder folder, StagedFolder::create(path, "answers of methods", force));
        EvaluationFolder made(std::move(folder), methods.front());
        std::vector<std::string> names{"truth"};
        for (const Method method : methods) {
            names.push_back(to_string(method));
            names.push_back(to_string(method) + "-error");
        }
        for (const std::string& name : names) {
            std::error_code error;
            if (!std::filesystem::create_directory(made.folder_.temporary_path() / name, error)) {
                return Error{path + "/" + name + ": cannot be created: " + error.message()};
            }
        }
        return made;
    }

    [[nodiscard]] Status write(const EvaluatedView& evaluated) const {
        const std::string name = numbered_image_name(static_cast<std::size_t>(evaluated.view));
        const std::string method = to_string(evaluated.method);
        const std::filesystem::path& root = folder_.temporary_path();
        if (evaluated.method == first_) {
            RS_TRY(write_png(root / "truth" / name, evaluated.truth));
        }
        RS_TRY(write_png(root / method / name, evaluated.rendering));
        return write_png(root / (method + "-error") / name,
                         error_image(evaluated.truth, evaluated.rendering, kErrorFullScale));
    }

    Status commit() { return folder_.commit(); }

private:
    EvaluationFolder(StagedFolder folder, Method first) : folder_(std::move(folder)), first_(first) {}
    StagedFolder folder_;
    Method first_;  // ground truth is written once, with this method's renderings
};

void print_json(const EvaluateArguments& arguments, const HoldOut& hold_out, const std::vector<MethodScores>& scores) {
    nlohmann::json json{
        {"set", arguments.set},        {"hold_out", arguments.hold_out},  {"planes", arguments.planes},
        {"views_kept", hold_out.kept}, {"views_held_out", hold_out.held}, {"methods", nlohmann::json::array()}};
    for (const MethodScores& method : scores) {
        nlohmann::json views = nlohmann::json::array();
        for (const HeldOutScore& view : method.views) {
            views.push_back(
                {{"view", view.view}, {"picture", view.image}, {"psnr_db", view.psnr_db}, {"ssim", view.ssim}});
        }
        json["methods"].push_back({{"method", method.method},
                                   {"mean_psnr_db", method.mean_psnr_db},
                                   {"pooled_psnr_db", method.pooled_psnr_db},
                                   {"mean_ssim", method.mean_ssim},
                                   {"build_seconds", method.build_seconds},
                                   {"views", std::move(views)}});
    }
    std::cout << json.dump(2) << '\n';
}

void print_table(const EvaluateArguments& arguments, const HoldOut& hold_out, const std::vector<MethodScores>& scores) {
    if (arguments.views) {
        std::printf("%5s  %-24s", "view", "image");
        for (const MethodScores& method : scores) std::printf("  %8s dB", method.method.c_str());
        std::printf("\n");
        for (std::size_t n = 0; n < hold_out.held.size(); ++n) {
            const HeldOutScore& first = scores.front().views[n];
            std::printf("%5d  %-24s", first.view, printable(first.image).c_str());
            for (const MethodScores& method : scores) std::printf("  %11.2f", method.views[n].psnr_db);
            std::printf("\n");
        }
        std::printf("\n");
    }
    std::printf("%s: built from %zu views, scored on %zu held out (%s)\n", arguments.set.c_str(), hold_out.kept.size(),
                hold_out.held.size(), arguments.hold_out.c_str());
    std::printf("%-8s %12s %14s %10s %9s\n", "method", "mean PSNR", "pooled PSNR", "mean SSIM", "build");
    for (const MethodScores& method : scores) {
        std::printf("%-8s %9.2f dB %11.2f dB %10.4f %7.1f s\n", method.method.c_str(), method.mean_psnr_db,
                    method.pooled_psnr_db, method.mean_ssim, method.build_seconds);
    }
}

Status write_page(const EvaluateArguments& arguments, const CaptureSet& set, const HoldOut& hold_out,
                  const std::vector<MethodScores>& scores, EvaluationThumbnails thumbnails, StagedFile& file) {
    BuildReport report;
    report.name = name_of(set);
    report.facts = {{"capture set", arguments.set},
                    {"images", std::to_string(set.upright.views.size()) + (set.resampled ? ", resampled upright" : "")},
                    {"reference planes", std::to_string(arguments.planes)}};
    report.rig = set.upright;
    RS_TRY(add_captured_images(set, report));
    std::string which = arguments.hold_out;  // every-3rd, turn=1
    for (const char separator : {'-', '='}) std::ranges::replace(which, separator, ' ');
    add_scores(set, hold_out, which, scores, std::move(thumbnails), report);
    return write_report(file, report);
}

Status run_evaluate(const EvaluateArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const HoldOutRule rule, parse_hold_out(arguments.hold_out));
    EvaluationOptions options;
    options.planes = arguments.planes;
    RS_ASSIGN_OR_RETURN(std::vector<Method> methods, parse_methods(arguments.methods));
    options.methods = std::move(methods);

    ProgressBar progress(arguments.quiet);
    RS_ASSIGN_OR_RETURN(const CaptureSet set, open_capture_set(arguments.set, &progress));
    for (const std::string& warning : set.warnings) std::cerr << "rs-encode: warning: " << warning << '\n';
    RS_ASSIGN_OR_RETURN(const HoldOut hold_out, choose_hold_out(set.upright, rule, arguments.set));
    std::vector<std::filesystem::path> inputs{arguments.set, arguments.report};
    for (const RigView& view : set.captured.views) inputs.push_back(image_path(set.folder, view));
    RS_TRY(refuse_overwriting_inputs(arguments.output, inputs));
    std::optional<EvaluationFolder> folder;
    if (!arguments.output.empty()) {
        RS_ASSIGN_OR_RETURN(EvaluationFolder created,
                            EvaluationFolder::create(arguments.output, arguments.force, options.methods));
        folder = std::move(created);
    }
    std::optional<StagedFile> page;
    if (!arguments.report.empty()) {
        RS_ASSIGN_OR_RETURN(StagedFile created, StagedFile::create(arguments.report));
        page = std::move(created);
    }
    EvaluationThumbnails thumbnails(hold_out, options.methods);
    const EvaluationSink sink = [&](const EvaluatedView& evaluated) -> Status {
        if (page) {
            RS_TRY(thumbnails.keep(evaluated));
        }
        return folder ? folder->write(evaluated) : Status{};
    };
    RS_ASSIGN_OR_RETURN(const std::vector<MethodScores> scores, evaluate(set, hold_out, options, sink, &progress));
    if (folder) {
        RS_TRY(folder->commit());
    }
    if (page) {
        RS_TRY(write_page(arguments, set, hold_out, scores, std::move(thumbnails), *page));
    }
    if (arguments.json) {
        print_json(arguments, hold_out, scores);
    } else {
        print_table(arguments, hold_out, scores);
    }
    return {};
}

}  // namespace

void add_evaluate_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<EvaluateArguments>();
    CLI::App* command =
        app.add_subcommand("evaluate",
                           "Build objects from some views of a set, render the others, and print PSNR and SSIM against "
                           "their images.\nRGB premultiplied by alpha, 8 bit, over pixels where either image's "
                           "alpha is above 0. Views used to build an object are never scored");
    command->add_option("SET", arguments->set, "capture set: a folder with transforms.json and its images")->required();
    command
        ->add_option(
            "--hold-out", arguments->hold_out,
            "every-Nth: hold out the middle one of each N neighbouring views of a ring; turn=N: all views of one "
            "turn of a set of several, the first is 0")
        ->capture_default_str();
    command
        ->add_option("--methods", arguments->methods,
                     "methods: photo (the nearest kept image, unchanged), plane and shape (as --raymap of build)")
        ->capture_default_str();
    command->add_option("--planes", arguments->planes, "reference planes about the axis, 3..64")->capture_default_str();
    command->add_option("-o,--output", arguments->output,
                        "folder for ground truth, renderings and error maps of the held-out views, as PNG");
    command
        ->add_option("--report", arguments->report,
                     "also write a report, PAGE.html: scores, some renderings beside ground truth, the cameras")
        ->check(ends_in({".html", ".htm"}));
    command->add_flag("--views", arguments->views, "also print the PSNR of every view");
    command->add_flag("--force", arguments->force, kForceHelp);
    command->add_flag("-q,--quiet", arguments->quiet, "suppress the progress bar");
    command->add_flag("--json", arguments->json, "print all results as JSON");
    command->footer(
        "Examples:\n  rs-encode evaluate vase-set --report vase.html\n"
        "  rs-encode evaluate vase-set --hold-out every-4th --methods plane,shape -o vase-errors --json");
    command->callback([arguments, &run] { run = [arguments] { return run_evaluate(*arguments); }; });
}

}  // namespace rs::encode
