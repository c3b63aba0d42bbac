#include "engine/model/blocks/shared/view_rays.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vray_position_0.h>
#include <Vray_position_0_mutants.h>
#include <Vray_position_1.h>
#include <Vray_position_1_mutants.h>

#include <algorithm>

namespace rs::engine::rtl {
namespace {

template <class Module, int kPointBits>
class RayPositionBench final : public Bench<Module> {
public:
    RayPositionBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(columns_, RS_RTL_PORTS(module, columns), [this] { return ray(); });
        this->output(points_, RS_RTL_PORTS(module, points));
    }

private:
    // Most rays meet the plane near the object; the others have directions of any length.
    model::ColumnRay ray() {
        Random& random = this->random_;
        model::ColumnRay ray;
        ray.view = random_view(registers_, random);
        const model::ObjectRegisters& object = registers_.object_of(ray.view);
        ray.plane = static_cast<int>(random.in(0, object.planes - 1));
        const model::PlaneView& plane = registers_.view(ray.view).planes[static_cast<std::size_t>(ray.plane)];
        ray.has_ray = plane.c_q20 > 0 && random.chance(0.95);
        ray.n_q28 = random.in(1 << 24, (std::int64_t{1} << random.in(25, 31)) - 1);
        ray.t_q28 = random.of_any_length(32);
        if (!ray.has_ray || random.chance(0.2)) return ray;
        const std::int64_t x_half_q20 = object.x_half_q20;
        const std::int64_t x_q20 = random.chance(0.3)
                                       ? (random.chance(0.5) ? x_half_q20 : -x_half_q20) + random.in(-4, 4)
                                       : random.in(-x_half_q20, x_half_q20) * 9 / 8;
        const std::int64_t t_q28 = (x_q20 - plane.a_q20) * ray.n_q28 / plane.c_q20;
        constexpr std::int64_t kLimit = std::int64_t{1} << 31;
        if (t_q28 >= -kLimit && t_q28 < kLimit) ray.t_q28 = t_q28;
        return ray;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        const int number = valid_view(registers_, module.view);
        const model::ObjectRegisters& object = registers_.object_of(number);
        const std::size_t place = std::min<std::size_t>(module.plane, model::kMaxPlanes - 1);
        const model::PlaneView& plane = registers_.view(number).planes[place];
        module.object_x_cells = static_cast<SData>(object.x_cells);
        module.object_u_cells = static_cast<SData>(object.u_cells);
        module.object_x_half_q20 = static_cast<IData>(object.x_half_q20);
        module.object_u_half_q28 = static_cast<IData>(object.u_half_q28);
        module.object_x_cells_per_unit_q12 = static_cast<IData>(object.x_cells_per_unit_q12);
        module.object_u_cells_per_unit_q12 = static_cast<IData>(object.u_cells_per_unit_q12);
        module.object_map = object.map;
        module.plane_a_q20 = static_cast<IData>(plane.a_q20) & ((1U << 29U) - 1);
        module.plane_c_q20 = static_cast<IData>(plane.c_q20) & ((1U << 29U) - 1);
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    model::Fifo<model::ColumnRay> columns_{"columns", 2, model::ColumnRay::kBits};
    model::Fifo<model::RayPoint> points_{"points", 2, kPointBits};
    model::RayPosition block_{registers_, {.in = columns_, .out = points_}};
};

template <class Module>
using PrototypePositionBench = RayPositionBench<Module, model::RayPoint::kBits>;
template <class Module>
using ParallelPositionBench = RayPositionBench<Module, model::RayPoint::kBitsWithDirection>;

RS_RTL_TESTS(RtlRayPosition, PrototypePositionBench, ray_position_0)
RS_RTL_TESTS(RtlParallelRayPosition, ParallelPositionBench, ray_position_1)

}  // namespace
}  // namespace rs::engine::rtl
