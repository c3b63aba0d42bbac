#include "compositor/tools/farm_report.hpp"

#include "rayspace/base/printable.hpp"

#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace rs::farm {
namespace {

constexpr double kSilence_s = 1;  // a run that ends within it reports nothing on its way
constexpr double kRedraw_s = 0.5;
constexpr double kLine_s = 30;

template <class... Values>
std::string text_of(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string duration_text(double seconds) {
    if (seconds < 100) return text_of("%.0f s", seconds);
    if (seconds < 6000) return text_of("%.0f min", seconds / 60);
    return text_of("%.0f h", seconds / 3600);
}

double share_done(const Standing& standing) {
    return standing.size_all > 0 ? standing.size_done / standing.size_all : 0;
}

std::string line_of(const Standing& standing, const std::vector<Item>& items) {
    const int failed = standing.count(State::kFailed);
    const int done = standing.count(State::kMade) + standing.count(State::kKept);
    std::string line = std::to_string(done) + " of " + std::to_string(items.size()) + " done";
    if (failed > 0) line += ", " + std::to_string(failed) + " failed";
    int working = 0;
    const Item* largest = nullptr;
    for (const RankRecord& rank : standing.ranks) {
        if (!rank.item) continue;
        ++working;
        const Item& item = items[*rank.item];
        if (largest == nullptr || item.size > largest->size) largest = &item;
    }
    line += ", " + std::to_string(working) + " of " + std::to_string(standing.ranks.size()) + " ranks at work";
    if (largest != nullptr) line += ", at " + printable(largest->name);
    if (standing.waits_for_memory) line += ", some wait for memory";
    const double share = share_done(standing);
    if (share > 0.02 && share < 1) line += ", " + duration_text(standing.seconds * (1 - share) / share) + " left";
    return line;
}

struct Totals {
    int items = 0;
    double busy_s = 0;
    int ranks = 0;
};

Totals totals_of(const Standing& standing) {
    Totals all;
    for (const RankRecord& rank : standing.ranks) {
        all.items += rank.items;
        all.busy_s += rank.busy_s;
        ++all.ranks;
    }
    return all;
}

double share_busy(const RankRecord& rank, const Standing& standing) {
    return standing.seconds > 0 ? std::min(1.0, rank.busy_s / standing.seconds) : 0;
}

}  // namespace

FarmProgress::FarmProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

void FarmProgress::show(const Standing& standing, const std::vector<Item>& items) {
    if (quiet_ || standing.seconds < kSilence_s) return;
    const double gone_s = standing.seconds - last_s_;
    const int tenth = static_cast<int>(10 * share_done(standing));
    if (terminal_ ? gone_s < kRedraw_s : tenth == last_tenth_ && gone_s < kLine_s) return;
    last_s_ = standing.seconds;
    last_tenth_ = tenth;
    std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "rs-farm: %s\n", line_of(standing, items).c_str());
    std::fflush(stderr);
    drawn_ = true;
}

void FarmProgress::finish() {
    if (drawn_ && terminal_) std::fputc('\n', stderr);
    drawn_ = false;
}

std::string table_of(const Standing& standing, const std::vector<Item>& items) {
    std::string table;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (standing.states[i] != State::kFailed) continue;
        table += "failed  " + printable(items[i].name) + ": " + printable(standing.outcomes[i].why) + "\n";
    }
    if (standing.ranks.size() > 1) {
        table += text_of("%5s  %-24s %6s %9s %6s\n", "rank", "node", "items", "seconds", "busy");
        for (std::size_t i = 0; i < standing.ranks.size(); ++i) {
            const RankRecord& rank = standing.ranks[i];
            table += text_of("%5zu  %-24s %6d %9.1f %5.0f%%\n", i, printable(rank.node).substr(0, 24).c_str(),
                             rank.items, rank.busy_s, 100 * share_busy(rank, standing));
        }
    }
    std::int64_t most_bytes = 0;
    for (const Outcome& outcome : standing.outcomes) most_bytes = std::max(most_bytes, outcome.memory_bytes);
    const Totals all = totals_of(standing);
    const int open = static_cast<int>(std::ranges::count(standing.states, std::optional<State>()));
    table += std::to_string(items.size()) + " items: " + std::to_string(standing.count(State::kMade)) + " made, " +
             std::to_string(standing.count(State::kKept)) + " kept, " + std::to_string(standing.count(State::kFailed)) +
             " failed" + (open > 0 ? ", " + std::to_string(open) + " not done" : std::string());
    table += text_of("; %.1f s of work in %.1f s on %d ranks, at most %.0f MB an item\n", all.busy_s, standing.seconds,
                     all.ranks, static_cast<double>(most_bytes) / 1e6);
    return table;
}

std::string json_of(const Standing& standing, const std::vector<Item>& items) {
    nlohmann::json json{{"items", items.size()},
                        {"made", standing.count(State::kMade)},
                        {"kept", standing.count(State::kKept)},
                        {"failed", nlohmann::json::array()},
                        {"seconds", standing.seconds},
                        {"ranks", nlohmann::json::array()}};
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (standing.states[i] != State::kFailed) continue;
        json["failed"].push_back({{"item", items[i].name}, {"why", standing.outcomes[i].why}});
    }
    for (const RankRecord& rank : standing.ranks) {
        json["ranks"].push_back({{"node", rank.node}, {"items", rank.items}, {"busy_s", rank.busy_s}});
    }
    json["items_per_second"] =
        standing.seconds > 0 ? static_cast<double>(standing.count(State::kMade)) / standing.seconds : 0;
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace rs::farm
