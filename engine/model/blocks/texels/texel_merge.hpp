#pragma once
// Texel merge: the samples of a block come unpacked from book_lookup, or as they are from memory; a texel per cycle, in
// the order in which the blocks were asked for. Of a raw block (parallel_layout.hpp) it keeps three words: (U, V) of a
// pair of columns, Y and alpha of one.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/parallel_messages.hpp"

namespace rs::engine::model {

class TexelMerge final : public Block {
public:
    TexelMerge(Fifo<FillKind>& kinds, Fifo<YuvaPixel>& coded, Fifo<MemoryWord>& raw_words, Fifo<YuvaPixel>& out);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "texels left " + std::to_string(left_); }

private:
    Activity take_word();
    [[nodiscard]] YuvaPixel raw_texel() const;

    Fifo<FillKind>& kinds_;
    Fifo<YuvaPixel>& coded_;
    Fifo<MemoryWord>& raw_words_;
    Fifo<YuvaPixel>& out_;
    int left_ = 0;  // texels of the block
    bool is_coded_ = false;
    int words_ = 0;  // of the column, and before it of the pair, that are here
    std::uint64_t chroma_ = 0, luma_ = 0, alpha_ = 0;
};

}  // namespace rs::engine::model
