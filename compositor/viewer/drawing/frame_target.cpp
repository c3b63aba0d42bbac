#include "compositor/viewer/drawing/frame_target.hpp"

#include <utility>

namespace rs::compositor {

Result<FrameTarget> FrameTarget::create(int width, int height, int samples) {
    RS_ASSIGN_OR_RETURN(auto drawn, gl::Framebuffer::create(width, height, samples));
    if (drawn.samples() == 1) return FrameTarget{std::move(drawn), std::nullopt};
    RS_ASSIGN_OR_RETURN(auto resolved, gl::Framebuffer::create(width, height, 1));
    return FrameTarget{std::move(drawn), std::move(resolved)};
}

}  // namespace rs::compositor
