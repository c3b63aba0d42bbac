#pragma once
// Host DMA, board side: reads a finished image buffer word by word and sends it to the bus, each image after a header
// with its size; frees the buffer when the bus has transferred the last word. If the columns of a view are spread over
// several channels (stripes.hpp), it requests the words of one stripe from its channel, and those of the next stripe
// after they have arrived.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"
#include "engine/model/signals/stripes.hpp"

#include <vector>

namespace rs::engine::model {

// Read port of the DMA to one memory channel.
struct DmaPort {
    Fifo<MemoryRead>* requests = nullptr;
    Fifo<MemoryWord>* answers = nullptr;
};

class HostDma final : public Block {
public:
    struct Ports {
        Fifo<Done>& images_ready;
        std::vector<DmaPort> channels;
        CrossingFifo<ImageWord>& words;
        CrossingFifo<Done>& transferred;
        Fifo<Done>& buffer_free;
    };
    HostDma(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override;

private:
    std::vector<DmaPort> declare_ports(std::vector<DmaPort> channels);
    void begin_view();
    bool send_request();
    [[nodiscard]] const std::vector<int>& sizes_words() const {
        return registers_.buffer_words[static_cast<std::size_t>(buffer_)];
    }

    const RegisterFile& registers_;
    Fifo<Done>& images_ready_;
    std::vector<DmaPort> channels_;
    CrossingFifo<ImageWord>& words_;
    CrossingFifo<Done>& transferred_;
    Fifo<Done>& buffer_free_;

    bool active_ = false;
    int buffer_ = 0;
    int view_ = 0;
    bool head_sent_ = false;
    WordAddress address_ = 0;
    int to_request_ = 0;
    int to_send_ = 0;
    int column_ = 0;  // of the next request
    int in_column_ = 0;
    std::size_t channel_ = 0;  // channel of the outstanding answers
};

}  // namespace rs::engine::model
