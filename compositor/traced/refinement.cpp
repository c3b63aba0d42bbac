#include "compositor/traced/refinement.hpp"

#include <array>
#include <exception>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::array kGrids = {16, 8, 4, 2};
constexpr int kMostPasses = 65536;

}  // namespace

Refinement::Refinement(std::function<Result<TracedRenderer>()> make)
    : thread_([this, made = std::move(make)] { work(made); }) {}

Refinement::~Refinement() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void Refinement::begin(const Camera& camera, TracedMethod method) {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = View{camera, method};
        newest_.reset();
        stop_ = true;
    }
    changed_.notify_all();
}

void Refinement::set_lights(Lighting lighting) {
    const std::lock_guard lock(mutex_);
    lighting_ = std::move(lighting);
    wanted_.reset();
    newest_.reset();
    stop_ = true;
}

void Refinement::end() {
    const std::lock_guard lock(mutex_);
    wanted_.reset();
    newest_.reset();
    stop_ = true;
}

std::optional<Refinement::Step> Refinement::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(newest_, std::nullopt);
}

std::optional<Error> Refinement::failure() {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void Refinement::publish(Image<Rgba8> picture, int passes) {
    auto shared = std::make_shared<const Image<Rgba8>>(std::move(picture));
    const std::lock_guard lock(mutex_);
    if (!stop_) newest_ = Step{std::move(shared), passes};
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
                changed_.wait(lock, [this] { return leaving_ || wanted_; });
                if (leaving_) return;
                view = *std::exchange(wanted_, std::nullopt);
                lighting = std::exchange(lighting_, std::nullopt);
                stop_ = false;
            }
            if (lighting) made->set_lights(*lighting->scene, lighting->exposure_ev);
            made->set_method(view.method);
            refine(*made, view.camera);
        }
    } catch (const std::exception& thrown) {
        const std::lock_guard lock(mutex_);
        failure_ = Error{std::string("tracing: ") + thrown.what()};
    }
}

void Refinement::refine(TracedRenderer& renderer, const Camera& camera) {
    for (const int side : kGrids) {
        std::optional<Image<Rgba8>> coarse = renderer.coarse_picture(camera, side, &stop_);
        if (!coarse) return;
        publish(std::move(*coarse), 0);
    }
    renderer.look(camera);
    while (renderer.passes() < kMostPasses && renderer.add_pass(nullptr, &stop_)) {
        publish(renderer.picture(), renderer.passes());
    }
}

}  // namespace rs::compositor
