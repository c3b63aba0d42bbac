#pragma once
// Interface of everything that renders views of objects: the definition, the software core, a board. All give the
// definition's images of as_drawn(object), bit for bit. engine/executors/executor_table.hpp lists them.
//
// traits(), takes(), draws() and as_drawn() may be called from any thread at any time; all else from one thread at a
// time.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rs::engine {

struct ExecutorTraits {
    std::string name;
    bool depth = true;    // renders depth
    bool tilted = true;   // renders views of tilted cameras
    bool filters = true;  // supports all of TexelFilter; else only kBilinear
    int views_per_cycle = std::numeric_limits<int>::max();
};

struct SlotView {
    int slot = 0;
    ViewRegisters registers;
    bool depth = true;  // needed, if the executor gives it
};
inline Error no_object_in(int slot) {
    return Error{"slot " + std::to_string(slot) + " holds no object"};
}

struct ExecutedView {
    Image<Rgba8> image;
    Image<std::int32_t> depth_q20;  // axial, 0 where alpha is 0; empty where none is given or needed
};

class Executor {
public:
    Executor() = default;
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;
    virtual ~Executor() = default;

    [[nodiscard]] virtual const ExecutorTraits& traits() const = 0;
    // Success if it could load and render such an object with nothing else loaded; else the reason.
    [[nodiscard]] virtual Status takes(const RaySpaceObject& /*object*/) const { return {}; }
    // Success if it can render such a view of an object that it takes; else the reason.
    [[nodiscard]] virtual Status draws(const ViewRegisters& /*registers*/) const { return {}; }
    // The object as it is rendered: boards may store alpha in fewer bits.
    [[nodiscard]] virtual RaySpaceObject as_drawn(RaySpaceObject object) const { return object; }

    // The object's slot; nullopt if there is no room now. On an error nothing is loaded.
    virtual Result<std::optional<int>> load(const RaySpaceObject& object) = 0;
    // Frees a slot that no cycle uses.
    virtual Status evict(int slot) = 0;
    // A rendering cycle: one image per view. Fails as a whole.
    virtual Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) = 0;
};

}  // namespace rs::engine
