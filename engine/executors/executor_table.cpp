#include "engine/executors/executor_table.hpp"

#include "engine/executors/software_executors.hpp"
#include "engine/model/simulated_board.hpp"

namespace rs::engine {
namespace {

using Made = Result<std::unique_ptr<Executor>>;

struct Row {
    const char* name;
    const char* argument;  // after a colon; null where it takes none
    Made (*make)(const std::string& argument, const ExecutorOptions& options);
};

constexpr Row kRows[] = {
    {"scalar", nullptr, [](const std::string&, const ExecutorOptions&) { return Made(make_scalar_executor()); }},
    {"core", nullptr, [](const std::string&, const ExecutorOptions&) { return Made(make_core_executor()); }},
    {"board", "CONFIG",
     [](const std::string& argument, const ExecutorOptions& options) -> Made {
         RS_ASSIGN_OR_RETURN(const model::BoardConfig config, model::read_board_config(argument));
         return Made(model::make_simulated_board(config, options.instant_loads));
     }},
};

}  // namespace

Result<std::unique_ptr<Executor>> make_executor(const std::string& name, const ExecutorOptions& options) {
    const std::size_t colon = name.find(':');
    for (const Row& row : kRows) {
        if (name.substr(0, colon) != row.name || (colon == std::string::npos) != (row.argument == nullptr)) continue;
        return row.make(colon == std::string::npos ? "" : name.substr(colon + 1), options);
    }
    return Error{"--executor " + name + ": there is no such executor; give one of " + executor_names()};
}

std::string executor_names() {
    std::string names;
    for (const Row& row : kRows) {
        names += (names.empty() ? "" : ", ") + std::string(row.name) +
                 (row.argument != nullptr ? ":" + std::string(row.argument) : "");
    }
    return names;
}

}  // namespace rs::engine
