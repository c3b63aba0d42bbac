#include "compositor/farm/schedule/item.hpp"

#include "rayspace/base/printable.hpp"

#include <array>
#include <utility>

namespace rs::farm {
namespace {

constexpr std::array<std::pair<State, const char*>, 5> kStates = {{{State::kMade, "made"},
                                                                   {State::kKept, "kept"},
                                                                   {State::kFailed, "failed"},
                                                                   {State::kRefused, "refused"},
                                                                   {State::kStopped, "stopped"}}};

}  // namespace

std::string to_string(State state) {
    return kStates.at(static_cast<std::size_t>(state)).second;
}

nlohmann::json to_json(const Outcome& outcome) {
    nlohmann::json json{{"state", to_string(outcome.state)}};
    const auto put = [&](const char* key, const std::string& text) {
        if (!text.empty()) json[key] = text;
    };
    put("why", outcome.why);
    put("key", outcome.key);
    put("inputs", outcome.inputs);
    put("output", outcome.output);
    put("sum", outcome.sum);
    put("staged", outcome.staged);
    if (outcome.recorded) json["recorded"] = true;
    json["seconds"] = outcome.seconds;
    json["memory_bytes"] = outcome.memory_bytes;
    return json;
}

Result<Outcome> outcome_from(const nlohmann::json& json) {
    Outcome outcome;
    try {
        const std::string state = json.at("state");
        bool known = false;
        for (const auto& [value, name] : kStates) {
            if (state != name) continue;
            outcome.state = value;
            known = true;
        }
        if (!known) return Error{"an item cannot be '" + printable(state) + "'"};
        outcome.why = json.value("why", "");
        outcome.key = json.value("key", "");
        outcome.inputs = json.value("inputs", "");
        outcome.output = json.value("output", "");
        outcome.sum = json.value("sum", "");
        outcome.staged = json.value("staged", "");
        outcome.recorded = json.value("recorded", false);
        outcome.seconds = json.value("seconds", 0.0);
        if (json.contains("memory_bytes")) {
            const nlohmann::json& bytes = json["memory_bytes"];
            // A number with a fraction or an exponent may be beyond all integers.
            if (!bytes.is_number_integer()) return Error{"memory_bytes is no whole number"};
            outcome.memory_bytes = bytes;
        }
    } catch (const nlohmann::json::exception& wrong) {
        return Error{std::string("what became of an item cannot be read: ") + wrong.what()};
    }
    return outcome;
}

}  // namespace rs::farm
