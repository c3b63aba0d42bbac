#include "engine/model/blocks/prototype/image_scan.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vrow_scan.h>
#include <Vrow_scan_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class RowScanBench final : public Bench<Module> {
public:
    RowScanBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(placed_, RS_RTL_PORTS(module, placed), [this] { return column(); });
        this->output(pairs_, RS_RTL_PORTS(module, pairs));
    }

private:
    model::PlacedColumn column() {
        Random& random = this->random_;
        model::PlacedColumn column;
        column.view = random_view(registers_, random);
        column.has_ray = random.chance(0.9);
        if (!column.has_ray) return column;
        const bool is_near = random.chance(0.7);  // else any registers
        column.row_0_q16 = is_near ? random.in(-(1 << 20), 600 << 16) : random.of_any_length(46);
        column.row_step_q16 = is_near ? random.in(-(4 << 16), 4 << 16) : random.of_any_length(36);
        column.luma = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        column.chroma = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        column.alpha = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
        return column;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const int view = valid_view(registers_, this->module_.view);
        this->module_.view_height = static_cast<SData>(registers_.view(view).height);
        this->module_.object_height = static_cast<SData>(registers_.object_of(view).height);
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    model::Fifo<model::PlacedColumn> placed_{"placed", 4, model::PlacedColumn::kBits};
    model::Fifo<model::PixelPair> pairs_{"pairs", 4, model::PixelPair::kBits};
    model::RowScan block_{registers_, {.in = placed_, .out = pairs_}};
};

RS_RTL_TESTS(RtlRowScan, RowScanBench, row_scan)

}  // namespace
}  // namespace rs::engine::rtl
