#include "engine/tools/commands.hpp"

#include "engine/core/definition/reconstruct.hpp"
#include "engine/model/layout/object_image.hpp"
#include "engine/model/report/report.hpp"
#include "engine/model/report/waveform.hpp"
#include "engine/rtl/board/rtl_board.hpp"
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
#include <filesystem>
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
    bool force = false;
    bool rtl = false;
};

// View of one of the objects.
struct SimulatedView {
    std::size_t object = 0;
    Camera camera;
    ViewRegisters registers;
};

// Upright camera whose image shows the object's centre in the same row.
Camera make_upright(const Camera& camera) {
    Camera upright = upright_camera(camera);
    const auto row = [](const Camera& c) { return c.project({0, 0, 0}).y; };
    upright.cy += row(camera) - row(upright);
    return upright;
}

// Views in the order of cameras, then objects, so that a rendering cycle shows several objects from one camera.
Result<std::vector<SimulatedView>> simulated_views(const std::vector<RaySpaceObject>& objects,
                                                   const SimulateArguments& arguments) {
    std::vector<std::vector<Camera>> cameras;
    for (const RaySpaceObject& object : objects) {
        RS_ASSIGN_OR_RETURN(std::vector<Camera> object_cameras, requested_cameras(object, arguments.views));
        cameras.push_back(std::move(object_cameras));
    }
    std::vector<SimulatedView> views;
    for (std::size_t v = 0; v < cameras.front().size(); ++v) {
        for (std::size_t n = 0; n < objects.size(); ++n) {
            const Camera camera = arguments.upright ? make_upright(cameras[n][v]) : cameras[n][v];
            RS_ASSIGN_OR_RETURN(const ViewRegisters registers,
                                prepare_view(objects[n], camera, TexelFilter::kBilinear));
            views.push_back({n, camera, registers});
        }
    }
    return views;
}

// Prints the board memory of an object, and the number of such objects that fit.
void print_footprint(const RaySpaceObject& object, const model::BoardConfig& config) {
    const BoardLimits& limits = config.limits;
    const model::ObjectLayout& layout = model::layout_of(limits.kind);
    if (!layout.drawable(object, limits)) return;  // loading reports the reason
    const auto words = layout.words(object);
    std::uint64_t all = 0;
    for (const std::uint64_t n : words) all += 8 * n;
    std::printf("%s: %llu bytes of board memory; memory for %llu such objects, %d slots\n",
                printable(object.name).c_str(), static_cast<unsigned long long>(all),
                static_cast<unsigned long long>(model::MemoryMap(config.memory).copies(words)), limits.objects);
}

Result<std::vector<int>> load_objects(model::Board& board, const std::vector<RaySpaceObject>& objects, bool load) {
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

Result<std::vector<std::vector<model::BoardView>>> rendering_cycles(const std::vector<SimulatedView>& views,
                                                                    const std::vector<int>& slots, int per_cycle) {
    std::vector<std::vector<model::BoardView>> cycles;
    for (const SimulatedView& simulated : views) {
        if (cycles.empty() || cycles.back().size() == static_cast<std::size_t>(per_cycle)) cycles.emplace_back();
        const Result<model::BoardView> view = model::board_view(simulated.registers, slots[simulated.object]);
        if (!view) {
            return Error{view.error().message + "; use --upright to make the requested views upright"};
        }
        cycles.back().push_back(*view);
    }
    return cycles;
}

void print_interval(const char* title, const model::Interval& interval) {
    std::printf("\n%s: %llu board cycles, %.3f ms; limited by %s\n", title,
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

// Prints the traffic of each memory channel since construction and its utilization while rendering.
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

void print_rates(const std::string& config, const model::RenderRates& rates) {
    std::printf("%s: %d rendering cycles, %d images, %lld pixels\n", config.c_str(), rates.cycles, rates.images,
                static_cast<long long>(rates.pixels));
    std::printf("drawing: %.2f Mpixel/s, %.2f rendering cycles/s (%llu board cycles)\n", rates.pixels_per_second / 1e6,
                rates.cycles_per_second, static_cast<unsigned long long>(rates.render_cycles));
    if (rates.arrivals_per_second > 0) {
        std::printf("arriving at the host: %.2f rendering cycles/s\n", rates.arrivals_per_second);
    }
}

void print_report(const model::BoardReport& report) {
    print_rates(report.config, report);
    print_interval("while rendering", report.rendering);
    print_interval("while delivering to the host's memory", report.delivering);
    print_channels(report);
    std::printf("host bus: %llu bytes of images in %llu bursts, %llu retries, %llu register writes\n",
                static_cast<unsigned long long>(report.bus.image_bytes),
                static_cast<unsigned long long>(report.bus.bursts), static_cast<unsigned long long>(report.bus.retries),
                static_cast<unsigned long long>(report.bus.register_writes));
}

// Compares all images with the definition, and writes them to the folder `output` unless it is empty.
Status check_and_write_images(const std::vector<model::RenderedCycle>& cycles, const std::vector<SimulatedView>& views,
                              const std::vector<RaySpaceObject>& stored, const std::string& output, bool force) {
    std::vector<Camera> cameras;
    cameras.reserve(views.size());
    for (const SimulatedView& view : views) cameras.push_back(view.camera);
    Rig rig = make_rig_of_views(cameras);
    std::optional<StagedFolder> folder;
    if (!output.empty()) {
        RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "rendered views", force));
        folder.emplace(std::move(staged));
    }
    std::size_t n = 0;
    std::size_t equal = 0;
    for (const model::RenderedCycle& cycle : cycles) {
        for (const Image<Rgba8>& image : cycle.images) {
            Image<Rgba8> defined(image.width(), image.height());
            reconstruct_scalar(stored[views[n].object], views[n].registers, defined);
            equal += static_cast<std::size_t>(image == defined);
            if (folder) {
                RS_TRY(write_png(folder->temporary_path() / rig.views[n].file_path, image));
            }
            ++n;
        }
    }
    std::printf("%zu of %zu images equal the definition bit for bit\n", equal, n);
    if (equal != n) return Error{"the board's images differ from the definition; this is a defect of its model or RTL"};
    if (!folder) return {};
    RS_TRY(write_rig(folder->temporary_path() / kRigFileName, rig));
    return folder->commit();
}

Status refuse_overwriting(const SimulateArguments& arguments) {
    std::vector<std::filesystem::path> used(arguments.objects.begin(), arguments.objects.end());
    used.emplace_back(arguments.views.poses);
    if (std::filesystem::is_regular_file(arguments.config)) used.emplace_back(arguments.config);
    for (const std::string& output : {arguments.output, arguments.stats, arguments.chart, arguments.trace}) {
        RS_TRY(refuse_overwriting_inputs(output, used));
        used.emplace_back(output);
    }
    return {};
}

struct Simulation {
    std::vector<RaySpaceObject> objects;  // as the board renders them
    std::vector<SimulatedView> views;
    int per_cycle = 0;
};

Result<std::vector<model::RenderedCycle>> render_with_model(const Simulation& simulation, model::Board& board,
                                                            const SimulateArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const std::vector<int> slots, load_objects(board, simulation.objects, arguments.load));
    RS_ASSIGN_OR_RETURN(const auto cycles, rendering_cycles(simulation.views, slots, simulation.per_cycle));
    std::unique_ptr<model::Waveform> waveform;
    if (!arguments.trace.empty()) {
        RS_ASSIGN_OR_RETURN(auto opened, model::Waveform::open(arguments.trace, board.top(), arguments.trace_cycles));
        waveform = std::move(opened);
    }
    const auto begin = std::chrono::steady_clock::now();
    RS_ASSIGN_OR_RETURN(model::BoardRun run, board.render(cycles));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (waveform) {
        RS_TRY(waveform->finish());
    }
    const model::BoardReport report = model::make_report(board, run);
    print_report(report);
    std::printf("simulated at %.2f million board cycles a second\n", double(report.board_cycles) / seconds / 1e6);
    if (!arguments.stats.empty()) {
        RS_TRY(write_file(arguments.stats, model::report_json(report)));
    }
    if (!arguments.chart.empty()) {
        const std::string title = report.config + ", " + std::to_string(report.images) + " images";
        RS_TRY(write_file(arguments.chart, model::report_chart_svg(report, title)));
    }
    return std::move(run.cycles);
}

Result<std::vector<model::RenderedCycle>> render_with_rtl(const Simulation& simulation,
                                                          const model::BoardConfig& config,
                                                          const SimulateArguments& arguments) {
    RS_ASSIGN_OR_RETURN(const std::unique_ptr<rtl::RtlBoard> board, rtl::make_rtl_board(config));
    std::vector<int> slots;
    for (const RaySpaceObject& object : simulation.objects) {
        RS_ASSIGN_OR_RETURN(const int slot, arguments.load ? board->start_load(object) : board->place(object));
        slots.push_back(slot);
    }
    RS_TRY(board->finish_loads());
    RS_ASSIGN_OR_RETURN(const auto cycles, rendering_cycles(simulation.views, slots, simulation.per_cycle));
    if (!arguments.trace.empty()) RS_TRY(board->trace(arguments.trace, arguments.trace_cycles));
    const std::uint64_t before = board->board_cycles();
    const auto begin = std::chrono::steady_clock::now();
    RS_ASSIGN_OR_RETURN(std::vector<model::RenderedCycle> rendered, board->render(cycles));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    print_rates(config.name + " in RTL", model::render_rates(rendered, config.clock_mhz));
    std::printf("simulated at %.2f million board cycles a second\n",
                double(board->board_cycles() - before) / seconds / 1e6);
    return rendered;
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
    RS_TRY(refuse_overwriting(arguments));
    Simulation simulation;
    for (const std::string& path : arguments.objects) {
        RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(path));
        simulation.objects.push_back(model::layout_of(config.limits.kind).as_rendered(std::move(object)));
        print_footprint(simulation.objects.back(), config);
    }
    RS_ASSIGN_OR_RETURN(simulation.views, simulated_views(simulation.objects, arguments));
    simulation.per_cycle = arguments.per_cycle > 0 ? arguments.per_cycle : config.limits.views_per_cycle;
    RS_ASSIGN_OR_RETURN(const std::vector<model::RenderedCycle> rendered,
                        arguments.rtl ? render_with_rtl(simulation, config, arguments)
                                      : render_with_model(simulation, board, arguments));
    return check_and_write_images(rendered, simulation.views, simulation.objects, arguments.output, arguments.force);
}

}  // namespace

void add_simulate_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<SimulateArguments>();
    CLI::App* command = app.add_subcommand(
        "simulate", "Render views with the cycle-accurate model of a board, and print the utilization of its blocks");
    command
        ->add_option("CONFIG", arguments->config,
                     "prototype-2000 (also with a remedy of its bus: -pci-x, -dedicated, -compressed-transfer), "
                     "compressed-2000, parallel, or a JSON file that overrides settings of one of them")
        ->required();
    command->add_option("OBJECT", arguments->objects, "ray-space objects, .rso; shape maps only with parallel");
    add_view_options(*command, arguments->views, false);
    command->add_flag("--upright", arguments->upright, "make tilted cameras upright, as the boards require");
    command
        ->add_option("--per-cycle", arguments->per_cycle,
                     "views per rendering cycle; default: as many as the board supports")
        ->check(CLI::Range(1, 15));
    command->add_flag("--load", arguments->load, "simulate loading of the objects from the board's disk first");
    command->add_option("-o,--output", arguments->output, "folder for the images");
    command->add_flag("--force", arguments->force, kForceHelp);
    command->add_option("--stats", arguments->stats, "write the cycle counts of every block to this JSON file")
        ->check(ends_in({".json"}));
    command->add_option("--chart", arguments->chart, "write a chart of the cycle counts to this SVG file")
        ->check(ends_in({".svg"}));
    command->add_option("--trace", arguments->trace, "write a waveform to this VCD file, for GTKWave")
        ->check(ends_in({".vcd"}));
    command->add_option("--trace-cycles", arguments->trace_cycles, "board cycles in the waveform")
        ->capture_default_str();
    command->add_flag("--rtl", arguments->rtl,
                      "run the board's RTL (engine/rtl) instead of its model; only prototype-2000, in builds with "
                      "Verilator. --trace then records all signals");
    command->add_flag("--diagram", arguments->diagram,
                      "print blocks, ports and FIFOs as in model/DIAGRAM.md, and exit");
    command->add_flag("--print-config", arguments->print_config, "print all settings of CONFIG as JSON, and exit");
    command->footer(
        "Examples (prototype-2000 renders objects encoded with --profile raw --raymap plane):\n"
        "  rs-engine simulate prototype-2000 vase-raw.rso --orbit 15 --size 256x256 -o drawn --stats vase.json\n"
        "  rs-engine simulate prototype-2000 a.rso b.rso c.rso --orbit 12 --per-cycle 3 --chart cycles.svg\n"
        "  rs-engine simulate compressed-2000 vase-board.rso --orbit 15 --size 256x256 --stats vase.json\n"
        "  rs-engine simulate parallel vase-shape.rso --orbit 4 --size 512x512 --upright\n"
        "  rs-engine simulate prototype-2000 vase-raw.rso --orbit 2 --size 64x64 --rtl --trace vase.vcd\n"
        "  rs-engine simulate prototype-2000 --diagram");
    command->callback([arguments, &run] {
        const RequestedViews& views = arguments->views;
        if (arguments->rtl && !(arguments->stats.empty() && arguments->chart.empty())) {
            throw CLI::ValidationError("--rtl",
                                       "the counts of --stats and --chart are those of the model; leave them out");
        }
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
