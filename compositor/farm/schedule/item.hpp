#pragma once
// What a farm hands out, and what comes back. Farm: items -> schedule -> ranks -> outcomes -> manifest.

#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::farm {

struct Item {
    std::string name;                // unique in a run; UTF-8
    double size = 0;                 // of the work, in any unit: the largest is begun first
    std::int64_t memory_bytes = 0;   // that it will take, as far as is known
    std::vector<std::size_t> after;  // items that must have been made before
    nlohmann::json order;            // what a worker must know; means nothing to the schedule
};

enum class State {
    kMade,     // now
    kKept,     // by an earlier run, of the same inputs with the same options
    kFailed,   // `why` states it; others go on
    kRefused,  // the options are wrong, and will be for all items
    kStopped,  // the run was ended
};
std::string to_string(State state);

// The sums are XXH64 as 16 hexadecimal digits.
struct Outcome {
    State state = State::kFailed;
    std::string why{};
    std::string key{};      // of kind, options, and names of inputs
    std::string inputs{};   // sum of the list of what was read
    std::string output{};   // where the result is to stand
    std::string sum{};      // of the result
    std::string staged{};   // where the result stands until it is in the manifest; empty: it stands at `output`
    bool recorded = false;  // the manifest holds it already
    double seconds = 0;
    std::int64_t memory_bytes = 0;  // the most that it took
};

nlohmann::json to_json(const Outcome& outcome);
Result<Outcome> outcome_from(const nlohmann::json& json);

}  // namespace rs::farm
