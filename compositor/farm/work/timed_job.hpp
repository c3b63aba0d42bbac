#pragma once
// Work of a known length that makes nothing, by which a farm's own pace is measured.

#include "compositor/farm/schedule/worker.hpp"

namespace rs::farm {

// Items "0", "1", ... that sleep `seconds` each, 0: that end at once. Sizes fall, so that they come in this order.
std::vector<Item> timed_items(int count, double seconds);

// For Worker.
BeginJob begin_timed_jobs();

}  // namespace rs::farm
