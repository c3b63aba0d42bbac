#pragma once
// Sample select (the paper's "Y, U, V, alpha data get"): takes the words that come back from memory in the order in
// which they were asked for, picks bytes and bits by their tags, and hands on a pixel with its Y.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

namespace rs::engine::model {

class SampleSelect final : public Block {
public:
    SampleSelect(Fifo<SampleTag>& tags, Fifo<MemoryWord>& words, Fifo<YuvaPixel>& out);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<SampleTag>& tags_;
    Fifo<MemoryWord>& words_;
    Fifo<YuvaPixel>& out_;
    int level_[2] = {0, 0};
    int u_ = 0;
    int v_ = 0;
};

}  // namespace rs::engine::model
