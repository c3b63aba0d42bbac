#include "engine/tools/commands.hpp"

#include "engine/core/views/compare.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/format/object_file.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <iostream>
#include <memory>

namespace rs::engine {
namespace {

struct CompareArguments {
    std::string object;
    std::string set;
    bool quiet = false;
    bool json = false;
};

Result<Renderer> open_renderer(const std::string& path) {
    RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(path, {.decode = false}));
    return Renderer::create(std::move(object));
}

Status run_compare(const CompareArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const Renderer renderer, open_renderer(arguments.object));
    ProgressBar progress(arguments.quiet);
    RS_ASSIGN_OR_RETURN(const Comparison comparison, compare_with_set(renderer, arguments.set, &progress));
    if (arguments.json) {
        nlohmann::json json{{"views", nlohmann::json::array()},
                            {"mean_psnr_db", comparison.mean_psnr_db},
                            {"pooled_psnr_db", comparison.pooled_psnr_db},
                            {"mean_ssim", comparison.mean_ssim}};
        for (const ComparedView& view : comparison.views) {
            json["views"].push_back({{"picture", view.image}, {"psnr_db", view.psnr_db}, {"ssim", view.ssim}});
        }
        std::cout << json.dump(2) << '\n';
        return {};
    }
    for (const ComparedView& view : comparison.views) {
        std::printf("%-24s %6.2f dB  SSIM %.4f\n", printable(view.image).c_str(), view.psnr_db, view.ssim);
    }
    std::printf("%-24s %6.2f dB  SSIM %.4f  (all pixels together %.2f dB)\n", "mean", comparison.mean_psnr_db,
                comparison.mean_ssim, comparison.pooled_psnr_db);
    return {};
}

}  // namespace

void add_compare_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = app.add_subcommand(
        "compare",
        "Render every pose of a capture set and print PSNR and SSIM against its photos.\n"
        "Measured on RGB premultiplied by alpha, 8 bit, over pixels where either image's alpha is above 0");
    command->add_option("OBJECT", arguments->object, "ray-space object, .rso")->required();
    command->add_option("SET", arguments->set, "capture set with the reference photos")->required();
    command->add_flag("-q,--quiet", arguments->quiet, "no progress bar");
    command->add_flag("--json", arguments->json, "print JSON");
    command->footer("Example:\n  rs-engine compare vase.rso vase-held-out --json");
    command->callback([arguments, &run] { run = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace rs::engine
