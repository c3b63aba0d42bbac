#include "engine/model/blocks/parallel/image_reader.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vpicture_reader.h>
#include <Vpicture_reader_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class PictureReaderBench final : public Bench<Module> {
public:
    PictureReaderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(bracketed_, RS_RTL_PORTS(module, bracketed), [this] { return ray(); });
        this->output(line_reads_, RS_RTL_PORTS(module, line_reads), [this](const model::MemoryRead&) { ++requested_; });
        this->input(
            line_words_, RS_RTL_PORTS(module, line_words), [this] { return word(); },
            [this] { return requested_ > 0; });
        this->output(lined_, RS_RTL_PORTS(module, lined));
    }

private:
    model::BracketedRay ray() {
        Random& random = this->random_;
        model::BracketedRay ray;
        ray.view = random_view(registers_, random);
        const model::ObjectRegisters& object = registers_.object_of(ray.view);
        const auto image = [&] { return static_cast<int>(random.in(0, object.images - 1)); };
        constexpr std::int64_t kMost = (std::int64_t{1} << 31) - 1;
        ray.kind = static_cast<model::RayKind>(random.in(0, 3));
        ray.plane = static_cast<int>(random.in(0, object.planes - 1));
        ray.x_q20 = random.of_any_length(23);
        ray.lambda_q20 = random.in(0, (1 << 29) - 1);
        ray.n_q28 = random.in(0, kMost);
        ray.t_q28 = random.of_any_length(32);
        ray.first = image();
        ray.second = image();
        ray.from_first_q20 = random.in(0, kMost);
        ray.width_q20 = random.in(0, kMost);
        ray.lines = static_cast<int>(random.in(0, 1024));
        ray.first_line = random.in(0, (1 << 27) - 1);
        ray.lines_before = random.chance(0.5);
        ray.lines_behind = random.chance(0.5);
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
