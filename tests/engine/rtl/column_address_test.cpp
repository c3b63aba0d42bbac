#include "engine/model/blocks/prototype/image_scan.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vcolumn_address.h>
#include <Vcolumn_address_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class ColumnAddressBench final : public Bench<Module> {
public:
    ColumnAddressBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(walks_, RS_RTL_PORTS(module, walks), [this] { return walk(); });
        this->output(placed_, RS_RTL_PORTS(module, placed));
    }

private:
    model::ColumnWalk walk() {
        Random& random = this->random_;
        model::ColumnWalk walk;
        walk.view = random_view(registers_, random);
        walk.has_ray = random.chance(0.8);
        if (!walk.has_ray) return walk;
        const model::ObjectRegisters& object = registers_.object_of(walk.view);
        walk.image = static_cast<int>(random.in(0, object.images - 1));
        walk.column = static_cast<int>(random.in(0, object.width - 1));
        walk.row_0_q16 = random.of_any_length(46);
        walk.row_step_q16 = random.of_any_length(36);
        return walk;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::ObjectRegisters& object = registers_.object_of(valid_view(registers_, this->module_.view));
        this->module_.object_width = static_cast<SData>(object.width);
        this->module_.object_luma_pitch = static_cast<CData>(object.luma_pitch);
        this->module_.object_chroma_pitch = static_cast<CData>(object.chroma_pitch);
        this->module_.object_alpha_pitch = static_cast<CData>(object.alpha_pitch);
        this->module_.object_luma = object.luma;
        this->module_.object_chroma = object.chroma;
        this->module_.object_alpha = object.alpha;
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    model::Fifo<model::ColumnWalk> walks_{"walks", 2, model::ColumnWalk::kBits};
    model::Fifo<model::PlacedColumn> placed_{"placed", 4, model::PlacedColumn::kBits};
    model::ColumnAddress block_{registers_, {.in = walks_, .out = placed_}};
};

RS_RTL_TESTS(RtlColumnAddress, ColumnAddressBench, column_address)

}  // namespace
}  // namespace rs::engine::rtl
