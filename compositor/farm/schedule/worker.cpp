#include "compositor/farm/schedule/worker.hpp"

#include <exception>
#include <utility>

namespace rs::farm {

// MessagePack, for names of files need not be UTF-8.
Worker::Worker(Transport& transport, const WorkerNode& node, BeginJob begin)
    : transport_(transport), begin_(std::move(begin)) {
    send({{"type", "hello"}, {"node", node.name}, {"memory_bytes", node.memory_bytes}});
}

void Worker::send(const nlohmann::json& json) {
    transport_.send(0, Channel::kToCoordinator, nlohmann::json::to_msgpack(json));
}

void Worker::report(const Outcome& outcome) {
    send({{"type", "outcome"}, {"item", item_}, {"outcome", to_json(outcome)}});
}

void Worker::take(const Message& message) {
    const nlohmann::json json = nlohmann::json::from_msgpack(message.bytes);
    if (json.at("type") == "stop") {
        if (job_) {
            job_.reset();
            report({.state = State::kStopped});
        }
        send({{"type", "bye"}});
        ended_ = true;
        return;
    }
    item_ = json.at("item");
    if (interrupted_) {
        report({.state = State::kStopped});
        return;
    }
    std::optional<Outcome> record;
    if (json.contains("record")) {
        const Result<Outcome> read = outcome_from(json.at("record"));
        if (read) record = *read;
    }
    try {
        job_ = begin_(json.at("order"), record ? &*record : nullptr);
    } catch (const std::exception& thrown) {
        report({.state = State::kFailed, .why = thrown.what()});
    }
}

bool Worker::step() {
    bool happened = false;
    if (job_) {
        std::optional<Outcome> outcome;
        try {
            outcome = job_->poll();
        } catch (const std::exception& thrown) {
            outcome = Outcome{.state = State::kFailed, .why = thrown.what()};
        }
        if (outcome) {
            job_.reset();
            report(*outcome);
            happened = true;
        }
    }
    while (!ended_) {
        const std::optional<Message> message = transport_.receive(Channel::kToWorker);
        if (!message) break;
        take(*message);
        happened = true;
    }
    return happened;
}

void Worker::interrupt() {
    if (interrupted_) return;
    interrupted_ = true;
    if (job_) {
        job_.reset();
        report({.state = State::kStopped});
    }
    send({{"type", "interrupted"}});
}

}  // namespace rs::farm
