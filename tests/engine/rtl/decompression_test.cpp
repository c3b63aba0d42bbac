// Block decompression in RTL beside a board of the model that renders views of objects with predictions of up to three
// hops: columns, samples, and all requests and words of the memory must be those of the model in every cycle.

#include "tests/engine/model/coded_test_objects.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/lockstep.hpp"

#include <Vdecompression.h>
#include <Vdecompression_mutants.h>

namespace rs::engine::rtl {
namespace {

// Memory FIFOs of the chain of a hop.
#define RS_RTL_HOP_FIFOS(hop)                                                        \
    this->output(fifos(hop).table_reads, RS_RTL_PORTS(module, table_reads_##hop));   \
    this->input(fifos(hop).table_words, RS_RTL_PORTS(module, table_words_##hop));    \
    this->output(fifos(hop).tile_reads, RS_RTL_PORTS(module, tile_reads_##hop));     \
    this->input(fifos(hop).tile_words, RS_RTL_PORTS(module, tile_words_##hop));      \
    this->output(fifos(hop).record_reads, RS_RTL_PORTS(module, record_reads_##hop)); \
    this->input(fifos(hop).record_words, RS_RTL_PORTS(module, record_words_##hop))

template <class Module>
class DecompressionBench final : public LockstepBench<Module> {
public:
    DecompressionBench(Module& module, model::Board& board, Random& random)
        : LockstepBench<Module>(module, board, random),
          body_(dynamic_cast<model::SingleBoard<model::BlockDecompression>&>(*board.top().body)) {
        this->input(body_.fifos.walks, RS_RTL_PORTS(module, walks));
        this->output(body_.fifos.samples, RS_RTL_PORTS(module, samples));
        this->output(body_.reading.book_reads, RS_RTL_PORTS(module, book_reads));
        this->input(body_.reading.book_words, RS_RTL_PORTS(module, book_words));
        RS_RTL_HOP_FIFOS(0);
        RS_RTL_HOP_FIFOS(1);
        RS_RTL_HOP_FIFOS(2);
        RS_RTL_HOP_FIFOS(3);
    }

private:
    model::HopFifos& fifos(std::size_t hop) { return *body_.reading.hop_fifos[hop]; }
    void look_up() override {
        Module& m = this->module_;
        m.scan_view_height = static_cast<SData>(this->view(m.scan_view).height);
        m.scan_object_height = static_cast<SData>(this->object(m.scan_view).height);
        const model::ObjectRegisters& books = this->object(m.books_view);
        m.books_object_serial = books.serial;
        m.books_object_books = books.books;
        m.books_object_book_words = static_cast<SData>(books.book_words);
        m.books_object_flat_blocks = static_cast<CData>(books.book_counts.block[0]);
        m.books_object_flat_quarters = static_cast<CData>(books.book_counts.quarter[0]);
        m.books_object_predicted_blocks = static_cast<CData>(books.book_counts.block[1]);
        m.books_object_predicted_quarters = static_cast<CData>(books.book_counts.quarter[1]);
        RS_RTL_LOOK_UP_HOP(0);
        RS_RTL_LOOK_UP_HOP(1);
        RS_RTL_LOOK_UP_HOP(2);
        RS_RTL_LOOK_UP_HOP(3);
    }

    model::SingleBoard<model::BlockDecompression>& body_;
};

// Views of two objects in turn, each of which begins with its codebooks.
template <class Module>
LockstepRun decompress_in_lockstep(Module& module, std::size_t views_of_each, std::uint64_t seed) {
    model::Board board(model::test::compressed());
    std::vector<model::BoardView> views;
    for (const std::uint64_t object_seed : {5 + 16 * seed, 13 + 16 * seed}) {
        std::mt19937_64 random_views(11);
        const RaySpaceObject object = model::test::random_coded_object(
            {.views = 12, .width = 90, .height = 70, .planes = 6, .seed = object_seed});
        const Result<int> slot = board.place(object);
        EXPECT_TRUE(slot.ok());
        for (std::size_t n = 0; n < views_of_each; ++n) {
            const auto prepared = prepare_view(object, model::test::random_upright(random_views, 100));
            views.push_back(*board.view(*slot, *prepared));
        }
    }
    board.submit(views);
    Random random(seed);
    const std::string difference = DecompressionBench<Module>(module, board, random).run(views.size());
    if (difference.empty() && seed == 0) {  // the first views of its objects have predictions of three hops
        EXPECT_GT(model::test::block_decompression(board).hop_fifos[3]->records.total_pushed(), 0U);
    }
    return {difference, board.top().simulator.board_cycles()};
}

TEST(RtlDecompression, EqualsTheBoard) {
    expect_equal_in_lockstep<Vdecompression>(
        [](Vdecompression& module, std::uint64_t seed) { return decompress_in_lockstep(module, 7, seed); });
}

TEST(RtlDecompression, MutantsDifferFromTheBoard) {
    expect_mutants_differ_in_lockstep<Vdecompression_mutants>(
        [](Vdecompression_mutants& module) { return decompress_in_lockstep(module, 2, 0); });
}

}  // namespace
}  // namespace rs::engine::rtl
