#pragma once
// A traced image that is there at once and gets better while nobody moves (progression.hpp), in a thread of its own.
//
//     begin(camera) -> first grid -> finer grids -> pass 1 -> pass 2 -> ... until end()
//
// The first image of a view is always finished, so that somebody who moves all the time sees where he goes.

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

// All functions may be called from one other thread than its own, and return at once.
class Refinement {
public:
    // `make` is called in the thread, at once: it may take its time.
    explicit Refinement(std::function<Result<TracedRenderer>()> make, Clock clock = steady_clock_s);
    Refinement(const Refinement&) = delete;
    Refinement& operator=(const Refinement&) = delete;
    ~Refinement();  // waits for what is under way: the making, a tile or two, a pass's virtual lights

    // Drops what was begun before, but for its first image.
    void begin(const Camera& camera, TracedMethod method = TracedMethod::kPath);
    // Other light from now on (TracedRenderer::set_lights); begin() must follow.
    struct Lighting {
        std::shared_ptr<const Scene> scene;
        double exposure_ev = 0;
    };
    void set_lights(Lighting lighting);
    void end();

    struct Step {
        std::shared_ptr<const Image<Rgba8>> image;  // of the camera's size
        Camera camera;
        int passes = 0;  // 0: of a coarse grid, or the first image of a view that was begun before the last
    };
    // The newest image; nothing where there is none since the last call. After the first image of a view tracing
    // goes on with the call after that which has taken it, so that the processors are free to draw it.
    std::optional<Step> take();
    // Why there will be no images; nothing where there will.
    [[nodiscard]] std::optional<Error> failure();

private:
    void work(const std::function<Result<TracedRenderer>()>& make);
    void publish(Image<Rgba8> image, const Camera& camera, int passes);
    static double steady_clock_s();
    void drop_view();

    std::mutex mutex_;
    std::condition_variable changed_;
    struct View {
        Camera camera;
        TracedMethod method;
    };
    std::optional<View> requested_;     // not yet begun
    std::optional<Lighting> lighting_;  // not yet taken over
    std::optional<Step> newest_;
    std::optional<Error> failure_;
    bool leaving_ = false;
    // How far the first image of what is under way has come.
    enum class First { kNotThere, kThere, kTaken, kDrawn };
    First first_ = First::kDrawn;
    Clock clock_;
    FirstGrid grid_;  // of the thread
    std::atomic<bool> stop_{false};
    std::thread thread_;  // the last member: it uses all others
};

}  // namespace rs::compositor
