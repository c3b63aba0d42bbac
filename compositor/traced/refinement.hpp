#pragma once
// A traced picture that is there at once and gets better while nobody moves: coarse grids first, each twice as fine as
// the one before, then a sample of each pixel at a time. What comes when is counted in pictures, never by the clock.
//
//     begin(camera) -> 16x16 pixels as one -> 8x8 -> 4x4 -> 2x2 -> pass 1 -> pass 2 -> ... until end()

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

// Works in a thread of its own; all functions may be called from one other thread and return at once.
class Refinement {
public:
    // `make` is called in the thread, at once: it may take its time.
    explicit Refinement(std::function<Result<TracedRenderer>()> make);
    Refinement(const Refinement&) = delete;
    Refinement& operator=(const Refinement&) = delete;
    ~Refinement();  // waits for what is under way, a tile or two

    // Drops what was begun before.
    void begin(const Camera& camera, TracedMethod method = TracedMethod::kPath);
    // Other light from now on (TracedRenderer::set_lights); begin() must follow.
    struct Lighting {
        std::shared_ptr<const Scene> scene;
        double exposure_ev = 0;
    };
    void set_lights(Lighting lighting);
    void end();

    struct Step {
        std::shared_ptr<const Image<Rgba8>> picture;  // of the camera's size
        int passes = 0;                               // 0: of a coarse grid
    };
    // The newest picture of what was begun last; nothing where there is none since the last call.
    std::optional<Step> take();
    // Why there will be no pictures; nothing where there will.
    [[nodiscard]] std::optional<Error> failure();

private:
    void work(const std::function<Result<TracedRenderer>()>& make);
    void refine(TracedRenderer& renderer, const Camera& camera);
    void publish(Image<Rgba8> picture, int passes);

    std::mutex mutex_;
    std::condition_variable changed_;
    struct View {
        Camera camera;
        TracedMethod method;
    };
    std::optional<View> wanted_;        // not yet begun
    std::optional<Lighting> lighting_;  // not yet taken over
    std::optional<Step> newest_;
    std::optional<Error> failure_;
    bool leaving_ = false;
    std::atomic<bool> stop_{false};
    std::thread thread_;  // the last member: it uses all others
};

}  // namespace rs::compositor
