#include "encode/tools/commands.hpp"

#include "encode/build.hpp"
#include "encode/report/ray_map_image.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/codec/stream/byte_account.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

namespace rs::encode {
namespace {

struct ObjectArguments {
    std::string object;
    std::string output;
    bool force = false;
    bool quiet = false;
    bool json = false;
    std::string map_image;
    int map_ring = 0;
    std::optional<int> map_plane;
};

std::string stored_as(const RaySpaceObject& object) {
    return object.coded ? codec::name_of(object.coded->profile) : "raw";
}

// Writes the figure of the RS map, if one is requested.
Status write_map_image(const ObjectArguments& arguments, const RaySpaceObject& object) {
    if (arguments.map_image.empty()) return {};
    if (arguments.map_ring >= static_cast<int>(object.rings.size())) {
        return Error{"--map-ring " + std::to_string(arguments.map_ring) + ": " + arguments.object + " has rings 0 to " +
                     std::to_string(object.rings.size() - 1)};
    }
    const Ring& ring = object.rings[static_cast<std::size_t>(arguments.map_ring)];
    const Result<Image<Rgba8>> image = ray_map_image(ring, arguments.map_plane);
    if (!image) return Error{"--map-plane: " + arguments.object + ": " + image.error().message};
    return write_png(arguments.map_image, *image);
}

Status run_info(const ObjectArguments& arguments) {
    RS_TRY(refuse_overwriting_inputs(arguments.map_image, {arguments.object}));
    RS_ASSIGN_OR_RETURN(const ContainerReader container, ContainerReader::open(arguments.object));
    Result<RaySpaceObject> object = read_object(container, {.max_level = -1});
    if (!object) return object.error();
    std::vector<codec::AccountEntry> account;
    if (object->coded) {
        object = read_object(container, {.decode = false});
        if (!object) return object.error();
        account = codec::account_bytes(*object->coded);
    }
    RS_TRY(write_map_image(arguments, *object));
    const std::vector<ChunkSummary> chunks = summarise_chunks(container);
    if (arguments.json) {
        nlohmann::json json{{"name", object->name},
                            {"views", object->views.size()},
                            {"width", object->width},
                            {"height", object->height},
                            {"bytes", container.size_bytes()},
                            {"units_per_radius", object->units_per_radius}};
        if (object->foot_q20) json["foot_radii"] = std::ldexp(*object->foot_q20, -20);
        for (const Ring& ring : object->rings) {
            json["rings"].push_back({{"elevation_deg", ring.elevation_udeg * 1e-6},
                                     {"views", ring.views.size()},
                                     {"planes", ring.planes},
                                     {"x_cells", ring.x_cells},
                                     {"u_cells", ring.u_cells}});
            const RingRotation& q = ring.rotation;
            if (q.is_identity()) continue;
            json["rings"].back()["rotation_q30"] = {q.x_q30, q.y_q30, q.z_q30, q.w_q30};
        }
        for (const ChunkSummary& chunk : chunks) {
            json["chunks"].push_back({{"name", chunk.name}, {"count", chunk.count}, {"bytes", chunk.size_bytes}});
        }
        json["pictures"] = stored_as(*object);
        for (const codec::AccountEntry& entry : account) {
            json["pictures_bytes"].push_back({{"name", entry.name}, {"bytes", std::llround(entry.bytes)}});
        }
        std::cout << json.dump(2) << '\n';
        return {};
    }
    std::printf("%s: \"%s\"\n", arguments.object.c_str(), printable(object->name).c_str());
    std::printf("  images   %zu of %dx%d, Y U V %sand alpha, %s\n", object->views.size(), object->width, object->height,
                object->coded ? "" : "at 4:2:0 ", stored_as(*object).c_str());
    for (const Ring& ring : object->rings) {
        std::printf("  ring       %zu views at elevation %.2f degrees%s; %d planes, RS map %dx%d (x, u)\n",
                    ring.views.size(), ring.elevation_udeg * 1e-6,
                    ring.rotation.is_identity() ? "" : " about an axis across the object's", ring.planes, ring.x_cells,
                    ring.u_cells);
    }
    std::printf("  radius     %g units of the capture set\n", object->units_per_radius);
    if (object->foot_q20) std::printf("  stands at  height %.3f radii\n", std::ldexp(*object->foot_q20, -20));
    std::printf("  file       %llu bytes\n", static_cast<unsigned long long>(container.size_bytes()));
    for (const ChunkSummary& chunk : chunks) {
        std::printf("    %s  x %-5llu %12llu bytes  %5.1f %%\n", chunk.name.c_str(),
                    static_cast<unsigned long long>(chunk.count), static_cast<unsigned long long>(chunk.size_bytes),
                    100.0 * static_cast<double>(chunk.size_bytes) / static_cast<double>(container.size_bytes()));
    }
    if (!account.empty()) std::printf("  in the images:\n");
    for (const codec::AccountEntry& entry : account) {
        std::printf("    %-34s %12.0f bytes  %5.1f %%\n", entry.name.c_str(), entry.bytes,
                    100.0 * entry.bytes / static_cast<double>(container.size_bytes()));
    }
    return {};
}

Status run_verify(const ObjectArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const ContainerReader container, ContainerReader::open(arguments.object));
    // Check every chunk, including those that read_object() skips, and then every bound of FORMAT.md.
    for (const ChunkEntry& entry : container.table()) {
        RS_TRY(container.read(entry));
    }
    RS_ASSIGN_OR_RETURN(const RaySpaceObject object, read_object(container));
    std::printf("%s: sound (%zu images, %zu rings)\n", arguments.object.c_str(), object.images.size(),
                object.rings.size());
    return {};
}

Status run_extract(const ObjectArguments& arguments) {
    if (Status kept = refuse_overwriting_inputs(arguments.output, {arguments.object}); !kept) return kept;
    RS_ASSIGN_OR_RETURN(const RaySpaceObject object, read_object(arguments.object));
    ProgressBar progress(arguments.quiet);
    RS_TRY(extract_images(object, arguments.output, &progress, arguments.force));
    std::printf("%s: %zu images\n", arguments.output.c_str(), object.images.size());
    return {};
}

// Adds a subcommand with the options common to all three.
CLI::App* add_object_command(CLI::App& app, std::function<Status()>& run, const char* name, const char* about,
                             const std::shared_ptr<ObjectArguments>& arguments,
                             Status (*action)(const ObjectArguments&)) {
    CLI::App* command = app.add_subcommand(name, about);
    command->add_option("OBJECT", arguments->object, "ray-space object, .rso")->required();
    command->callback([arguments, action, &run] { run = [arguments, action] { return action(*arguments); }; });
    return command;
}

}  // namespace

void add_info_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<ObjectArguments>();
    CLI::App* command = add_object_command(app, run, "info", "Print an object's contents and the size of its parts",
                                           arguments, run_info);
    command->add_flag("--json", arguments->json, "print as JSON");
    CLI::Option* const image =
        command
            ->add_option("--map-image", arguments->map_image,
                         "draw the RS map to this PNG file: x across, u down, the reference planes one below the "
                         "other; colours are the photos in turning order, transparent is none")
            ->check(ends_in({".png"}));
    command->add_option("--map-ring", arguments->map_ring, "ring that --map-image draws, from 0")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->needs(image);
    command->add_option("--map-plane", arguments->map_plane, "reference plane that --map-image draws alone, from 0")
        ->check(CLI::NonNegativeNumber)
        ->needs(image);
    command->footer("Examples:\n  rs-encode info vase.rso --json\n  rs-encode info vase.rso --map-image map.png");
}

void add_verify_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<ObjectArguments>();
    add_object_command(app, run, "verify", "Check every checksum and bound of an object", arguments, run_verify)
        ->footer("Example:\n  rs-encode verify vase.rso");
}

void add_extract_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<ObjectArguments>();
    CLI::App* command = add_object_command(
        app, run, "extract", "Write the stored images and their rig as a capture set", arguments, run_extract);
    command->add_option("-o,--output", arguments->output, "capture set to write")->required();
    command->add_flag("--force", arguments->force, kForceHelp);
    command->add_flag("-q,--quiet", arguments->quiet, "suppress the progress bar");
    command->footer("Example:\n  rs-encode extract vase.rso -o vase-images");
}

}  // namespace rs::encode
