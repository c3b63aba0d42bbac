#include "compositor/viewer/drawing/displayed_nodes.hpp"

#include <limits>
#include <map>

namespace rs::compositor {

engine::PreparedObject prepared(const std::shared_ptr<const ViewableObject>& object) {
    engine::PreparedObject result;
    result.renderer = {object, &object->renderer};
    if (object->for_board) result.for_board = {object, object->for_board.get()};
    result.not_on_board = object->not_on_board;
    return result;
}

Result<std::shared_ptr<const DisplayedNodes>> load_all_nodes(const std::vector<PlacedObject>& objects,
                                                             engine::RenderSession& engine) {
    const auto nodes = std::make_shared<DisplayedNodes>();
    std::map<const ViewableObject*, engine::ObjectHandle> loaded;
    for (const PlacedObject& placed : objects) {
        const auto [known, is_new] = loaded.try_emplace(placed.object.get());
        if (is_new) {
            RS_ASSIGN_OR_RETURN(const engine::ObjectHandle handle, engine.load(prepared(placed.object)));
            known->second = handle;
        }
        nodes->push_back({.object = placed, .handle = known->second, .placeholder = std::nullopt});
    }
    return std::shared_ptr<const DisplayedNodes>(nodes);
}

engine::RenderSessionLimits viewer_session_limits() {
    engine::RenderSessionLimits limits;
    limits.objects = std::numeric_limits<int>::max();
    return limits;
}

}  // namespace rs::compositor
