#include "rayspace/api/types/executor_table.hpp"

#include "engine/core/fast/core_executor.hpp"
#include "engine/executors/entries.hpp"

#include <algorithm>

namespace rs::engine {

ExecutorEntry core_entry() {
    return {"core", "", [](const std::string&) -> Result<std::unique_ptr<Executor>> {
                return std::unique_ptr<Executor>(std::make_unique<CoreExecutor>());
            }};
}

ExecutorTable::ExecutorTable() : entries_{scalar_entry(), core_entry()} {
    for (ExecutorEntry& entry : hardware_entries()) entries_.push_back(std::move(entry));
}

Status ExecutorTable::add(ExecutorEntry entry) {
    if (entry.name.empty() || entry.name.find(':') != std::string::npos) {
        return Error{"executor \"" + entry.name + "\": the name must not be empty or contain a colon"};
    }
    if (!entry.create) return Error{"executor " + entry.name + ": has no create function; set ExecutorEntry::create"};
    const auto same = [&](const ExecutorEntry& other) { return other.name == entry.name; };
    if (std::ranges::any_of(entries_, same)) {
        return Error{"executor " + entry.name + ": exists already; use another name"};
    }
    entries_.push_back(std::move(entry));
    return {};
}

Result<std::unique_ptr<Executor>> ExecutorTable::create(const std::string& name) const {
    const std::size_t colon = name.find(':');
    for (const ExecutorEntry& entry : entries_) {
        if (name.substr(0, colon) != entry.name || (colon == std::string::npos) != entry.argument.empty()) continue;
        return entry.create(colon == std::string::npos ? "" : name.substr(colon + 1));
    }
    return Error{"executor " + name + ": no such executor; use one of " + names()};
}

std::string ExecutorTable::names() const {
    std::string all;
    for (const ExecutorEntry& entry : entries_) {
        all += (all.empty() ? "" : ", ") + entry.name + (entry.argument.empty() ? "" : ":" + entry.argument);
    }
    return all;
}

}  // namespace rs::engine
