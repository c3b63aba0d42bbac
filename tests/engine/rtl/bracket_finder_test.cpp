#include "engine/model/blocks/parallel/bracket_finder.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vbracket_finder.h>
#include <Vbracket_finder_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class BracketFinderBench final : public Bench<Module> {
public:
    BracketFinderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(mapped_, RS_RTL_PORTS(module, mapped), [this] { return ray(); });
        this->output(reads_, RS_RTL_PORTS(module, bracket_reads), [this](const model::MemoryRead& read) {
            read_ = read.address;
            is_read_ = true;
        });
        this->input(
            words_, RS_RTL_PORTS(module, bracket_words), [this] { return word(); }, [this] { return is_read_; });
        this->output(bracketed_, RS_RTL_PORTS(module, bracketed));
    }

private:
    static model::RegisterFile random_rings(Random& random) {
        model::RegisterFile file = random_registers(random);
        for (model::ObjectRegisters& object : file.objects) {
            object.shape.exists = random.chance(0.8);
            if (random.chance(0.7)) object.images = static_cast<int>(random.in(1, 6));
        }
        return file;
    }
    model::MappedRay ray() {
        Random& random = this->random_;
        model::MappedRay ray;
        ray.view = random_view(registers_, random);
        const model::ObjectRegisters& object = registers_.object_of(ray.view);
        ray.has_ray = random.chance(0.9);
        ray.plane = static_cast<int>(random.in(0, object.planes - 1));
        ray.x_q20 = random.of_any_length(22);
        ray.lambda_q20 = random.in(0, (1 << 29) - 1);
        ray.image = static_cast<int>(random.in(0, object.images - 1));
        ray.u_q28 = random.of_any_length(30);
        ray.n_q28 = random.in(1 << 24, (std::int64_t{1} << 31) - 1);
        ray.t_q28 = random.of_any_length(32);
        return ray;
    }
    // Most viewpoints are those of crossings near the ray. For some rays all are on one side, which leads around the
    // ring.
    model::MemoryWord word() {
        Random& random = this->random_;
        is_read_ = false;
        const model::MappedRay& ray = mapped_.front();
        const model::ObjectRegisters& object = registers_.object_of(ray.view);
        const auto word = static_cast<int>(read_ - object.lines) % model::record_words(object.planes);
        if (word == 2) {
            const std::int64_t lines = random.chance(0.1) ? 0 : random.in(1, std::int64_t{1} << random.in(0, 10));
            return {word_of(lines | random.in(0, 3) << 16, random.in(0, (1 << 27) - 1))};
        }
        const std::int64_t c_q20 = random.of_any_length(29);
        const std::int64_t distance = random.chance(0.1) ? 0 : std::abs(random.of_any_length(24));
        const bool is_left = ray.n_q28 % 4 == 0 || (ray.n_q28 % 4 > 1 && random.chance(0.5));
        const std::int64_t x_q20 = ray.x_q20 + (is_left ? -distance : distance);
        const std::int64_t a_q20 = x_q20 - ((ray.u_q28 * c_q20) >> 28);
        constexpr std::int64_t kLimit = (std::int64_t{1} << 28) - 1;
        return {word_of(std::clamp(a_q20, -kLimit, kLimit), c_q20)};
    }
    static std::uint64_t word_of(std::int64_t low, std::int64_t high) {
        return static_cast<std::uint32_t>(low) | static_cast<std::uint64_t>(high) << 32U;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::ObjectRegisters& object = registers_.object_of(valid_view(registers_, this->module_.view));
        this->module_.object_has_shape = object.shape.exists;
        this->module_.object_images = static_cast<CData>(object.images);
        this->module_.object_planes = static_cast<CData>(object.planes);
        this->module_.object_lines = object.lines;
    }

    bool is_read_ = false;
    model::WordAddress read_ = 0;
    model::RegisterFile registers_ = random_rings(this->random_);
    model::Fifo<model::MappedRay> mapped_{"mapped", 2, model::MappedRay::kBitsWithDirection};
    model::Fifo<model::MemoryRead> reads_{"bracket_reads", 2, model::MemoryRead::kBits};
    model::Fifo<model::MemoryWord> words_{"bracket_words", 2, model::MemoryWord::kBits};
    model::Fifo<model::BracketedRay> bracketed_{"bracketed", 2, model::BracketedRay::kBits};
    model::BracketFinder block_{registers_, {.in = mapped_, .requests = reads_, .answers = words_, .out = bracketed_}};
};

RS_RTL_TESTS(RtlBracketFinder, BracketFinderBench, bracket_finder)

}  // namespace
}  // namespace rs::engine::rtl
