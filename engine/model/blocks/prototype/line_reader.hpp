#pragma once
// Line reader: reads the four words of an image's camera and its line of the reference plane (ray_space_object.hpp,
// CapturedView and CapturedLine), which are stored in one record:
//
//     record of image p, words 2 (p (1 + K)) ..:  cx | cy << 32,  fl_y | height << 32,
//         then for plane k, words 2 (p (1 + K) + 1 + k) ..:  l0 | l1 << 32,  q0 | q1 << 32
//
// 9 cycles for the product of the address, four requests, four answers.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

class LineReader final : public Block {
public:
    struct Ports {
        Fifo<MappedRay>& in;
        Fifo<MemoryRead>& requests;
        Fifo<MemoryWord>& answers;
        Fifo<RayLine>& out;
    };
    LineReader(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "requested " + std::to_string(requested_) + " answered " + std::to_string(answered_);
    }

private:
    void send_request();
    const RegisterFile& registers_;
    Fifo<MappedRay>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<MemoryWord>& answers_;
    Fifo<RayLine>& out_;
    int multiplying_ = 0;
    int requested_ = 0;
    int answered_ = 0;
    std::array<std::uint64_t, 4> words_{};
};

}  // namespace rs::engine::model
