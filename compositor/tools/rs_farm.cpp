// rs-farm: the other tools' work on many items, by many ranks of an MPI job.

#include "compositor/farm/mpi/mpi_transport.hpp"
#include "compositor/farm/schedule/coordinator.hpp"
#include "compositor/farm/schedule/worker.hpp"
#include "compositor/farm/work/node_resources.hpp"
#include "compositor/farm/work/timed_job.hpp"
#include "compositor/farm/work/tool_job.hpp"
#include "compositor/farm/work/work_kinds.hpp"
#include "compositor/tools/farm_report.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/tool/interruption.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>

namespace rs::farm {
namespace {

namespace fs = std::filesystem;

constexpr double kPatience_s = 10;  // for the ranks of a run that was killed to be gone
constexpr std::uint64_t kListCap_bytes = 256 << 20;

struct FarmArguments {
    std::vector<std::string> inputs;
    std::string list;
    std::string output;
    std::vector<std::string> options;  // behind "--"
    std::optional<std::int64_t> memory_mib;
    std::optional<std::int64_t> item_memory_mib;
    std::optional<int> threads;
    int count = 20000;
    double sleep_ms = 0;
    bool json = false;
    bool quiet = false;
};

// What a run needs where the coordinator is.
struct Run {
    std::vector<Item> items;
    fs::path manifest;
};

// Short waits first, for the next message may be on its way; long ones while items are worked at.
class Patience {
public:
    void happened() { idle_ = 0; }
    void wait() {
        constexpr int kSpins = 200;
        constexpr std::int64_t kLongest_us = 2000;
        if (++idle_ < kSpins) {
            ::sched_yield();
        } else {
            std::this_thread::sleep_for(
                std::chrono::microseconds(std::min<std::int64_t>(kLongest_us, 10 * (idle_ - kSpins + 1))));
        }
    }

private:
    std::int64_t idle_ = 0;
};

fs::path tools_folder() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error).parent_path();
}

void work_until_end(Worker& worker, Coordinator* coordinator, FarmProgress* progress) {
    Patience patience;
    while (!worker.ended() || (coordinator != nullptr && !coordinator->ended())) {
        bool happened = !worker.ended() && worker.step();
        if (coordinator != nullptr && coordinator->step()) happened = true;
        if (interruption() != 0) worker.interrupt();
        if (progress != nullptr) progress->show(coordinator->standing(), coordinator->items());
        if (happened) {
            patience.happened();
        } else {
            patience.wait();
        }
    }
}

// Others wait for nothing else than to be let go.
Status let_all_go(Transport& transport, Worker& worker, const Error& why) {
    for (int rank = 0; rank < transport.ranks(); ++rank) {
        transport.send(rank, Channel::kToWorker, nlohmann::json::to_msgpack({{"type", "stop"}}));
    }
    int left = 0;
    while (left < transport.ranks()) {
        worker.step();
        const std::optional<Message> message = transport.receive(Channel::kToCoordinator);
        if (!message) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } else if (nlohmann::json::from_msgpack(message->bytes).at("type") == "bye") {
            ++left;
        }
    }
    return why;
}

Status conclude(const FarmArguments& arguments, const Coordinator& coordinator) {
    const Standing& standing = coordinator.standing();
    if (coordinator.failure()) return *coordinator.failure();
    std::fputs((arguments.json ? json_of : table_of)(standing, coordinator.items()).c_str(), stdout);
    if (standing.interrupted) return Error{"was interrupted; the same command goes on where it was"};
    if (const int failed = standing.count(State::kFailed); failed > 0) {
        return Error{std::to_string(failed) + " of " + std::to_string(coordinator.items().size()) +
                     " items failed; the same command tries them again"};
    }
    return {};
}

using MakeRun = std::function<Result<Run>()>;

Status run_farm(MpiTransport& transport, const FarmArguments& arguments, const BeginJob& begin, const MakeRun& make) {
    note_interruptions();
    Worker worker(transport, this_node(), begin);
    if (transport.rank() != 0) {
        work_until_end(worker, nullptr, nullptr);
        return {};
    }
    Result<Run> run = make();
    if (!run) return let_all_go(transport, worker, run.error());
    Result<Manifest> manifest = Manifest::open(run->manifest, kPatience_s);
    if (!manifest) return let_all_go(transport, worker, manifest.error());
    std::optional<std::int64_t> budget_bytes;
    if (arguments.memory_mib) budget_bytes = *arguments.memory_mib << 20;
    Coordinator coordinator(transport, std::move(run->items), *manifest, budget_bytes);
    FarmProgress progress(arguments.quiet);
    work_until_end(worker, &coordinator, &progress);
    progress.finish();
    return conclude(arguments, coordinator);
}

Result<std::vector<std::string>> listed_inputs(const FarmArguments& arguments) {
    std::vector<std::string> inputs = arguments.inputs;
    if (arguments.list.empty()) return inputs;
    const auto bytes = read_file(arguments.list, kListCap_bytes);
    if (!bytes) return bytes.error();
    std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (!line.empty() && line.front() != '#') inputs.push_back(line);
    }
    if (inputs.empty()) return Error{arguments.list + ": names no inputs; write one to a line"};
    return inputs;
}

std::optional<std::int64_t> item_memory_bytes(const FarmArguments& arguments) {
    if (!arguments.item_memory_mib) return std::nullopt;
    return *arguments.item_memory_mib << 20;
}

Status make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return Error{folder.string() + ": cannot be made: " + error.message()};
    return {};
}

Result<Run> make_items_run(const WorkKind& kind, const FarmArguments& arguments) {
    Result<std::vector<std::string>> inputs = listed_inputs(arguments);
    if (!inputs) return inputs.error();
    Result<std::vector<Item>> items =
        items_of(kind, {std::move(*inputs), arguments.output, arguments.options, item_memory_bytes(arguments)});
    if (!items) return items.error();
    const fs::path state = state_folder(arguments.output);
    if (Status made = make_folder(state); !made) return made.error();
    return Run{std::move(*items), state / "manifest.jsonl"};
}

Result<Run> make_render_run(const FarmArguments& arguments) {
    const fs::path output = fs::absolute(arguments.output).lexically_normal();
    const fs::path plain = output.has_filename() ? output : output.parent_path();
    const fs::path state = plain.parent_path() / ("." + plain.filename().string() + ".rs-farm");
    if (Status made = make_folder(state); !made) return made.error();
    Result<std::vector<Item>> items = render_items({arguments.inputs.empty() ? "" : arguments.inputs.front(), plain,
                                                    arguments.options, item_memory_bytes(arguments), tools_folder()},
                                                   state);
    if (!items) return items.error();
    return Run{std::move(*items), state / "manifest.jsonl"};
}

// Of a folder of its own that nobody sees.
Status run_bench(MpiTransport& transport, const FarmArguments& arguments) {
    std::string folder = (fs::temp_directory_path() / "rs-farm-bench-XXXXXX").string();
    const MakeRun make = [&]() -> Result<Run> {
        if (::mkdtemp(folder.data()) == nullptr) return Error{folder + ": cannot be made"};
        return Run{timed_items(arguments.count, arguments.sleep_ms / 1000), fs::path(folder) / "manifest.jsonl"};
    };
    Status status = run_farm(transport, arguments, begin_timed_jobs(), make);
    std::error_code ignored;
    if (transport.rank() == 0) fs::remove_all(folder, ignored);
    return status;
}

void add_common_options(CLI::App& command, FarmArguments& arguments) {
    command
        .add_option("--memory", arguments.memory_mib,
                    "MiB of each node that its items may take together; others wait (three quarters of the node's)")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 30))
        ->type_name("MIB");
    command
        .add_option("--item-memory", arguments.item_memory_mib,
                    "MiB that an item takes (by its images and their pixels)")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 30))
        ->type_name("MIB");
    command
        .add_option("--threads", arguments.threads,
                    "processors of each item (those that mpirun or srun bound the rank to; where it did not, an equal "
                    "share of the node's)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    command.add_flag("--json", arguments.json, "the table as JSON");
    command.add_flag("-q,--quiet", arguments.quiet, "no progress");
}

const char* const kFooter =
    "What stands behind \" -- \" are options of the tool, for all items: rs-encode build, rs-capture import, "
    "rs-capture "
    "synth, rs-view.\n"
    "A run that was ended goes on where it was when it is started again (compositor/farm/README.md).\n"
    "Examples:\n"
    "  mpirun -n 8 rs-farm encode sets/* -o objects -- --psnr 36\n"
    "  mpirun -n 8 rs-farm import --list folders.txt -o sets\n"
    "  mpirun -n 8 rs-farm synth recipes/*.json -o sets -- --views 180\n"
    "  mpirun -n 8 rs-farm render hall.wrl -o evening.png -- --renderer path --passes 1024\n"
    "  srun rs-farm encode --list sets.txt -o objects\n"
    "  mpirun -n 4 rs-farm bench                       how many items a second can be handed out";

// Lets only one rank speak of the command line, which all of them read.
class Silence {
public:
    explicit Silence(bool silent) {
        if (!silent) return;
        const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
            kept_[stream - 1] = ::fcntl(stream, F_DUPFD_CLOEXEC, 3);
            ::dup2(nothing, stream);
        }
        ::close(nothing);
        silent_ = true;
    }
    ~Silence() { end(); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;
    void end() {
        if (!silent_) return;
        std::cout.flush();  // what was buffered goes where it was meant to go
        std::fflush(nullptr);
        for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
            ::dup2(kept_[stream - 1], stream);
            ::close(kept_[stream - 1]);
        }
        silent_ = false;
    }

private:
    bool silent_ = false;
    int kept_[2] = {-1, -1};
};

}  // namespace

int farm_main(int argc, char** argv) {
    FarmArguments arguments;
    for (int i = 1; i < argc; ++i) {
        if (std::string_view(argv[i]) != "--") continue;
        arguments.options.assign(argv + i + 1, argv + argc);
        argc = i;
    }
    MpiTransport transport;
    const MpiTransport::NodePlace place = transport.place_on_node();
    Silence silence(transport.rank() != 0);
    CLI::App app(
        "Does the other tools' work on many items: hands them out to the ranks of an MPI job, the largest first.",
        "rs-farm");
    app.footer(kFooter);
    app.require_subcommand(0, 1);
    std::function<Status()> run;
    const auto tool_jobs = [&] {
        return begin_tool_jobs({tools_folder(), processors_of(place.place, place.places, arguments.threads)});
    };
    for (const WorkKind& kind : kWorkKinds) {
        CLI::App* command = app.add_subcommand(kind.name, std::string(kind.tool) + " " + kind.command + " for " +
                                                              kind.input + ", each into a result of its name");
        command->add_option("INPUTS", arguments.inputs, kind.input);
        command->add_option("--list", arguments.list,
                            "file that names further inputs, one to a line; # begins a comment");
        command->add_option("-o,--output", arguments.output, "folder of the results")->required();
        add_common_options(*command, arguments);
        command->footer(kFooter);
        command->callback([&] {
            if (arguments.inputs.empty() && arguments.list.empty()) {
                throw CLI::ValidationError("no inputs; give " + std::string(kind.input) + " or --list FILE");
            }
            run = [&] {
                silence.end();
                return run_farm(transport, arguments, tool_jobs(), [&] { return make_items_run(kind, arguments); });
            };
        });
    }
    CLI::App* render =
        app.add_subcommand("render", "rs-view of a scene by a --renderer that traces, in tiles of frames");
    render->add_option("SCENE", arguments.inputs, "scene, as for rs-view")->expected(0, 1);
    render->add_option("-o,--output", arguments.output, "FILE.png, FILE.mp4 or a folder")->required();
    add_common_options(*render, arguments);
    render->footer(kFooter);
    render->callback([&] {
        run = [&] {
            silence.end();
            return run_farm(transport, arguments, tool_jobs(), [&] { return make_render_run(arguments); });
        };
    });
    CLI::App* bench = app.add_subcommand("bench", "How fast items are handed out that are no work, or sleep");
    bench->add_option("--items", arguments.count, "how many")->check(CLI::Range(1, 10'000'000))->capture_default_str();
    bench->add_option("--sleep", arguments.sleep_ms, "milliseconds that each takes")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    bench->add_flag("--json", arguments.json, "the table as JSON");
    bench->add_flag("-q,--quiet", arguments.quiet, "no progress");
    bench->callback([&] {
        run = [&] {
            silence.end();
            return run_bench(transport, arguments);
        };
    });
    return tool_main(app, argc, argv, run);
}

}  // namespace rs::farm

int main(int argc, char** argv) {
    return rs::farm::farm_main(argc, argv);
}
