#include "engine/tools/commands.hpp"

#include "engine/core/views/compare.hpp"
#include "engine/model/layout/object_image.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/format/object_file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
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

Status run_board(const std::vector<std::string>& paths) {
    const BoardLimits limits;
    const model::ObjectLayout& layout = model::layout_of(limits.kind);
    std::vector<RaySpaceObject> objects;
    std::printf("%-28s %9s %9s %9s %9s %9s  MB\n", "object", "luma", "chroma", "alpha", "RS map", "total");
    for (const std::string& path : paths) {
        RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(path, {.max_level = -1}));
        const model::BoardFootprint f = layout.footprint(object);
        const auto megabytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) / 1e6; };
        std::printf("%-28s %9.2f %9.2f %9.2f %9.2f %9.2f\n", printable(object.name).c_str(), megabytes(f.luma_bytes),
                    megabytes(f.chroma_bytes), megabytes(f.alpha_bytes), megabytes(f.map_bytes),
                    megabytes(f.total_bytes()));
        objects.push_back(std::move(object));
    }
    std::printf("%-28s %49.2f\n", "image buffer", static_cast<double>(image_buffer_bytes(limits)) / 1e6);
    for (const RaySpaceObject& object : objects) {
        if (Status status = layout.fits(object, limits); !status) return status;
    }
    if (Status status = layout.fit_together(objects, limits); !status) return status;
    std::printf("all fit on the published board (%llu bytes)\n", static_cast<unsigned long long>(limits.memory_bytes));
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const bool has_shape =
            std::ranges::any_of(objects[i].rings, [](const Ring& ring) { return !ring.shape.empty(); });
        if (objects[i].coded == nullptr && !has_shape) continue;
        std::fprintf(stderr,
                     "rs-engine: %s: the board draws raw images on planes alone; encode it with --profile raw --raymap "
                     "plane, and it takes what is stated here\n",
                     printable(paths[i]).c_str());
    }
    return {};
}

}  // namespace

void add_compare_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command =
        app.add_subcommand("compare",
                           "Render every pose of a capture set and print PSNR and SSIM against its images.\n"
                           "RGB premultiplied by alpha, 8 bit, over pixels where either image's alpha is above 0");
    command->add_option("OBJECT", arguments->object, "ray-space object, .rso")->required();
    command->add_option("SET", arguments->set, "capture set with the true images")->required();
    command->add_flag("-q,--quiet", arguments->quiet, "no progress bar");
    command->add_flag("--json", arguments->json, "as JSON");
    command->footer("Example:\n  rs-engine compare vase.rso vase-held-out --json");
    command->callback([arguments, &run] { run = [arguments] { return run_compare(*arguments); }; });
}

void add_board_command(CLI::App& app, std::function<Status()>& run) {
    auto objects = std::make_shared<std::vector<std::string>>();
    CLI::App* command = app.add_subcommand(
        "board", "Say how much memory of the published hardware board objects take, and whether they fit");
    command->add_option("OBJECT", *objects, "ray-space objects, .rso")->required();
    command->footer("Example:\n  rs-engine board vase.rso doll.rso");
    command->callback([objects, &run] { run = [objects] { return run_board(*objects); }; });
}

}  // namespace rs::engine
