#include "engine/model/blocks/texels/texel_fills.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vfill_fetch.h>
#include <Vfill_fetch_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class FillFetchBench final : public Bench<Module> {
public:
    FillFetchBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(fills_, RS_RTL_PORTS(module, fills), [this] { return fill(); });
        this->output(asks_, RS_RTL_PORTS(module, asks));
        this->output(pixels_, RS_RTL_PORTS(module, coded_pixels));
        this->output(reads_, RS_RTL_PORTS(module, raw_reads));
        this->output(kinds_, RS_RTL_PORTS(module, kinds));
        this->output(targets_, RS_RTL_PORTS(module, targets));
    }

private:
    static model::RegisterFile random_blocks(Random& random) {
        model::RegisterFile file = random_coded_registers(random);
        std::uint32_t serial = 1;
        for (model::ObjectRegisters& object : file.objects) {
            object.serial = serial++;
            object.coded = random.chance(0.5);
            object.block_columns = (object.width + 7) / 8;
            object.block_rows = (object.height + 7) / 8;
            object.raw_blocks = static_cast<model::WordAddress>(random.in(0, 1 << 26));
        }
        return file;
    }
    model::TexelFill fill() {
        Random& random = this->random_;
        const auto number = [&](int most) { return static_cast<int>(random.in(0, most)); };
        if (view_ < 0 || random.chance(0.3)) view_ = random_view(registers_, random);
        const model::ObjectRegisters& object = registers_.object_of(view_);
        return {view_,
                number(object.images - 1),
                number(object.block_columns - 1),
                number(object.block_rows - 1),
                number(127),
                static_cast<std::uint32_t>(number(1023))};
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::ObjectRegisters& object = registers_.object_of(valid_view(registers_, this->module_.view));
        this->module_.object_coded = object.coded;
        this->module_.object_serial = object.serial;
        this->module_.object_block_columns = static_cast<CData>(object.block_columns);
        this->module_.object_block_rows = static_cast<CData>(object.block_rows);
        this->module_.object_raw_blocks = object.raw_blocks;
    }

    model::RegisterFile registers_ = random_blocks(this->random_);
    int view_ = -1;
    model::Fifo<model::TexelFill> fills_{"fills", 4, model::TexelFill::kBits};
    model::Fifo<model::BlockRequest> asks_{"asks", 4, model::BlockRequest::kBits};
    model::Fifo<model::CodedPixel> pixels_{"pixels", 8, model::CodedPixel::bits(0)};
    model::Fifo<model::MemoryRead> reads_{"raw_reads", 4, model::MemoryRead::kBits};
    model::Fifo<model::FillKind> kinds_{"kinds", 2, model::FillKind::kBits};
    model::Fifo<model::FillTarget> targets_{"targets", 2, model::FillTarget::kBits};
    model::FillFetch block_{
        registers_,
        {.in = fills_, .asks = asks_, .pixels = pixels_, .raw_reads = reads_, .kinds = kinds_, .targets = targets_}};
};

RS_RTL_TESTS(RtlFillFetch, FillFetchBench, fill_fetch)

}  // namespace
}  // namespace rs::engine::rtl
