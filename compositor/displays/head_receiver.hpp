#pragma once
// Receives head poses over UDP (head_datagram.hpp). Only the newest is used, since a frame shows the current pose.
//
//     tracker ──► socket ──► pending datagrams ──► newest valid head pose
//
// Uses standalone Asio (libasio-dev, header-only). Single-threaded.

#include "compositor/displays/wall.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace rs::compositor {

/// Local address to receive datagrams at.
struct UdpEndpoint {
    std::string address = "127.0.0.1";  // local IPv4 or IPv6 address; 0.0.0.0 and :: stand for all
    std::uint16_t port = 0;             // 0: any free port

    [[nodiscard]] std::string text() const;  // udp:ADDRESS:PORT
};

/// Accepts "udp:PORT", "udp:ADDRESS:PORT", "udp:[ADDRESS]:PORT", ports 1..65535. is_udp_endpoint() only checks the
/// scheme.
bool is_udp_endpoint(const std::string& text);
Result<UdpEndpoint> parse_udp_endpoint(const std::string& text);

class HeadReceiver {
public:
    /// Fails if the address is not local, or the port is in use or not permitted.
    static Result<HeadReceiver> listen(const UdpEndpoint& place);
    HeadReceiver(HeadReceiver&&) noexcept;
    HeadReceiver& operator=(HeadReceiver&&) noexcept;
    ~HeadReceiver();

    /// Newest valid head pose since the last call, in the tracker's axes; does not block.
    std::optional<Head> newest();
    /// Same, but waits for a datagram for at most `seconds`.
    std::optional<Head> wait_for_newest(double seconds);

    [[nodiscard]] const UdpEndpoint& place() const { return place_; }  // with the actual port
    [[nodiscard]] std::int64_t received() const { return received_; }  // number of datagrams, invalid ones included
    [[nodiscard]] std::int64_t dropped() const { return dropped_; }
    /// Fault of the first invalid datagram; empty if none.
    [[nodiscard]] const std::string& first_error() const { return first_fault_; }

private:
    struct Socket;
    HeadReceiver(std::unique_ptr<Socket> socket, UdpEndpoint place);

    std::unique_ptr<Socket> socket_;
    UdpEndpoint place_;
    std::int64_t received_ = 0;
    std::int64_t dropped_ = 0;
    std::string first_fault_;
};

}  // namespace rs::compositor
