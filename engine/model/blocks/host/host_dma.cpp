#include "engine/model/blocks/host/host_dma.hpp"

namespace rs::engine::model {

HostDma::HostDma(const RegisterFile& registers, const Ports& ports)
    : Block("host_dma", "a request and a word per cycle"),
      registers_(registers),
      images_ready_(reads(ports.images_ready)),
      channels_(declare_ports(ports.channels)),
      words_(writes(ports.words)),
      transferred_(reads(ports.transferred)),
      buffer_free_(writes(ports.buffer_free)) {}

std::vector<DmaPort> HostDma::declare_ports(std::vector<DmaPort> channels) {
    for (const DmaPort& channel : channels) {
        writes(*channel.requests);
        reads(*channel.answers);
    }
    return channels;
}

void HostDma::begin_view() {
    head_sent_ = false;
    to_request_ = to_send_ = sizes_words()[static_cast<std::size_t>(view_)];
    address_ = registers_.image(buffer_, view_);
    column_ = in_column_ = 0;
}

bool HostDma::send_request() {
    const auto channel = static_cast<std::size_t>(stripe_owner(view_, column_, static_cast<int>(channels_.size())));
    if (channel != channel_ && to_request_ < to_send_) return false;  // words of another channel are outstanding
    if (!channels_[channel].requests->can_push()) return false;
    channel_ = channel;
    channels_[channel].requests->push({address_++, false});
    --to_request_;
    const int pitch = registers_.buffer_pitches[static_cast<std::size_t>(buffer_)][static_cast<std::size_t>(view_)];
    if (++in_column_ == pitch) {
        in_column_ = 0;
        ++column_;
    }
    return true;
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
    if (view_ == views) {  // all words sent; wait for the bus
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
    Activity activity = to_request_ > 0 ? Activity::memory_port : Activity::memory_data;
    // The channel of the answers must be selected before the next request changes it.
    Fifo<MemoryWord>& answers = *channels_[channel_].answers;
    if (to_request_ > 0 && send_request()) activity = Activity::busy;
    if (answers.can_pop()) {
        if (!words_.can_push()) return activity == Activity::busy ? activity : Activity::output_full;
        words_.push({answers.pop().data, false, false});
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
    return "buffer " + std::to_string(buffer_) + " view " + std::to_string(view_) + ", to request " +
           std::to_string(to_request_) + ", to send " + std::to_string(to_send_);
}

}  // namespace rs::engine::model
