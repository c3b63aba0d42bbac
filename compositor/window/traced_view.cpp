#include "compositor/window/traced_view.hpp"

#include <utility>
#include <vector>

namespace rs::compositor {

void TracedView::set_lights(const Lighting& lighting) {
    if (refinement_) refinement_->set_lights(lighting);
    relit_ = true;
}

void TracedView::drop(FrameCompositor& compositor) {
    if (traced_) compositor.set_traced(nullptr);
    traced_.reset();
    refinement_.reset();
}

void TracedView::make_tracer(const Showroom& showroom, const std::function<Lighting()>& lighting) {
    // Objects come and go while the camera moves; the tracer has those that were in memory when it was made.
    std::vector<PlacedObject> objects = showroom.placed();
    if (refinement_ && traced_objects_ == objects.size()) return;
    traced_objects_ = objects.size();
    const Lighting now = lighting();
    TracedOptions options = options_;
    options.exposure_ev = now.exposure_ev;
    auto make = [scene = now.scene, options, objects = std::move(objects)] {
        return TracedRenderer::create(*scene, objects, options);
    };
    refinement_.emplace(std::move(make), Refinement::steady_clock_s, first_grid_cells_);
}

void TracedView::prepare_when_idle(const Camera& camera, double seconds, const Showroom& showroom,
                                   std::size_t object_count, const std::function<Lighting()>& lighting) {
    constexpr double kIdle_s = 1;
    idle_s_ = camera.world_from_camera == idle_camera_.world_from_camera ? idle_s_ + seconds : 0;
    idle_camera_ = camera;
    if (refinement_ || idle_s_ < kIdle_s || !showroom.settled()) return;
    if (showroom.placed().size() == object_count) make_tracer(showroom, lighting);
}

void TracedView::stop(FrameCompositor& compositor) {
    if (!traced_) return;
    refinement_->end();
    traced_.reset();
    compositor.set_traced(nullptr);
}

Result<bool> TracedView::refine(const Camera& camera, TracedMethod method, const Showroom& showroom,
                                const std::function<Lighting()>& lighting, FrameCompositor& compositor) {
    if (!traced_) make_tracer(showroom, lighting);
    if (const std::optional<Error> failed = refinement_->failure()) {
        traced_.reset();
        return *failed;
    }
    const bool other_image = !traced_ || traced_->camera.width != camera.width ||
                             traced_->camera.height != camera.height || traced_->method != method;
    const bool moved = !other_image && traced_->camera.world_from_camera != camera.world_from_camera;
    if (other_image || moved || relit_) {
        traced_ = View{camera, method};
        refinement_->begin(camera, method);
        passes_ = 0;
    }
    if (other_image) {
        compositor.set_traced(nullptr);
        image_camera_ = camera;
    }
    const bool draws_anew = other_image || std::exchange(relit_, false);
    const std::optional<Refinement::Step> step = refinement_->take();
    if (!step || step->camera.width != camera.width || step->camera.height != camera.height) return draws_anew;
    passes_ = step->passes;
    image_camera_ = step->camera;
    compositor.set_traced(step->image, step->irradiance);
    return true;
}

}  // namespace rs::compositor
