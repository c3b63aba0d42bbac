#pragma once
// Shares the current view with followers over TCP (shared_view.hpp).
//
//     frame -> publish() -> newest message -> a non-blocking socket per follower
//
// A follower that does not read gets no queue: it receives the rest of the message that was begun, then the newest.
// Unencrypted, without authentication: listens at the given address only. Uses standalone Asio. Single-threaded.

#include "compositor/displays/network_endpoint.hpp"
#include "compositor/sharing/shared_view.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace rs::compositor {

/// Further connections wait until one is closed.
inline constexpr std::size_t kMaxFollowers = 64;
/// An unchanged view is sent again after this time, so that followers detect a lost leader.
inline constexpr double kHeartbeat_s = 1;

class ViewLeader {
public:
    /// Fails if the address is not local, or the port is in use or not permitted.
    /// \param place port 0: any free port
    /// \param scene digest of the scene, which followers compare with theirs
    static Result<ViewLeader> listen(const NetworkEndpoint& place, std::uint64_t scene);
    ViewLeader(ViewLeader&&) noexcept;
    ViewLeader& operator=(ViewLeader&&) noexcept;
    ~ViewLeader();

    /// Replaces the lights, a JSON light list of at most kMaxLightsMessage_bytes; sent by publish().
    void set_lights(const std::string& json);
    /// Accepts followers and sends them the lights and the view, if they do not have them yet. Call it once per frame;
    /// does not block.
    void publish(const SharedView& view);

    [[nodiscard]] const NetworkEndpoint& place() const { return place_; }  // with the actual port
    [[nodiscard]] std::size_t followers() const;

private:
    struct Network;
    ViewLeader(std::unique_ptr<Network> network, NetworkEndpoint place, std::uint64_t scene);

    std::unique_ptr<Network> network_;
    NetworkEndpoint place_;
    std::uint64_t scene_;
};

}  // namespace rs::compositor
