#pragma once
// What the data module needs of a hardware board: real, simulated (model/simulated_board.hpp), or behind a cable.
//
// takes(), draws() and as_drawn() may be called from any thread at any time; all else from one thread at a time (the
// data module's board thread).

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <optional>
#include <vector>

namespace rs::engine {

struct DeviceView {
    int slot = 0;
    ViewRegisters registers;
};

class BoardDevice {
public:
    BoardDevice() = default;
    BoardDevice(const BoardDevice&) = delete;
    BoardDevice& operator=(const BoardDevice&) = delete;
    virtual ~BoardDevice() = default;

    // Whether the board could hold and draw such an object, if it had nothing else; says why not.
    [[nodiscard]] virtual Status takes(const RaySpaceObject& object) const = 0;
    // Whether it could draw such a view of an object that it takes.
    [[nodiscard]] virtual Status draws(const ViewRegisters& registers) const = 0;
    // The object that it really draws: boards may hold alpha in fewer bits. Its pictures equal the definition's of
    // this.
    [[nodiscard]] virtual RaySpaceObject as_drawn(RaySpaceObject object) const = 0;
    [[nodiscard]] virtual int views_per_cycle() const = 0;

    // The object's slot; nothing where there is no room now. Fails where loading failed, with nothing loaded.
    virtual Result<std::optional<int>> load(const RaySpaceObject& object) = 0;
    // The slot is free again; no cycle uses it.
    virtual Status evict(int slot) = 0;
    // A rendering cycle: one picture per view. Fails as a whole.
    virtual Result<std::vector<Image<Rgba8>>> render(const std::vector<DeviceView>& views) = 0;
};

}  // namespace rs::engine
