#pragma once
// Texel cache: 128 lines of 8x8 texels, R, G, B and alpha, in four banks by the lowest bits of column and row, so that
// the four texels of any sample are read in one cycle, that in which it passes; one texel is written in the same cycle.
// A sample waits until the blocks that were requested for it have been written. Texels without a weight are 0.

#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/blocks/texels/texel_tags.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/parallel_messages.hpp"

#include <array>

namespace rs::engine::model {

class TexelCache final : public Block {
public:
    static constexpr int kLineTexels = 64;
    static constexpr int kBits = kCacheLines * kLineTexels * 32;
    struct Ports {
        Fifo<WaitingSample>& in;
        Fifo<FillTarget>& targets;
        Fifo<RgbaPixel>& texels;
        Fifo<TexelQuad>& out;
    };
    explicit TexelCache(const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "blocks written and not waited for " + std::to_string(fills_) + ", samples read " +
               std::to_string(samples_);
    }

private:
    bool read();
    bool write(std::uint64_t samples_read);

    Fifo<WaitingSample>& in_;
    Fifo<FillTarget>& targets_;
    Fifo<RgbaPixel>& texels_;
    Fifo<TexelQuad>& out_;
    std::array<std::array<std::uint32_t, kLineTexels>, kCacheLines> lines_{};
    int written_ = 0;  // texels written of the current block
    int fills_ = 0;    // blocks written, minus those that samples have waited for
    std::uint64_t samples_ = 0;
};

// Texel filter: sums of a sample over its four texels (RECONSTRUCTION.md, section 7): weight * alpha, and this times R,
// G and B: four small products, twelve of 14 x 8 bits, two levels of additions. A sample per cycle.

// Weighted sums of a sample's four texels, without the clock.
FilteredSample filter_quad(const TexelQuad& quad);

class TexelFilter final : public Block {
public:
    static constexpr int kStages = 6;
    struct Ports {
        Fifo<TexelQuad>& in;
        Fifo<FilteredSample>& out;
    };
    explicit TexelFilter(const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<TexelQuad>& in_;
    PipelinedStage<FilteredSample> stage_;
};

}  // namespace rs::engine::model
