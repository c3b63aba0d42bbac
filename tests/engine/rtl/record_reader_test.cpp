#include "engine/model/blocks/decompression/record_reading.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vrecord_reader.h>
#include <Vrecord_reader_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class RecordReaderBench final : public Bench<Module> {
public:
    RecordReaderBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(tiles_, RS_RTL_PORTS(module, tiles), [this] { return tile(); });
        this->input(words_, RS_RTL_PORTS(module, tile_words), [this] {
            const std::uint64_t references = this->random_.chance(0.5) ? 0xFFFF : this->random_.word() & 0x7F7F;
            return model::MemoryWord{(this->random_.word() & 0xFFFFFFFFFFFFU) | references << 48U};
        });
        this->output(reads_, RS_RTL_PORTS(module, record_reads));
        this->output(records_, RS_RTL_PORTS(module, asked_records));
    }

private:
    model::RequestedTile tile() {
        Random& random = this->random_;
        model::RequestedTile tile;
        tile.request = random_request(registers_, last_, random);
        // The requests of a tile are of one object: the first one of an object begins a tile (tile_finder).
        const bool begins = !has_tile_ || tile.request.first || random.chance(0.5);
        has_tile_ = true;
        if (!begins) return tile;
        tile.kind = random.chance(0.8) ? model::RequestedTile::Kind::read : model::RequestedTile::Kind::nothing;
        if (tile.kind == model::RequestedTile::Kind::read) {
            tile.address = static_cast<model::WordAddress>(random.in(0, (1 << 27) - 100));
        }
        return tile;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const auto& classes = registers_.object_of(valid_view(registers_, this->module_.view)).classes;
        this->module_.object_record_sizes = record_sizes(classes[0]);
        this->module_.object_predicted_sizes = record_sizes(classes[1]);
    }

    model::RegisterFile registers_ = random_coded_registers(this->random_);
    model::BlockRequest last_;
    bool has_tile_ = false;
    model::Fifo<model::RequestedTile> tiles_{"tiles", 4, model::RequestedTile::kBits};
    model::Fifo<model::MemoryWord> words_{"tile_words", 4, model::MemoryWord::kBits};
    model::Fifo<model::MemoryRead> reads_{"record_reads", 2, model::MemoryRead::kBits};
    model::Fifo<model::RequestedRecord> records_{"asked_records", 4, model::RequestedRecord::kBits};
    model::RecordReader block_{0, registers_, {.in = tiles_, .heads = words_, .requests = reads_, .out = records_}};
};

RS_RTL_TESTS(RtlRecordReader, RecordReaderBench, record_reader)

}  // namespace
}  // namespace rs::engine::rtl
