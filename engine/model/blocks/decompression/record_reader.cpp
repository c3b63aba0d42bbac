#include "engine/model/blocks/decompression/record_reader.hpp"

#include "engine/model/limits/coded_layout.hpp"

namespace rs::engine::model {

RecordReader::RecordReader(int hop, const RegisterFile& registers, Fifo<AskedTile>& in, Fifo<MemoryWord>& heads,
                           Fifo<MemoryRead>& requests, Fifo<AskedRecord>& out)
    : Block("record_reader_" + std::to_string(hop),
            "a record in as many cycles as it has words, 1 without; 1 more for a new tile"),
      registers_(registers),
      in_(reads(in)),
      heads_(reads(heads)),
      requests_(writes(requests)),
      out_(writes(out)) {}

Activity RecordReader::tick(std::uint64_t) {
    if (to_ask_ > 0) {
        if (!requests_.can_push()) return Activity::memory_port;
        requests_.push({next_++, false});
        --to_ask_;
        return Activity::busy;
    }
    if (!in_.can_pop()) return Activity::idle;
    const AskedTile& asked = in_.front();
    if (asked.kind == AskedTile::Kind::read && !loaded_) {
        if (!heads_.can_pop()) return Activity::memory_data;
        head_ = heads_.pop().data;
        tile_ = asked.address;
        loaded_ = true;
        return Activity::busy;
    }
    if (!out_.can_push()) return Activity::output_full;
    if (!requests_.can_push()) return Activity::memory_port;
    if (asked.kind == AskedTile::Kind::nothing) head_ = 0;
    const int block = asked.ask.block();
    AskedRecord record;
    record.ask = asked.ask;
    record.class_number = block_class(head_, block);
    const auto byte = [&](int n) { return static_cast<int>((head_ >> (8 * n)) & 255U); };
    record.predicted_picture = byte(6) != kNoReferenceByte;
    record.references = {byte(6), byte(7)};
    if (record.class_number > 0) {
        const auto& classes = registers_.object_of(asked.ask.view).classes[record.predicted_picture ? 1 : 0];
        const int offset = record_offset(head_, block, classes);
        const int bytes = classes[static_cast<std::size_t>(record.class_number)].bytes();
        record.lane = offset & 7;
        record.words = (record.lane + bytes + 7) / 8;
        next_ = tile_ + 1 + static_cast<WordAddress>(offset / 8);
        requests_.push({next_++, false});
        to_ask_ = record.words - 1;
    }
    out_.push(record);
    in_.pop();
    loaded_ = false;
    return Activity::busy;
}

}  // namespace rs::engine::model
