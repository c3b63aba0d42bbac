#include "engine/model/blocks/decompression/tile_finder.hpp"

namespace rs::engine::model {

TileFinder::TileFinder(int hop, const RegisterFile& registers, Fifo<BlockAsk>& in, Fifo<MemoryRead>& requests,
                       Fifo<FoundTile>& out)
    : Block("tile_finder_" + std::to_string(hop), "a block per cycle"),
      registers_(registers),
      in_(reads(in)),
      requests_(writes(requests)),
      out_(writes(out)) {}

Activity TileFinder::tick(std::uint64_t) {
    if (!in_.can_pop()) return Activity::idle;
    if (!out_.can_push()) return Activity::output_full;
    const BlockAsk& ask = in_.front();
    const ObjectRegisters& object = registers_.object_of(ask.view);
    const int column = ask.picture * object.tile_columns + (ask.column >> 5);
    const int entry = column * object.table_pitch + (ask.block_row >> 2);
    // Within a view column all blocks are of one object; what was known before it may be of one that is gone.
    const bool same = !ask.first && entry == last_entry_;
    if (!same) {
        if (!requests_.can_push()) return Activity::memory_port;
        requests_.push({object.tile_table + static_cast<WordAddress>(entry >> 1), false});
    }
    out_.push({ask, same, (entry & 1) != 0});
    last_entry_ = entry;
    in_.pop();
    return Activity::busy;
}

}  // namespace rs::engine::model
