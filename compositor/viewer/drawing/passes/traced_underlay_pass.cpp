#include "compositor/viewer/drawing/passes/traced_underlay_pass.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/viewer/drawing/background_shaders.hpp"
#include "compositor/viewer/drawing/shaders.hpp"

namespace rs::compositor {

Result<TracedUnderlayPass> TracedUnderlayPass::create() {
    RS_ASSIGN_OR_RETURN(auto program,
                        gl::Program::create("traced image", shaders::kWholeFrameVertex, shaders::kImageFragment));
    return TracedUnderlayPass(std::move(program));
}

Status TracedUnderlayPass::run(FrameContext& frame) const {
    if (frame.traced == nullptr) return {};
    RS_CHECK(frame.traced->width() == frame.target.drawn.width() &&
             frame.traced->height() == frame.target.drawn.height());
    frame.background.draw(frame.view.camera, BackgroundArea::kWholeFrame);
    const gl::Texture texture(frame.traced->width(), frame.traced->height());
    texture.upload(frame.traced->view());
    texture.bind(1);
    gl::draw(program_, rectangle_,
             {.depth_test = false, .depth_write = false, .blending = gl::Blending::kOverPremultiplied});
    frame.geometry.surfaces().draw_fog(frame.view);
    return {};
}

}  // namespace rs::compositor
