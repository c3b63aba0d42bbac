#include "engine/model/blocks/host_dma.hpp"

namespace rs::engine::model {

HostDma::HostDma(const RegisterFile& registers, Fifo<Done>& images_ready, Fifo<MemoryRead>& requests,
                 Fifo<MemoryWord>& answers, CrossingFifo<ImageWord>& words, CrossingFifo<Done>& transferred,
                 Fifo<Done>& buffer_free)
    : Block("host_dma", "a request and a word per cycle"),
      registers_(registers),
      images_ready_(reads(images_ready)),
      requests_(writes(requests)),
      answers_(reads(answers)),
      words_(writes(words)),
      transferred_(reads(transferred)),
      buffer_free_(writes(buffer_free)) {}

void HostDma::begin_view() {
    head_sent_ = false;
    to_ask_ = to_send_ = sizes_words()[static_cast<std::size_t>(view_)];
    address_ = registers_.image(buffer_, view_);
}

Activity HostDma::tick(std::uint64_t) {
    if (!active_) {
        if (!images_ready_.can_pop()) return Activity::idle;
        buffer_ = images_ready_.pop().number;
        view_ = 0;
        begin_view();
        active_ = true;
        return Activity::busy;
    }
    const auto views = static_cast<int>(sizes_words().size());
    if (view_ == views) {  // all sent; wait for the bus
        if (!transferred_.can_pop()) return Activity::output_full;
        if (!buffer_free_.can_push()) return Activity::output_full;
        transferred_.pop();
        buffer_free_.push({buffer_});
        active_ = false;
        return Activity::busy;
    }
    if (!head_sent_) {
        if (!words_.can_push()) return Activity::output_full;
        words_.push({static_cast<std::uint64_t>(to_send_) | static_cast<std::uint64_t>(view_) << 32U, true,
                     view_ + 1 == views});
        head_sent_ = true;
        return Activity::busy;
    }
    Activity activity = to_ask_ > 0 ? Activity::memory_port : Activity::memory_data;
    if (to_ask_ > 0 && requests_.can_push()) {
        requests_.push({address_++, false});
        --to_ask_;
        activity = Activity::busy;
    }
    if (answers_.can_pop()) {
        if (!words_.can_push()) return activity == Activity::busy ? activity : Activity::output_full;
        words_.push({answers_.pop().data, false, false});
        activity = Activity::busy;
        if (--to_send_ == 0) {
            ++view_;
            if (view_ < views) begin_view();
        }
    }
    return activity;
}

std::string HostDma::state_text() const {
    if (!active_) return "no buffer";
    return "buffer " + std::to_string(buffer_) + " view " + std::to_string(view_) + ", to ask " +
           std::to_string(to_ask_) + ", to send " + std::to_string(to_send_);
}

}  // namespace rs::engine::model
