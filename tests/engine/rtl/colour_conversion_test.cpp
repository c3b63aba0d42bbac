#include "engine/model/blocks/shared/colour_conversion.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vcolour_conversion_2.h>
#include <Vcolour_conversion_2_mutants.h>
#include <Vcolour_conversion_8.h>
#include <Vcolour_conversion_8_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module, int kSampleBits>
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
        const int level = 85 * static_cast<int>(random.in(0, 3));
        const bool is_coded = kSampleBits == model::YuvaPixel::kBitsOfCoded;
        return {static_cast<int>(random.in(0, 14)), number(), number(), number(), is_coded ? number() : level};
    }
    model::Block& block() override { return block_; }

    model::Fifo<model::YuvaPixel> samples_{"samples", 4, kSampleBits};
    model::Fifo<model::RgbaPixel> pixels_{"pixels", 4, model::RgbaPixel::kBits};
    model::ColourConversion block_{{.in = samples_, .out = pixels_}};
};

template <class Module>
using RawColourBench = ColourConversionBench<Module, model::YuvaPixel::kBits>;
template <class Module>
using CodedColourBench = ColourConversionBench<Module, model::YuvaPixel::kBitsOfCoded>;

RS_RTL_TESTS(RtlColourConversion, RawColourBench, colour_conversion_2)
RS_RTL_TESTS(RtlCodedColourConversion, CodedColourBench, colour_conversion_8)

}  // namespace
}  // namespace rs::engine::rtl
