#pragma once
// Hosts and ports of sockets, and remedies for those that cannot be bound. Pure; thread-safe.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace rs::compositor {

struct NetworkEndpoint {
    std::string host;  // name or address; may be empty
    std::uint16_t port = 0;

    [[nodiscard]] std::string text() const;  // HOST:PORT, [ADDRESS]:PORT for IPv6
    bool operator==(const NetworkEndpoint&) const = default;
};

/// Parses "PORT", "HOST:PORT" and "[ADDRESS]:PORT", ports 1..65535. The host is not looked up; it is empty if only a
/// port is given, and not empty before a colon.
std::optional<NetworkEndpoint> parse_network_endpoint(std::string_view text);

/// Advice for the user if a local address cannot be opened or bound.
std::string bind_remedy(const std::error_code& why);

}  // namespace rs::compositor
