#pragma once
// A rank that does items, one at a time. The work itself goes on beside it (in a process of its own,
// compositor/farm/work), so that rank 0 can be coordinator and worker in one thread.

#include "compositor/farm/schedule/item.hpp"
#include "compositor/farm/schedule/transport.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace rs::farm {

// An item under way. Dropped, it ends and leaves nothing half-made.
class Job {
public:
    virtual ~Job() = default;
    // Nothing while it is under way. Does not wait.
    virtual std::optional<Outcome> poll() = 0;
};

// Begins an item's order; `record` is what the manifest holds of it, null where it is new.
using BeginJob = std::function<std::unique_ptr<Job>(const nlohmann::json& order, const Outcome* record)>;

struct WorkerNode {
    std::string name;
    std::int64_t memory_bytes = 0;  // what the system lets programs have
};

class Worker {
public:
    // Reports to the coordinator at once.
    Worker(Transport& transport, const WorkerNode& node, BeginJob begin);
    // True where something happened.
    bool step();
    // Ends the item under way and has the coordinator end the run.
    void interrupt();
    [[nodiscard]] bool ended() const { return ended_; }

private:
    void take(const Message& message);
    void report(const Outcome& outcome);
    void send(const nlohmann::json& json);

    Transport& transport_;
    BeginJob begin_;
    std::unique_ptr<Job> job_;
    std::size_t item_ = 0;
    bool interrupted_ = false;
    bool ended_ = false;
};

}  // namespace rs::farm
