#pragma once
// Load broadcast: the words of the private bus go to all memory channels, which hold the same objects. An object is
// loaded when it is in all of them.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

#include <vector>

namespace rs::engine::model {

struct LoadPort {
    Fifo<MemoryWrite>* words = nullptr;
    Fifo<Done>* loaded = nullptr;
};

class LoadBroadcast final : public Block {
public:
    LoadBroadcast(Fifo<MemoryWrite>& in, std::vector<LoadPort> channels, Fifo<Done>& loaded);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<MemoryWrite>& in_;
    std::vector<LoadPort> channels_;
    Fifo<Done>& loaded_;
};

}  // namespace rs::engine::model
