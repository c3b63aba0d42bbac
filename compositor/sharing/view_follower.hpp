#pragma once
// Receives the view of a leader (view_leader.hpp), and connects again by itself if it is lost. Uses standalone Asio.
// Single-threaded.
//
//     poll() once per frame -> look-up, connection -> stream of messages -> newest view, newest lights

#include "compositor/displays/network_endpoint.hpp"
#include "compositor/sharing/shared_view.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace rs::compositor {

struct FollowerTiming {
    double first_retry_s = 0.25;  // pause after a lost connection, doubled with each failure
    double last_retry_s = 4;
    double silence_s = 10;  // a leader that sends nothing for this time is lost
};

class ViewFollower {
public:
    /// Does not connect yet.
    /// \param scene digest of the scene, which must be the leader's
    ViewFollower(NetworkEndpoint leader, std::uint64_t scene, FollowerTiming timing = {});
    ViewFollower(ViewFollower&&) noexcept;
    ViewFollower& operator=(ViewFollower&&) noexcept;
    ~ViewFollower();

    /// Receives messages; connects if necessary. Does not block. Fails if the peer is not a leader, or one of another
    /// version or scene; a leader that does not answer is no failure.
    Status poll();

    /// Newest view; kept while the leader is lost.
    [[nodiscard]] const std::optional<SharedView>& view() const { return view_; }
    /// Newest lights, as a JSON light list, since the last call.
    std::optional<std::string> take_lights();
    /// Reason and address while no leader is connected; else empty.
    [[nodiscard]] std::string note() const;
    [[nodiscard]] const NetworkEndpoint& leader() const { return leader_; }

private:
    struct Connection;
    void connect();
    void lose(const std::string& why);
    Status receive();

    NetworkEndpoint leader_;
    std::uint64_t scene_;
    FollowerTiming timing_;
    std::unique_ptr<Connection> connection_;  // null between attempts
    double retry_s_;
    double next_attempt_s_ = 0;  // of the steady clock
    std::string fault_;          // of the last attempt
    std::optional<SharedView> view_;
    std::optional<std::string> lights_;
};

}  // namespace rs::compositor
