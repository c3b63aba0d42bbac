#pragma once
// Progressive tracing on a background thread (progression.hpp).
//
//     begin(camera) -> first grid -> finer grids -> pass 1 -> pass 2 -> ... until end()
//
// The first image of a view is always completed, so that continuous movement still shows images.

#include "compositor/traced/progression.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/image/image.hpp"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace rs::compositor {

/// All functions may be called from one thread other than the internal one; they return at once.
class Refinement {
public:
    static double steady_clock_s();

    /// `make` is called on the internal thread and may take long.
    /// \param first_grid_cells of FirstGridSelector
    explicit Refinement(std::function<Result<TracedRenderer>()> make, Clock clock = steady_clock_s,
                        std::optional<int> first_grid_cells = {});
    Refinement(const Refinement&) = delete;
    Refinement& operator=(const Refinement&) = delete;
    ~Refinement();  // waits for `make`, a few tiles, or the virtual lights of a pass

    /// Cancels the previous view after its first image.
    void begin(const Camera& camera, TracedMethod method = TracedMethod::kPath);
    /// Changes the lights (TracedRenderer::set_lights); begin() must follow.
    struct Lighting {
        std::shared_ptr<const Scene> scene;
        double exposure_ev = 0;
    };
    void set_lights(Lighting lighting);
    void end();

    struct Step {
        std::shared_ptr<const Image<Rgba8>> image;  // of the camera's size
        Camera camera;
        int passes = 0;                                        // 0: coarse grid, or first image of a cancelled view
        std::shared_ptr<const LocalIrradiances> irradiance{};  // TracedRenderer::object_irradiance()
    };
    /// Newest image, or nullopt if there is none since the last call. After the first image of a view tracing pauses
    /// until the call after the one that returned it, so that the CPU is free to draw it.
    std::optional<Step> take();
    /// Error that prevents all images, if any.
    [[nodiscard]] std::optional<Error> failure();

private:
    void work(const std::function<Result<TracedRenderer>()>& make);
    void publish(Step step);
    void drop_view();

    std::mutex mutex_;
    std::condition_variable changed_;
    struct View {
        Camera camera;
        TracedMethod method;
    };
    std::optional<View> requested_;     // not started yet
    std::optional<Lighting> lighting_;  // not applied yet
    std::optional<Step> newest_;
    std::optional<Error> failure_;
    bool stopping_ = false;
    // State of the first image of the current view.
    enum class FirstImage { kPending, kReady, kTaken, kDrawn };
    FirstImage first_ = FirstImage::kDrawn;
    Clock clock_;
    FirstGridSelector grid_;  // used by the thread
    std::atomic<bool> stop_{false};
    std::thread thread_;  // last member: the thread uses all others
};

}  // namespace rs::compositor
