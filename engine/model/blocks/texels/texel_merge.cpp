#include "engine/model/blocks/texels/texel_merge.hpp"

namespace rs::engine::model {

TexelMerge::TexelMerge(Fifo<FillKind>& kinds, Fifo<YuvaPixel>& coded, Fifo<MemoryWord>& raw_words, Fifo<YuvaPixel>& out)
    : Block("texel_merge",
            "1 cycle to begin a block, then a texel per cycle; a raw one's words come before them, 3 for an even "
            "column, 2 "
            "for an odd one"),
      kinds_(reads(kinds)),
      coded_(reads(coded)),
      raw_words_(reads(raw_words)),
      out_(writes(out)) {}

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
    if (left_ % 8 == 0) words_ = left_ / 8 % 2 == 1 ? 1 : 0;  // behind an even column its chroma serves once more
    return Activity::busy;
}

}  // namespace rs::engine::model
