#include "engine/model/blocks/decompression/record_reading.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vtile_reader.h>
#include <Vtile_reader_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class TileReaderBench final : public Bench<Module> {
public:
    TileReaderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(found_, RS_RTL_PORTS(module, found), [this] {
            const model::BlockRequest request = random_request(registers_, last_, this->random_);
            return model::FoundTile{request, this->random_.chance(0.5), this->random_.chance(0.5)};
        });
        this->input(words_, RS_RTL_PORTS(module, table_words),
                    [this] { return model::MemoryWord{entry() | entry() << 32U}; });
        this->output(reads_, RS_RTL_PORTS(module, tile_reads));
        this->output(tiles_, RS_RTL_PORTS(module, tiles));
    }

private:
    // A word address, or that of no tile.
    std::uint64_t entry() {
        return this->random_.chance(0.3) ? 0xFFFFFFFFU : static_cast<std::uint64_t>(this->random_.in(0, (1 << 27) - 1));
    }
    model::Block& block() override { return block_; }

    model::RegisterFile registers_ = random_coded_registers(this->random_);
    model::BlockRequest last_;
    model::Fifo<model::FoundTile> found_{"found", 4, model::FoundTile::kBits};
    model::Fifo<model::MemoryWord> words_{"table_words", 4, model::MemoryWord::kBits};
    model::Fifo<model::MemoryRead> reads_{"tile_reads", 2, model::MemoryRead::kBits};
    model::Fifo<model::RequestedTile> tiles_{"tiles", 4, model::RequestedTile::kBits};
    model::TileReader block_{0, {.in = found_, .entries = words_, .requests = reads_, .out = tiles_}};
};

RS_RTL_TESTS(RtlTileReader, TileReaderBench, tile_reader)

}  // namespace
}  // namespace rs::engine::rtl
