#pragma once
// Record select of a hop: joins pixels and records. A pixel takes from its block's record the codebook entries of its
// quarter, and goes on to the reference's row where the record is predicted. The first pixel that needs a record takes
// it; it stays for the pixels behind. A pixel that needs nothing of this hop passes.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

// The arithmetic without the clock: the pixel behind the hop. `took`: the record is a new one.
CodedPixel behind_hop(const CodedPixel& pixel, const BlockRecord& record, bool took, int coded_height);

class RecordSelect final : public Block {
public:
    RecordSelect(int hop, const RegisterFile& registers, Fifo<CodedPixel>& in, Fifo<BlockRecord>& records,
                 Fifo<CodedPixel>& out);
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
