#include "engine/model/blocks/texels/texel_fills.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vtexel_merge.h>
#include <Vtexel_merge_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class TexelMergeBench final : public Bench<Module> {
public:
    TexelMergeBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(kinds_, RS_RTL_PORTS(module, kinds), [this] { return model::FillKind{this->random_.chance(0.5)}; });
        this->input(samples_, RS_RTL_PORTS(module, samples), [this] { return sample(); });
        this->input(words_, RS_RTL_PORTS(module, raw_words),
                    [this] { return model::MemoryWord{this->random_.word()}; });
        this->output(merged_, RS_RTL_PORTS(module, merged));
    }

private:
    model::YuvaPixel sample() {
        const auto number = [this] { return static_cast<int>(this->random_.in(0, 255)); };
        return {static_cast<int>(this->random_.in(0, 14)), number(), number(), number(), number()};
    }
    model::Block& block() override { return block_; }

    model::Fifo<model::FillKind> kinds_{"kinds", 4, model::FillKind::kBits};
    model::Fifo<model::YuvaPixel> samples_{"samples", 4, model::YuvaPixel::kBitsOfCoded};
    model::Fifo<model::MemoryWord> words_{"raw_words", 8, model::MemoryWord::kBits};
    model::Fifo<model::YuvaPixel> merged_{"merged", 4, model::YuvaPixel::kBitsOfCoded};
    model::TexelMerge block_{{.kinds = kinds_, .coded = samples_, .raw_words = words_, .out = merged_}};
};

RS_RTL_TESTS(RtlTexelMerge, TexelMergeBench, texel_merge)

}  // namespace
}  // namespace rs::engine::rtl
