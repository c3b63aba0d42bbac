#include "engine/model/blocks/parallel/image_reader.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_rays.hpp"

#include <Vpicture_reader.h>
#include <Vpicture_reader_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class PictureReaderBench final : public Bench<Module> {
public:
    PictureReaderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(bracketed_, RS_RTL_PORTS(module, bracketed),
                    [this] { return random_bracketed_ray(registers_, this->random_); });
        this->output(line_reads_, RS_RTL_PORTS(module, line_reads), [this](const model::MemoryRead&) { ++requested_; });
        this->input(
            line_words_, RS_RTL_PORTS(module, line_words), [this] { return word(); },
            [this] { return requested_ > 0; });
        this->output(lined_, RS_RTL_PORTS(module, lined));
    }

private:
    model::MemoryWord word() {
        --requested_;
        return {this->random_.word()};
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::ObjectRegisters& object = registers_.object_of(valid_view(registers_, this->module_.view));
        this->module_.object_planes = static_cast<CData>(object.planes);
        this->module_.object_lines = object.lines;
    }

    int requested_ = 0;
    model::RegisterFile registers_ = random_registers(this->random_);
    model::Fifo<model::BracketedRay> bracketed_{"bracketed", 2, model::BracketedRay::kBits};
    model::Fifo<model::MemoryRead> line_reads_{"line_reads", static_cast<int>(this->random_.in(1, 4)),
                                               model::MemoryRead::kBits};
    model::Fifo<model::MemoryWord> line_words_{"line_words", static_cast<int>(this->random_.in(1, 8)),
                                               model::MemoryWord::kBits};
    model::Fifo<model::RayWithLines> lined_{"lined", 2, model::RayWithLines::kBits};
    model::ImageReader block_{registers_,
                              {.in = bracketed_, .requests = line_reads_, .answers = line_words_, .out = lined_}};
};

RS_RTL_TESTS(RtlPictureReader, PictureReaderBench, picture_reader)

}  // namespace
}  // namespace rs::engine::rtl
