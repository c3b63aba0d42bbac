// A whole pipe of `parallel` in RTL beside a board of the model that renders views of objects with and without a shape
// map, uncompressed and compressed, while another object is loaded. In every cycle its commands to the SDRAM, the words
// that it writes, its ends of the FIFOs and the fill of all FIFOs in it must be those of the model.

#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/parallel_lockstep.hpp"
#include "tests/engine/rtl/sdram_pins.hpp"

#include <verilated_sym_props.h>

#include <Vparallel_pipe_2.h>
#include <Vparallel_pipe_2_mutants.h>

namespace rs::engine::rtl {
namespace {

// Fill of a FIFO in the module, beside that of the model.
struct PipeFifo {
    const model::FifoState* fifo = nullptr;
    const VerilatedVar* count = nullptr;
    [[nodiscard]] int messages() const {
        return count->vltype() == VLVT_UINT8 ? *static_cast<const CData*>(count->datap())
                                             : *static_cast<const SData*>(count->datap());
    }
};

// A FIFO by its name in the model; nullptr if it is at a port, or the module was verilated without its .vlt.
const VerilatedVar* find_count(VerilatedContext& context, std::string name) {
    name.erase(name.rfind("_p"));  // number of the pipe
    const std::string hop = name.substr(0, name.size() - 2);
    const std::string in_chain = "chain_" + name.substr(name.size() - 1) + ".";
    std::vector<std::string> scopes{name, "column_chain_block." + name, "march_pipe_block." + name, in_chain + hop};
    if (hop == "asks") scopes.push_back(in_chain + "requests");
    if (hop == "pixels") scopes.push_back(in_chain + "coded_pixels");
    for (const std::string& path : scopes) {
        const VerilatedScope* scope = context.scopeFind(("TOP.parallel_pipe." + path + "_fifo").c_str());
        if (scope != nullptr && scope->varFind("count") != nullptr) return scope->varFind("count");
    }
    return nullptr;
}

template <class Module>
class ParallelPipeBench final : public ParallelLockstepBench<Module> {
public:
    ParallelPipeBench(Module& module, model::Board& board, Random& random)
        : ParallelLockstepBench<Module>(module, board, random), pins_(module, this->pipe_.sdram, random) {
        model::ParallelFifos& fifos = this->pipe_.fifos;
        this->input(fifos.jobs, RS_RTL_PORTS(module, jobs));
        this->input(fifos.scan_jobs, RS_RTL_PORTS(module, scan_jobs));
        this->input(fifos.book_jobs, RS_RTL_PORTS(module, book_jobs));
        this->output(fifos.view_written, RS_RTL_PORTS(module, view_written));
        this->input(fifos.host_reads, RS_RTL_PORTS(module, host_reads));
        this->output(fifos.host_words, RS_RTL_PORTS(module, host_words));
        this->input(fifos.load_words, RS_RTL_PORTS(module, load_words));
        this->output(fifos.object_loaded, RS_RTL_PORTS(module, object_loaded));
        find_fifos(fifos);
        find_fifos(this->pipe_.chains);
        for (const auto& hop : this->pipe_.chains.hop_fifos) find_fifos(*hop);
    }
    [[nodiscard]] std::size_t compared_fifos() const { return fifos_.size(); }
    [[nodiscard]] std::size_t fifos_at_ports() const { return at_ports_; }

private:
    void find_fifos(const model::FifoGroup& group) {
        for (const model::FifoState* fifo : group.fifos()) {
            const VerilatedVar* count = find_count(*this->module_.contextp(), fifo->name());
            if (count != nullptr) fifos_.push_back({fifo, count});
            at_ports_ += count == nullptr;
        }
    }
    void drive() override {
        this->module_.host_words_room = static_cast<CData>(this->pipe_.fifos.host_words.room());
        this->drive_effective_depths();
    }
    std::string compare() override {
        this->count_effective_depths();
        std::string difference = pins_.clock();
        for (const PipeFifo& of : fifos_) {
            if (of.messages() == of.fifo->count()) continue;
            difference += of.fifo->name() + " has " + std::to_string(of.messages()) + " messages, in the model " +
                          std::to_string(of.fifo->count()) + ". ";
        }
        return difference;
    }
    void look_up() override {
        this->look_up_columns();
        this->look_up_pixels();
        look_up_texels();
        look_up_books();
        Module& m = this->module_;
        RS_RTL_LOOK_UP_HOP(0);
        RS_RTL_LOOK_UP_HOP(1);
        RS_RTL_LOOK_UP_HOP(2);
        RS_RTL_LOOK_UP_HOP(3);
    }
    void look_up_texels() {
        Module& m = this->module_;
        m.place_view_b_q20 = static_cast<IData>(this->view(m.place_view).b_q20) & static_cast<IData>(mask(29));
        m.place_object_width = static_cast<SData>(this->object(m.place_view).width);
        m.place_object_height = static_cast<SData>(this->object(m.place_view).height);
        m.tags_object_serial = this->object(m.tags_view).serial;
        const model::ObjectRegisters& fetch = this->object(m.fetch_view);
        m.fetch_object_coded = fetch.coded;
        m.fetch_object_serial = fetch.serial;
        m.fetch_object_block_columns = static_cast<CData>(fetch.block_columns);
        m.fetch_object_block_rows = static_cast<CData>(fetch.block_rows);
        m.fetch_object_raw_blocks = fetch.raw_blocks;
    }
    void look_up_books() {
        Module& m = this->module_;
        m.books_object_serial = this->object(m.books_view).serial;
        const model::ObjectRegisters& next = this->object(m.next_view);
        m.next_object_coded = next.coded;
        m.next_object_serial = next.serial;
        m.next_object_books = next.books;
        m.next_object_book_words = static_cast<SData>(next.book_words);
        m.next_object_flat_blocks = static_cast<CData>(next.book_counts.block[0]);
        m.next_object_flat_quarters = static_cast<CData>(next.book_counts.quarter[0]);
        m.next_object_predicted_blocks = static_cast<CData>(next.book_counts.block[1]);
        m.next_object_predicted_quarters = static_cast<CData>(next.book_counts.quarter[1]);
    }

    SdramPins<Module> pins_;
    std::vector<PipeFifo> fifos_;
    std::size_t at_ports_ = 0;
};

// Views of four objects: with and without a shape map, uncompressed and compressed.
std::vector<model::BoardView> place_objects(model::Board& board, std::size_t views_of_each, std::uint64_t seed) {
    constexpr std::uint64_t kFirstSeed = 4;  // its views have many rays through the shape maps
    seed += kFirstSeed;
    std::vector<model::BoardView> views;
    std::mt19937_64 random_views(seed);
    for (const std::uint64_t n : {3U, 2U, 0U, 1U}) {
        const RaySpaceObject object =
            model::test::any_object({.views = 12, .width = 70, .height = 60, .planes = 6, .seed = 4 * seed + n},
                                    {.coded = n % 2 != 0, .shape = n >= 2}, n >= 2);
        const Result<int> slot = board.place(object);
        EXPECT_TRUE(slot.ok());
        for (std::size_t v = 0; v < views_of_each; ++v) {
            const auto prepared =
                prepare_view(object, model::test::random_upright(random_views, 80), TexelFilter::kBilinear);
            views.push_back(*board.view(*slot, *prepared));
        }
    }
    return views;
}

template <class Module>
LockstepRun draw_in_lockstep(Module& module, std::size_t views_of_each, std::uint64_t seed, bool load) {
    constexpr int kPipesOfBoard = 2;  // the module is the first one
    model::Board board(model::test::parallel(kPipesOfBoard));
    const std::vector<model::BoardView> views = place_objects(board, views_of_each, seed);
    if (load) {
        EXPECT_TRUE(board.start_load(rs::test::ring_object({.views = 4, .width = 16, .height = 16, .planes = 3})).ok());
    }
    board.submit(views);
    Random random(seed);
    ParallelPipeBench<Module> bench(module, board, random);
    const std::string difference = bench.run(views.size());
    const model::ParallelPipe& pipe = *model::test::pipes(board).front();
    if (difference.empty() && seed == 0 && load) {
        EXPECT_EQ(bench.fifos_at_ports(), 8U);
        EXPECT_EQ(bench.compared_fifos(),
                  pipe.fifos.fifos().size() - 8 + 4 * pipe.chains.hop_fifos[0]->fifos().size() + 1);
        EXPECT_GT(pipe.fifos.band_reads.total_pushed(), 1000U);
        EXPECT_GT(pipe.surface_blend.sent_back(), 500U);
        EXPECT_GT(pipe.fifos.raw_reads.total_pushed(), 1000U);
        EXPECT_GT(pipe.fifos.samples.total_pushed(), 1000U);
        EXPECT_GT(pipe.chains.hop_fifos[3]->records.total_pushed(), 0U);
    }
    return {difference, board.top().simulator.board_cycles()};
}

TEST(RtlParallelPipe, EqualsTheBoard) {
    expect_equal_in_lockstep<Vparallel_pipe_2>(
        [](Vparallel_pipe_2& module, std::uint64_t seed) { return draw_in_lockstep(module, 3, seed, true); });
}

TEST(RtlParallelPipe, MutantsDifferFromTheBoard) {
    expect_mutants_differ_in_lockstep<Vparallel_pipe_2_mutants>(
        [](Vparallel_pipe_2_mutants& module) { return draw_in_lockstep(module, 2, 0, false); });
}

}  // namespace
}  // namespace rs::engine::rtl
