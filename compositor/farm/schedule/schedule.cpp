#include "compositor/farm/schedule/schedule.hpp"

#include "rayspace/base/check.hpp"

#include <algorithm>

namespace rs::farm {

Schedule::Schedule(std::vector<Item> items) : items_(std::move(items)), places_(items_.size()) {
    for (std::size_t i = 0; i < items_.size(); ++i) {
        places_[i].awaited = items_[i].after.size();
        for (const std::size_t before : items_[i].after) {
            RS_CHECK(before < i);  // which leads one way
            places_[before].wakes.push_back(i);
        }
        if (places_[i].awaited == 0) ready_.emplace(items_[i].size, i);
    }
}

void Schedule::add_worker(int worker, const std::string& node, std::int64_t budget_bytes) {
    RS_CHECK(!seats_.contains(worker));
    seats_[worker].node = node;
    Node& there = nodes_[node];
    there.budget_bytes = there.budget_bytes == 0 ? budget_bytes : std::min(there.budget_bytes, budget_bytes);
}

std::optional<std::size_t> Schedule::next(int worker) {
    Seat& seat = seats_.at(worker);
    RS_CHECK(!seat.item);
    Node& node = nodes_.at(seat.node);
    const auto fits = [&](std::size_t item) {
        return node.running == 0 || items_[item].memory_bytes <= node.budget_bytes - node.used_bytes;
    };
    for (auto at = ready_.begin(); at != ready_.end(); ++at) {
        const std::size_t item = at->second;
        if (!fits(item)) {
            if (places_[item].passed_over >= kMostPassedOver) return std::nullopt;
            continue;
        }
        for (auto before = ready_.begin(); before != at; ++before) ++places_[before->second].passed_over;
        ready_.erase(at);
        seat.item = item;
        node.used_bytes += items_[item].memory_bytes;
        ++node.running;
        return item;
    }
    return std::nullopt;
}

void Schedule::finish(int worker) {
    Seat& seat = seats_.at(worker);
    RS_CHECK(seat.item.has_value());
    Node& node = nodes_.at(seat.node);
    node.used_bytes -= items_[*seat.item].memory_bytes;
    --node.running;
    seat.item.reset();
}

std::vector<std::size_t> Schedule::settle(std::size_t item, bool made) {
    std::vector<std::size_t> lost;
    std::vector<std::size_t> open{item};
    while (!open.empty()) {
        const std::size_t at = open.back();
        open.pop_back();
        if (places_[at].settled) continue;
        places_[at].settled = true;
        ++settled_;
        if (at != item) lost.push_back(at);
        for (const std::size_t after : places_[at].wakes) {
            if (!made) {
                open.push_back(after);
            } else if (--places_[after].awaited == 0 && !places_[after].settled) {
                ready_.emplace(items_[after].size, after);
            }
        }
    }
    return lost;
}

}  // namespace rs::farm
