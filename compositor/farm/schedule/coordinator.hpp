#pragma once
// Rank 0: hands out items, writes down what became of them, and puts results in place.
//
//     outcome -> manifest, on the disk -> the result is renamed into place -> items after it may begin
//
// In this order nothing is done twice, wherever it is cut: a result that is staged and in no manifest is found there by
// whoever gets the item next (compositor/farm/work/tool_job.hpp), one that is in the manifest and staged is only
// renamed.

#include "compositor/farm/schedule/item.hpp"
#include "compositor/farm/schedule/manifest.hpp"
#include "compositor/farm/schedule/schedule.hpp"
#include "compositor/farm/schedule/transport.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rs::farm {

struct RankRecord {
    std::string node;
    int items = 0;                    // that it has done something for
    double busy_s = 0;                // with them
    std::optional<std::size_t> item;  // under way
    bool here = false;
    bool left = false;
};

// A run so far.
struct Standing {
    std::vector<std::optional<State>> states;  // [item]; nothing: still to come
    std::vector<Outcome> outcomes;             // [item]
    std::vector<RankRecord> ranks;
    double seconds = 0;
    double size_done = 0;  // of the items' sizes, of which size_all is the sum
    double size_all = 0;
    bool waits_for_memory = false;  // a rank is idle while items could begin
    bool interrupted = false;

    [[nodiscard]] int count(State state) const;
};

class Coordinator {
public:
    // Of each node `budget_bytes`, or without it three quarters of what the node has.
    Coordinator(Transport& transport, std::vector<Item> items, Manifest& manifest,
                std::optional<std::int64_t> budget_bytes);
    // True where something happened.
    bool step();
    // No further item is begun, those under way are stopped.
    void interrupt();
    // All ranks have been ordered to end, and have.
    [[nodiscard]] bool ended() const;
    // Why the run cannot go on: wrong options, or a manifest that cannot be written.
    [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
    [[nodiscard]] const Standing& standing() const { return standing_; }
    [[nodiscard]] const std::vector<Item>& items() const { return schedule_.items(); }

private:
    using Clock = std::chrono::steady_clock;
    void take(const Message& message);
    void take_outcome(int rank, std::size_t item, Outcome outcome);
    void hand_out();
    void commit();
    void settle(std::size_t item);
    void stop_all();
    void send(int rank, const nlohmann::json& json);

    Transport& transport_;
    Schedule schedule_;
    Manifest& manifest_;
    std::optional<std::int64_t> budget_bytes_;
    Standing standing_;
    std::set<int> idle_;
    bool offer_ = false;  // somebody may get something
    std::vector<std::size_t> uncommitted_;
    Clock::time_point begun_ = Clock::now();
    Clock::time_point oldest_;  // of the uncommitted
    bool stopping_ = false;
    std::optional<Error> failure_;
};

}  // namespace rs::farm
