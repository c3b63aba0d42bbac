#include "engine/model/blocks/texels/double_buffered_codebook.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vdouble_buffered_codebook.h>
#include <Vdouble_buffered_codebook_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class DoubleBufferedCodebookBench final : public Bench<Module> {
public:
    static constexpr std::int64_t kLongestEpisode = 40'000;  // codebooks have some thousand words

    DoubleBufferedCodebookBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(
            jobs_, RS_RTL_PORTS(module, book_jobs), [this] { return job(); },
            [this] { return views_.size() < kMostViews; });
        this->input(
            view_done_, RS_RTL_PORTS(module, view_done),
            [this] {
                views_.pop_front();
                return model::Done{};
            },
            [this] { return !views_.empty() && views_[0].pixels == 0 && views_[0].in_module == 0; });
        this->input(
            pixels_, RS_RTL_PORTS(module, complete), [this] { return pixel(); },
            [this] { return pixels_left(0) || pixels_left(1); });
        this->output(reads_, RS_RTL_PORTS(module, book_reads), [this](const model::MemoryRead&) { ++requested_; });
        this->input(
            words_, RS_RTL_PORTS(module, book_words),
            [this] {
                --requested_;
                return model::MemoryWord{random_book_word(this->random_)};
            },
            [this] { return requested_ > 0; });
        this->output(samples_, RS_RTL_PORTS(module, samples), [this](const model::YuvaPixel&) {
            for (View& view : views_) {
                if (view.order == order_of_pixels_.front()) --view.in_module;
            }
            order_of_pixels_.pop_front();
        });
    }

private:
    static constexpr std::size_t kMostViews = 15;
    struct View {
        int number = 0;
        int order = 0;
        int pixels = 0;  // to be sent
        int in_module = 0;
    };

    // Few objects, so that codebooks are used again; some without codebooks, or with none of them.
    static model::RegisterFile random_objects(Random& random) {
        model::RegisterFile file = random_registers_with_books(random);
        for (model::ObjectRegisters& object : file.objects) {
            object.coded = random.chance(0.85);
            if (!random.chance(0.3)) continue;
            object.book_counts = {};
            object.book_words = 0;
        }
        for (model::ViewBank& bank : file.banks) {
            for (model::BoardView& view : bank.views) view.object = static_cast<int>(random.in(0, 3));
        }
        return file;
    }
    model::ViewJob job() {
        Random& random = this->random_;
        const int number = random_view(registers_, random);
        // Views of raw images, and empty ones, have no pixels.
        if (random.chance(0.1)) empty_rate_ = 0.3 * static_cast<double>(random.in(0, 3));
        const bool is_empty = !registers_.object_of(number).coded || random.chance(empty_rate_);
        views_.push_back({number, next_order_++, static_cast<int>(is_empty ? 0 : random.in(1, 600)), 0});
        return {number};
    }
    // At most the pixels of two views are under way.
    bool pixels_left(std::size_t view) const { return view < views_.size() && views_[view].pixels > 0; }
    model::CodedPixel pixel() {
        View& view = views_[!pixels_left(0) || (pixels_left(1) && this->random_.chance(0.05)) ? 1 : 0];
        --view.pixels;
        ++view.in_module;
        order_of_pixels_.push_back(view.order);
        return random_complete_pixel(registers_, view.number, this->random_);
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        module.object_serial = registers_.object_of(valid_view(registers_, module.view)).serial;
        const model::ObjectRegisters& next = registers_.object_of(valid_view(registers_, module.next_view));
        module.next_object_coded = next.coded;
        module.next_object_serial = next.serial;
        module.next_object_books = next.books;
        module.next_object_book_words = static_cast<SData>(next.book_words);
        module.next_object_flat_blocks = static_cast<CData>(next.book_counts.block[0]);
        module.next_object_flat_quarters = static_cast<CData>(next.book_counts.quarter[0]);
        module.next_object_predicted_blocks = static_cast<CData>(next.book_counts.block[1]);
        module.next_object_predicted_quarters = static_cast<CData>(next.book_counts.quarter[1]);
    }

    model::RegisterFile registers_ = random_objects(this->random_);
    std::deque<View> views_;  // that are not done, in order
    int next_order_ = 0;
    double empty_rate_ = 0;
    std::deque<int> order_of_pixels_;  // order of the view of each pixel in the module
    int requested_ = 0;
    model::Fifo<model::ViewJob> jobs_{"book_jobs", 16, model::ViewJob::kBits};
    model::Fifo<model::Done> view_done_{"view_done", 2, 1};
    model::Fifo<model::CodedPixel> pixels_{"complete", 4, model::CodedPixel::bits(model::kHops)};
    model::Fifo<model::MemoryRead> reads_{"book_reads", 4, model::MemoryRead::kBits};
    model::Fifo<model::MemoryWord> words_{"book_words", 8, model::MemoryWord::kBits};
    model::Fifo<model::YuvaPixel> samples_{"samples", 4, model::YuvaPixel::kBitsOfCoded};
    model::DoubleBufferedCodebook block_{
        registers_,
        {.jobs = jobs_, .view_done = view_done_, .in = pixels_, .requests = reads_, .words = words_, .out = samples_}};
};

RS_RTL_TESTS(RtlDoubleBufferedCodebook, DoubleBufferedCodebookBench, double_buffered_codebook)

}  // namespace
}  // namespace rs::engine::rtl
