#pragma once
// Fill fetch: fetches a block of 8x8 texels column by column. For coded images it requests each column of the block
// from the readers of hop 0 and sends the 64 pixels that are joined with the records; for raw images it requests the
// block's words from memory. The target line is sent ahead to the cache.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class FillFetch final : public Block {
public:
    struct Ports {
        Fifo<TexelFill>& in;
        Fifo<BlockRequest>& asks;
        Fifo<CodedPixel>& pixels;
        Fifo<MemoryRead>& raw_reads;
        Fifo<FillKind>& kinds;
        Fifo<FillTarget>& targets;
    };
    FillFetch(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "columns to request " + std::to_string(8 - requested_) + ", pixels to send " +
               std::to_string(64 - sent_);
    }

private:
    bool begin();
    bool fetch_coded();
    bool fetch_raw();

    const RegisterFile& registers_;
    Fifo<TexelFill>& in_;
    Fifo<BlockRequest>& asks_;
    Fifo<CodedPixel>& pixels_;
    Fifo<MemoryRead>& raw_reads_;
    Fifo<FillKind>& kinds_;
    Fifo<FillTarget>& targets_;
    bool active_ = false;
    TexelFill fill_;
    bool coded_ = false;
    std::uint32_t serial_ = 0;  // object of the last request
    bool first_ = false;        // first request of that object
    int requested_ = 8;
    int sent_ = 64;
    WordAddress next_ = 0;
};

// Texel merge: outputs the samples of a block, decompressed by the codebook look-up or raw from memory; a texel per
// cycle, in the order in which the blocks were requested. For a raw block (parallel_layout.hpp) it stores three words:
// (U, V) of a pair of columns, Y and alpha of one.

class TexelMerge final : public Block {
public:
    struct Ports {
        Fifo<FillKind>& kinds;
        Fifo<YuvaPixel>& coded;
        Fifo<MemoryWord>& raw_words;
        Fifo<YuvaPixel>& out;
    };
    explicit TexelMerge(const Ports& ports);
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
    int words_ = 0;  // words received of the column, including those of its pair
    std::uint64_t chroma_ = 0, luma_ = 0, alpha_ = 0;
};

}  // namespace rs::engine::model
