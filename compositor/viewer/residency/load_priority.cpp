#include "compositor/viewer/residency/load_priority.hpp"

#include <algorithm>

namespace rs::compositor {
namespace {

constexpr double kFarther = 1.25;  // times as far: clearly farther

}  // namespace

bool gives_way(const LoadPriority& held, const LoadPriority& wanted) {
    if (held.room < wanted.room) return false;
    if (held.room == wanted.room) return held.distance > kFarther * wanted.distance + wanted.door;
    // A room that was left a moment ago is still near, wherever the visitor is bound for.
    return std::min(std::max(held.room, 0.0), held.room_now) > kFarther * std::max(wanted.room, 0.0) + wanted.door;
}

}  // namespace rs::compositor
