#include "engine/model/blocks/decompression/record_select.hpp"
#include "engine/model/blocks/decompression/block_motion.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vrecord_select_0.h>
#include <Vrecord_select_0_mutants.h>
#include <Vrecord_select_1.h>
#include <Vrecord_select_1_mutants.h>
#include <Vrecord_select_2.h>
#include <Vrecord_select_2_mutants.h>
#include <Vrecord_select_3.h>
#include <Vrecord_select_3_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module, int kHop>
class RecordSelectBench final : public Bench<Module> {
public:
    RecordSelectBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(pixels_, RS_RTL_PORTS(module, coded_pixels), [this] { return pixel(); });
        this->input(
            records_, RS_RTL_PORTS(module, records), [this] { return record(); }, [this] { return !needed_.empty(); });
        this->output(next_, RS_RTL_PORTS(module, next_pixels));
    }

private:
    // Pixels of the same block follow each other often; `needed_` gets the blocks whose records they take.
    model::CodedPixel pixel() {
        Random& random = this->random_;
        model::CodedPixel pixel;
        pixel.view = random_view(registers_, random);
        pixel.is_visible = random.chance(0.9);
        if (!pixel.is_visible) return pixel;
        pixel.pending = kHop == 0 || random.chance(0.8);
        const int hops = pixel.pending ? kHop : static_cast<int>(random.in(1, std::max(1, kHop)));
        while (pixel.hops < hops) pixel.hop[static_cast<std::size_t>(pixel.hops++)] = random_lookup(random);
        if (kHop > 0) random_colour(pixel, random);
        pixel.column = static_cast<int>(random.in(0, 7));
        const int height = registers_.object_of(pixel.view).height;
        const bool stays = block_row_ >= 0 && 8 * block_row_ < height && random.chance(0.7);
        pixel.row = static_cast<int>(stays ? random.in(8 * block_row_, std::min(height, 8 * block_row_ + 8) - 1)
                                           : random.in(0, height - 1));
        if (!pixel.pending) return pixel;
        pixel.begins = block_row_ < 0 || random.chance(0.1);
        if (pixel.begins || pixel.row >> 3 != block_row_) needed_.push_back(pixel.row >> 3);
        block_row_ = pixel.row >> 3;
        return pixel;
    }
    model::BlockRecord record() {
        Random& random = this->random_;
        model::BlockRecord record;
        record.block_row = needed_.front();
        needed_.pop_front();
        record.empty = random.chance(0.1);
        if (record.empty) return record;
        std::array<std::uint8_t, 32> bytes{};
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.word());
        const codec::RecordClass record_class{random.chance(0.5), random.chance(0.5),
                                              static_cast<int>(random.in(0, codec::kMaxBlockStages)),
                                              static_cast<int>(random.in(0, codec::kMaxQuarterStages))};
        const int block_row = record.block_row;
        record = model::block_record(record_class, bytes);
        record.block_row = block_row;
        if (record_class.predicted) {
            record.motion_y = static_cast<int>(random.in(-64, 63));
            record.reference_column = static_cast<int>(random.in(0, 7));
        }
        return record;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        this->module_.object_coded_height =
            static_cast<SData>(registers_.object_of(valid_view(registers_, this->module_.view)).coded_height);
    }

    model::RegisterFile registers_ = random_coded_registers(this->random_);
    int block_row_ = -1;  // of the last record
    std::deque<int> needed_;
    model::Fifo<model::CodedPixel> pixels_{"pixels", 4, model::CodedPixel::bits(kHop)};
    model::Fifo<model::BlockRecord> records_{"records", 2, model::BlockRecord::kBits};
    model::Fifo<model::CodedPixel> next_{"next_pixels", 2, model::CodedPixel::bits(kHop + 1)};
    model::RecordSelect block_{kHop, registers_, {.in = pixels_, .records = records_, .out = next_}};
};

template <class Module>
using FirstSelectBench = RecordSelectBench<Module, 0>;
template <class Module>
using SecondSelectBench = RecordSelectBench<Module, 1>;
template <class Module>
using ThirdSelectBench = RecordSelectBench<Module, 2>;
template <class Module>
using FourthSelectBench = RecordSelectBench<Module, 3>;

RS_RTL_TESTS(RtlRecordSelect0, FirstSelectBench, record_select_0)
RS_RTL_TESTS(RtlRecordSelect1, SecondSelectBench, record_select_1)
RS_RTL_TESTS(RtlRecordSelect2, ThirdSelectBench, record_select_2)
RS_RTL_TESTS(RtlRecordSelect3, FourthSelectBench, record_select_3)

}  // namespace
}  // namespace rs::engine::rtl
