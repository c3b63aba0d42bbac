#include "engine/model/blocks/prototype/line_reader.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vline_reader.h>
#include <Vline_reader_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class LineReaderBench final : public Bench<Module> {
public:
    LineReaderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(mapped_, RS_RTL_PORTS(module, mapped), [this] { return ray(); });
        this->output(line_reads_, RS_RTL_PORTS(module, line_reads), [this](const model::MemoryRead&) { ++requested_; });
        this->input(
            line_words_, RS_RTL_PORTS(module, line_words), [this] { return word(); },
            [this] { return requested_ > 0; });
        this->output(lines_, RS_RTL_PORTS(module, lines));
    }

private:
    model::MappedRay ray() {
        Random& random = this->random_;
        model::MappedRay ray;
        ray.view = random_view(registers_, random);
        const model::ObjectRegisters& object = registers_.object_of(ray.view);
        ray.has_ray = random.chance(0.8);
        ray.plane = static_cast<int>(random.in(0, object.planes - 1));
        ray.x_q20 = random.of_any_length(23);
        ray.lambda_q20 = random.in(0, (1 << 29) - 1);
        ray.image = static_cast<int>(random.in(0, object.images - 1));
        return ray;
    }
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
    model::Fifo<model::MappedRay> mapped_{"mapped", 2, model::MappedRay::kBits};
    model::Fifo<model::MemoryRead> line_reads_{"line_reads", static_cast<int>(this->random_.in(1, 4)),
                                               model::MemoryRead::kBits};
    model::Fifo<model::MemoryWord> line_words_{"line_words", 4, model::MemoryWord::kBits};
    model::Fifo<model::RayLine> lines_{"lines", 2, model::RayLine::kBits};
    model::LineReader block_{registers_,
                             {.in = mapped_, .requests = line_reads_, .answers = line_words_, .out = lines_}};
};

RS_RTL_TESTS(RtlLineReader, LineReaderBench, line_reader)

}  // namespace
}  // namespace rs::engine::rtl
