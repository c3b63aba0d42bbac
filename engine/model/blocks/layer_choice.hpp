#pragma once
// Layer choice (RECONSTRUCTION.md, section 8): collects the samples of a met cell, scores its layers, and blends the
// two pictures of the better one. Where that one shows something the pixel is known, else it goes back to cell_march,
// or, behind its last cell, shows nothing. A sample per cycle. Division of the score by 16,320 is a product.

#include "engine/core/shape_pixel.hpp"
#include "engine/model/blocks/delay_line.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/parallel_messages.hpp"

#include <array>

namespace rs::engine::model {

class LayerChoice final : public Block {
public:
    static constexpr int kStages = 8;
    LayerChoice(Fifo<FilteredSample>& in, Fifo<ChosenPixel>& out, Fifo<MarchAgain>& again);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::uint64_t sent_back() const { return sent_back_; }

    // The samples of a layer so far.
    struct Layer {
        std::array<SampleSum, 2> sample;
        std::array<bool, 2> sees{};
        bool is_there = false;
    };
    // The arithmetic without the clock; `weight` of the second picture.
    static ShapeLayer scored(const Layer& layer, int weight);

private:
    struct Outcome {
        bool sends_back = false;
        ChosenPixel chosen;
        MarchAgain again;
    };
    [[nodiscard]] Outcome decided(const SampleHead& last) const;

    Fifo<FilteredSample>& in_;
    Fifo<ChosenPixel>& out_;
    Fifo<MarchAgain>& again_;
    std::array<Layer, 2> layers_{};
    DelayLine<Outcome> line_{kStages};
    std::uint64_t sent_back_ = 0;
};

}  // namespace rs::engine::model
