#include "engine/model/blocks/parallel/dispatch.hpp"

#include <algorithm>

namespace rs::engine::model {

ViewDispatcher::ViewDispatcher(const RegisterFile& registers, const Ports& ports)
    : Block("view_dispatcher", "a view's start and a view's end per cycle"),
      registers_(registers),
      in_(reads(ports.in)),
      pipes_(ports.pipes),
      view_written_(writes(ports.view_written)),
      begun_(pipes_.size()),
      written_(pipes_.size()) {
    for (const DispatchPort& pipe : pipes_) {
        writes(*pipe.columns);
        writes(*pipe.pixels);
        writes(*pipe.books);
        reads(*pipe.written);
    }
}

bool ViewDispatcher::begin_view() {
    if (!in_.can_pop()) return false;
    const bool room = std::all_of(pipes_.begin(), pipes_.end(), [](const DispatchPort& pipe) {
        return pipe.columns->can_push() && pipe.pixels->can_push() && pipe.books->can_push();
    });
    if (!room) return false;
    const ViewJob job = in_.pop();
    std::vector<std::uint64_t> ends(pipes_.size());
    for (std::size_t n = 0; n < pipes_.size(); ++n) {
        const StripeShare share{static_cast<int>(n), static_cast<int>(pipes_.size())};
        if (!share.has_columns(job.view, registers_.view(job.view).width)) continue;
        pipes_[n].columns->push(job);
        pipes_[n].pixels->push(job);
        pipes_[n].books->push(job);
        ends[n] = ++begun_[n];
    }
    views_.push_back(std::move(ends));
    return true;
}

bool ViewDispatcher::end_view() {
    if (views_.empty() || !view_written_.can_push()) return false;
    for (std::size_t n = 0; n < pipes_.size(); ++n) {
        if (written_[n] < views_.front()[n]) return false;
    }
    view_written_.push({});
    views_.pop_front();
    return true;
}

Activity ViewDispatcher::tick(std::uint64_t) {
    bool busy = end_view();
    for (std::size_t n = 0; n < pipes_.size(); ++n) {
        if (!pipes_[n].written->can_pop()) continue;
        pipes_[n].written->pop();
        ++written_[n];
        busy = true;
    }
    busy |= begin_view();
    if (busy) return Activity::busy;
    return in_.can_pop() ? Activity::output_full : Activity::idle;
}

LoadBroadcast::LoadBroadcast(const Ports& ports)
    : Block("load_broadcast", "a word per cycle, to all channels"),
      in_(reads(ports.in)),
      channels_(ports.channels),
      loaded_(writes(ports.loaded)) {
    for (const LoadPort& channel : channels_) {
        writes(*channel.words);
        reads(*channel.loaded);
    }
}

Activity LoadBroadcast::tick(std::uint64_t) {
    bool busy = false;
    const auto all = [&](auto&& holds) { return std::all_of(channels_.begin(), channels_.end(), holds); };
    if (loaded_.can_push() && all([](const LoadPort& c) { return c.loaded->can_pop(); })) {
        for (const LoadPort& channel : channels_) channel.loaded->pop();
        loaded_.push({});
        busy = true;
    }
    if (in_.can_pop() && all([](const LoadPort& c) { return c.words->can_push(); })) {
        const MemoryWrite word = in_.pop();
        for (const LoadPort& channel : channels_) channel.words->push(word);
        busy = true;
    }
    if (busy) return Activity::busy;
    return in_.can_pop() ? Activity::output_full : Activity::idle;
}

}  // namespace rs::engine::model
