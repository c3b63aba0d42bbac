#pragma once
// Host DMA, the board's half: reads a finished image buffer word by word and sends it across to the bus, each picture
// behind a head that says its size; frees the buffer when the bus has carried the last word.

#include "engine/model/clock/block.hpp"
#include "engine/model/messages.hpp"
#include "engine/model/registers.hpp"

namespace rs::engine::model {

class HostDma final : public Block {
public:
    HostDma(const RegisterFile& registers, Fifo<Done>& images_ready, Fifo<MemoryRead>& requests,
            Fifo<MemoryWord>& answers, CrossingFifo<ImageWord>& words, CrossingFifo<Done>& transferred,
            Fifo<Done>& buffer_free);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override;

private:
    void begin_view();
    [[nodiscard]] const std::vector<int>& sizes_words() const {
        return registers_.buffer_words[static_cast<std::size_t>(buffer_)];
    }

    const RegisterFile& registers_;
    Fifo<Done>& images_ready_;
    Fifo<MemoryRead>& requests_;
    Fifo<MemoryWord>& answers_;
    CrossingFifo<ImageWord>& words_;
    CrossingFifo<Done>& transferred_;
    Fifo<Done>& buffer_free_;

    bool active_ = false;
    int buffer_ = 0;
    int view_ = 0;
    bool head_sent_ = false;
    WordAddress address_ = 0;
    int to_ask_ = 0;
    int to_send_ = 0;
};

}  // namespace rs::engine::model
