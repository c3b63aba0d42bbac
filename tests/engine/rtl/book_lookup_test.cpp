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
                return model::MemoryWord{word()};
            },
            [this] { return requested_ > 0; });
        this->output(samples_, RS_RTL_PORTS(module, samples));
    }

private:
    static model::RegisterFile random_books(Random& random) {
        model::RegisterFile file = random_coded_registers(random);
        std::uint32_t serial = 1;
        for (model::ObjectRegisters& object : file.objects) {
            object.serial = serial++;
            object.books = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 1));
            object.book_counts.alpha = random.chance(0.5);
            std::size_t bytes = object.book_counts.alpha ? model::BookBanks::kAlphaBytes : 0;
            for (const std::size_t set : {0U, 1U}) {
                int& blocks = object.book_counts.block[set];
                int& quarters = object.book_counts.quarter[set];
                blocks = random.chance(0.6) ? 0 : static_cast<int>(random.in(1, codec::kMaxBlockStages));
                quarters = random.chance(0.4) ? 0 : static_cast<int>(random.in(1, codec::kMaxQuarterStages));
                bytes += static_cast<std::size_t>(blocks) * model::BookBanks::kBlockBytes +
                         static_cast<std::size_t>(quarters) * model::BookBanks::kQuarterBytes;
            }
            object.book_words = static_cast<std::uint32_t>(bytes / 8);
        }
        return file;
    }
    // Differences of all lengths, so that sums are clamped sometimes.
    std::uint64_t word() {
        std::uint64_t word = 0;
        for (int n = 0; n < 8; ++n) {
            word = word << 8U | static_cast<std::uint8_t>(this->random_.of_any_length(8));
        }
        return word;
    }
    // Another object is shown rarely, as each loads its codebooks.
    model::CodedPixel pixel() {
        Random& random = this->random_;
        if (view_ < 0 || random.chance(0.0003)) view_ = random_view(registers_, random);
        const model::BookCounts& counts = registers_.object_of(view_).book_counts;
        model::CodedPixel pixel;
        pixel.view = view_;
        pixel.is_visible = random.chance(0.9);
        if (!pixel.is_visible) return pixel;
        const auto last = static_cast<int>(random.in(0, random.chance(0.5) ? 1 : model::kHops - 1));
        for (int n = 0; n <= last; ++n) {
            model::HopLookup hop = random_lookup(random);
            hop.predicted = n < last;
            const auto set = static_cast<std::size_t>(hop.predicted);
            hop.block_stages = static_cast<int>(random.in(0, counts.block[set]));
            hop.quarter_stages = static_cast<int>(random.in(0, counts.quarter[set]));
            pixel.hop[static_cast<std::size_t>(pixel.hops++)] = hop;
        }
        random_colour(pixel, random);
        if (pixel.alpha == model::CodedPixel::Alpha::book && !counts.alpha) {
            pixel.alpha = model::CodedPixel::Alpha::full;
        }
        if (last > 0 && pixel.alpha == model::CodedPixel::Alpha::none) pixel.alpha = model::CodedPixel::Alpha::full;
        return pixel;
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

    model::RegisterFile registers_ = random_books(this->random_);
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
