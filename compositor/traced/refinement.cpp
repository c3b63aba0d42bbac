#include "compositor/traced/refinement.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace rs::compositor {

Refinement::Refinement(std::function<Result<TracedRenderer>()> make, Clock clock, std::optional<int> first_grid_cells)
    : clock_(std::move(clock)),
      grid_(FirstGridSelector::kTimeLimit_s, first_grid_cells),
      thread_([this, made = std::move(make)] { work(made); }) {}

Refinement::~Refinement() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

double Refinement::steady_clock_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Cancels the current view once its first image is complete.
void Refinement::drop_view() {
    if (newest_) newest_->passes = 0;
    if (first_ != FirstImage::kPending) stop_ = true;
}

void Refinement::begin(const Camera& camera, TracedMethod method) {
    {
        const std::lock_guard lock(mutex_);
        requested_ = View{camera, method};
        drop_view();
    }
    changed_.notify_all();
}

void Refinement::set_lights(Lighting lighting) {
    {
        const std::lock_guard lock(mutex_);
        lighting_ = std::move(lighting);
        requested_.reset();
        drop_view();
    }
    changed_.notify_all();
}

void Refinement::end() {
    {
        const std::lock_guard lock(mutex_);
        requested_.reset();
        newest_.reset();
        stop_ = true;
    }
    changed_.notify_all();
}

std::optional<Refinement::Step> Refinement::take() {
    {
        const std::lock_guard lock(mutex_);
        if (newest_) {
            if (first_ == FirstImage::kReady) first_ = FirstImage::kTaken;
            return std::exchange(newest_, std::nullopt);
        }
        if (first_ != FirstImage::kTaken) return std::nullopt;
        first_ = FirstImage::kDrawn;
    }
    changed_.notify_all();
    return std::nullopt;
}

std::optional<Error> Refinement::failure() {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void Refinement::publish(Step step) {
    std::unique_lock lock(mutex_);
    const bool outdated = requested_ || lighting_;
    if (outdated) step.passes = 0;
    if (!stop_) newest_ = std::move(step);
    if (outdated) stop_ = true;
    if (first_ != FirstImage::kPending) return;
    first_ = FirstImage::kReady;
    changed_.wait(lock,
                  [this] { return stop_ || stopping_ || requested_ || lighting_ || first_ == FirstImage::kDrawn; });
}

void Refinement::work(const std::function<Result<TracedRenderer>()>& make) {
    try {
        Result<TracedRenderer> made = make();
        if (!made) {
            const std::lock_guard lock(mutex_);
            failure_ = made.error();
            return;
        }
        for (;;) {
            View view;
            std::optional<Lighting> lighting;
            {
                std::unique_lock lock(mutex_);
                changed_.wait(lock, [this] { return stopping_ || requested_; });
                if (stopping_) return;
                view = *std::exchange(requested_, std::nullopt);
                lighting = std::exchange(lighting_, std::nullopt);
                stop_ = false;
                first_ = FirstImage::kPending;
            }
            if (lighting) made->set_lights(*lighting->scene, lighting->exposure_ev);
            made->set_method(view.method);
            refine(*made, view.camera, grid_, clock_, stop_, [&](Image<Rgba8> image, int passes) {
                publish({std::make_shared<const Image<Rgba8>>(std::move(image)), view.camera, passes,
                         made->object_irradiance()});
            });
        }
    } catch (const std::exception& thrown) {
        const std::lock_guard lock(mutex_);
        failure_ = Error{std::string("tracing: ") + thrown.what()};
    }
}

}  // namespace rs::compositor
