#include "compositor/viewer/views/engine_views.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rs::compositor {

EngineViews::~EngineViews() {
    for (const engine::CycleHandle cycle : in_flight_) static_cast<void>(engine_.retrieve_views(cycle));
}

Status EngineViews::submit(std::vector<engine::ViewRequest> views) {
    views_ = std::move(views);
    return submit_more();
}

Status EngineViews::submit_more() {
    const engine::RenderSessionLimits& limits = engine_.limits();
    while (submitted_ < views_.size() && in_flight_.size() < static_cast<std::size_t>(limits.cycles_in_flight)) {
        const std::size_t count =
            std::min(views_.size() - submitted_, static_cast<std::size_t>(limits.views_per_cycle));
        const auto first = views_.begin() + static_cast<std::ptrdiff_t>(submitted_);
        RS_ASSIGN_OR_RETURN(const engine::CycleHandle cycle,
                            engine_.submit({first, first + static_cast<std::ptrdiff_t>(count)}));
        in_flight_.push_back(cycle);
        submitted_ += count;
    }
    return {};
}

Result<std::vector<engine::DrawnView>> EngineViews::retrieve() {
    std::vector<engine::DrawnView> all;
    while (!in_flight_.empty()) {
        Result<std::vector<engine::DrawnView>> drawn = engine_.retrieve_views(in_flight_.front());
        in_flight_.pop_front();
        if (!drawn) return drawn.error();
        std::move(drawn->begin(), drawn->end(), std::back_inserter(all));
        RS_TRY(submit_more());
    }
    return all;
}

}  // namespace rs::compositor
