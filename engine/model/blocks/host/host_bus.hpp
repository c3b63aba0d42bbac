#pragma once
// Host bus: PCI or PCI-X, with two masters: the host, which writes the registers of a rendering cycle and starts it,
// and the board, which writes images into host memory in bursts.
//
// A burst of W words of an image, 64 bits each, takes, in bus clocks:
//
//     grant_clocks | address | target_clocks | T times (wait_per_transfer | transfer) | turnaround
//
// with T = 2 W transfers of 32 bits, or W of 64 bits; with compression 2 half as many, rounded up.
// It is requested when its words have crossed to the bus clock (or are the rest of an image). A busy target answers
// with a retry: the master releases the bus for two clocks and requests the same words again; none is lost or
// duplicated. Register writes of the host alternate with bursts, so neither blocks the other. On a dedicated bus they
// go over another one and take their clocks beside the bursts.

#include "engine/model/blocks/host/host_program.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

#include <deque>

namespace rs::engine::model {

class HostBus final : public Block {
public:
    struct Ports {
        CrossingFifo<ImageWord>& words;
        CrossingFifo<StartCommand>& commands;
        CrossingFifo<Done>& transferred;
    };
    HostBus(const PciSettings& settings, const HostPrograms& programs, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override;

    [[nodiscard]] const std::deque<HostImage>& images() const { return images_; }
    std::deque<HostImage>& images() { return images_; }
    struct Counters {
        std::uint64_t bursts = 0;
        std::uint64_t retries = 0;
        std::uint64_t register_writes = 0;
        std::uint64_t image_bytes = 0;  // on the bus
    };
    [[nodiscard]] const Counters& counters() const { return counters_; }
    // Transfers of a burst of `words` words of an image.
    static int burst_transfers(const PciSettings& settings, int words);
    // Bus clocks of a complete burst of `words` words of an image.
    static int burst_clocks(const PciSettings& settings, int words);
    // Bus clocks that an image of `words` words takes when the board always has words: bursts and the driver's pause.
    static std::uint64_t image_clocks(const PciSettings& settings, std::uint64_t words);

private:
    enum class State { idle, grant, address, target, data, turnaround, register_write, interrupt };
    Activity advance(std::uint64_t now);
    Activity decide(std::uint64_t now);
    bool write_beside();
    bool finish_register_write();
    Activity transfer(std::uint64_t now);
    Activity after_burst();
    void enter(State state, int clocks);
    [[nodiscard]] bool burst_is_ready() const;

    PciSettings settings_;
    const HostPrograms& programs_;
    CrossingFifo<ImageWord>& words_;
    CrossingFifo<StartCommand>& commands_;
    CrossingFifo<Done>& transferred_;

    State state_ = State::idle;
    int left_ = 0;  // remaining clocks of the state
    bool host_was_last_ = false;
    std::uint64_t next_program_ = 0;
    int registers_left_ = -1;       // of the next program; -1: not begun
    int register_clocks_left_ = 0;  // of the register write on another bus; 0: none
    int words_left_ = 0;            // words left of the image
    int burst_words_left_ = 0;      // of them, words left of the burst
    int burst_left_ = 0;            // remaining transfers
    bool retry_ = false;
    Counters counters_;
    std::deque<HostImage> images_;
};

}  // namespace rs::engine::model
