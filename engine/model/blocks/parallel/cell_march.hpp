#pragma once
// Cell march: follows a pixel's ray through the surface between the cells beside it (RECONSTRUCTION.md, section 6), two
// looks per cycle, and outputs the first hit. If the surface is transparent there, surface_blend sends the pixel back
// and the march continues behind the hit; returned pixels precede new ones. So a ray marches no farther than necessary,
// and other rays overtake it. After the last surface, the farther of two groups and the farthest of eight cells are
// tried if they exist: the ray repeats the turns of the foot for each.
//
// The pipeline is a ring: the result of a *turn* of two looks is available kStages cycles later; only then the ray
// takes its next turn, with priority over other rays; up to kStages rays march at the same time. Stages of a look:
// effective depth (a table), band from it, the foot and per_d (a product, kProductCycles), read, nearest and farthest,
// groups and weights, products and sums, mean (a table of reciprocals and a product, divide_by_weight()), hit test.
//
// Stores the cells of two stripes, already interpolated between their lines (SurfaceCell, 26 bits), in four memories:
// even and odd bands of both places in p, four bands per two words of 52 bits. A look reads each memory at one address;
// they have two ports, and a write of new cells occupies one. Also stores, for each pixel in flight, the line along
// which its ray crosses the bands, and the effective depths of all objects, 256 of 13 bits each, in a memory with two
// ports for the two looks. They are written when an object is loaded.

#include "engine/core/definition/effective_depth.hpp"
#include "engine/core/definition/shape_cells.hpp"
#include "engine/model/blocks/parallel/column_setup.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/limits/board_limits.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

// Division of a ray into steps, without the clock.
struct MarchSteps {
    int steps = 1;
    int size = 256;
};
MarchSteps march_steps(std::int32_t per_d_q20);

class CellMarch final : public Block {
public:
    static constexpr int kStages = kProductCycles + 7;
    static constexpr int kSurfaceBits = 12 + 5 + 8 + 1;
    static constexpr std::size_t kCellBits =
        std::size_t{kStripeSlots} * kStripeColumns * 2 * kMaxBands * static_cast<std::size_t>(kSurfaceBits);
    static constexpr std::size_t kHeldBits = std::size_t{4} * kMaxBands / kCellsPerWord * 64;
    static constexpr std::size_t kPixelBits = std::size_t{kPatchIds} * PixelBandRay::kBits;
    static constexpr std::size_t kDepthBits =
        static_cast<std::size_t>(BoardLimits{}.objects) * EffectiveDepth::kDepths * 13;

    struct Ports {
        Fifo<ColumnSetup>& columns;
        Fifo<MemoryWord>& words;
        Fifo<PixelBandRay>& in;
        Fifo<ReturnedPixel>& again;
        Fifo<SurfaceHit>& met;
        Fifo<FinishedPixel>& empty;
    };
    CellMarch(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "words to come " + std::to_string(words_left_); }
    [[nodiscard]] std::uint64_t looks() const { return looks_; }  // looks used by rays

private:
    // A ray with the result of its turn.
    struct Turn {
        enum class Outcome { continues, met, empty };
        PixelBandRay ray;
        MarchState state;
        SurfaceStack foot;  // surfaces at the foot, from the second to last look
        Outcome outcome = Outcome::continues;
        SurfaceHit met;
    };
    bool load(bool& writes_cells);
    void store_cells(std::uint64_t first_line, std::uint64_t second_line);
    bool next_ray(Turn& turn);
    void take_turn(Turn& turn, int looks);
    void look(Turn& turn, const ColumnSetup& column);
    void look_at_foot(Turn& turn, const ColumnSetup& column);
    [[nodiscard]] std::int32_t band_q12(const Turn& turn, int d) const;
    [[nodiscard]] SurfaceStack surfaces_at(const ColumnSetup& column, std::int32_t at_q12);

    const RegisterFile& registers_;
    Fifo<ColumnSetup>& columns_;
    Fifo<MemoryWord>& words_;
    Fifo<PixelBandRay>& in_;
    Fifo<ReturnedPixel>& again_;
    Fifo<SurfaceHit>& met_;
    Fifo<FinishedPixel>& empty_;

    ColumnTable table_;
    using Cells = std::array<std::array<SurfaceCell, kMaxBands>, 2>;  // [p]
    std::array<Cells, std::size_t{kStripeSlots} * kStripeColumns> cells_{};
    int words_left_ = 0;  // words left of the column that is being loaded
    int words_of_column_ = 0;
    std::uint64_t first_line_word_ = 0;
    std::array<std::uint64_t, std::size_t{4} * kMaxBands / kCellsPerWord> held_{};  // words of the previous column
    ColumnSetup loading_;

    std::array<PixelBandRay, kPatchIds> pixels_;
    DelayLine<Turn> line_{kStages};
    std::uint64_t looks_ = 0;
};

}  // namespace rs::engine::model
