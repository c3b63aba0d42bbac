#include "compositor/viewer/drawing/passes/frame_context.hpp"

#include "compositor/gl/draw.hpp"

#include <utility>

namespace rs::compositor {

Result<FrameTarget> FrameTarget::create(int width, int height, int samples) {
    RS_ASSIGN_OR_RETURN(auto drawn, gl::Framebuffer::create(width, height, samples));
    if (drawn.samples() == 1) return FrameTarget{std::move(drawn), std::nullopt};
    RS_ASSIGN_OR_RETURN(auto resolved, gl::Framebuffer::create(width, height, 1));
    return FrameTarget{std::move(drawn), std::move(resolved)};
}

double PartClock::lap() {
    if (waits_) gl::finish();
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
}

}  // namespace rs::compositor
