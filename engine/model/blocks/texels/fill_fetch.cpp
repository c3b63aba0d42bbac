#include "engine/model/blocks/texels/fill_fetch.hpp"

#include "engine/model/limits/parallel_layout.hpp"

namespace rs::engine::model {

FillFetch::FillFetch(const RegisterFile& registers, Fifo<TexelFill>& in, Fifo<BlockAsk>& asks, Fifo<CodedPixel>& pixels,
                     Fifo<MemoryRead>& raw_reads, Fifo<FillKind>& kinds, Fifo<FillTarget>& targets)
    : Block("fill_fetch", "a coded block in 64 cycles, a raw one in " + std::to_string(kRawBlockWords)),
      registers_(registers),
      in_(reads(in)),
      asks_(writes(asks)),
      pixels_(writes(pixels)),
      raw_reads_(writes(raw_reads)),
      kinds_(writes(kinds)),
      targets_(writes(targets)) {}

bool FillFetch::begin() {
    if (!kinds_.can_push() || !targets_.can_push()) return false;
    fill_ = in_.pop();
    const ObjectRegisters& object = registers_.object_of(fill_.view);
    coded_ = object.coded;
    kinds_.push({coded_});
    targets_.push({fill_.line, fill_.guard});
    first_ = object.serial != serial_;
    serial_ = object.serial;
    asked_ = sent_ = 0;
    const int block = (fill_.picture * object.block_columns + fill_.block_column) * object.block_rows + fill_.block_row;
    next_ = object.raw_blocks + static_cast<WordAddress>(block * kRawBlockWords);
    return active_ = true;
}

// An ask and a pixel a cycle, each as far as there is room.
bool FillFetch::fetch_coded() {
    bool moved = false;
    if (asked_ < 8 && asks_.can_push()) {
        asks_.push({fill_.view, first_, true, fill_.picture, 8 * fill_.block_column + asked_, fill_.block_row, 0xFF});
        first_ = false;
        ++asked_;
        moved = true;
    }
    if (sent_ < 64 && pixels_.can_push()) {
        CodedPixel pixel;
        pixel.view = fill_.view;
        pixel.shows = pixel.pending = true;
        pixel.begins = sent_ % 8 == 0;
        pixel.row = 8 * fill_.block_row + sent_ % 8;
        pixel.column = sent_ / 8;
        pixels_.push(pixel);
        ++sent_;
        moved = true;
    }
    active_ = asked_ < 8 || sent_ < 64;
    return moved;
}

bool FillFetch::fetch_raw() {
    if (!raw_reads_.can_push()) return false;
    raw_reads_.push({next_++, false});
    active_ = ++asked_ < kRawBlockWords;
    return true;
}

Activity FillFetch::tick(std::uint64_t) {
    if (!active_) {
        if (!in_.can_pop()) return Activity::idle;
        if (!begin()) return Activity::output_full;
    }
    if (coded_ ? fetch_coded() : fetch_raw()) return Activity::busy;
    return coded_ ? Activity::output_full : Activity::memory_port;
}

}  // namespace rs::engine::model
