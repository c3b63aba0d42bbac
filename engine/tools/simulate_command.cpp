#include "engine/tools/commands.hpp"

#include "engine/core/definition/reconstruct.hpp"
#include "engine/model/layout/object_image.hpp"
#include "engine/model/report/diagram.hpp"
#include "engine/model/report/report.hpp"
#include "engine/model/report/waveform.hpp"
#include "engine/tools/requested_views.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <chrono>
#include <cstdio>
#include <memory>

namespace rs::engine {
namespace {

struct SimulateArguments {
    std::string config;
    std::vector<std::string> objects;
    RequestedViews views;
    std::string output;
    std::string stats;
    std::string trace;
    std::string chart;
    std::uint64_t trace_cycles = 20000;
    int per_cycle = 0;
    bool upright = false;
    bool load = false;
    bool diagram = false;
    bool print_config = false;
};

// A view of one of the objects, as the definition and as the board take it.
struct Drawing {
    std::size_t object = 0;
    Camera camera;
    ViewRegisters registers;
};

// The upright camera in whose image the object's centre keeps its row.
Camera stood_upright(const Camera& camera) {
    Camera upright = upright_camera(camera);
    const auto row = [](const Camera& c) { return c.project({0, 0, 0}).y; };
    upright.cy += row(camera) - row(upright);
    return upright;
}

// View by view, of each view all objects: so a rendering cycle shows the objects side by side.
Result<std::vector<Drawing>> requested_drawings(const std::vector<RaySpaceObject>& objects,
                                                const SimulateArguments& arguments) {
    std::vector<std::vector<Camera>> cameras;
    for (const RaySpaceObject& object : objects) {
        RS_ASSIGN_OR_RETURN(std::vector<Camera> asked, requested_cameras(object, arguments.views));
        cameras.push_back(std::move(asked));
    }
    std::vector<Drawing> drawings;
    for (std::size_t v = 0; v < cameras.front().size(); ++v) {
        for (std::size_t n = 0; n < objects.size(); ++n) {
            const Camera camera = arguments.upright ? stood_upright(cameras[n][v]) : cameras[n][v];
            RS_ASSIGN_OR_RETURN(const ViewRegisters registers,
                                prepare_view(objects[n], camera, TexelFilter::kBilinear));
            drawings.push_back({n, camera, registers});
        }
    }
    return drawings;
}

// What an object takes of the board, and how many like it the board would hold.
void print_footprint(const RaySpaceObject& object, const model::Board& board) {
    const BoardLimits& limits = board.top().config.limits;
    const model::ObjectLayout& layout = model::layout_of(limits.kind);
    if (!layout.drawable(object, limits)) return;  // refused, with the reason, when it is loaded
    const auto words = layout.words(object);
    std::uint64_t all = 0;
    for (const std::uint64_t n : words) all += 8 * n;
    std::printf("%s: %llu bytes of board memory; memory for %llu such objects, %d slots\n",
                printable(object.name).c_str(), static_cast<unsigned long long>(all),
                static_cast<unsigned long long>(board.memory_map().copies(words)), limits.objects);
}

Result<std::vector<int>> put_on_board(model::Board& board, const std::vector<RaySpaceObject>& objects, bool load) {
    std::vector<int> slots;
    for (const RaySpaceObject& object : objects) {
        RS_ASSIGN_OR_RETURN(const int slot, load ? board.start_load(object) : board.place(object));
        slots.push_back(slot);
    }
    if (!load) return slots;
    RS_TRY(board.finish_loads());
    const double hz = 1e6 * board.top().config.clock_mhz;
    for (const auto& done : board.top().disk_controller.loads()) {
        const double seconds = double(done.finished - done.started) / hz;
        std::printf("loaded slot %d: %.2f MByte in %.3f s, %.2f MByte/s\n", done.slot, double(done.bytes) / 1e6,
                    seconds, double(done.bytes) / 1e6 / seconds);
    }
    return slots;
}

Result<std::vector<std::vector<model::BoardView>>> rendering_cycles(const model::Board& board,
                                                                    const std::vector<Drawing>& drawings,
                                                                    const std::vector<int>& slots, int per_cycle) {
    std::vector<std::vector<model::BoardView>> cycles;
    for (const Drawing& drawing : drawings) {
        if (cycles.empty() || cycles.back().size() == static_cast<std::size_t>(per_cycle)) cycles.emplace_back();
        const Result<model::BoardView> view = board.view(slots[drawing.object], drawing.registers);
        if (!view) {
            return Error{view.error().message + "; --upright does so for the views asked for"};
        }
        cycles.back().push_back(*view);
    }
    return cycles;
}

void print_interval(const char* what, const model::Interval& interval) {
    std::printf("\n%s: %llu board cycles, %.3f ms; limited by %s\n", what,
                static_cast<unsigned long long>(interval.board_cycles), interval.seconds * 1e3,
                interval.limiting_block.c_str());
    for (const model::BlockShare& block : interval.blocks) {
        std::printf("  %-22s", block.name.c_str());
        for (std::size_t a = 0; a < model::kActivities; ++a) {
            const auto activity = static_cast<model::Activity>(a);
            if (block.counts.of(activity) == 0) continue;
            std::printf("  %s %.1f%%", std::string(model::activity_name(activity)).c_str(),
                        100 * block.share(activity));
        }
        std::printf("\n");
    }
}

// What each channel carried since the board was made, and how much of its time that took while rendering.
void print_channels(const model::BoardReport& report) {
    const double peak = report.clock_mhz * 8;
    std::printf("\n");
    for (std::size_t c = 0; c < report.channels.size(); ++c) {
        const model::ChannelReport& channel = report.channels[c];
        const double moved = channel.rendering.share(model::Activity::busy);
        std::printf("memory channel %zu: %llu bytes; while rendering %.1f of %.0f MByte/s (%.1f%%), occupied %.1f%%\n",
                    c, static_cast<unsigned long long>(channel.words * 8), moved * peak, peak, 100 * moved,
                    100 * channel.rendering.occupied());
    }
    std::printf("memory channel 0:");
    for (const model::MemoryTraffic& traffic : report.memory) {
        if (traffic.words + traffic.nulls == 0) continue;
        std::printf("  %s %llu bytes", traffic.client.c_str(), static_cast<unsigned long long>(traffic.words * 8));
    }
    std::printf("\n");
}

void print_report(const model::BoardReport& report) {
    std::printf("%s: %d rendering cycles, %d images, %lld pixels\n", report.config.c_str(), report.cycles,
                report.images, static_cast<long long>(report.pixels));
    std::printf("drawing: %.2f Mpixel/s, %.2f rendering cycles/s (%llu board cycles)\n", report.pixels_per_second / 1e6,
                report.cycles_per_second, static_cast<unsigned long long>(report.render_cycles));
    if (report.arrivals_per_second > 0) {
        std::printf("arriving at the host: %.2f rendering cycles/s\n", report.arrivals_per_second);
    }
    print_interval("while rendering", report.rendering);
    print_interval("while delivering to the host's memory", report.delivering);
    print_channels(report);
    std::printf("host bus: %llu bytes of images in %llu bursts, %llu retries, %llu register writes\n",
                static_cast<unsigned long long>(report.bus.image_bytes),
                static_cast<unsigned long long>(report.bus.bursts), static_cast<unsigned long long>(report.bus.retries),
                static_cast<unsigned long long>(report.bus.register_writes));
}

// All images against the definition, and into a folder where one is given.
Status use_images(const model::BoardRun& run, const std::vector<Drawing>& drawings,
                  const std::vector<RaySpaceObject>& stored, const std::string& output) {
    std::vector<Camera> cameras;
    cameras.reserve(drawings.size());
    for (const Drawing& drawing : drawings) cameras.push_back(drawing.camera);
    Rig rig = rig_of_views(cameras);
    std::optional<StagedFolder> folder;
    if (!output.empty()) {
        RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "rendered views"));
        folder.emplace(std::move(staged));
    }
    std::size_t n = 0;
    std::size_t equal = 0;
    for (const model::RenderedCycle& cycle : run.cycles) {
        for (const Image<Rgba8>& image : cycle.images) {
            Image<Rgba8> defined(image.width(), image.height());
            reconstruct_scalar(stored[drawings[n].object], drawings[n].registers, defined);
            equal += static_cast<std::size_t>(image == defined);
            if (folder) {
                Status status = write_png(folder->temporary_path() / rig.views[n].file_path, image);
                if (!status) return status;
            }
            ++n;
        }
    }
    std::printf("%zu of %zu images equal the definition bit for bit\n", equal, n);
    if (equal != n) return Error{"the board's images are not those of the definition; this is a defect of the model"};
    if (!folder) return {};
    if (Status status = write_rig(folder->temporary_path() / kRigFileName, rig); !status) return status;
    return folder->commit();
}

Status run_simulate(const SimulateArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const model::BoardConfig config, model::read_board_config(arguments.config));
    if (arguments.print_config) {
        std::printf("%s\n", model::board_config_json(config).c_str());
        return {};
    }
    model::Board board(config);
    if (arguments.diagram) {
        std::printf("%s", model::diagram_tables(board.top()).c_str());
        return {};
    }
    std::vector<RaySpaceObject> objects;
    for (const std::string& path : arguments.objects) {
        RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(path));
        objects.push_back(model::layout_of(config.limits.kind).as_rendered(std::move(object)));
    }
    for (const RaySpaceObject& object : objects) print_footprint(object, board);
    RS_ASSIGN_OR_RETURN(const std::vector<int> slots, put_on_board(board, objects, arguments.load));
    RS_ASSIGN_OR_RETURN(const std::vector<Drawing> drawings, requested_drawings(objects, arguments));
    const int per_cycle = arguments.per_cycle > 0 ? arguments.per_cycle : config.limits.views_per_cycle;
    RS_ASSIGN_OR_RETURN(const auto cycles, rendering_cycles(board, drawings, slots, per_cycle));

    std::unique_ptr<model::Waveform> waveform;
    if (!arguments.trace.empty()) {
        RS_ASSIGN_OR_RETURN(auto opened, model::Waveform::open(arguments.trace, board.top(), arguments.trace_cycles));
        waveform = std::move(opened);
    }
    const auto begin = std::chrono::steady_clock::now();
    RS_ASSIGN_OR_RETURN(const model::BoardRun run, board.render(cycles));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (waveform) {
        if (Status status = waveform->finish(); !status) return status;
    }
    const model::BoardReport report = model::make_report(board, run);
    print_report(report);
    std::printf("simulated at %.2f million board cycles a second\n", double(report.board_cycles) / seconds / 1e6);
    if (!arguments.stats.empty()) {
        if (Status status = write_file(arguments.stats, model::report_json(report)); !status) return status;
    }
    if (!arguments.chart.empty()) {
        const std::string title = report.config + ", " + std::to_string(report.images) + " images";
        if (Status status = write_file(arguments.chart, model::report_chart_svg(report, title)); !status) return status;
    }
    return use_images(run, drawings, objects, arguments.output);
}

}  // namespace

void add_simulate_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<SimulateArguments>();
    CLI::App* command = app.add_subcommand(
        "simulate", "Draw views with the cycle-accurate model of the board, and say where its cycles went");
    command
        ->add_option("CONFIG", arguments->config,
                     "prototype-2000, compressed-2000, parallel, or a JSON file with settings that differ from one of "
                     "them")
        ->required();
    command->add_option("OBJECT", arguments->objects, "ray-space objects, .rso; with a shape map for parallel only");
    add_view_options(*command, arguments->views, false);
    command->add_flag("--upright", arguments->upright, "stand tilted cameras upright: the board draws no others");
    command
        ->add_option("--per-cycle", arguments->per_cycle,
                     "views of a rendering cycle; as many as it takes if not given")
        ->check(CLI::Range(1, 15));
    command->add_flag("--load", arguments->load, "have the board load the objects from its disk first");
    command->add_option("-o,--output", arguments->output, "a folder for the images");
    command->add_option("--stats", arguments->stats, "a JSON file for the cycles of every block")
        ->check(ends_in({".json"}));
    command->add_option("--chart", arguments->chart, "an SVG file: where the cycles went")->check(ends_in({".svg"}));
    command->add_option("--trace", arguments->trace, "a VCD file, for GTKWave")->check(ends_in({".vcd"}));
    command->add_option("--trace-cycles", arguments->trace_cycles, "board cycles in it")->capture_default_str();
    command->add_flag("--diagram", arguments->diagram, "print blocks, ports and FIFOs as in model/DIAGRAM.md, and end");
    command->add_flag("--print-config", arguments->print_config, "print all settings of CONFIG as JSON, and end");
    command->footer(
        "Examples (prototype-2000 draws objects that rs-encode built with --profile raw --raymap plane):\n"
        "  rs-engine simulate prototype-2000 vase-raw.rso --orbit 15 --size 256x256 -o drawn --stats vase.json\n"
        "  rs-engine simulate prototype-2000 a.rso b.rso c.rso --orbit 12 --per-cycle 3 --chart cycles.svg\n"
        "  rs-engine simulate compressed-2000 vase-board.rso --orbit 15 --size 256x256 --stats vase.json\n"
        "  rs-engine simulate parallel vase-shape.rso --orbit 4 --size 512x512 --upright\n"
        "  rs-engine simulate prototype-2000 --diagram");
    command->callback([arguments, &run] {
        const RequestedViews& views = arguments->views;
        if (!arguments->diagram && !arguments->print_config) {
            if (arguments->objects.empty()) throw CLI::RequiredError("OBJECT");
            if (views.orbit == 0 && views.poses.empty() && views.eye.empty()) {
                throw CLI::RequiredError("one of --orbit, --poses, --eye");
            }
        }
        run = [arguments] { return run_simulate(*arguments); };
    });
}

}  // namespace rs::engine
