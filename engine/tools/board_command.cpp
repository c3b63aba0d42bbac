#include "engine/model/layout/object_image.hpp"
#include "engine/tools/commands.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/format/object_file.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace rs::engine {
namespace {

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
        RS_TRY(layout.fits(object, limits));
    }
    RS_TRY(layout.fit_together(objects, limits));
    std::printf("all fit on the published board (%llu bytes)\n", static_cast<unsigned long long>(limits.memory_bytes));
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const bool has_shape =
            std::ranges::any_of(objects[i].rings, [](const Ring& ring) { return !ring.shape.empty(); });
        if (objects[i].coded == nullptr && !has_shape) continue;
        std::fprintf(
            stderr,
            "rs-engine: %s: the board renders only raw images with a plane map; the sizes above are those after "
            "encoding with --profile raw --raymap plane\n",
            printable(paths[i]).c_str());
    }
    return {};
}

}  // namespace

void add_board_command(CLI::App& app, std::function<Status()>& run) {
    auto objects = std::make_shared<std::vector<std::string>>();
    CLI::App* command = app.add_subcommand(
        "board", "Print the memory that objects take on the published hardware board, and check that they fit");
    command->add_option("OBJECT", *objects, "ray-space objects, .rso")->required();
    command->footer("Example:\n  rs-engine board vase.rso doll.rso");
    command->callback([objects, &run] { run = [objects] { return run_board(*objects); }; });
}

}  // namespace rs::engine
