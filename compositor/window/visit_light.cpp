// The light of a visit: what is edited, and the view that is traced while nobody moves.

#include "compositor/window/visit.hpp"

#include <utility>

namespace rs::compositor {

EditorView Visit::desk_view() {
    return {camera(), [this](const glm::dvec2& at) {
                return compositor_.surface_at(static_cast<int>(at.x), static_cast<int>(at.y));
            }};
}

Status Visit::relight() {
    desk_.update(desk_view());
    if (std::string news = desk_.take_message(); !news.empty()) report(news);
    if (!desk_.take_change()) return {};
    const double exposure_ev = desk_.edits().state().exposure_ev;
    if (refinement_) refinement_->set_lights({desk_.scene(), exposure_ev});
    relit_ = true;
    return compositor_.set_lights(*desk_.scene(), exposure_ev);
}

Status Visit::show(const glm::ivec2& size) {
    if (!desk_.is_open()) {
        compositor_.show_in_window(size.x, size.y);
        return {};
    }
    if (Status drawn = compositor_.draw_handles(desk_.strokes(camera())); !drawn) return drawn;
    compositor_.handles()->shown().show_in_window(size.x, size.y);
    return {};
}

std::shared_ptr<const Scene> Visit::scene_to_trace() const {
    if (!playback_) return desk_.scene();
    auto scene = std::make_shared<Scene>(playback_->scene());
    copy_lights(*desk_.scene(), *scene);
    return scene;
}

void Visit::make_tracer() {
    // Objects come and go while one walks; what is traced has those that were there when it began.
    if (refinement_ && traced_objects_ == showroom_->placed().size()) return;
    std::vector<PlacedObject> objects = showroom_->placed();
    traced_objects_ = objects.size();
    TracedOptions tracing = options_.tracing;
    tracing.exposure_ev = desk_.edits().state().exposure_ev;
    refinement_.emplace([scene = scene_to_trace(), tracing, there = std::move(objects)] {
        return TracedRenderer::create(*scene, there, tracing);
    });
}

void Visit::expect_tracing(const Camera& here, double seconds) {
    constexpr double kStill_s = 1;
    still_s_ = here.world_from_camera == still_at_.world_from_camera ? still_s_ + seconds : 0;
    still_at_ = here;
    if (refinement_ || playback_ || still_s_ < kStill_s || !showroom_->settled()) return;
    // Where all objects fit into memory: else others would have come by the time that it is needed.
    if (showroom_->placed().size() == names_.size()) make_tracer();
}

bool Visit::refine(const Camera& here) {
    if (!panel_.traced) {
        if (refined_) refinement_->end();
        const bool was_traced = std::exchange(refined_, std::nullopt).has_value();
        if (was_traced) compositor_.set_traced(nullptr);
        return true;
    }
    if (!refined_) make_tracer();
    if (const std::optional<Error> failed = refinement_->failure()) {
        panel_.traced = false;
        refined_.reset();
        report(failed->message);
        return true;
    }
    const bool otherwise =
        !refined_ || refined_->width != here.width || refined_->height != here.height || refined_by_ != panel_.method;
    const bool moved = !otherwise && refined_->world_from_camera != here.world_from_camera;
    if (otherwise || moved || relit_) {
        refined_ = here;
        refined_by_ = panel_.method;
        refinement_->begin(here, panel_.method);
        panel_.passes = 0;
    }
    if (otherwise) {
        compositor_.set_traced(nullptr);
        shown_from_ = here;
    }
    const bool anew = otherwise || std::exchange(relit_, false);
    const std::optional<Refinement::Step> step = refinement_->take();
    if (!step || step->camera.width != here.width || step->camera.height != here.height) return anew;
    panel_.passes = step->passes;
    shown_from_ = step->camera;
    compositor_.set_traced(step->image);
    return true;
}

}  // namespace rs::compositor
