#include "compositor/farm/work/tool_job.hpp"

#include "compositor/farm/work/child_process.hpp"
#include "compositor/farm/work/result_sums.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_list.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

namespace rs::farm {
namespace {

namespace fs = std::filesystem;

constexpr int kUsageExit = 2;  // rayspace/tool/tool_main.hpp

ToolOrder order_from(const nlohmann::json& json) {
    return {json.at("tool"), json.at("arguments"), json.at("folder"), json.at("output"), json.at("state")};
}

// What the tool printed last of an error, or its last line.
std::string last_word(const fs::path& log) {
    std::ifstream file(log);
    std::string last;
    std::string fault;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty()) last = line;
        if (line.find(": error: ") != std::string::npos) fault = line;
    }
    return fault.empty() ? last : fault;
}

class Finished final : public Job {
public:
    explicit Finished(Outcome outcome) : outcome_(std::move(outcome)) {}
    std::optional<Outcome> poll() override { return outcome_; }

private:
    Outcome outcome_;
};

// The places and sums of an order.
struct Place {
    ToolOrder order;
    std::string key;
    fs::path folder;  // STATE/items/NAME/KEY
    fs::path staged;

    explicit Place(ToolOrder given) : order(std::move(given)), key(key_of(order)) {
        folder = fs::path(order.state) / key;
        staged = folder / "out" / fs::path(order.output).filename();
    }
    [[nodiscard]] fs::path inputs() const { return folder / "inputs"; }

    // Sum of the list of inputs, where it is there and they are what they were.
    [[nodiscard]] std::optional<std::string> unchanged_inputs() const {
        const auto bytes = read_file(inputs(), kInputListCap_bytes);
        if (!bytes) return std::nullopt;
        const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        const auto stamps = parse_input_list(text, inputs().string());
        if (!stamps || !are_unchanged(*stamps)) return std::nullopt;
        return sum_text(text);
    }

    // Of the work that is complete. It fails where the result is not there, or not whole.
    [[nodiscard]] Outcome made(const std::string& inputs_sum) const {
        Outcome outcome{.state = State::kMade, .key = key, .inputs = inputs_sum, .output = order.output};
        const Result<std::string> sum = sum_of_result(staged);
        if (!sum) return {.state = State::kFailed, .why = sum.error().message, .key = key};
        outcome.sum = *sum;
        outcome.staged = staged.string();
        return outcome;
    }
};

// What an earlier run has left that is as good as done.
std::optional<Outcome> found(const Place& place, const Outcome* record) {
    const std::optional<std::string> inputs = place.unchanged_inputs();
    if (!inputs) return std::nullopt;
    const bool recorded =
        record != nullptr && record->state == State::kMade && record->key == place.key && record->inputs == *inputs;
    if (recorded && record->output == place.order.output) {
        const Result<std::string> sum = sum_of_result(place.order.output);
        if (sum && *sum == record->sum) {
            Outcome kept = *record;
            kept.state = State::kKept;
            return kept;
        }
    }
    std::error_code ignored;
    if (!fs::exists(place.staged, ignored)) return std::nullopt;
    Outcome outcome = place.made(*inputs);
    if (outcome.state != State::kMade) return std::nullopt;
    outcome.recorded = recorded && record->sum == outcome.sum && record->output == outcome.output;
    return outcome;
}

class ToolJob final : public Job {
public:
    ToolJob(Place place, ChildProcess child) : place_(std::move(place)), child_(std::move(child)) {}

    std::optional<Outcome> poll() override {
        const std::optional<ChildEnd> end = child_.poll();
        if (!end) return std::nullopt;
        Outcome outcome = outcome_of(*end);
        outcome.key = place_.key;
        outcome.seconds = end->seconds;
        outcome.memory_bytes = end->peak_memory_bytes;
        return outcome;
    }

private:
    [[nodiscard]] Outcome outcome_of(const ChildEnd& end) const {
        const fs::path log = place_.folder / "log";
        if (end.signal != 0) {
            return {.why = place_.order.tool + " was ended by signal " + std::to_string(end.signal) +
                           (end.signal == SIGKILL ? ", as happens where memory runs out" : "") +
                           "; it said: " + last_word(log)};
        }
        if (end.exit_code != 0) {
            return {.state = end.exit_code == kUsageExit ? State::kRefused : State::kFailed, .why = last_word(log)};
        }
        const std::optional<std::string> inputs = place_.unchanged_inputs();
        if (!inputs) return {.why = "what it reads was changed meanwhile; begin again"};
        return place_.made(*inputs);
    }

    Place place_;
    ChildProcess child_;
};

std::unique_ptr<Job> failed(const std::string& why) {
    return std::make_unique<Finished>(Outcome{.state = State::kFailed, .why = why});
}

std::unique_ptr<Job> begin(const ToolJobOptions& options, const nlohmann::json& json, const Outcome* record) {
    Place place(order_from(json));
    if (std::optional<Outcome> done = found(place, record)) return std::make_unique<Finished>(std::move(*done));
    std::error_code error;
    fs::remove_all(place.order.state, error);  // of other options or inputs, or cut short
    fs::create_directories(place.staged.parent_path(), error);
    if (error) return failed(place.folder.string() + ": cannot be made: " + error.message());
    std::vector<std::string> words{(options.tools / place.order.tool).string()};
    words.insert(words.end(), place.order.arguments.begin(), place.order.arguments.end());
    words.insert(words.end(), {"-o", place.staged.string()});
    Result<ChildProcess> child =
        ChildProcess::start(words, {.log = place.folder / "log",
                                    .environment = {std::string(kInputListVariable) + "=" + place.inputs().string()},
                                    .processors = options.processors});
    if (!child) return failed(child.error().message);
    return std::make_unique<ToolJob>(std::move(place), std::move(*child));
}

}  // namespace

nlohmann::json to_json(const ToolOrder& order) {
    return {{"tool", order.tool},
            {"arguments", order.arguments},
            {"folder", order.folder},
            {"output", order.output},
            {"state", order.state}};
}

BeginJob begin_tool_jobs(const ToolJobOptions& options) {
    return [options](const nlohmann::json& order, const Outcome* record) { return begin(options, order, record); };
}

}  // namespace rs::farm
