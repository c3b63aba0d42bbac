#pragma once
// The traced image of a window: it refines while the view stands still, and the tracer is built in advance while the
// camera is idle, so that it is ready when traced light is switched on.

#include "compositor/scene/scene.hpp"
#include "compositor/traced/refinement.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "rayspace/geometry/camera.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace rs::compositor {

// One thread.
class TracedView {
public:
    /// The scene and the exposure to trace, as they are now.
    using Lighting = Refinement::Lighting;

    /// \param first_grid_cells of FirstGridSelector
    explicit TracedView(TracedOptions options, std::optional<int> first_grid_cells = {})
        : options_(std::move(options)), first_grid_cells_(first_grid_cells) {}

    /// The lights have changed; the view is traced again.
    void set_lights(const Lighting& lighting);
    /// The geometry has changed: the tracer is dropped, and so is its image in `compositor`.
    void drop(FrameCompositor& compositor);

    /// Builds the tracer in advance, if the camera has been idle for a second and all objects of the scene fit into
    /// memory; else others would have been loaded by the time that it is needed.
    /// \param seconds since the last call
    /// \param object_count of the scene
    void prepare_when_idle(const Camera& camera, double seconds, const Showroom& showroom, std::size_t object_count,
                           const std::function<Lighting()>& lighting);

    /// Begins or continues to trace the view, and gives the newest image to `compositor`. Fails if the scene cannot be
    /// traced; traced light is off then.
    /// \return the compositor's image has changed and must be drawn
    Result<bool> refine(const Camera& camera, TracedMethod method, const Showroom& showroom,
                        const std::function<Lighting()>& lighting, FrameCompositor& compositor);
    /// Switches back to rasterized geometry.
    void stop(FrameCompositor& compositor);

    [[nodiscard]] bool has_tracer() const { return refinement_.has_value(); }
    /// Passes of the image; 0 for a coarse grid.
    [[nodiscard]] int passes() const { return passes_; }
    /// The camera of the image that is shown, which lags behind one that moves; nullopt if nothing is traced.
    [[nodiscard]] std::optional<Camera> camera_of_image() const {
        return traced_ ? std::optional(image_camera_) : std::nullopt;
    }

private:
    void make_tracer(const Showroom& showroom, const std::function<Lighting()>& lighting);

    TracedOptions options_;
    std::optional<int> first_grid_cells_;
    std::optional<Refinement> refinement_;
    std::size_t traced_objects_ = 0;  // that the tracer was made with
    struct View {
        Camera camera;
        TracedMethod method;
    };
    std::optional<View> traced_;  // requested from the tracer
    Camera image_camera_;
    bool relit_ = false;  // since the view was begun
    int passes_ = 0;
    Camera idle_camera_;  // of the last frame
    double idle_s_ = 0;
};

}  // namespace rs::compositor
