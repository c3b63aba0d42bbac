// rs-encode: capture set -> ray-space object, and a look into objects.

#include "encode/build.hpp"
#include "encode/capture_set.hpp"
#include "rayspace/object_file.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/tool_main.hpp"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <iostream>

namespace rs::encode {
namespace {

struct BuildArguments {
    std::string set;
    std::string output;
    std::string raymap = "512x512";
    BuildOptions options;
    bool quiet = false;
    bool json = false;
};

struct ObjectArguments {
    std::string object;
    std::string output;
    bool quiet = false;
    bool json = false;
};

// The most memory that this process has held, as the system counts it.
long long peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * 1024LL;
}

Status run_build(const BuildArguments& arguments) {
    const auto begun = std::chrono::steady_clock::now();
    ProgressBar progress(arguments.quiet);
    BuildOptions options = arguments.options;
    const Result<PixelSize> cells = parse_size(arguments.raymap);
    if (!cells) return Error{"--raymap " + arguments.raymap + ": give cells of x and of u, such as 512x512"};
    options.map.x_cells = cells->width;
    options.map.u_cells = cells->height;

    Result<CaptureSet> set = open_capture_set(arguments.set, &progress);
    if (!set) return set.error();
    if (options.name.empty())
        options.name = std::filesystem::weakly_canonical(std::filesystem::absolute(set->folder)).filename().string();
    if (set->resampled) std::cerr << "rs-encode: the cameras look up or down; their pictures are made upright\n";
    Result<BuiltObject> built = build_object(*set, options, &progress);
    if (!built) return built.error();
    for (const std::string& warning : built->warnings) std::cerr << "rs-encode: warning: " << warning << '\n';
    if (Status status = write_object(arguments.output, built->object, &progress); !status) return status;

    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const auto bytes = std::filesystem::file_size(arguments.output);
    const RaySpaceObject& object = built->object;
    if (arguments.json) {
        std::cout << nlohmann::json{{"object", arguments.output},   {"views", object.views.size()},
                                    {"width", object.width},        {"height", object.height},
                                    {"rings", object.rings.size()}, {"bytes", bytes},
                                    {"seconds", seconds},           {"peak_memory_bytes", peak_memory_bytes()}}
                         .dump(2)
                  << '\n';
    } else {
        std::printf("%s: %zu views of %dx%d, %d planes, %.1f MB, %.1f s, peak memory %.0f MB\n",
                    arguments.output.c_str(), object.views.size(), object.width, object.height, options.map.planes,
                    static_cast<double>(bytes) / 1e6, seconds, static_cast<double>(peak_memory_bytes()) / 1e6);
    }
    return {};
}

Status run_info(const ObjectArguments& arguments) {
    const Result<ContainerReader> container = ContainerReader::open(arguments.object);
    if (!container) return container.error();
    const Result<RaySpaceObject> object = read_object(*container, {.max_level = -1});
    if (!object) return object.error();
    const std::vector<ChunkSummary> chunks = summarise_chunks(*container);
    if (arguments.json) {
        nlohmann::json json{{"name", object->name},
                            {"views", object->views.size()},
                            {"width", object->width},
                            {"height", object->height},
                            {"bytes", container->size_bytes()},
                            {"units_per_radius", object->units_per_radius}};
        for (const Ring& ring : object->rings) {
            json["rings"].push_back({{"elevation_deg", ring.elevation_udeg * 1e-6},
                                     {"views", ring.views.size()},
                                     {"planes", ring.planes},
                                     {"x_cells", ring.x_cells},
                                     {"u_cells", ring.u_cells}});
        }
        for (const ChunkSummary& chunk : chunks) {
            json["chunks"].push_back({{"name", chunk.name}, {"count", chunk.count}, {"bytes", chunk.size_bytes}});
        }
        std::cout << json.dump(2) << '\n';
        return {};
    }
    std::printf("%s: \"%s\"\n", arguments.object.c_str(), object->name.c_str());
    std::printf("  pictures   %zu of %dx%d, Y U V at 4:2:0 and alpha, uncompressed\n", object->views.size(),
                object->width, object->height);
    for (const Ring& ring : object->rings) {
        std::printf("  ring       %zu views at elevation %.2f degrees; %d planes, RS map %dx%d (x, u)\n",
                    ring.views.size(), ring.elevation_udeg * 1e-6, ring.planes, ring.x_cells, ring.u_cells);
    }
    std::printf("  radius     %g units of the capture set\n", object->units_per_radius);
    std::printf("  file       %llu bytes\n", static_cast<unsigned long long>(container->size_bytes()));
    for (const ChunkSummary& chunk : chunks) {
        std::printf("    %s  x %-5llu %12llu bytes  %5.1f %%\n", chunk.name.c_str(),
                    static_cast<unsigned long long>(chunk.count), static_cast<unsigned long long>(chunk.size_bytes),
                    100.0 * static_cast<double>(chunk.size_bytes) / static_cast<double>(container->size_bytes()));
    }
    return {};
}

Status run_verify(const ObjectArguments& arguments) {
    const Result<ContainerReader> container = ContainerReader::open(arguments.object);
    if (!container) return container.error();
    // Every chunk, also those that an object is read without, and then every bound of FORMAT.md.
    for (const ChunkEntry& entry : container->table()) {
        if (const auto payload = container->read(entry); !payload) return payload.error();
    }
    const Result<RaySpaceObject> object = read_object(*container);
    if (!object) return object.error();
    std::printf("%s: sound (%zu pictures, %zu rings)\n", arguments.object.c_str(), object->pictures.size(),
                object->rings.size());
    return {};
}

Status run_extract(const ObjectArguments& arguments) {
    const Result<RaySpaceObject> object = read_object(arguments.object);
    if (!object) return object.error();
    ProgressBar progress(arguments.quiet);
    if (Status status = extract_pictures(*object, arguments.output, &progress); !status) return status;
    std::printf("%s: %zu pictures\n", arguments.output.c_str(), object->pictures.size());
    return {};
}

void add_build(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<BuildArguments>();
    CLI::App* command = app.add_subcommand("build", "Build a ray-space object from a capture set");
    command->add_option("SET", arguments->set, "capture set: a folder with transforms.json and its pictures")
        ->required();
    command->add_option("-o,--output", arguments->output, "the object to write, OBJECT.rso")->required();
    command->add_option("--planes", arguments->options.map.planes, "reference planes about the axis, 3..64")
        ->capture_default_str();
    command->add_option("--raymap", arguments->raymap, "cells of the RS map of a plane, X x U")->capture_default_str();
    command->add_option("--name", arguments->options.name, "name of the object; the set's folder where not given");
    command->add_flag("-q,--quiet", arguments->quiet, "no progress bar");
    command->add_flag("--json", arguments->json, "the summary as JSON");
    command->footer("Example:\n  rs-encode build vase-set -o vase.rso --planes 12 --raymap 512x512");
    command->callback([arguments, &run] { run = [arguments] { return run_build(*arguments); }; });
}

void add_object_command(CLI::App& app, std::function<Status()>& run, const char* name, const char* about,
                        const char* footer, bool json, Status (*action)(const ObjectArguments&)) {
    auto arguments = std::make_shared<ObjectArguments>();
    CLI::App* command = app.add_subcommand(name, about);
    command->add_option("OBJECT", arguments->object, "ray-space object, .rso")->required();
    if (json) command->add_flag("--json", arguments->json, "as JSON");
    if (action == run_extract) {
        command->add_option("-o,--output", arguments->output, "capture set to write")->required();
        command->add_flag("-q,--quiet", arguments->quiet, "no progress bar");
    }
    command->footer(footer);
    command->callback([arguments, action, &run] { run = [arguments, action] { return action(*arguments); }; });
}

}  // namespace
}  // namespace rs::encode

int main(int argc, char** argv) {
    using namespace rs::encode;
    CLI::App app("Builds ray-space objects from capture sets, and looks into them.", "rs-encode");
    app.footer(
        "Examples:\n  rs-encode build vase-set -o vase.rso\n  rs-encode info vase.rso\n  rs-encode verify vase.rso\n"
        "  rs-encode extract vase.rso -o vase-pictures");
    std::function<rs::Status()> run;
    add_build(app, run);
    add_object_command(app, run, "info", "Say what an object holds and where its bytes go",
                       "Example:\n  rs-encode info vase.rso --json", true, run_info);
    add_object_command(app, run, "verify", "Check every checksum and bound of an object",
                       "Example:\n  rs-encode verify vase.rso", false, run_verify);
    add_object_command(app, run, "extract", "Write the stored pictures and their rig as a capture set",
                       "Example:\n  rs-encode extract vase.rso -o vase-pictures", false, run_extract);
    return rs::tool_main(app, argc, argv, run);
}
