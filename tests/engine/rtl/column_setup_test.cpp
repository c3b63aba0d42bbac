#include "engine/model/blocks/parallel/column_setup.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_rays.hpp"

#include <Vcolumn_setup.h>
#include <Vcolumn_setup_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class ColumnSetupBench final : public Bench<Module> {
public:
    ColumnSetupBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(lined_, RS_RTL_PORTS(module, lined), [this] { return ray(); });
        this->output(set_up_, RS_RTL_PORTS(module, set_up));
    }

private:
    // Numbers within the ranges of a shape map (chunk `shap` of encode/FORMAT.md).
    static model::RegisterFile random_shapes(Random& random) {
        constexpr std::int64_t kOne_q20 = 1 << 20;
        constexpr std::int64_t kMostHalf_q20 = 2 * kOne_q20 + kOne_q20 / 16;
        const auto number = [&](std::int64_t low, std::int64_t high) {
            return static_cast<std::int32_t>(random.in(low, high));
        };
        model::RegisterFile file = random_registers(random);
        for (model::ObjectRegisters& object : file.objects) {
            model::ShapeRegisters& shape = object.shape;
            shape.exists = true;
            shape.p_cells = number(1, std::int64_t{1} << random.in(0, 12));
            shape.p_half_q20 = number(kOne_q20, kMostHalf_q20 - 1);
            shape.p_cells_per_unit_q12 =
                static_cast<std::int32_t>((std::int64_t{shape.p_cells} << 31) / shape.p_half_q20);
            shape.reference_distance_q20 = number(kOne_q20 + 1, kOne_q20 << random.in(1, 8));
            shape.depth_low_q20 = number(-kMostHalf_q20, kMostHalf_q20);
            shape.depth_step_q24 = random.chance(0.5) ? 1 << 18 : number(1, std::int64_t{1} << random.in(0, 18));
            shape.lines = 1024 + random.in(0, (std::int64_t{1} << random.in(0, 26)) - 1);
        }
        return file;
    }
    // Line of an object with a shape map: numbers of 1 in magnitude at most (l1, l2) or 2^14 px (q0, q1, q2).
    model::ImageLine line() {
        Random& random = this->random_;
        const bool is_large = random.chance(0.5);
        const auto number = [&](int width_bits) {
            const std::int64_t most = (std::int64_t{1} << (width_bits - 1)) - 1;
            const std::int64_t large = random.chance(0.5) ? most : -most;
            return static_cast<std::int32_t>(is_large ? large : random.of_any_length(width_bits));
        };
        return {number(31), number(31), number(31), number(29), number(29),
                number(31), number(31), number(31), number(31), number(31)};
    }
    model::RayWithLines ray() {
        Random& random = this->random_;
        model::RayWithLines ray;
        ray.ray = random_bracketed_ray(registers_, random);
        if (ray.ray.kind == model::RayKind::plane) {
            const model::RayLine plane = random_line(registers_, random);
            ray.ray.view = plane.view;
            ray.ray.x_q20 = plane.x_q20;
            ray.ray.lambda_q20 = plane.lambda_q20;
            ray.image[0] = {plane.cx_q16,
                            plane.cy_q16,
                            plane.fl_y_q16,
                            plane.height_q20,
                            plane.l0_q20,
                            plane.l1_q30,
                            plane.q0_q16,
                            plane.q1_q16,
                            0,
                            0};
            return ray;
        }
        ray.image = {line(), line()};
        return ray;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        const int number = valid_view(registers_, module.view);
        const model::BoardView& view = registers_.view(number);
        const model::ObjectRegisters& object = registers_.object_of(number);
        const model::ShapeRegisters& shape = object.shape;
        const std::size_t place = std::min<std::size_t>(module.plane, model::kMaxPlanes - 1);
        const model::PlaneView& plane = view.planes[place];
        constexpr IData kMask29 = (1U << 29U) - 1;
        module.view_b_q20 = static_cast<IData>(view.b_q20) & kMask29;
        module.view_s0_q28 = static_cast<IData>(view.s0_q32 >> 4);
        module.view_sy_q32 = static_cast<QData>(view.sy_q32 & ((std::int64_t{1} << 34) - 1));
        module.plane_a_q20 = static_cast<IData>(plane.a_q20) & kMask29;
        module.plane_c_q20 = static_cast<IData>(plane.c_q20) & kMask29;
        module.object_width = static_cast<SData>(object.width);
        module.shape_p_cells = static_cast<SData>(shape.p_cells);
        module.shape_lines = static_cast<IData>(shape.lines);
        module.shape_p_half_q20 = static_cast<IData>(shape.p_half_q20);
        module.shape_p_cells_per_unit_q12 = static_cast<IData>(shape.p_cells_per_unit_q12);
        module.shape_reference_distance_q20 = static_cast<IData>(shape.reference_distance_q20);
        module.shape_depth_low_q20 = static_cast<IData>(shape.depth_low_q20);
        module.shape_depth_step_q24 = static_cast<IData>(shape.depth_step_q24);
    }

    model::RegisterFile registers_ = random_shapes(this->random_);
    model::Fifo<model::RayWithLines> lined_{"lined", 2, model::RayWithLines::kBits};
    model::Fifo<model::ColumnSetup> set_up_{"set_up", 2, model::ColumnSetup::kBits};
    model::ColumnSetupStage block_{registers_, {.in = lined_, .out = set_up_}};
};

RS_RTL_TESTS(RtlColumnSetup, ColumnSetupBench, column_setup)

}  // namespace
}  // namespace rs::engine::rtl
