#include "compositor/viewer/drawing/passes/object_request_pass.hpp"

#include <utility>

namespace rs::compositor {

Status ObjectRequestPass::run(FrameContext& frame) const {
    std::vector<engine::ViewRequest> requests;
    for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
        auto view = frame.nodes.view_of(i, frame.view.camera);
        if (!view) continue;
        requests.push_back({frame.nodes[i].handle, view->camera, depths_});
        frame.visible_nodes.push_back({i, *view});
    }
    frame.statistics.nodes_not_seen = static_cast<int>(frame.nodes.size() - frame.visible_nodes.size());
    return frame.engine_views.submit(std::move(requests));
}

}  // namespace rs::compositor
