#include "engine/model/blocks/memory/memory_controller.hpp"

#include <algorithm>
#include <bit>

namespace rs::engine::model {

int MemoryController::window_cycles(const MemorySettings& settings) {
    const SdramTiming& t = settings.timing;
    return t.refresh_to_any + t.activate_to_column + settings.load_words_per_window + t.write_to_precharge +
           t.precharge_to_activate;
}

int MemoryController::read_cycles(const MemorySettings& settings) {
    return settings.timing.read_latency + settings.timing.interface_latency + 1;
}

MemoryController::MemoryController(std::string name, const MemorySettings& settings, Sdram& sdram, const Ports& ports)
    : Block(std::move(name), "a command per cycle; a read's word after " + std::to_string(read_cycles(settings)) +
                                 " cycles; " + std::to_string(window_cycles(settings)) +
                                 " cycles of maintenance behind the refresh every " +
                                 std::to_string(settings.maintenance_interval)),
      settings_(settings),
      sdram_(sdram),
      ports_(ports.read_ports),
      image_writes_(reads(ports.image_writes)),
      view_written_(writes(ports.view_written)),
      loads_(reads(ports.loads)),
      object_loaded_(writes(ports.object_loaded)),
      in_flight_(std::bit_ceil(static_cast<std::size_t>(read_cycles(settings)))),
      outstanding_(ports_.size()),
      next_window_(static_cast<std::uint64_t>(settings.maintenance_interval)) {
    for (const ReadPort& port : ports_) {
        reads(*port.requests);
        writes(*port.answers);
    }
    counters_.words_read.resize(ports_.size());
    counters_.nulls.resize(ports_.size());
}

Activity MemoryController::tick(std::uint64_t now) {
    deliver(now);
    if (window_ != Window::none || now >= next_window_) return maintain(now);
    if (chosen_ == kNoClient) choose_client();
    if (chosen_ == kNoClient) return starved_ ? Activity::output_full : Activity::idle;
    return serve(now);
}

void MemoryController::deliver(std::uint64_t now) {
    if (returned_ != kNoClient) --outstanding_[static_cast<std::size_t>(returned_)];
    InFlight& arriving = in_flight_[now & (in_flight_.size() - 1)];
    returned_ = arriving.port;
    if (arriving.port == kNoClient) return;
    ports_[static_cast<std::size_t>(arriving.port)].answers->push({arriving.data});
    arriving.port = kNoClient;
}

Activity MemoryController::maintain(std::uint64_t now) {
    const SdramTiming& t = settings_.timing;
    switch (window_) {
        case Window::none:
            window_ = Window::closing;
            next_window_ += static_cast<std::uint64_t>(settings_.maintenance_interval);
            ++counters_.windows;
            [[fallthrough]];
        case Window::closing:
            if (sdram_.allows(SdramCommand::precharge_all, 0, now)) {
                sdram_.issue(SdramCommand::precharge_all, 0, now);
                window_ = Window::refreshing;
            }
            return Activity::maintenance;
        case Window::refreshing:
            if (sdram_.allows(SdramCommand::refresh, 0, now)) {
                sdram_.issue(SdramCommand::refresh, 0, now);
                refreshed_ = now;
                load_row_open_ = false;
                window_ = Window::loading;
            }
            return Activity::maintenance;
        case Window::loading:
            break;
    }
    const auto at = static_cast<int>(now - refreshed_);
    const int first_word = t.refresh_to_any + t.activate_to_column;
    const int precharge = first_word + settings_.load_words_per_window + t.write_to_precharge;
    if (at == t.refresh_to_any && loads_.can_pop()) {
        sdram_.issue(SdramCommand::activate, loads_.front().address, now);
        load_row_open_ = true;
    }
    if (at >= first_word && at < first_word + settings_.load_words_per_window && load_row_open_) load_word(now);
    if (at == precharge && load_row_open_) sdram_.issue(SdramCommand::precharge_all, 0, now);
    if (at == precharge + t.precharge_to_activate - 1) window_ = Window::none;
    return Activity::maintenance;
}

void MemoryController::load_word(std::uint64_t now) {
    if (!loads_.can_pop()) return;
    const MemoryWrite& word = loads_.front();
    if (!sdram_.allows(SdramCommand::write, word.address, now)) return;  // another row: continues in the next window
    if (word.last) {
        if (!object_loaded_.can_push()) return;
        object_loaded_.push({});
    }
    sdram_.issue(SdramCommand::write, word.address, now);
    sdram_.set_word(word.address, word.data);
    ++counters_.load_words;
    loads_.pop();
}

void MemoryController::choose_client() {
    if (batch_left_ == 0 && image_writes_.count() >= settings_.write_batch) batch_left_ = settings_.write_batch;
    if (batch_left_ > 0 && image_writes_.can_pop()) {
        chosen_ = kImageWrite;
        counters_.write_batches += static_cast<std::uint64_t>(batch_left_ == settings_.write_batch);
        return;
    }
    batch_left_ = 0;
    starved_ = false;
    for (std::size_t n = 0; n < ports_.size(); ++n) {
        if (!ports_[n].requests->can_pop()) continue;
        if (ports_[n].answers->room() > outstanding_[n]) {
            chosen_ = static_cast<int>(n);
            return;
        }
        starved_ = true;
    }
    if (image_writes_.can_pop()) {
        batch_left_ = std::min(image_writes_.count(), settings_.write_batch);
        ++counters_.write_batches;
        chosen_ = kImageWrite;
    }
}

Activity MemoryController::serve(std::uint64_t now) {
    return chosen_ == kImageWrite ? serve_write(now) : serve_read(now);
}

Activity MemoryController::open_row(WordAddress address, std::uint64_t now) {
    const bool other_row = sdram_.is_open(sdram_.bank_of(address));
    const SdramCommand command = other_row ? SdramCommand::precharge : SdramCommand::activate;
    if (sdram_.allows(command, address, now)) {
        sdram_.issue(command, address, now);
        counters_.row_misses += static_cast<std::uint64_t>(!other_row);
    }
    return Activity::row_miss;
}

Activity MemoryController::serve_read(std::uint64_t now) {
    const auto n = static_cast<std::size_t>(chosen_);
    const MemoryRead& read = ports_[n].requests->front();
    std::uint64_t data = 0;
    if (!read.null) {
        if (!sdram_.has_row(sdram_.bank_of(read.address), sdram_.row_of(read.address)))
            return open_row(read.address, now);
        if (!sdram_.allows(SdramCommand::read, read.address, now)) return Activity::row_miss;
        sdram_.issue(SdramCommand::read, read.address, now);
        data = sdram_.word(read.address);
    }
    ++(read.null ? counters_.nulls : counters_.words_read)[n];
    ports_[n].requests->pop();
    ++outstanding_[n];
    const std::uint64_t arrives = now + static_cast<std::uint64_t>(read_cycles(settings_) - 1);
    in_flight_[arrives & (in_flight_.size() - 1)] = {chosen_, data};
    chosen_ = kNoClient;
    return Activity::busy;
}

Activity MemoryController::serve_write(std::uint64_t now) {
    const MemoryWrite& word = image_writes_.front();
    if (!sdram_.has_row(sdram_.bank_of(word.address), sdram_.row_of(word.address))) return open_row(word.address, now);
    if (!sdram_.allows(SdramCommand::write, word.address, now)) return Activity::turnaround;
    if (word.last) {
        if (!view_written_.can_push()) return Activity::output_full;
        view_written_.push({});
    }
    sdram_.issue(SdramCommand::write, word.address, now);
    sdram_.set_word(word.address, word.data);
    image_writes_.pop();
    ++counters_.image_words;
    --batch_left_;
    chosen_ = kNoClient;
    return Activity::busy;
}

std::string MemoryController::state_text() const {
    std::string text = chosen_ == kNoClient     ? "no client"
                       : chosen_ == kImageWrite ? "image write"
                                                : ports_[static_cast<std::size_t>(chosen_)].client;
    return "serves " + text + ", batch left " + std::to_string(batch_left_);
}

}  // namespace rs::engine::model
