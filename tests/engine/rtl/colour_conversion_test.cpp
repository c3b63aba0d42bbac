#include "engine/model/blocks/shared/colour_conversion.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vcolour_conversion.h>
#include <Vcolour_conversion_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class ColourConversionBench final : public Bench<Module> {
public:
    ColourConversionBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(samples_, RS_RTL_PORTS(module, samples), [this] { return sample(); });
        this->output(pixels_, RS_RTL_PORTS(module, pixels));
    }

private:
    model::YuvaPixel sample() {
        Random& random = this->random_;
        const auto number = [&] {
            return static_cast<int>(random.chance(0.1) ? 255 * random.in(0, 1) : random.in(0, 255));
        };
        return {static_cast<int>(random.in(0, 14)), number(), number(), number(),
                85 * static_cast<int>(random.in(0, 3))};
    }
    model::Block& block() override { return block_; }

    model::Fifo<model::YuvaPixel> samples_{"samples", 4, model::YuvaPixel::kBits};
    model::Fifo<model::RgbaPixel> pixels_{"pixels", 4, model::RgbaPixel::kBits};
    model::ColourConversion block_{{.in = samples_, .out = pixels_}};
};

RS_RTL_TESTS(RtlColourConversion, ColourConversionBench, colour_conversion)

}  // namespace
}  // namespace rs::engine::rtl
