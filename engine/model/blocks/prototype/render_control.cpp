#include "engine/model/blocks/prototype/render_control.hpp"

#include <algorithm>

namespace rs::engine::model {

RenderControl::RenderControl(const BoardConfig& config, RegisterFile& registers, const HostPrograms& programs,
                             const Ports& ports)
    : Block("render_control", "a command, a view's start and a view's end per cycle"),
      config_(config),
      registers_(registers),
      programs_(programs),
      commands_(reads(ports.commands)),
      jobs_(writes(ports.jobs)),
      view_written_(reads(ports.view_written)),
      images_ready_(writes(ports.images_ready)),
      buffer_free_(reads(ports.buffer_free)),
      object_ready_(reads(ports.object_ready)) {}

Activity RenderControl::tick(std::uint64_t now) {
    bool busy = take_command();
    if (buffer_free_.can_pop()) {
        buffer_busy_[buffer_free_.pop().number] = false;
        busy = true;
    }
    if (object_ready_.can_pop()) {
        const auto slot = static_cast<std::size_t>(object_ready_.pop().number);
        registers_.objects[slot] = registers_.loaded[slot];
        busy = true;
    }
    const bool was_rendering = rendering_;
    busy |= finish_views(now);
    // Registers of a new cycle become active in a cycle of their own, while all blocks that read them are empty.
    if (was_rendering) {
        if (rendering_ &&
            next_view_ < static_cast<int>(registers_.banks[static_cast<std::size_t>(registers_.active)].views.size()) &&
            jobs_.can_push()) {
            jobs_.push({next_view_++});
            busy = true;
        }
    } else {
        busy |= start_views(now);
    }
    if (busy) return Activity::busy;
    return queue_.empty() ? Activity::idle : rendering_ ? Activity::output_full : Activity::buffer_wait;
}

bool RenderControl::is_free(int bank) const {
    return std::none_of(queue_.begin(), queue_.end(), [&](const QueuedCycle& q) { return q.bank == bank; });
}

bool RenderControl::take_command() {
    if (!commands_.can_pop()) return false;
    const std::uint64_t number = commands_.pop().program;
    ++commands_taken_;
    const ViewBank& bank = programs_[number].bank;
    if (static_cast<int>(queue_.size()) >= config_.queue_cycles || !is_free(next_bank_)) {
        refusals_.push_back({number, "queue overrun: " + std::to_string(queue_.size()) +
                                         " rendering cycles are waiting or being rendered; wait for one"});
        return true;
    }
    if (bank.views.empty() || bank.views.size() > static_cast<std::size_t>(config_.limits.views_per_cycle)) {
        refusals_.push_back({number, "bad registers: " + std::to_string(bank.views.size()) + " views, outside 1.." +
                                         std::to_string(config_.limits.views_per_cycle)});
        return true;
    }
    for (std::size_t v = 0; v < bank.views.size(); ++v) {
        if (const std::string error = register_error(bank.views[v], registers_, config_.limits); !error.empty()) {
            refusals_.push_back({number, "bad registers: view " + std::to_string(v) + ": " + error});
            return true;
        }
    }
    registers_.banks[static_cast<std::size_t>(next_bank_)] = bank;
    queue_.push_back({number, next_bank_});
    next_bank_ ^= 1;
    return true;
}

bool RenderControl::finish_views(std::uint64_t now) {
    if (!rendering_ || !view_written_.can_pop()) return false;
    const int views = static_cast<int>(registers_.banks[static_cast<std::size_t>(registers_.active)].views.size());
    if (written_views_ + 1 == views && !images_ready_.can_push()) return false;
    view_written_.pop();
    if (++written_views_ < views) return true;
    images_ready_.push({registers_.active});
    cycles_.back().rendered = now;
    queue_.pop_front();
    rendering_ = false;
    return true;
}

bool RenderControl::start_views(std::uint64_t now) {
    if (queue_.empty() || buffer_busy_[queue_.front().bank]) return false;
    registers_.active = queue_.front().bank;
    buffer_busy_[registers_.active] = true;
    std::vector<int>& sizes = registers_.buffer_words[static_cast<std::size_t>(registers_.active)];
    std::vector<int>& pitches = registers_.buffer_pitches[static_cast<std::size_t>(registers_.active)];
    sizes.clear();
    pitches.clear();
    for (const BoardView& view : registers_.banks[static_cast<std::size_t>(registers_.active)].views) {
        sizes.push_back(view.words());
        pitches.push_back(view.words_per_column());
    }
    rendering_ = true;
    next_view_ = written_views_ = 0;
    cycles_.push_back({queue_.front().program, now, 0});
    ++cycles_begun_;
    if (cycles_.size() > kKeptCycles) cycles_.pop_front();
    return true;
}

bool RenderControl::uses_object(int slot) const {
    return std::any_of(queue_.begin(), queue_.end(), [&](const QueuedCycle& q) {
        const std::vector<BoardView>& views = registers_.banks[static_cast<std::size_t>(q.bank)].views;
        return std::any_of(views.begin(), views.end(), [&](const BoardView& v) { return v.object == slot; });
    });
}

std::string RenderControl::state_text() const {
    return std::string(rendering_ ? "rendering" : "waiting") + ", queued " + std::to_string(queue_.size()) +
           ", views started " + std::to_string(next_view_) + ", written " + std::to_string(written_views_) +
           ", buffers busy " + std::to_string(buffer_busy_[0]) + std::to_string(buffer_busy_[1]);
}

}  // namespace rs::engine::model
