#pragma once
// Connects a visit to those on other machines: its view is shared with followers, or taken from a leader
// (compositor/sharing). Lights are exchanged through the light editor. Single-threaded.

#include "compositor/sharing/view_follower.hpp"
#include "compositor/sharing/view_leader.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/window/light_editor.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace rs::compositor {

/// Neither, or one of them.
struct SharingPeers {
    std::shared_ptr<ViewLeader> leader;
    std::shared_ptr<ViewFollower> follower;
    std::filesystem::path scene;  // files of lights are relative to its folder
};

/// SharedView::renderer of a traced renderer.
std::uint8_t shared_number(TracedMethod method);

class VisitSharing {
public:
    explicit VisitSharing(SharingPeers peers) : peers_(std::move(peers)) {}

    [[nodiscard]] bool leads() const { return peers_.leader != nullptr; }
    [[nodiscard]] bool follows() const { return peers_.follower != nullptr; }

    /// Sends the view and the lights to the followers; does not block.
    void publish(const SharedView& view, const LightEditor& lights);
    /// Takes over the leader's lights, and returns its view; nullptr if none was received yet. Fails as
    /// ViewFollower::poll() does.
    Result<const SharedView*> receive(LightEditor& lights);
    /// Message for the user since the last call: no leader is connected, or lights that cannot be shared. Repeated
    /// while there is no leader.
    std::string take_note();

private:
    SharingPeers peers_;
    std::optional<LightingState> published_;  // last one that was sent
    std::string fault_;                       // of lights
};

}  // namespace rs::compositor
