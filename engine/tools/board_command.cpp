#include "engine/model/board.hpp"
#include "engine/model/layout/object_image.hpp"
#include "engine/model/report/report.hpp"
#include "engine/tools/commands.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/format/object_file.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

namespace rs::engine {
namespace {

struct BoardArguments {
    std::vector<std::string> objects;
    std::string config = "prototype-2000";
    bool buses = false;
};

struct MemoryColumn {
    const char* title;
    std::uint64_t bytes;
};

// Board memory of an object by kind of data.
std::vector<MemoryColumn> memory_columns(const model::BoardFootprint& f, BoardKind kind) {
    if (kind == BoardKind::raw_images) {
        return {{"luma", f.luma_bytes},
                {"chroma", f.chroma_bytes},
                {"alpha", f.alpha_bytes},
                {"RS map", f.map_bytes},
                {"total", f.total_bytes()}};
    }
    return {{"images", f.luma_bytes + f.chroma_bytes + f.alpha_bytes + f.tile_bytes + f.tile_table_bytes},
            {"codebooks", f.book_bytes},
            {"RS map", f.map_bytes},
            {"shape map", f.shape_bytes},
            {"total", f.total_bytes()}};
}

double megabytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / 1e6;
}

void print_header(BoardKind kind) {
    std::printf("%-28s", "object");
    for (const MemoryColumn& column : memory_columns({}, kind)) std::printf(" %9s", column.title);
    std::printf("  MB\n");
}

void print_memory(const std::string& name, const std::vector<MemoryColumn>& columns) {
    std::printf("%-28s", name.c_str());
    for (const MemoryColumn& column : columns) std::printf(" %9.2f", megabytes(column.bytes));
    std::printf("\n");
}

bool has_shape_map(const RaySpaceObject& object) {
    return std::ranges::any_of(object.rings, [](const Ring& ring) { return !ring.shape.empty(); });
}

// Names on stderr what the board renders differently from the core, or leaves to it.
void print_differences(const std::vector<RaySpaceObject>& objects, const ExecutorTraits& traits) {
    for (const RaySpaceObject& object : objects) {
        if (traits.filters || !has_shape_map(object)) continue;
        std::fprintf(stderr,
                     "rs-engine: %s: this board has only the bilinear texel filter, so views are softer than those of "
                     "the core, which also has sharp and smooth\n",
                     printable(object.name).c_str());
    }
    if (!traits.tilted) std::printf("views of tilted cameras: not on this board; use --upright\n");
    if (!traits.depth) std::printf("depth of pixels: not on this board\n");
}

Status run_board(const BoardArguments& arguments) {
    if (arguments.buses) {
        std::printf("%s", model::bus_table().c_str());
        return {};
    }
    RS_ASSIGN_OR_RETURN(const model::BoardConfig config, model::read_board_config(arguments.config));
    const BoardLimits& limits = config.limits;
    const model::ObjectLayout& layout = model::layout_of(limits.kind);
    std::vector<RaySpaceObject> objects;
    std::size_t refused = 0;
    print_header(limits.kind);
    for (const std::string& path : arguments.objects) {
        RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(path, {.decode = false}));
        const Status drawable = layout.drawable(object, limits);
        // The size of raw images follows from the photos' size, whatever their present profile is.
        if (drawable || limits.kind == BoardKind::raw_images) {
            print_memory(printable(object.name), memory_columns(layout.footprint(object), limits.kind));
        }
        if (!drawable) {
            ++refused;
            std::fprintf(stderr, "rs-engine: %s: %s\n", printable(path).c_str(),
                         printable(drawable.error().message).c_str());
        }
        object.images.clear();
        objects.push_back(std::move(object));
    }
    print_memory("image buffer", {{"", image_buffer_bytes(limits)}});
    if (refused > 0) {
        return Error{
            std::to_string(refused) + " of " + std::to_string(objects.size()) + " objects cannot be drawn by " +
            config.name + ", for the reasons above" +
            (limits.kind == BoardKind::raw_images ? "; their sizes are those of raw images with a plane map" : "")};
    }
    RS_TRY(layout.fit_together(objects, limits));
    std::printf("all fit on %s (%llu bytes), and it can draw them\n", printable(config.name).c_str(),
                static_cast<unsigned long long>(limits.memory_bytes));
    print_differences(objects, model::board_traits(config));
    return {};
}

}  // namespace

void add_board_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<BoardArguments>();
    CLI::App* command = app.add_subcommand(
        "board", "Print the memory that objects take on a hardware board, and check that they fit and can be drawn");
    CLI::Option* const objects = command->add_option("OBJECT", arguments->objects, "ray-space objects, .rso");
    CLI::Option* const config =
        command
            ->add_option("--config", arguments->config,
                         "prototype-2000, compressed-2000, parallel, or a JSON file as of simulate")
            ->capture_default_str();
    command->add_flag("--buses", arguments->buses, "print the rates of the boards' buses for nine images, and exit")
        ->excludes(objects)
        ->excludes(config);
    command->footer(
        "Examples:\n  rs-engine board vase.rso doll.rso\n"
        "  rs-engine board --config parallel vase.rso\n"
        "  rs-engine board --buses");
    command->callback([arguments, &run] {
        if (!arguments->buses && arguments->objects.empty()) throw CLI::RequiredError("OBJECT");
        run = [arguments] { return run_board(*arguments); };
    });
}

}  // namespace rs::engine
