#include "engine/model/blocks/decompression/block_scan.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vblock_scan.h>
#include <Vblock_scan_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class BlockScanBench final : public Bench<Module> {
public:
    BlockScanBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(walks_, RS_RTL_PORTS(module, walks), [this] { return walk(); });
        this->output(asks_, RS_RTL_PORTS(module, asks));
        this->output(pixels_, RS_RTL_PORTS(module, coded_pixels));
    }

private:
    model::ColumnWalk walk() {
        Random& random = this->random_;
        model::ColumnWalk walk;
        walk.view = random_view(registers_, random);
        walk.has_ray = random.chance(0.9);
        if (!walk.has_ray) return walk;
        const model::ObjectRegisters& object = registers_.object_of(walk.view);
        walk.image = static_cast<int>(random.in(0, object.images - 1));
        walk.column = static_cast<int>(random.in(0, object.width - 1));
        const bool is_near = random.chance(0.8);  // else any registers
        walk.row_0_q16 = is_near ? random.in(0, std::int64_t{object.height} << 16) : random.of_any_length(46);
        walk.row_step_q16 = is_near ? random.in(-(2 << 16), 2 << 16) : random.of_any_length(36);
        if (random.chance(0.3)) walk.row_step_q16 = random.in(-(1 << 13), 1 << 13);  // long runs
        return walk;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const int view = valid_view(registers_, this->module_.view);
        this->module_.view_height = static_cast<SData>(registers_.view(view).height);
        this->module_.object_height = static_cast<SData>(registers_.object_of(view).height);
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    model::Fifo<model::ColumnWalk> walks_{"walks", 2, model::ColumnWalk::kBits};
    model::Fifo<model::BlockRequest> asks_{"asks", 4, model::BlockRequest::kBits};
    model::Fifo<model::CodedPixel> pixels_{"coded_pixels", 20, model::CodedPixel::bits(0)};
    model::BlockScan block_{registers_, {.in = walks_, .asks = asks_, .pixels = pixels_}};
};

RS_RTL_TESTS(RtlBlockScan, BlockScanBench, block_scan)

}  // namespace
}  // namespace rs::engine::rtl
