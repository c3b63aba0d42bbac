#pragma once
// How ranks talk: short messages that arrive whole, and from one rank in the order sent. What carries them stands
// elsewhere (compositor/farm/mpi; queues between threads in tests).

#include <cstdint>
#include <optional>
#include <vector>

namespace rs::farm {

enum class Channel { kToCoordinator, kToWorker };

struct Message {
    int from = 0;
    std::vector<std::uint8_t> bytes;
};

// A rank's end; used by one thread. Rank 0 is the coordinator's, and a worker too: it may send to itself.
class Transport {
public:
    virtual ~Transport() = default;
    [[nodiscard]] virtual int rank() const = 0;
    [[nodiscard]] virtual int ranks() const = 0;
    // Returns at once.
    virtual void send(int to, Channel channel, std::vector<std::uint8_t> bytes) = 0;
    // Nothing where none has arrived.
    virtual std::optional<Message> receive(Channel channel) = 0;
};

}  // namespace rs::farm
