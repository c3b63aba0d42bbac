#include "engine/model/blocks/texels/surface_blend.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vsurface_blend.h>
#include <Vsurface_blend_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class SurfaceBlendBench final : public Bench<Module> {
public:
    SurfaceBlendBench(Module& module, Random& random) : Bench<Module>(module, random) {
        for (int id = 0; id < kIds; ++id) waiting_.push_back(id);
        this->input(
            samples_, RS_RTL_PORTS(module, filtered), [this] { return sample(); },
            [this] { return is_second_ || !waiting_.empty(); });
        this->output(resolved_, RS_RTL_PORTS(module, resolved),
                     [this](const model::FinishedPixel& pixel) { waiting_.push_back(pixel.id); });
        this->output(again_, RS_RTL_PORTS(module, again),
                     [this](const model::ReturnedPixel& pixel) { waiting_.push_back(pixel.id); });
    }

private:
    static constexpr int kIds = 40;  // few, so that pixels often return

    // One or two samples of a surface of a pixel that is not in the module.
    model::FilteredSample sample() {
        Random& random = this->random_;
        model::SampleHead& head = last_.head;
        if (is_second_) {
            head.second = head.last = true;
            is_second_ = false;
        } else {
            head.id = static_cast<int>(waiting_.front());
            waiting_.pop_front();
            head.weight = static_cast<int>(random.chance(0.2) ? 256 * random.in(0, 1) : random.in(0, 256));
            head.final = random.chance(0.2);
            head.next.begin = static_cast<int>(random.chance(0.5) ? random.in(256, 258) : random.in(0, 255));
            is_second_ = random.chance(0.5);
            head.last = !is_second_;
            head.second = !is_second_ && random.chance(0.3);
        }
        head.is_there = random.chance(0.95);
        model::FilteredSample sample{head, random.chance(0.9), 0, 0, 0, 0};
        if (!sample.inside) return sample;
        sample.a = static_cast<std::int32_t>(random.chance(0.3)   ? 64 * 255
                                             : random.chance(0.5) ? random.of_any_length(14) & 0x3FFF
                                                                  : random.in(0, 64 * 255));
        sample.a = std::min(sample.a, 64 * 255);
        for (std::int32_t* const sum : {&sample.r, &sample.g, &sample.b}) {
            *sum = sample.a * static_cast<std::int32_t>(random.in(0, 255));
        }
        return sample;
    }
    model::Block& block() override { return block_; }

    std::deque<int> waiting_;  // pixels that are not in the module
    bool is_second_ = false;   // the next sample is the second one of its surface
    model::FilteredSample last_;
    model::Fifo<model::FilteredSample> samples_{"filtered", 4, model::FilteredSample::kBits};
    model::Fifo<model::FinishedPixel> resolved_{"resolved", 4, model::FinishedPixel::kBits};
    model::Fifo<model::ReturnedPixel> again_{"again", 4, model::ReturnedPixel::kBits};
    model::SurfaceBlend block_{{.in = samples_, .out = resolved_, .again = again_}};
};

RS_RTL_TESTS(RtlSurfaceBlend, SurfaceBlendBench, surface_blend)

}  // namespace
}  // namespace rs::engine::rtl
