#pragma once
// How much objects are wanted in memory. Pure; thread-safe.

#include <compare>
#include <limits>

namespace rs::compositor {

// How much an object is wanted; less is more. First its room counts, then its own distance; scene units.
struct LoadPriority {
    static constexpr double kAlways = -2;  // belongs to no room
    static constexpr double kHere = -1;    // the visitor is in its room
    double room = kAlways;                 // one of these, or how far its room is from where the visitor will be soon
    double distance = 0;
    double door = 0.5;  // what does not count as a difference of distances: a step or so
    double room_now = std::numeric_limits<double>::infinity();  // how far its room is from where the visitor is
    auto operator<=>(const LoadPriority&) const = default;
};
// Whether something that is in memory has to make room for something that is not: only where it is wanted clearly less,
// so that a visitor at a door does not make two rooms take turns.
bool gives_way(const LoadPriority& held, const LoadPriority& wanted);

}  // namespace rs::compositor
