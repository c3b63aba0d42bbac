#pragma once
/// \file
/// Executor: interface of everything that renders views of objects, such as the definition, the software core, a board
/// or a class of your own. All give the images of engine/RECONSTRUCTION.md for as_rendered(object), bit for bit.
/// rs::api::ExecutorTable (rayspace/api/executor.hpp) creates executors by name.

#include "rayspace/api/types/image.hpp"
#include "rayspace/api/types/ray_space_object.hpp"
#include "rayspace/api/types/result.hpp"
#include "rayspace/api/types/view_registers.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rs::engine {

/// Capabilities of an executor.
struct ExecutorTraits {
    std::string name;                                       ///< as given to the tools
    bool depth = true;                                      ///< renders depth
    bool tilted = true;                                     ///< renders views of tilted cameras
    bool filters = true;                                    ///< supports all of TexelFilter; else only kBilinear
    int views_per_cycle = std::numeric_limits<int>::max();  ///< most views of one call of render()
};

/// A view that is to be rendered.
struct SlotView {
    int slot = 0;             ///< of the object, from Executor::load
    ViewRegisters registers;  ///< within the ranges of RECONSTRUCTION.md
    bool depth = true;        ///< depth is needed, if the executor has the trait
    bool may_defer = false;   ///< the caller accepts ExecutedView::deferred in place of images
};

/// Error of a slot that holds no object.
inline Error no_object_in(int slot) {
    return Error{"slot " + std::to_string(slot) + " holds no object"};
}

/// A view that the caller renders in its own graphics context, so that its image stays in that context. Executors of a
/// GPU derive from it.
class DeferredView {
public:
    DeferredView() = default;
    DeferredView(const DeferredView&) = delete;             ///< not copied
    DeferredView& operator=(const DeferredView&) = delete;  ///< not copied
    virtual ~DeferredView() = default;
};

/// A rendered view.
struct ExecutedView {
    Image<Rgba8> image;             ///< of the view's size; empty if deferred
    Image<std::int32_t> depth_q20;  ///< axial, object radii, 0 where alpha is 0; empty if not needed or not supported
    std::shared_ptr<const DeferredView> deferred = nullptr;  ///< only if SlotView::may_defer; null: see `image`
};

/// Renders views of objects. traits(), supports(), can_render() and as_rendered() may be called from any thread at any
/// time; everything else from one thread at a time.
class Executor {
public:
    Executor() = default;
    Executor(const Executor&) = delete;             ///< not copied
    Executor& operator=(const Executor&) = delete;  ///< not copied
    virtual ~Executor() = default;

    /// Capabilities; constant.
    [[nodiscard]] virtual const ExecutorTraits& traits() const = 0;
    /// Success if the executor could load and render the object with nothing else loaded; else the reason.
    [[nodiscard]] virtual Status supports(const RaySpaceObject& /*object*/) const { return {}; }
    /// Success if the executor can render the view of an object that it supports; else the reason.
    [[nodiscard]] virtual Status can_render(const ViewRegisters& /*registers*/) const { return {}; }
    /// The object with the precision in which it is rendered: boards may store alpha in fewer bits.
    [[nodiscard]] virtual RaySpaceObject as_rendered(RaySpaceObject object) const { return object; }

    /// Loads an object.
    /// \param object  supported; its photos may be present only in compressed form (RaySpaceObject::coded)
    /// \return its slot, or nullopt if there is no free memory now. On an error nothing is loaded.
    virtual Result<std::optional<int>> load(const RaySpaceObject& object) = 0;
    /// Frees a slot that no view is being rendered from.
    virtual Status evict(int slot) = 0;
    /// Renders a cycle of views, at most ExecutorTraits::views_per_cycle.
    /// \return one image per view, in their order; fails as a whole
    virtual Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) = 0;
};

}  // namespace rs::engine
