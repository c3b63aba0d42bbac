#include "engine/model/blocks/memory/image_writer.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vimage_writer.h>
#include <Vimage_writer_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class ImageWriterBench final : public Bench<Module> {
public:
    ImageWriterBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(pixels_, RS_RTL_PORTS(module, pixels), [this] { return pixel(); });
        this->output(writes_, RS_RTL_PORTS(module, image_writes));
    }

private:
    // The pixels of whole views.
    model::RgbaPixel pixel() {
        Random& random = this->random_;
        if (left_ == 0) {
            view_ = random_view(registers_, random);
            left_ = 2 * registers_.view(view_).words();
        }
        --left_;
        return {view_, static_cast<std::uint32_t>(random.word())};
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::BoardView& view = registers_.view(valid_view(registers_, this->module_.view));
        this->module_.view_width = static_cast<SData>(view.width);
        this->module_.view_height = static_cast<SData>(view.height);
        this->module_.active_buffer = static_cast<CData>(registers_.active);
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    int view_ = 0;
    int left_ = 0;  // pixels
    model::Fifo<model::RgbaPixel> pixels_{"pixels", 4, model::RgbaPixel::kBits};
    model::Fifo<model::MemoryWrite> writes_{"image_writes", 16, model::MemoryWrite::kBits};
    model::ImageWriter block_{registers_, {.in = pixels_, .out = writes_}};
};

RS_RTL_TESTS(RtlImageWriter, ImageWriterBench, image_writer)

}  // namespace
}  // namespace rs::engine::rtl
