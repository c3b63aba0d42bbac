#pragma once
// Block motion of a hop: collects a record's words, splits it into fields, and requests its references: the needed rows
// of one column of one or two blocks of the reference, one above the other. The record leaves with the first of these
// requests, so that consumers of the record never wait for the second.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

// Decodes a record of class `record_class`, without the clock; bytes in memory order, zero after the record.
BlockRecord block_record(const codec::RecordClass& record_class, const std::array<std::uint8_t, 32>& bytes);

// Reference row or column of a predicted one, clamped to the coded size.
constexpr int clamped_coordinate(int place, int motion, int coded_size) {
    const int at = place + motion;
    return at < 0 ? 0 : at >= coded_size ? coded_size - 1 : at;
}

// Requests of a predicted record, in the order in which their pixels arrive; `count` is 1 or 2.
struct ReferenceRequests {
    int count = 0;
    std::array<BlockRequest, 2> items;
};
ReferenceRequests reference_requests(const BlockRequest& request, int image, int motion_x, int motion_y,
                                     int coded_width, int coded_height);

class BlockMotion final : public Block {
public:
    struct Ports {
        Fifo<RequestedRecord>& in;
        Fifo<MemoryWord>& words;
        Fifo<BlockRecord>& out;
        Fifo<BlockRequest>* asks;  // null for the last hop, where no record is predicted
    };
    BlockMotion(int hop, const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "words " + std::to_string(collected_) + (second_ ? ", one more request" : "");
    }

private:
    Activity send_output();

    const RegisterFile& registers_;
    Fifo<RequestedRecord>& in_;
    Fifo<MemoryWord>& words_;
    Fifo<BlockRecord>& out_;
    Fifo<BlockRequest>* asks_;
    int collected_ = 0;
    std::array<std::uint64_t, 4> collected_words_{};
    bool first_ = false;   // a view column has begun, and no request of the next hop was made in it
    bool second_ = false;  // left_over_ is still to be sent
    BlockRequest left_over_;
};

}  // namespace rs::engine::model
