#pragma once
// Which item comes next. Pure bookkeeping: no clock, no messages, no files.
//
// Of the items whose predecessors are made, the largest goes to the rank that is free, as list scheduling requires (R.
// Graham, "Bounds on Multiprocessing Timing Anomalies", 1969: at most 4/3 of the shortest time), if what it takes fits
// into the memory that is left of its node's budget; else the next smaller that does. An item that was passed over
// kMostPassedOver times is waited for. One that is larger than the budget has a node to itself.

#include "compositor/farm/schedule/item.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rs::farm {

inline constexpr int kMostPassedOver = 16;

// Not thread-safe. A worker has one item at a time.
class Schedule {
public:
    // `after` must name items of the list, and lead one way (checked).
    explicit Schedule(std::vector<Item> items);

    // Workers of the same node share its budget.
    void add_worker(int worker, const std::string& node, std::int64_t budget_bytes);
    // What the worker, which must be idle, begins; nothing: it waits.
    std::optional<std::size_t> next(int worker);
    // The worker is idle again, and its memory free.
    void finish(int worker);
    // Whether the item's result is there. The items that now can never be made, for those after it: they are settled.
    std::vector<std::size_t> settle(std::size_t item, bool made);

    [[nodiscard]] const std::vector<Item>& items() const { return items_; }
    [[nodiscard]] std::size_t settled() const { return settled_; }
    [[nodiscard]] bool done() const { return settled_ == items_.size(); }
    // Items that could begin if there was memory, or a worker.
    [[nodiscard]] std::size_t ready() const { return ready_.size(); }

private:
    struct Node {
        std::int64_t budget_bytes = 0;
        std::int64_t used_bytes = 0;
        int running = 0;
    };
    struct Seat {
        std::string node;
        std::optional<std::size_t> item;
    };
    struct Place {
        std::size_t awaited = 0;         // predecessors that are not made
        std::vector<std::size_t> wakes;  // successors
        int passed_over = 0;
        bool settled = false;
    };
    struct LargestFirst {
        bool operator()(const std::pair<double, std::size_t>& a, const std::pair<double, std::size_t>& b) const {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        }
    };

    std::vector<Item> items_;
    std::vector<Place> places_;
    std::set<std::pair<double, std::size_t>, LargestFirst> ready_;
    std::map<std::string, Node> nodes_;
    std::map<int, Seat> seats_;
    std::size_t settled_ = 0;
};

}  // namespace rs::farm
