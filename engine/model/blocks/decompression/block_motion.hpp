#pragma once
// Motion of a hop: collects a record's words, moves its fields to their places, and requests what it is predicted from:
// the needed rows of one column of one or two blocks of the reference, above each other. The record leaves with the
// first of these requests, so that whoever waits for it never waits for the second.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

// The arithmetic without the clock. The record of class `of`; bytes as they stand in memory, zero behind the record.
BlockRecord block_record(const codec::RecordClass& of, const std::array<std::uint8_t, 32>& bytes);

// Where a row or column of a predicted image is taken from: clamped to the coded size.
constexpr int moved(int place, int motion, int coded_size) {
    const int at = place + motion;
    return at < 0 ? 0 : at >= coded_size ? coded_size - 1 : at;
}

// The requests of a predicted record, in the order in which their pixels come; `count` of them are made, 1 or 2.
struct ReferenceAsks {
    int count = 0;
    std::array<BlockAsk, 2> ask;
};
ReferenceAsks reference_asks(const BlockAsk& ask, int image, int motion_x, int motion_y, int coded_width,
                             int coded_height);

class BlockMotion final : public Block {
public:
    // `asks` is null behind the last hop, where no record is predicted.
    BlockMotion(int hop, const RegisterFile& registers, Fifo<AskedRecord>& in, Fifo<MemoryWord>& words,
                Fifo<BlockRecord>& out, Fifo<BlockAsk>* asks);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "words " + std::to_string(collected_) + (second_ ? ", one more ask" : "");
    }

private:
    Activity hand_over();

    const RegisterFile& registers_;
    Fifo<AskedRecord>& in_;
    Fifo<MemoryWord>& words_;
    Fifo<BlockRecord>& out_;
    Fifo<BlockAsk>* asks_;
    int collected_ = 0;
    std::array<std::uint64_t, 4> collected_words_{};
    bool first_ = false;   // a view column has begun, and nothing of the next hop was requested in it
    bool second_ = false;  // a request is left over
    BlockAsk left_over_;
};

}  // namespace rs::engine::model
