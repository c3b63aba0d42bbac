#pragma once
// Record select of a hop: joins pixels with records. A pixel takes the codebook entries of its quarter from its block's
// record; if the record is predicted, the pixel continues at the reference's row. The first pixel that needs a record
// pops it; the record remains valid for the following pixels. A pixel without a record at this hop passes.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

// The pixel after the hop, without the clock. `is_new_record`: the previous pixel had another record.
CodedPixel apply_hop(const CodedPixel& pixel, const BlockRecord& record, bool is_new_record, int coded_height);

class RecordSelect final : public Block {
public:
    struct Ports {
        Fifo<CodedPixel>& in;
        Fifo<BlockRecord>& records;
        Fifo<CodedPixel>& out;
    };
    RecordSelect(int hop, const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return text(record_); }

private:
    const RegisterFile& registers_;
    Fifo<CodedPixel>& in_;
    Fifo<BlockRecord>& records_;
    Fifo<CodedPixel>& out_;
    BlockRecord record_;
};

}  // namespace rs::engine::model
