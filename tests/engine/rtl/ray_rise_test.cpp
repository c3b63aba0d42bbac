#include "engine/model/blocks/parallel/pixel_rays.hpp"
#include "tests/engine/rtl/stripe_traffic.hpp"

#include <Vray_rise.h>
#include <Vray_rise_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class RayRiseBench final : public Bench<Module> {
public:
    RayRiseBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(
            columns_, RS_RTL_PORTS(module, rise_columns), [this] { return column(); },
            [this] { return traffic_.has_column(); });
        this->input(
            pixels_, RS_RTL_PORTS(module, scanned), [this] { return traffic_.pixel(); },
            [this] { return traffic_.has_pixel(); });
        this->output(rays_, RS_RTL_PORTS(module, risen),
                     [this](const model::PixelBandRay& ray) { traffic_.finish(ray.pixel); });
    }

private:
    // Registers of all lengths within the limits of a shape map.
    static model::RegisterFile random_shapes(Random& random) {
        model::RegisterFile file = random_registers(random);
        const auto number = [&](int bits) { return static_cast<std::int32_t>(random.of_any_length(bits)); };
        for (model::ObjectRegisters& object : file.objects) {
            model::ShapeRegisters& shape = object.shape;
            shape.exists = true;
            shape.h_low_q20 = number(29);
            shape.reference_height_q20 = number(29);
            shape.bands_per_unit_q12 = 1 + std::abs(number(27) >> 1);
            shape.depth_step_q24 = 1 + std::abs(number(19) >> 1);
            if (random.chance(0.2)) shape.bands_per_unit_q12 = 1 << 26;
            if (random.chance(0.2)) shape.depth_step_q24 = 1 << 18;
        }
        return file;
    }
    model::ColumnSetup column() {
        Random& random = this->random_;
        model::ColumnSetup setup = traffic_.column();
        setup.kind = random.chance(0.8) ? model::RayKind::shape : static_cast<model::RayKind>(random.in(0, 2));
        setup.lambda_foot_q20 = random.of_any_length(30);
        setup.inverse_r_q20 = random.chance(0.1) ? 1 << 24 : std::abs(random.of_any_length(25));
        setup.inverse_rho_q20 = random.chance(0.1) ? 1 << 21 : std::abs(random.of_any_length(22));
        return setup;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const int view = valid_view(registers_, this->module_.view);
        const model::ShapeRegisters& shape = registers_.object_of(view).shape;
        const auto bits = [](std::int32_t value, int width) {
            return static_cast<IData>(value) & ((IData{1} << width) - 1);
        };
        this->module_.view_b_q20 = bits(registers_.view(view).b_q20, 29);
        this->module_.object_shape_h_low_q20 = bits(shape.h_low_q20, 29);
        this->module_.object_shape_reference_height_q20 = bits(shape.reference_height_q20, 29);
        this->module_.object_shape_bands_per_unit_q12 = bits(shape.bands_per_unit_q12, 27);
        this->module_.object_shape_depth_step_q24 = bits(shape.depth_step_q24, 19);
    }

    model::RegisterFile registers_ = random_shapes(this->random_);
    StripeTraffic traffic_{registers_, this->random_};
    model::Fifo<model::ColumnSetup> columns_{"rise_columns", 2, model::ColumnSetup::kRiseBits};
    model::Fifo<model::ScannedPixel> pixels_{"scanned", 4, model::ScannedPixel::kBits};
    model::Fifo<model::PixelBandRay> rays_{"risen", 4, model::PixelBandRay::kBits};
    model::RayRise block_{registers_, {.columns = columns_, .in = pixels_, .out = rays_}};
};

RS_RTL_TESTS(RtlRayRise, RayRiseBench, ray_rise)

}  // namespace
}  // namespace rs::engine::rtl
