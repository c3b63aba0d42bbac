#include "engine/model/blocks/decompression/tile_reader.hpp"

#include "engine/model/limits/coded_layout.hpp"

namespace rs::engine::model {

TileReader::TileReader(int hop, Fifo<FoundTile>& in, Fifo<MemoryWord>& entries, Fifo<MemoryRead>& requests,
                       Fifo<AskedTile>& out)
    : Block("tile_reader_" + std::to_string(hop), "a block per cycle, that of a new tile with its word"),
      in_(reads(in)),
      entries_(reads(entries)),
      requests_(writes(requests)),
      out_(writes(out)) {}

Activity TileReader::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    if (!out_.can_push()) return Activity::output_full;
    const FoundTile& found = in_.front();
    AskedTile asked{found.ask, AskedTile::Kind::same, 0};
    if (!found.same) {
        if (!entries_.can_pop()) return Activity::memory_data;
        if (!requests_.can_push()) return Activity::memory_port;
        const auto entry = static_cast<std::uint32_t>(entries_.pop().data >> (found.high ? 32 : 0));
        asked.kind = entry == kNoTile ? AskedTile::Kind::nothing : AskedTile::Kind::read;
        if (asked.kind == AskedTile::Kind::read) {
            asked.address = entry;
            requests_.push({entry, false});
        }
    }
    out_.push(asked);
    in_.pop();
    return Activity::busy;
}

}  // namespace rs::engine::model
