#include "engine/model/blocks/prototype/vertical_compensation.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vvertical_compensation.h>
#include <Vvertical_compensation_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class VerticalCompensationBench final : public Bench<Module> {
public:
    VerticalCompensationBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(lines_, RS_RTL_PORTS(module, lines), [this] { return line(); });
        this->output(walks_, RS_RTL_PORTS(module, walks));
    }

private:
    // Most lines meet the photo, or pass it by a few columns.
    model::RayLine line() {
        Random& random = this->random_;
        const auto number = [&](int width_bits) { return static_cast<std::int32_t>(random.of_any_length(width_bits)); };
        model::RayLine line;
        line.view = random_view(registers_, random);
        line.has_ray = random.chance(0.95);
        if (!line.has_ray) return line;
        const model::ObjectRegisters& object = registers_.object_of(line.view);
        line.x_q20 = random.of_any_length(22);
        line.lambda_q20 = random.in(0, (std::int64_t{1} << random.in(10, 29)) - 1);
        line.image = static_cast<int>(random.in(0, object.images - 1));
        line.cy_q16 = number(31);
        line.fl_y_q16 = number(30);
        line.height_q20 = number(29);
        line.l1_q30 = number(31);
        line.q1_q16 = number(31);
        const std::int64_t l_q20 = (1 << 17) + random.in(-2, std::int64_t{1} << random.in(2, 28));
        line.l0_q20 = static_cast<std::int32_t>(l_q20 - ((line.x_q20 * line.l1_q30) >> 30));
        line.cx_q16 = static_cast<std::int32_t>(random.in(0, std::int64_t{object.width} << 16));
        const std::int64_t column_q16 = random.in(-2 * 65536, (std::int64_t{object.width} + 2) << 16);
        const std::int64_t lateral_q16 = ((column_q16 - line.cx_q16) * l_q20) >> 20;
        line.q0_q16 = random.chance(0.1) ? number(31)
                                         : static_cast<std::int32_t>(lateral_q16 - ((line.x_q20 * line.q1_q16) >> 20));
        return line;
    }
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
