#pragma once
// Bracket finder (RECONSTRUCTION.md, section 5): finds the two captured rays that enclose a view ray. Starts at the
// image of the RS map and steps along the ring, at most N looks. Reads the words of image records that a look needs and
// that are not yet read, one after the other: S and first_line of a gap, and the viewpoint of an image, whose parallel
// ray's crossing X takes a product of 9 cycles. Processes one ray at a time; rays of objects without a shape map pass
// unchanged.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class BracketFinder final : public Block {
public:
    struct Ports {
        Fifo<MappedRay>& in;
        Fifo<MemoryRead>& requests;
        Fifo<MemoryWord>& answers;
        Fifo<BracketedRay>& out;
    };
    BracketFinder(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "gap " + std::to_string(gap_) + ", looks " + std::to_string(looks_);
    }

private:
    enum class Step { idle, near, gap_word, first, second, decide };
    struct Crossing {
        bool known = false;
        std::int64_t x_q20 = 0;
    };
    Activity crossing(int image, Crossing& into);
    Activity read(int image, int word);
    void next_step();
    Activity decide();
    Activity send_output(const BracketedRay& ray);

    const RegisterFile& registers_;
    Fifo<MappedRay>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<MemoryWord>& answers_;
    Fifo<BracketedRay>& out_;
    Step step_ = Step::idle;
    int gap_ = 0;
    int looks_ = 0;
    bool gap_known_ = false;
    std::uint64_t gap_word_ = 0;
    Crossing first_, second_;
    bool requested_ = false;
    bool answered_ = false;
    std::uint64_t word_ = 0;
    int multiplying_ = 0;
};

}  // namespace rs::engine::model
