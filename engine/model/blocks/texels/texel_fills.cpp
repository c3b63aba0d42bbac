#include "engine/model/blocks/texels/texel_fills.hpp"
#include "engine/model/limits/parallel_layout.hpp"

namespace rs::engine::model {

FillFetch::FillFetch(const RegisterFile& registers, const Ports& ports)
    : Block("fill_fetch", "a coded block in 64 cycles, a raw one in " + std::to_string(kRawBlockWords)),
      registers_(registers),
      in_(reads(ports.in)),
      asks_(writes(ports.asks)),
      pixels_(writes(ports.pixels)),
      raw_reads_(writes(ports.raw_reads)),
      kinds_(writes(ports.kinds)),
      targets_(writes(ports.targets)) {}

bool FillFetch::begin() {
    if (!kinds_.can_push() || !targets_.can_push()) return false;
    fill_ = in_.pop();
    const ObjectRegisters& object = registers_.object_of(fill_.view);
    coded_ = object.coded;
    kinds_.push({coded_});
    targets_.push({fill_.line, fill_.guard});
    first_ = object.serial != serial_;
    serial_ = object.serial;
    requested_ = sent_ = 0;
    const int block = (fill_.image * object.block_columns + fill_.block_column) * object.block_rows + fill_.block_row;
    next_ = object.raw_blocks + static_cast<WordAddress>(block * kRawBlockWords);
    return active_ = true;
}

// Sends a request and a pixel per cycle, as far as the FIFOs have space.
bool FillFetch::fetch_coded() {
    bool moved = false;
    if (requested_ < 8 && asks_.can_push()) {
        asks_.push({fill_.view, first_, true, fill_.image, 8 * fill_.block_column + requested_, fill_.block_row, 0xFF});
        first_ = false;
        ++requested_;
        moved = true;
    }
    if (sent_ < 64 && pixels_.can_push()) {
        CodedPixel pixel;
        pixel.view = fill_.view;
        pixel.is_visible = pixel.pending = true;
        pixel.begins = sent_ % 8 == 0;
        pixel.row = 8 * fill_.block_row + sent_ % 8;
        pixel.column = sent_ / 8;
        pixels_.push(pixel);
        ++sent_;
        moved = true;
    }
    active_ = requested_ < 8 || sent_ < 64;
    return moved;
}

bool FillFetch::fetch_raw() {
    if (!raw_reads_.can_push()) return false;
    raw_reads_.push({next_++, false});
    active_ = ++requested_ < kRawBlockWords;
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

TexelMerge::TexelMerge(const Ports& ports)
    : Block("texel_merge",
            "1 cycle to begin a block, then a texel per cycle; a raw one's words come before them, 3 for an even "
            "column, 2 "
            "for an odd one"),
      kinds_(reads(ports.kinds)),
      coded_(reads(ports.coded)),
      raw_words_(reads(ports.raw_words)),
      out_(writes(ports.out)) {}

YuvaPixel TexelMerge::raw_texel() const {
    const int row = (64 - left_) % 8;
    const auto byte = [](std::uint64_t word, int n) { return static_cast<int>((word >> (8 * n)) & 255U); };
    YuvaPixel texel;
    texel.y = byte(luma_, row);
    texel.u = byte(chroma_, row / 2 * 2);
    texel.v = byte(chroma_, row / 2 * 2 + 1);
    texel.alpha = byte(alpha_, row);
    return texel;
}

Activity TexelMerge::take_word() {
    if (!raw_words_.can_pop()) return Activity::memory_data;
    std::uint64_t* const into[] = {&chroma_, &luma_, &alpha_};
    *into[words_++] = raw_words_.pop().data;
    return Activity::busy;
}

Activity TexelMerge::tick(std::uint64_t) {
    if (left_ == 0) {
        if (!kinds_.can_pop()) return Activity::idle;
        is_coded_ = kinds_.pop().coded;
        left_ = 64;
        words_ = 0;
        return Activity::busy;
    }
    if (is_coded_) {
        if (!coded_.can_pop()) return Activity::memory_data;
        if (!out_.can_push()) return Activity::output_full;
        out_.push(coded_.pop());
        --left_;
        return Activity::busy;
    }
    if (words_ < 3) return take_word();
    if (!out_.can_push()) return Activity::output_full;
    out_.push(raw_texel());
    --left_;
    if (left_ % 8 == 0) words_ = left_ / 8 % 2 == 1 ? 1 : 0;  // after an even column its chroma is used once more
    return Activity::busy;
}

}  // namespace rs::engine::model
