#include "compositor/farm/schedule/coordinator.hpp"

#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <ctime>
#include <utility>

namespace rs::farm {
namespace {

// Outcomes wait so long for others, so that the disk is waited for once for all of them.
constexpr std::chrono::milliseconds kGathered(50);

std::string now_text() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

}  // namespace

int Standing::count(State state) const {
    return static_cast<int>(std::ranges::count(states, std::optional<State>(state)));
}

Coordinator::Coordinator(Transport& transport, std::vector<Item> items, Manifest& manifest,
                         std::optional<std::int64_t> budget_bytes)
    : transport_(transport), schedule_(std::move(items)), manifest_(manifest), budget_bytes_(budget_bytes) {
    standing_.states.resize(schedule_.items().size());
    standing_.outcomes.resize(schedule_.items().size());
    standing_.ranks.resize(static_cast<std::size_t>(transport.ranks()));
    for (const Item& item : schedule_.items()) standing_.size_all += item.size;
}

void Coordinator::send(int rank, const nlohmann::json& json) {
    transport_.send(rank, Channel::kToWorker, nlohmann::json::to_msgpack(json));
}

bool Coordinator::step() {
    bool happened = false;
    while (const std::optional<Message> message = transport_.receive(Channel::kToCoordinator)) {
        take(*message);
        happened = true;
    }
    if (offer_ && !stopping_) hand_out();
    const bool all_idle =
        std::ranges::none_of(standing_.ranks, [](const RankRecord& rank) { return rank.item.has_value(); });
    if (!uncommitted_.empty() && (all_idle || stopping_ || Clock::now() - oldest_ >= kGathered)) {
        commit();
        happened = true;
    }
    standing_.seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    if (schedule_.done() && !stopping_) stop_all();
    return happened;
}

void Coordinator::take(const Message& message) {
    const nlohmann::json json = nlohmann::json::from_msgpack(message.bytes);
    const std::string type = json.at("type");
    RankRecord& rank = standing_.ranks.at(static_cast<std::size_t>(message.from));
    if (type == "hello") {
        rank.node = json.at("node");
        rank.here = true;
        const std::int64_t memory_bytes = json.at("memory_bytes");
        schedule_.add_worker(message.from, rank.node, budget_bytes_.value_or(memory_bytes / 4 * 3));
        idle_.insert(message.from);
        offer_ = true;
    } else if (type == "bye") {
        rank.left = true;
    } else if (type == "interrupted") {
        interrupt();
    } else {
        const Result<Outcome> outcome = outcome_from(json.at("outcome"));
        take_outcome(message.from, json.at("item"),
                     outcome ? *outcome : Outcome{.state = State::kFailed, .why = outcome.error().message});
    }
}

void Coordinator::take_outcome(int rank, std::size_t item, Outcome outcome) {
    RankRecord& record = standing_.ranks.at(static_cast<std::size_t>(rank));
    record.item.reset();
    schedule_.finish(rank);
    idle_.insert(rank);
    offer_ = true;
    if (outcome.state == State::kStopped) return;  // it is as if it had never begun
    if (outcome.state == State::kRefused) {
        failure_ = Error{outcome.why};
        stop_all();
        return;
    }
    if (outcome.state != State::kKept) {
        ++record.items;
        record.busy_s += outcome.seconds;
    }
    const bool is_complete = outcome.state == State::kKept || outcome.recorded;
    if (!is_complete) {
        manifest_.add(schedule_.items()[item].name, outcome,
                      {{"rank", rank}, {"node", record.node}, {"time", now_text()}});
    }
    const bool is_kept = outcome.state == State::kKept;
    standing_.outcomes[item] = std::move(outcome);
    if (is_kept) {
        settle(item);
        return;
    }
    if (uncommitted_.empty()) oldest_ = Clock::now();
    uncommitted_.push_back(item);
}

void Coordinator::settle(std::size_t item) {
    const Outcome& outcome = standing_.outcomes[item];
    standing_.states[item] = outcome.state;
    standing_.size_done += schedule_.items()[item].size;
    const std::vector<std::size_t> lost = schedule_.settle(item, outcome.state != State::kFailed);
    for (const std::size_t after : lost) {
        standing_.states[after] = State::kFailed;
        standing_.outcomes[after] = {.why = "was not begun, for " + schedule_.items()[item].name + " failed"};
        standing_.size_done += schedule_.items()[after].size;
    }
    offer_ = true;
}

void Coordinator::commit() {
    const auto write = [&] {
        const Status status = manifest_.commit();
        if (status) return true;
        if (!failure_) failure_ = status.error();
        stop_all();
        return false;
    };
    const std::vector<std::size_t> items = std::exchange(uncommitted_, {});
    if (!write()) return;
    for (const std::size_t item : items) {
        Outcome& outcome = standing_.outcomes[item];
        if (outcome.state == State::kMade && !outcome.staged.empty()) {
            if (const Status moved = move_into_place(outcome.staged, outcome.output); !moved) {
                outcome.state = State::kFailed;
                outcome.why = moved.error().message;
                manifest_.add(schedule_.items()[item].name, outcome, {{"time", now_text()}});
            }
        }
        settle(item);
    }
    write();
}

void Coordinator::hand_out() {
    offer_ = false;
    for (auto at = idle_.begin(); at != idle_.end();) {
        const int rank = *at;
        const std::optional<std::size_t> item = schedule_.next(rank);
        if (!item) {
            ++at;  // another's node may have room
            continue;
        }
        at = idle_.erase(at);
        const Item& next = schedule_.items()[*item];
        nlohmann::json message{{"type", "work"}, {"item", *item}, {"order", next.order}};
        if (const Outcome* record = manifest_.find(next.name)) message["record"] = to_json(*record);
        standing_.ranks.at(static_cast<std::size_t>(rank)).item = *item;
        send(rank, message);
    }
    standing_.waits_for_memory = !idle_.empty() && schedule_.ready() > 0;
}

void Coordinator::interrupt() {
    standing_.interrupted = true;
    stop_all();
}

void Coordinator::stop_all() {
    if (std::exchange(stopping_, true)) return;
    for (int rank = 0; rank < transport_.ranks(); ++rank) send(rank, {{"type", "stop"}});
}

bool Coordinator::ended() const {
    return stopping_ && uncommitted_.empty() &&
           std::ranges::all_of(standing_.ranks, [](const RankRecord& rank) { return rank.left; });
}

}  // namespace rs::farm
