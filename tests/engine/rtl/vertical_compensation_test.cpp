#include "engine/model/blocks/prototype/vertical_compensation.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_rays.hpp"

#include <Vvertical_compensation.h>
#include <Vvertical_compensation_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class VerticalCompensationBench final : public Bench<Module> {
public:
    VerticalCompensationBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(lines_, RS_RTL_PORTS(module, lines), [this] { return random_line(registers_, this->random_); });
        this->output(walks_, RS_RTL_PORTS(module, walks));
    }

private:
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        const int number = valid_view(registers_, module.view);
        const model::BoardView& view = registers_.view(number);
        module.view_b_q20 = static_cast<IData>(view.b_q20) & ((1U << 29U) - 1);
        module.view_s0_q28 = static_cast<IData>(view.s0_q32 >> 4);
        module.view_sy_q32 = static_cast<QData>(view.sy_q32 & ((std::int64_t{1} << 34) - 1));
        module.object_width = static_cast<SData>(registers_.object_of(number).width);
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    model::Fifo<model::RayLine> lines_{"lines", 2, model::RayLine::kBits};
    model::Fifo<model::ColumnWalk> walks_{"walks", 2, model::ColumnWalk::kBits};
    model::VerticalCompensation block_{registers_, {.in = lines_, .out = walks_}};
};

RS_RTL_TESTS(RtlVerticalCompensation, VerticalCompensationBench, vertical_compensation)

}  // namespace
}  // namespace rs::engine::rtl
