#pragma once
// RS map reader: one byte of the map is the captured image of the column; 255: none. One column at a time: request,
// wait, select the byte.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

namespace rs::engine::model {

inline constexpr int kNoImageByte = 255;

class MapReader final : public Block {
public:
    struct Ports {
        Fifo<RayPoint>& in;
        Fifo<MemoryRead>& requests;
        Fifo<MemoryWord>& answers;
        Fifo<MappedRay>& out;
    };
    explicit MapReader(const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return requested_ ? "requested" : "not requested"; }

private:
    Fifo<RayPoint>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<MemoryWord>& answers_;
    Fifo<MappedRay>& out_;
    bool requested_ = false;
};

}  // namespace rs::engine::model
