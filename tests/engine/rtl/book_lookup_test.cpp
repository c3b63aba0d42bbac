#include "engine/model/blocks/decompression/book_lookup.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vbook_lookup.h>
#include <Vbook_lookup_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class BookLookupBench final : public Bench<Module> {
public:
    static constexpr std::int64_t kLongestEpisode = 40'000;  // codebooks have some thousand words

    BookLookupBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(pixels_, RS_RTL_PORTS(module, complete), [this] { return pixel(); });
        this->output(reads_, RS_RTL_PORTS(module, book_reads), [this](const model::MemoryRead&) { ++requested_; });
        this->input(
            words_, RS_RTL_PORTS(module, book_words),
            [this] {
                --requested_;
                return model::MemoryWord{random_book_word(this->random_)};
            },
            [this] { return requested_ > 0; });
        this->output(samples_, RS_RTL_PORTS(module, samples));
    }

private:
    // Another object is shown rarely, as each loads its codebooks.
    model::CodedPixel pixel() {
        Random& random = this->random_;
        if (view_ < 0 || random.chance(0.0003)) view_ = random_view(registers_, random);
        return random_complete_pixel(registers_, view_, random);
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::ObjectRegisters& object = registers_.object_of(valid_view(registers_, this->module_.view));
        this->module_.object_serial = object.serial;
        this->module_.object_books = object.books;
        this->module_.object_book_words = static_cast<SData>(object.book_words);
        this->module_.object_flat_blocks = static_cast<CData>(object.book_counts.block[0]);
        this->module_.object_flat_quarters = static_cast<CData>(object.book_counts.quarter[0]);
        this->module_.object_predicted_blocks = static_cast<CData>(object.book_counts.block[1]);
        this->module_.object_predicted_quarters = static_cast<CData>(object.book_counts.quarter[1]);
    }

    model::RegisterFile registers_ = random_registers_with_books(this->random_);
    int view_ = -1;
    int requested_ = 0;
    model::Fifo<model::CodedPixel> pixels_{"complete", 4, model::CodedPixel::bits(model::kHops)};
    model::Fifo<model::MemoryRead> reads_{"book_reads", 8, model::MemoryRead::kBits};
    model::Fifo<model::MemoryWord> words_{"book_words", 16, model::MemoryWord::kBits};
    model::Fifo<model::YuvaPixel> samples_{"samples", 4, model::YuvaPixel::kBitsOfCoded};
    model::BookLookup block_{registers_, {.in = pixels_, .requests = reads_, .words = words_, .out = samples_}};
};

RS_RTL_TESTS(RtlBookLookup, BookLookupBench, book_lookup)

}  // namespace
}  // namespace rs::engine::rtl
