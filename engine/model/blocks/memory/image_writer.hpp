#pragma once
// Image writer: packs two pixels into a word and writes the words of a view consecutively into the image buffer, column
// by column: pixel (i, j) of a view is half (j & 1) of word i * ceil(height / 2) + (j >> 1).

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class ImageWriter final : public Block {
public:
    struct Ports {
        Fifo<RgbaPixel>& in;
        Fifo<MemoryWrite>& out;
    };
    ImageWriter(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "words left " + std::to_string(left_); }

private:
    const RegisterFile& registers_;
    Fifo<RgbaPixel>& in_;
    Fifo<MemoryWrite>& out_;
    bool has_first_ = false;
    std::uint32_t first_ = 0;
    WordAddress address_ = 0;
    int left_ = 0;  // remaining words of the view
};

}  // namespace rs::engine::model
