#include "engine/model/blocks/decompression/block_motion.hpp"

#include "rayspace/codec/board/board_tile.hpp"

namespace rs::engine::model {

BlockRecord block_record(const codec::RecordClass& of, const std::array<std::uint8_t, 32>& bytes) {
    BlockRecord record;
    record.of = of;
    std::size_t next = 0;
    if (of.predicted) {
        next = 2;
    } else {
        for (std::uint8_t& sample : record.flat) sample = bytes[next++];
    }
    for (std::size_t s = 0; s < static_cast<std::size_t>(of.block_stages); ++s) record.block[s] = bytes[next++];
    for (std::size_t s = 0; s < static_cast<std::size_t>(of.quarter_stages); ++s) {
        for (std::uint8_t& index : record.quarter[s]) index = bytes[next++];
    }
    if (of.alpha) {
        for (std::uint8_t& index : record.alpha) index = bytes[next++];
    }
    return record;
}

ReferenceAsks reference_asks(const BlockAsk& ask, int image, int motion_x, int motion_y, int coded_width,
                             int coded_height) {
    ReferenceAsks asks;
    const int column = moved(ask.column, motion_x, coded_width);
    for (int n = 0; n < 8; ++n) {
        const int r = ask.down ? n : 7 - n;
        if (((ask.rows >> r) & 1U) == 0) continue;
        const int row = moved(8 * ask.block_row + r, motion_y, coded_height);
        if (asks.count == 0 || asks.ask[static_cast<std::size_t>(asks.count) - 1].block_row != row >> 3) {
            asks.ask[static_cast<std::size_t>(asks.count++)] = {ask.view, false, ask.down, image, column, row >> 3, 0};
        }
        asks.ask[static_cast<std::size_t>(asks.count) - 1].rows |= 1U << (row & 7);
    }
    return asks;
}

BlockMotion::BlockMotion(int hop, const RegisterFile& registers, Fifo<AskedRecord>& in, Fifo<MemoryWord>& words,
                         Fifo<BlockRecord>& out, Fifo<BlockAsk>* asks)
    : Block("block_motion_" + std::to_string(hop),
            asks == nullptr ? "a word per cycle, and one to hand over"
                            : "a word per cycle, one to hand over, one more for a second ask"),
      registers_(registers),
      in_(reads(in)),
      words_(reads(words)),
      out_(writes(out)),
      asks_(asks) {
    if (asks_ != nullptr) writes(*asks_);
}

Activity BlockMotion::tick(std::uint64_t) {
    if (second_) {
        if (!asks_->can_push()) return Activity::output_full;
        asks_->push(left_over_);
        second_ = false;
        return Activity::busy;
    }
    if (!in_.can_pop()) return Activity::idle;
    if (collected_ < in_.front().words) {
        if (!words_.can_pop()) return Activity::memory_data;
        collected_words_[static_cast<std::size_t>(collected_++)] = words_.pop().data;
        return Activity::busy;
    }
    return hand_over();
}

Activity BlockMotion::hand_over() {
    if (!out_.can_push()) return Activity::output_full;
    const AskedRecord& asked = in_.front();
    first_ = first_ || asked.ask.first;
    BlockRecord record;
    record.empty = asked.class_number == 0;
    if (!record.empty) {
        const ObjectRegisters& object = registers_.object_of(asked.ask.view);
        const codec::RecordClass& of =
            object.classes[asked.predicted_image ? 1 : 0][static_cast<std::size_t>(asked.class_number)];
        if (of.predicted && (asks_ == nullptr || !asks_->can_push())) return Activity::output_full;
        std::array<std::uint8_t, 32> bytes{};
        for (int n = 0; n < of.bytes(); ++n) {
            const int at = asked.lane + n;
            bytes[static_cast<std::size_t>(n)] =
                static_cast<std::uint8_t>(collected_words_[static_cast<std::size_t>(at / 8)] >> (8 * (at % 8)));
        }
        record = block_record(of, bytes);
        if (of.predicted) {
            const codec::BoardMotion motion = codec::board_motion(static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8));
            ReferenceAsks asks = reference_asks(asked.ask, asked.references[static_cast<std::size_t>(motion.reference)],
                                                motion.x, motion.y, object.coded_width, object.coded_height);
            record.motion_y = motion.y;
            record.reference_column = asks.ask[0].column & 7;
            asks.ask[0].first = first_;
            first_ = false;
            asks_->push(asks.ask[0]);
            second_ = asks.count == 2;
            left_over_ = asks.ask[1];
        }
    }
    record.block_row = asked.ask.block_row;
    out_.push(record);
    in_.pop();
    collected_ = 0;
    return Activity::busy;
}

}  // namespace rs::engine::model
