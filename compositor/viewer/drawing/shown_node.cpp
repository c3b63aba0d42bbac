#include "compositor/viewer/drawing/shown_node.hpp"

#include <limits>
#include <map>

namespace rs::compositor {

engine::PreparedObject prepared(const std::shared_ptr<const ViewableObject>& object) {
    engine::PreparedObject result;
    result.renderer = {object, &object->renderer};
    if (object->for_board) result.for_board = {object, object->for_board.get()};
    return result;
}

Result<std::shared_ptr<const ShownNodes>> show_all(const std::vector<PlacedObject>& objects,
                                                   engine::DataModule& engine) {
    const auto nodes = std::make_shared<ShownNodes>();
    std::map<const ViewableObject*, engine::ObjectHandle> loaded;
    for (const PlacedObject& placed : objects) {
        const auto [known, is_new] = loaded.try_emplace(placed.object.get());
        if (is_new) {
            const Result<engine::ObjectHandle> handle = engine.load(prepared(placed.object));
            if (!handle) return handle.error();
            known->second = *handle;
        }
        nodes->push_back({.object = placed, .handle = known->second, .placeholder = std::nullopt});
    }
    return std::shared_ptr<const ShownNodes>(nodes);
}

engine::DataModuleLimits limits_of_viewer() {
    engine::DataModuleLimits limits;
    limits.objects = std::numeric_limits<int>::max();
    return limits;
}

}  // namespace rs::compositor
