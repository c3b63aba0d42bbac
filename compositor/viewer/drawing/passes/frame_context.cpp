#include "compositor/viewer/drawing/passes/frame_context.hpp"

#include "compositor/gl/draw.hpp"

#include <utility>

namespace rs::compositor {

double PartClock::lap() {
    if (waits_) gl::finish();
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
}

}  // namespace rs::compositor
