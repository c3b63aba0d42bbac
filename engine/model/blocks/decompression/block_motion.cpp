#include "engine/model/blocks/decompression/block_motion.hpp"

#include "rayspace/codec/board/board_profile.hpp"

namespace rs::engine::model {

BlockRecord block_record(const codec::RecordClass& record_class, const std::array<std::uint8_t, 32>& bytes) {
    BlockRecord record;
    record.record_class = record_class;
    std::size_t next = 0;
    if (record_class.predicted) {
        next = 2;
    } else {
        for (std::uint8_t& sample : record.flat) sample = bytes[next++];
    }
    for (std::size_t s = 0; s < static_cast<std::size_t>(record_class.block_stages); ++s)
        record.block[s] = bytes[next++];
    for (std::size_t s = 0; s < static_cast<std::size_t>(record_class.quarter_stages); ++s) {
        for (std::uint8_t& index : record.quarter[s]) index = bytes[next++];
    }
    if (record_class.alpha) {
        for (std::uint8_t& index : record.alpha) index = bytes[next++];
    }
    return record;
}

ReferenceRequests reference_requests(const BlockRequest& request, int image, int motion_x, int motion_y,
                                     int coded_width, int coded_height) {
    ReferenceRequests requests;
    const int column = clamped_coordinate(request.column, motion_x, coded_width);
    for (int n = 0; n < 8; ++n) {
        const int r = request.down ? n : 7 - n;
        if (((request.rows >> r) & 1U) == 0) continue;
        const int row = clamped_coordinate(8 * request.block_row + r, motion_y, coded_height);
        if (requests.count == 0 || requests.items[static_cast<std::size_t>(requests.count) - 1].block_row != row >> 3) {
            requests.items[static_cast<std::size_t>(requests.count++)] = {
                request.view, false, request.down, image, column, row >> 3, 0};
        }
        requests.items[static_cast<std::size_t>(requests.count) - 1].rows |= 1U << (row & 7);
    }
    return requests;
}

BlockMotion::BlockMotion(int hop, const RegisterFile& registers, const Ports& ports)
    : Block("block_motion_" + std::to_string(hop),
            ports.asks == nullptr ? "a word per cycle, and one to hand over"
                                  : "a word per cycle, one to hand over, one more for a second ask"),
      registers_(registers),
      in_(reads(ports.in)),
      words_(reads(ports.words)),
      out_(writes(ports.out)),
      asks_(ports.asks) {
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
    return send_output();
}

Activity BlockMotion::send_output() {
    if (!out_.can_push()) return Activity::output_full;
    const RequestedRecord& requested = in_.front();
    first_ = first_ || requested.request.first;
    BlockRecord record;
    record.empty = requested.class_number == 0;
    if (!record.empty) {
        const ObjectRegisters& object = registers_.object_of(requested.request.view);
        const codec::RecordClass& record_class =
            object.classes[requested.predicted_image ? 1 : 0][static_cast<std::size_t>(requested.class_number)];
        if (record_class.predicted && (asks_ == nullptr || !asks_->can_push())) return Activity::output_full;
        std::array<std::uint8_t, 32> bytes{};
        for (int n = 0; n < record_class.bytes(); ++n) {
            const int at = requested.lane + n;
            bytes[static_cast<std::size_t>(n)] =
                static_cast<std::uint8_t>(collected_words_[static_cast<std::size_t>(at / 8)] >> (8 * (at % 8)));
        }
        record = block_record(record_class, bytes);
        if (record_class.predicted) {
            const codec::BoardMotion motion = codec::board_motion(static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8));
            ReferenceRequests requests =
                reference_requests(requested.request, requested.references[static_cast<std::size_t>(motion.reference)],
                                   motion.x, motion.y, object.coded_width, object.coded_height);
            record.motion_y = motion.y;
            record.reference_column = requests.items[0].column & 7;
            requests.items[0].first = first_;
            first_ = false;
            asks_->push(requests.items[0]);
            second_ = requests.count == 2;
            left_over_ = requests.items[1];
        }
    }
    record.block_row = requested.request.block_row;
    out_.push(record);
    in_.pop();
    collected_ = 0;
    return Activity::busy;
}

}  // namespace rs::engine::model
