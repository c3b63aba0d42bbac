#include "engine/model/blocks/decompression/block_motion.hpp"
#include "tests/engine/rtl/coded_registers.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vblock_motion.h>
#include <Vblock_motion_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class BlockMotionBench final : public Bench<Module> {
public:
    BlockMotionBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(requested_, RS_RTL_PORTS(module, asked_records), [this] { return requested(); });
        this->input(words_, RS_RTL_PORTS(module, record_words),
                    [this] { return model::MemoryWord{this->random_.word()}; });
        this->output(records_, RS_RTL_PORTS(module, records));
        this->output(asks_, RS_RTL_PORTS(module, asks));
    }

private:
    model::RequestedRecord requested() {
        Random& random = this->random_;
        model::RequestedRecord record;
        record.request = random_request(registers_, last_, random);
        record.predicted_image = random.chance(0.8);
        for (int& image : record.references) image = static_cast<int>(random.in(0, 119));
        record.class_number = static_cast<int>(random.in(0, codec::kBoardClasses - 1));
        if (record.class_number == 0) return record;
        const auto& classes = registers_.object_of(record.request.view).classes[record.predicted_image ? 1 : 0];
        record.lane = 2 * static_cast<int>(random.in(0, 3));
        record.words = (record.lane + classes[static_cast<std::size_t>(record.class_number)].bytes() + 7) / 8;
        return record;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const model::ObjectRegisters& object = registers_.object_of(valid_view(registers_, this->module_.view));
        this->module_.object_classes = class_bytes(object.classes[0]);
        this->module_.object_predicted_classes = class_bytes(object.classes[1]);
        this->module_.object_coded_width = static_cast<SData>(object.coded_width);
        this->module_.object_coded_height = static_cast<SData>(object.coded_height);
    }

    model::RegisterFile registers_ = random_coded_registers(this->random_);
    model::BlockRequest last_;
    model::Fifo<model::RequestedRecord> requested_{"asked_records", 4, model::RequestedRecord::kBits};
    model::Fifo<model::MemoryWord> words_{"record_words", 4, model::MemoryWord::kBits};
    model::Fifo<model::BlockRecord> records_{"records", 2, model::BlockRecord::kBits};
    model::Fifo<model::BlockRequest> asks_{"asks", 2, model::BlockRequest::kBits};
    model::BlockMotion block_{0, registers_, {.in = requested_, .words = words_, .out = records_, .asks = &asks_}};
};

RS_RTL_TESTS(RtlBlockMotion, BlockMotionBench, block_motion)

}  // namespace
}  // namespace rs::engine::rtl
