#pragma once
// Software core as an executor. Supports every object and every view. Creates a Renderer for each object that it loads,
// and can share existing renderers.

#include "engine/core/fast/renderer.hpp"
#include "rayspace/api/types/executor.hpp"

#include <map>
#include <memory>

namespace rs::engine {

class CoreExecutor final : public Executor {
public:
    [[nodiscard]] const ExecutorTraits& traits() const override { return traits_; }

    /// Adds an existing renderer (not null). \return its slot, which evict() releases
    int add(std::shared_ptr<const Renderer> renderer);

    Result<std::optional<int>> load(const RaySpaceObject& object) override;
    Status evict(int slot) override;
    /// Uses the threads of the calling tbb arena, as Renderer::render does.
    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override;

private:
    ExecutorTraits traits_{.name = "core"};
    std::map<int, std::shared_ptr<const Renderer>> renderers_;
    int next_slot_ = 0;
};

}  // namespace rs::engine
