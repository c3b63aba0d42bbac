#include "compositor/window/visit_sharing.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor {

std::uint8_t shared_number(TracedMethod method) {
    const auto* const found = std::ranges::find(kTracedMethods, method, &NamedMethod::method);
    return static_cast<std::uint8_t>(found - kTracedMethods.begin() + 1);
}

void VisitSharing::publish(const SharedView& view, const LightEditor& lights) {
    const LightingState& state = lights.edits().state();
    if (published_ != state) {
        published_ = state;
        const Result<std::string> json = light_list_to_json(list_of(state), peers_.scene);
        if (json && json->size() <= kMaxLightsMessage_bytes) {
            peers_.leader->set_lights(*json);
        } else {
            fault_ = "followers keep their lights: " + (json ? "more than 4 MiB" : json.error().message);
        }
    }
    peers_.leader->publish(view);
}

Result<const SharedView*> VisitSharing::receive(LightEditor& lights) {
    ViewFollower& follower = *peers_.follower;
    RS_TRY(follower.poll());
    if (!follower.view()) return nullptr;
    const double exposure_ev = follower.view()->exposure_ev;
    if (const std::optional<std::string> json = follower.take_lights()) {
        const Result<LightList> list = light_list_from_json(*json, peers_.scene);
        const Status set =
            list ? lights.set_lights(*list, exposure_ev, follower.leader().text()) : Status(list.error());
        if (!set) fault_ = "the leader's lights are not shown: " + set.error().message;
    }
    if (lights.edits().state().exposure_ev != exposure_ev) {
        LightingState exposed = lights.edits().state();
        exposed.exposure_ev = exposure_ev;
        lights.edits().set(std::move(exposed));
    }
    return &*follower.view();
}

std::string VisitSharing::take_note() {
    if (!fault_.empty()) return std::exchange(fault_, {});
    return follows() ? peers_.follower->note() : std::string();
}

}  // namespace rs::compositor
