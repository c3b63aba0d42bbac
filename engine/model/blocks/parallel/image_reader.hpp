#pragma once
// Image reader: reads the camera and the line of the ray's plane for one or two images (parallel_layout.hpp): four
// words without a shape map, five with one and no gap, ten in a gap. 9 cycles for the products of the addresses, then a
// request per cycle.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class ImageReader final : public Block {
public:
    struct Ports {
        Fifo<BracketedRay>& in;
        Fifo<MemoryRead>& requests;
        Fifo<MemoryWord>& answers;
        Fifo<RayWithLines>& out;
    };
    ImageReader(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "requested " + std::to_string(requested_) + " answered " + std::to_string(answered_);
    }
    static constexpr int words_of(RayKind kind) {
        return kind == RayKind::none ? 0 : kind == RayKind::plane ? 4 : kind == RayKind::foot ? 5 : 10;
    }

private:
    void send_request();
    void take(std::uint64_t word);
    const RegisterFile& registers_;
    Fifo<BracketedRay>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<MemoryWord>& answers_;
    Fifo<RayWithLines>& out_;
    int multiplying_ = 0;
    int requested_ = 0;
    int answered_ = 0;
    RayWithLines lined_;
};

}  // namespace rs::engine::model
