#pragma once
// The ranks of an MPI job. All that the farm knows of MPI is here.

#include "compositor/farm/schedule/transport.hpp"

#include <memory>

namespace rs::farm {

// One for the life of a process. Never waits inside of MPI, which would take a processor for itself while it does.
class MpiTransport final : public Transport {
public:
    // Begins MPI, which ends with the object, when all ranks have come to its end. Without mpirun or srun there is one
    // rank.
    MpiTransport();
    MpiTransport(const MpiTransport&) = delete;
    MpiTransport& operator=(const MpiTransport&) = delete;
    ~MpiTransport() override;

    [[nodiscard]] int rank() const override;
    [[nodiscard]] int ranks() const override;
    // Among the ranks of this node. All ranks must call it, once, together.
    struct NodePlace {
        int place = 0;
        int places = 1;
    };
    [[nodiscard]] NodePlace place_on_node() const;
    void send(int to, Channel channel, std::vector<std::uint8_t> bytes) override;
    std::optional<Message> receive(Channel channel) override;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rs::farm
