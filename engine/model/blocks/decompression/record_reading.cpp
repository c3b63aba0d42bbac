#include "engine/model/blocks/decompression/record_reading.hpp"
#include "engine/model/limits/coded_layout.hpp"

namespace rs::engine::model {

TileFinder::TileFinder(int hop, const RegisterFile& registers, const Ports& ports)
    : Block("tile_finder_" + std::to_string(hop), "a block per cycle"),
      registers_(registers),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      out_(writes(ports.out)) {}

Activity TileFinder::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    if (!out_.can_push()) return Activity::output_full;
    const BlockRequest& request = in_.front();
    const ObjectRegisters& object = registers_.object_of(request.view);
    const int column = request.image * object.tile_columns + (request.column >> 5);
    const int entry = column * object.table_pitch + (request.block_row >> 2);
    // All blocks of a view column belong to one object; the entry of an earlier column may belong to an evicted object.
    const bool same = !request.first && entry == last_entry_;
    if (!same) {
        if (!requests_.can_push()) return Activity::memory_port;
        requests_.push({object.tile_table + static_cast<WordAddress>(entry >> 1), false});
    }
    out_.push({request, same, (entry & 1) != 0});
    last_entry_ = entry;
    in_.pop();
    return Activity::busy;
}

TileReader::TileReader(int hop, const Ports& ports)
    : Block("tile_reader_" + std::to_string(hop), "a block per cycle, that of a new tile with its word"),
      in_(reads(ports.in)),
      entries_(reads(ports.entries)),
      requests_(writes(ports.requests)),
      out_(writes(ports.out)) {}

Activity TileReader::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    if (!out_.can_push()) return Activity::output_full;
    const FoundTile& found = in_.front();
    RequestedTile requested{found.request, RequestedTile::Kind::same, 0};
    if (!found.same) {
        if (!entries_.can_pop()) return Activity::memory_data;
        if (!requests_.can_push()) return Activity::memory_port;
        const auto entry = static_cast<std::uint32_t>(entries_.pop().data >> (found.high ? 32 : 0));
        requested.kind = entry == kNoTile ? RequestedTile::Kind::nothing : RequestedTile::Kind::read;
        if (requested.kind == RequestedTile::Kind::read) {
            requested.address = entry;
            requests_.push({entry, false});
        }
    }
    out_.push(requested);
    in_.pop();
    return Activity::busy;
}

RecordReader::RecordReader(int hop, const RegisterFile& registers, const Ports& ports)
    : Block("record_reader_" + std::to_string(hop),
            "a record in as many cycles as it has words, 1 without; 1 more for a new tile"),
      registers_(registers),
      in_(reads(ports.in)),
      heads_(reads(ports.heads)),
      requests_(writes(ports.requests)),
      out_(writes(ports.out)) {}

Activity RecordReader::tick(std::uint64_t) {
    if (to_request_ > 0) {
        if (!requests_.can_push()) return Activity::memory_port;
        requests_.push({next_++, false});
        --to_request_;
        return Activity::busy;
    }
    if (!in_.can_pop()) return Activity::idle;
    const RequestedTile& requested = in_.front();
    if (requested.kind == RequestedTile::Kind::read && !loaded_) {
        if (!heads_.can_pop()) return Activity::memory_data;
        head_ = heads_.pop().data;
        tile_ = requested.address;
        loaded_ = true;
        return Activity::busy;
    }
    if (!out_.can_push()) return Activity::output_full;
    if (!requests_.can_push()) return Activity::memory_port;
    if (requested.kind == RequestedTile::Kind::nothing) head_ = 0;
    const int block = requested.request.block();
    RequestedRecord record;
    record.request = requested.request;
    record.class_number = block_class(head_, block);
    const auto byte = [&](int n) { return static_cast<int>((head_ >> (8 * n)) & 255U); };
    record.predicted_image = byte(6) != kNoReferenceByte;
    record.references = {byte(6), byte(7)};
    if (record.class_number > 0) {
        const auto& classes = registers_.object_of(requested.request.view).classes[record.predicted_image ? 1 : 0];
        const int offset = record_offset(head_, block, classes);
        const int bytes = classes[static_cast<std::size_t>(record.class_number)].bytes();
        record.lane = offset & 7;
        record.words = (record.lane + bytes + 7) / 8;
        next_ = tile_ + 1 + static_cast<WordAddress>(offset / 8);
        requests_.push({next_++, false});
        to_request_ = record.words - 1;
    }
    out_.push(record);
    in_.pop();
    loaded_ = false;
    return Activity::busy;
}

}  // namespace rs::engine::model
