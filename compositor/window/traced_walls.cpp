#include "compositor/window/traced_walls.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kPassesFactor = 4;      // from round to round
constexpr int kMaxTurnPasses = 4096;  // of the last round

bool is_same_view(const Camera& a, const Camera& b) {
    return a.world_from_camera == b.world_from_camera && a.width == b.width && a.height == b.height;
}

}  // namespace

void TracedWalls::make_tracer(const Showroom& showroom) {
    std::vector<PlacedObject> objects = showroom.placed();
    if (refinement_ && traced_objects_ == objects.size()) return;
    traced_objects_ = objects.size();
    views_.clear();
    refinement_.emplace([scene = scene_, options = options_, objects = std::move(objects)] {
        return TracedRenderer::create(*scene, objects, options);
    });
}

Result<bool> TracedWalls::refine(const std::vector<Camera>& cameras, const Showroom& showroom) {
    make_tracer(showroom);
    if (const std::optional<Error> failed = refinement_->failure()) return *failed;
    const auto is_traced = [](const View& view, const Camera& camera) { return is_same_view(view.camera, camera); };
    if (!std::ranges::equal(views_, cameras, is_traced)) {
        views_.clear();
        for (const Camera& camera : cameras) views_.push_back({camera});
        turn_ = 0;
        turn_passes_ = 1;
        refinement_->begin(cameras.front(), options_.method);
        return true;
    }
    const std::optional<Refinement::Step> step = refinement_->take();
    return step && take(*step);
}

// Keeps an image that is better than the one before, and begins the next turn at the end of one.
bool TracedWalls::take(const Refinement::Step& step) {
    View& view = views_[turn_];
    if (!is_same_view(step.camera, view.camera)) return false;  // of the turn before
    const bool is_better = !view.image || step.passes >= std::max(view.passes, 1);
    if (is_better) {
        view.image = step.image;
        view.passes = step.passes;
    }
    if (step.passes < turn_passes_) return is_better;
    if (++turn_ == views_.size()) {
        turn_ = 0;
        turn_passes_ *= kPassesFactor;
    }
    if (turn_passes_ > kMaxTurnPasses) {
        refinement_->end();
    } else {
        refinement_->begin(views_[turn_].camera, options_.method);
    }
    return is_better;
}

void TracedWalls::stop() {
    if (refinement_) refinement_->end();
    views_.clear();
}

void TracedWalls::set_method(TracedMethod method) {
    if (std::exchange(options_.method, method) != method) views_.clear();
}

void TracedWalls::set_scene(std::shared_ptr<const Scene> scene, double exposure_ev) {
    scene_ = std::move(scene);
    options_.exposure_ev = exposure_ev;
    refinement_.reset();
    views_.clear();
}

int TracedWalls::passes() const {
    if (views_.empty()) return 0;
    return std::ranges::min_element(views_, {}, &View::passes)->passes;
}

}  // namespace rs::compositor
