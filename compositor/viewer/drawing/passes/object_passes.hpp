#pragma once
// Passes of ray-space objects: the first requests their images from the engine, the second adds them to the frame.

#include "compositor/gpu/gpu_renderer.hpp"
#include "compositor/viewer/drawing/object_cartoon.hpp"
#include "compositor/viewer/drawing/object_renderer.hpp"
#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "compositor/viewer/drawing/placeholder_renderer.hpp"
#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace rs::compositor {

/// First pass of a frame: determines which objects are visible and submits their views to the engine, which renders
/// them while geometry is drawn.
///
/// The camera is transformed into each node's coordinates (equation 3); only the pixels that the node can cover are
/// requested.
class ObjectRequestPass {
public:
    /// \param depths request a depth per pixel
    /// \param may_defer views of a GPU are rendered by ObjectPass
    ObjectRequestPass(bool depths, bool may_defer) : depths_(depths), may_defer_(may_defer) {}
    /// Fails if the engine rejects a view; the error names the object.
    Status run(FrameContext& frame) const;

private:
    bool depths_;
    bool may_defer_;
};

/// Waits for the engine's images of the visible objects, uploads them or renders them on the GPU, and adds objects and
/// placeholders to the blended draws, each at the depth of its reference plane (object_view.hpp). Requires a current
/// gl::Context that outlives it; move-only.
class ObjectPass {
public:
    static Result<ObjectPass> create(std::size_t nodes, ObjectDepth depth,
                                     std::shared_ptr<const ObjectCartoon> cartoon);
    /// The pass must not move until the blended draws are done.
    Status run(FrameContext& frame);

private:
    ObjectPass(ObjectRenderer objects, PlaceholderRenderer placeholders, std::shared_ptr<const ObjectCartoon> cartoon)
        : objects_(std::move(objects)), placeholders_(std::move(placeholders)), cartoon_(std::move(cartoon)) {}
    void release_unloaded(const ObjectNodes& nodes);
    Status add_image(const VisibleNode& node, const engine::DrawnView& rendered, FrameContext& frame);
    Status upload(const VisibleNode& node, const engine::DrawnView& rendered, const FrameContext& frame);
    Status render(const VisibleNode& node, const DeferredGpuView& deferred);
    void draw(const VisibleNode& node, const FrameContext& frame) const;
    void add_placeholders(FrameContext& frame) const;

    ObjectRenderer objects_;
    PlaceholderRenderer placeholders_;
    std::shared_ptr<const ObjectCartoon> cartoon_;  // null: the look of the photos
    std::optional<GpuRenderer> gpu_;                // since the first deferred view
};

}  // namespace rs::compositor
