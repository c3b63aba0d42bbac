#pragma once
// Heads that come over UDP (head_datagram.hpp): the newest one counts, for an image shows where the head is now.
//
//     tracker ──► socket ──► datagrams that wait ──► the newest that is a head
//
// Standalone Asio (libasio-dev, headers only) is the socket. For one thread at a time.

#include "compositor/displays/wall.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace rs::compositor {

// Where datagrams are awaited.
struct UdpPlace {
    std::string address = "127.0.0.1";  // of this machine: IPv4 or IPv6; 0.0.0.0 and ::, all that it has
    std::uint16_t port = 0;             // 0: one that is free

    [[nodiscard]] std::string text() const;  // udp:ADDRESS:PORT
};

// "udp:PORT", "udp:ADDRESS:PORT", "udp:[ADDRESS]:PORT", ports 1..65535. names_udp_port(): whether that is meant at all.
bool names_udp_port(const std::string& text);
Result<UdpPlace> udp_place_from(const std::string& text);

class HeadReceiver {
public:
    // Fails where the address is not this machine's, and where the port is taken or not allowed.
    static Result<HeadReceiver> listen(const UdpPlace& place);
    HeadReceiver(HeadReceiver&&) noexcept;
    HeadReceiver& operator=(HeadReceiver&&) noexcept;
    ~HeadReceiver();

    // The head of the newest datagram since the last call that is one, in the axes of the tracker; does not wait.
    std::optional<Head> newest();
    // The same, but waits for one; nothing after that many seconds.
    std::optional<Head> wait_for_newest(double seconds);

    [[nodiscard]] const UdpPlace& place() const { return place_; }     // with the port that it has got
    [[nodiscard]] std::int64_t received() const { return received_; }  // datagrams, with those that are no heads
    [[nodiscard]] std::int64_t dropped() const { return dropped_; }
    // What was wrong with the first of those that were dropped; empty while there are none.
    [[nodiscard]] const std::string& first_fault() const { return first_fault_; }

private:
    struct Socket;
    HeadReceiver(std::unique_ptr<Socket> socket, UdpPlace place);

    std::unique_ptr<Socket> socket_;
    UdpPlace place_;
    std::int64_t received_ = 0;
    std::int64_t dropped_ = 0;
    std::string first_fault_;
};

}  // namespace rs::compositor
