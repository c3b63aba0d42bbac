#include "engine/model/blocks/texels/texel_tags.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vtexel_tags.h>
#include <Vtexel_tags_mutants.h>

#include <algorithm>

namespace rs::engine::rtl {
namespace {

template <class Module>
class TexelTagsBench final : public Bench<Module> {
public:
    TexelTagsBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(placed_, RS_RTL_PORTS(module, placed), [this] { return sample(); });
        this->output(fills_, RS_RTL_PORTS(module, fills));
        this->output(waiting_, RS_RTL_PORTS(module, waiting));
    }

private:
    static model::RegisterFile random_objects(Random& random) {
        model::RegisterFile file = random_registers(random);
        std::uint32_t serial = 1;
        for (model::ObjectRegisters& object : file.objects) object.serial = serial++;
        return file;
    }
    // A position near the last one mostly, so that blocks are found, replaced and used again after some time.
    static int moved(int position, int side, Random& random) {
        const std::int64_t last = side - 1;
        return static_cast<int>(random.chance(0.02) ? random.in(0, last)
                                                    : std::clamp<std::int64_t>(position + random.in(-9, 9), 0, last));
    }
    model::PlacedSample sample() {
        Random& random = this->random_;
        const auto number = [&](int most) { return static_cast<int>(random.in(0, most)); };
        if (random.chance(0.002)) view_ = random_view(registers_, random);
        if (random.chance(0.003)) quiet_ = !quiet_;
        const model::ObjectRegisters& object = registers_.object_of(view_);
        last_.view = view_;
        last_.head = {number(511),
                      random.chance(0.9),
                      random.chance(0.5),
                      number(256),
                      random.chance(0.5),
                      random.chance(0.5),
                      {number(model::MarchState::kFarthest)}};
        last_.image = std::min(random.chance(0.1) ? number(object.images - 1) : last_.image, object.images - 1);
        last_.left = moved(last_.left, object.width, random);
        last_.top = moved(last_.top, object.height, random);
        last_.right_is_left = last_.left == object.width - 1;
        last_.bottom_is_top = last_.top == object.height - 1;
        last_.fx = random.chance(0.2) ? 0 : number(7);
        last_.fy = random.chance(0.2) ? 0 : number(7);
        // Runs of many samples of few lines, or outside of the images, so that the others become old.
        last_.inside = random.chance(quiet_ ? 0.05 : 0.9);
        return last_;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        this->module_.object_serial = registers_.object_of(valid_view(registers_, this->module_.view)).serial;
    }

    model::RegisterFile registers_ = random_objects(this->random_);
    int view_ = random_view(registers_, this->random_);
    bool quiet_ = false;
    model::PlacedSample last_;
    model::Fifo<model::PlacedSample> placed_{"placed", 4, model::PlacedSample::kBits};
    model::Fifo<model::TexelFill> fills_{"fills", 8, model::TexelFill::kBits};
    model::Fifo<model::WaitingSample> waiting_{"waiting", model::kWaitingSamples, model::WaitingSample::kBits};
    model::TexelTags block_{registers_, {.in = placed_, .fills = fills_, .out = waiting_}};
};

RS_RTL_TESTS(RtlTexelTags, TexelTagsBench, texel_tags)

}  // namespace
}  // namespace rs::engine::rtl
