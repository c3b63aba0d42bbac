#pragma once
// The software core as an executor: it takes every object and every view. It makes a Renderer of what it loads, and
// shares those that others have made.

#include "rayspace/api/types/executor.hpp"
#include "engine/core/fast/renderer.hpp"

#include <map>
#include <memory>

namespace rs::engine {

class CoreExecutor final : public Executor {
public:
    [[nodiscard]] const ExecutorTraits& traits() const override { return traits_; }

    // The slot of an object that is prepared already (not null); evict() releases it.
    int hold(std::shared_ptr<const Renderer> renderer);

    Result<std::optional<int>> load(const RaySpaceObject& object) override;
    Status evict(int slot) override;
    // Uses the threads of the calling tbb arena, as Renderer::render does.
    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override;

private:
    ExecutorTraits traits_{.name = "core"};
    std::map<int, std::shared_ptr<const Renderer>> held_;
    int next_slot_ = 0;
};

}  // namespace rs::engine
