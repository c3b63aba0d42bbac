#pragma once
// Sample fetch: issues the reads of a pair of pixels, one per cycle, always in this order through one address adder:
//
//     alpha of both (again, where the two rows lie in different words), chroma 0, Y 0, chroma 1, Y 1
//
// Two alphas of 2 bits are nearly always in the same word of 32 rows, so one read gives the alpha of the pair; a word
// of (U, V) pairs gives both colour differences. An empty pixel issues null reads in the same order, so that pixels
// stay in order and the rate of the board does not depend on the image.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

namespace rs::engine::model {

class SampleFetch final : public Block {
public:
    struct Ports {
        Fifo<PixelPair>& in;
        Fifo<MemoryRead>& requests;
        Fifo<SampleTag>& tags;
    };
    explicit SampleFetch(const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "slot " + std::to_string(slot_); }

private:
    Fifo<PixelPair>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<SampleTag>& tags_;
    int slot_ = 0;  // 0, 1: alpha; 2..5: chroma and Y of pixel 0 and 1
};

// Sample select (the paper's "Y, U, V, alpha data get"): takes the words from memory in the order of their requests,
// selects bytes and bits by their tags, and outputs a pixel with its Y.

class SampleSelect final : public Block {
public:
    struct Ports {
        Fifo<SampleTag>& tags;
        Fifo<MemoryWord>& words;
        Fifo<YuvaPixel>& out;
    };
    explicit SampleSelect(const Ports& ports);
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
