#include "engine/model/blocks/texels/texel_cache.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vtexel_cache.h>
#include <Vtexel_cache_mutants.h>

#include <algorithm>

namespace rs::engine::rtl {
namespace {

// Samples with their lines and the requested blocks come from the model's tags, so that guards and waiting are legal.
template <class Module>
class TexelCacheBench final : public Bench<Module> {
public:
    static constexpr std::int64_t kLongestEpisode = 40'000;  // a line takes at least 64 cycles

    TexelCacheBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(
            waiting_, RS_RTL_PORTS(module, waiting), [this] { return tagged_.pop(); },
            [this] { return tagged_.can_pop(); });
        this->input(
            targets_, RS_RTL_PORTS(module, targets),
            [this] {
                const model::TexelFill fill = fills_.pop();
                return model::FillTarget{fill.line, fill.guard};
            },
            [this] { return fills_.can_pop(); });
        this->input(texels_, RS_RTL_PORTS(module, texels), [this] {
            return model::RgbaPixel{static_cast<int>(this->random_.in(0, 14)),
                                    static_cast<std::uint32_t>(this->random_.word())};
        });
        this->output(quads_, RS_RTL_PORTS(module, quads));
    }

private:
    static constexpr int kNearDepth = 4;

    static model::RegisterFile object_of_all_views(Random& random) {
        model::RegisterFile file = random_registers(random);
        for (model::ObjectRegisters& object : file.objects) object.serial = 1;
        return file;
    }
    // A run of samples near each other, of samples of few blocks of one set, or of samples outside of the images.
    model::PlacedSample sample() {
        Random& random = this->random_;
        constexpr int kSide = 512;
        const auto number = [&](int most) { return static_cast<int>(random.in(0, most)); };
        const auto moved = [&](int position) {
            return static_cast<int>(std::clamp<std::int64_t>(position + random.in(-2, 2), 0, kSide - 1));
        };
        if (left_in_run_-- == 0) {
            left_in_run_ = number(random.chance(0.3) ? 1500 : 100);
            kind_ = number(2);
            last_.image = number(2);
            last_.left = number(kSide - 1);
            last_.top = number(kSide - 1);
        }
        last_.head = {number(511),
                      random.chance(0.9),
                      random.chance(0.5),
                      number(256),
                      random.chance(0.5),
                      random.chance(0.5),
                      {number(model::MarchState::kFarthest)}};
        last_.left = kind_ == 1 ? 32 * number(2) : moved(last_.left);
        last_.top = moved(last_.top);
        last_.right_is_left = last_.left == kSide - 1;
        last_.bottom_is_top = last_.top == kSide - 1;
        last_.fx = random.chance(0.3) ? 0 : number(7);
        last_.fy = random.chance(0.3) ? 0 : number(7);
        last_.inside = random.chance(kind_ == 2 ? 0.02 : 0.95);
        return last_;
    }
    model::Block& block() override { return block_; }
    std::string compare() override {
        if (placed_.can_push()) placed_.push(sample());
        tags_.clock(0);
        placed_.commit();
        fills_.commit();
        tagged_.commit();
        return {};
    }

    int left_in_run_ = 0;
    int kind_ = 0;
    model::PlacedSample last_;
    model::RegisterFile registers_ = object_of_all_views(this->random_);
    model::Fifo<model::PlacedSample> placed_{"placed", 4, model::PlacedSample::kBits};
    model::Fifo<model::TexelFill> fills_{"fills", 8, model::TexelFill::kBits};
    model::Fifo<model::WaitingSample> tagged_{"tagged", model::kWaitingSamples - kNearDepth,
                                              model::WaitingSample::kBits};
    model::TexelTags tags_{registers_, {.in = placed_, .fills = fills_, .out = tagged_}};
    model::Fifo<model::WaitingSample> waiting_{"waiting", kNearDepth, model::WaitingSample::kBits};
    model::Fifo<model::FillTarget> targets_{"targets", 16, model::FillTarget::kBits};
    model::Fifo<model::RgbaPixel> texels_{"texels", 16, model::RgbaPixel::kBits};
    model::Fifo<model::TexelQuad> quads_{"quads", 4, model::TexelQuad::kBits};
    model::TexelCache block_{{.in = waiting_, .targets = targets_, .texels = texels_, .out = quads_}};
};

RS_RTL_TESTS(RtlTexelCache, TexelCacheBench, texel_cache)

}  // namespace
}  // namespace rs::engine::rtl
