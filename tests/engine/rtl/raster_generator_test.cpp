#include "engine/model/blocks/shared/view_rays.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vraster_generator_1.h>
#include <Vraster_generator_16.h>
#include <Vraster_generator_16_mutants.h>
#include <Vraster_generator_1_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module, int kPipes>
class RasterGeneratorBench final : public Bench<Module> {
public:
    RasterGeneratorBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(jobs_, RS_RTL_PORTS(module, jobs),
                    [this] { return model::ViewJob{random_view(registers_, this->random_)}; });
        this->output(columns_, RS_RTL_PORTS(module, columns));
    }

private:
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        const int number = valid_view(registers_, module.view);
        const model::BoardView& view = registers_.view(number);
        const model::PlaneView& plane = view.planes[std::min<std::size_t>(module.plane, model::kMaxPlanes - 1)];
        constexpr std::int64_t k36Bits = (std::int64_t{1} << 36) - 1;
        module.view_width = static_cast<SData>(view.width);
        module.object_planes = static_cast<CData>(registers_.object_of(number).planes);
        module.plane_c_q20 = static_cast<IData>(plane.c_q20) & ((1U << 29U) - 1);
        module.plane_n0_q32 = static_cast<QData>(plane.n0_q32 & k36Bits);
        module.plane_nx_q32 = static_cast<QData>(plane.nx_q32 & k36Bits);
        module.plane_t0_q32 = static_cast<QData>(plane.t0_q32 & k36Bits);
        module.plane_tx_q32 = static_cast<QData>(plane.tx_q32 & k36Bits);
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    model::Fifo<model::ViewJob> jobs_{"jobs", 2, model::ViewJob::kBits};
    model::Fifo<model::ColumnRay> columns_{"columns", 2, model::ColumnRay::kBits};
    model::RasterGenerator block_{registers_, {0, kPipes}, {.jobs = jobs_, .columns = columns_}};
};

template <class Module>
using PrototypeRasterBench = RasterGeneratorBench<Module, 1>;
template <class Module>
using ParallelRasterBench = RasterGeneratorBench<Module, 16>;

RS_RTL_TESTS(RtlRasterGenerator, PrototypeRasterBench, raster_generator_1)
RS_RTL_TESTS(RtlParallelRasterGenerator, ParallelRasterBench, raster_generator_16)

}  // namespace
}  // namespace rs::engine::rtl
