#pragma once
// Traced images of several cameras of a still scene (walls, and the eyes before them) by one tracer, which traces them
// in turns: each with 1 pass, then each with 4, 16, ... The repeated passes cost a third of the time, and the memory is
// that of one tracer.

#include "compositor/scene/scene.hpp"
#include "compositor/traced/refinement.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/showroom.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace rs::compositor {

// One thread.
class TracedWalls {
public:
    TracedWalls(std::shared_ptr<const Scene> scene, TracedOptions options)
        : scene_(std::move(scene)), options_(std::move(options)) {}

    /// Begins or continues to trace the cameras. If one of them has moved, all images are dropped. Fails if the scene
    /// cannot be traced.
    /// \return an image has changed or was dropped
    Result<bool> refine(const std::vector<Camera>& cameras, const Showroom& showroom);
    /// Drops all images.
    void stop();
    /// Drop the images if they change something.
    void set_method(TracedMethod method);
    void set_scene(std::shared_ptr<const Scene> scene, double exposure_ev);

    /// Newest image of a camera, of its size; null before the first one.
    [[nodiscard]] std::shared_ptr<const Image<Rgba8>> image(std::size_t camera) const {
        return camera < views_.size() ? views_[camera].image : nullptr;
    }
    /// Passes of the image with the fewest; 0 if one is missing or a coarse grid.
    [[nodiscard]] int passes() const;

private:
    void make_tracer(const Showroom& showroom);
    bool take(const Refinement::Step& step);

    std::shared_ptr<const Scene> scene_;
    TracedOptions options_;
    std::optional<Refinement> refinement_;
    std::size_t traced_objects_ = 0;  // that the tracer was made with
    struct View {
        Camera camera;
        std::shared_ptr<const Image<Rgba8>> image = nullptr;
        int passes = 0;
    };
    std::vector<View> views_;
    std::size_t turn_ = 0;  // view that is traced
    int turn_passes_ = 1;   // passes of each view in this round
};

}  // namespace rs::compositor
