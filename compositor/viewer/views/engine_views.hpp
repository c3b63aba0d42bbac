#pragma once
// The views of one frame on their way through the engine: in as many rendering cycles as they need, of which as many
// are under way at a time as the data module takes.

#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"

#include <deque>
#include <vector>

namespace rs::compositor {

// One thread; nobody else submits to the module meanwhile, which outlives this.
class EngineViews {
public:
    explicit EngineViews(engine::RenderSession& engine) : engine_(engine) {}
    EngineViews(const EngineViews&) = delete;
    EngineViews& operator=(const EngineViews&) = delete;
    ~EngineViews();  // waits for what is under way

    // Begins to draw; once. Fails where a view is refused, naming the object.
    Status submit(std::vector<engine::ViewRequest> views);
    // Waits for all of them, in the order of submit().
    Result<std::vector<engine::DrawnView>> retrieve();

private:
    Status submit_more();

    engine::RenderSession& engine_;
    std::vector<engine::ViewRequest> views_;
    std::size_t submitted_ = 0;
    std::deque<engine::CycleHandle> under_way_;
};

}  // namespace rs::compositor
