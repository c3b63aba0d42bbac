#include "engine/model/blocks/texels/texel_cache.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vtexel_filter.h>
#include <Vtexel_filter_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class TexelFilterBench final : public Bench<Module> {
public:
    TexelFilterBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(quads_, RS_RTL_PORTS(module, quads), [this] { return quad(); });
        this->output(filtered_, RS_RTL_PORTS(module, filtered));
    }

private:
    model::TexelQuad quad() {
        Random& random = this->random_;
        const auto number = [&](int most) { return static_cast<int>(random.in(0, most)); };
        model::TexelQuad quad;
        quad.head = {number(511),
                     random.chance(0.5),
                     random.chance(0.5),
                     number(256),
                     random.chance(0.5),
                     random.chance(0.5),
                     {number(model::MarchState::kFarthest)}};
        quad.inside = random.chance(0.9);
        quad.fx = number(7);
        quad.fy = number(7);
        for (std::uint32_t& texel : quad.rgba) {
            texel = random.chance(0.2) ? 0xFFFFFFFF : static_cast<std::uint32_t>(random.word());
        }
        return quad;
    }
    model::Block& block() override { return block_; }

    model::Fifo<model::TexelQuad> quads_{"quads", 4, model::TexelQuad::kBits};
    model::Fifo<model::FilteredSample> filtered_{"filtered", 4, model::FilteredSample::kBits};
    model::TexelFilter block_{{.in = quads_, .out = filtered_}};
};

RS_RTL_TESTS(RtlTexelFilter, TexelFilterBench, texel_filter)

}  // namespace
}  // namespace rs::engine::rtl
