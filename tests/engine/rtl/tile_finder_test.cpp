#include "engine/model/blocks/decompression/record_reading.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vtile_finder.h>
#include <Vtile_finder_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class TileFinderBench final : public Bench<Module> {
public:
    TileFinderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(asks_, RS_RTL_PORTS(module, asks),
                    [this] { return random_request(registers_, last_, this->random_); });
        this->output(reads_, RS_RTL_PORTS(module, table_reads));
        this->output(found_, RS_RTL_PORTS(module, found));
    }

private:
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::ObjectRegisters& object = registers_.object_of(valid_view(registers_, this->module_.view));
        this->module_.object_tile_columns = static_cast<CData>(object.tile_columns);
        this->module_.object_table_pitch = static_cast<CData>(object.table_pitch);
        this->module_.object_tile_table = object.tile_table;
    }

    model::RegisterFile registers_ = random_coded_registers(this->random_);
    model::BlockRequest last_;
    model::Fifo<model::BlockRequest> asks_{"asks", 4, model::BlockRequest::kBits};
    model::Fifo<model::MemoryRead> reads_{"table_reads", 2, model::MemoryRead::kBits};
    model::Fifo<model::FoundTile> found_{"found", 4, model::FoundTile::kBits};
    model::TileFinder block_{0, registers_, {.in = asks_, .requests = reads_, .out = found_}};
};

RS_RTL_TESTS(RtlTileFinder, TileFinderBench, tile_finder)

}  // namespace
}  // namespace rs::engine::rtl
