#pragma once
// Renders the views of one frame through a render session, in as many cycles as they need; several cycles are in flight
// at a time.

#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"

#include <deque>
#include <vector>

namespace rs::compositor {

/// Single-threaded; nothing else may submit to the session, which must outlive this.
class EngineViews {
public:
    explicit EngineViews(engine::RenderSession& engine) : engine_(engine) {}
    EngineViews(const EngineViews&) = delete;
    EngineViews& operator=(const EngineViews&) = delete;
    ~EngineViews();  // waits for the cycles in flight

    /// Starts rendering; call it once. Fails if a view is rejected; the error names the object.
    Status submit(std::vector<engine::ViewRequest> views);
    /// Waits for all views; results are in the order of submit().
    Result<std::vector<engine::DrawnView>> retrieve();

private:
    Status submit_more();

    engine::RenderSession& engine_;
    std::vector<engine::ViewRequest> views_;
    std::size_t submitted_ = 0;
    std::deque<engine::CycleHandle> in_flight_;
};

}  // namespace rs::compositor
