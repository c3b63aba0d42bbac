#include "engine/model/blocks/parallel/load_broadcast.hpp"

#include <algorithm>

namespace rs::engine::model {

LoadBroadcast::LoadBroadcast(Fifo<MemoryWrite>& in, std::vector<LoadPort> channels, Fifo<Done>& loaded)
    : Block("load_broadcast", "a word per cycle, to all channels"),
      in_(reads(in)),
      channels_(std::move(channels)),
      loaded_(writes(loaded)) {
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
