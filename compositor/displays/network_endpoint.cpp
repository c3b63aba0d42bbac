#include "compositor/displays/network_endpoint.hpp"

#include <charconv>

namespace rs::compositor {

std::string NetworkEndpoint::text() const {
    const bool is_v6 = host.find(':') != std::string::npos;
    return (is_v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

std::optional<NetworkEndpoint> parse_network_endpoint(std::string_view text) {
    NetworkEndpoint endpoint;
    if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos) {
        std::string_view host = text.substr(0, colon);
        if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
        if (host.empty()) return std::nullopt;
        endpoint.host = host;
        text = text.substr(colon + 1);
    }
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), endpoint.port);
    if (failed != std::errc() || end != text.data() + text.size() || endpoint.port == 0) return std::nullopt;
    return endpoint;
}

std::string bind_remedy(const std::error_code& why) {
    // Asio's categories do not map to std::errc.
    switch (static_cast<std::errc>(why.value())) {
        case std::errc::address_in_use:
            return "another program has the port: end it, or give another port";
        case std::errc::permission_denied:
            return "give a port from 1024 on";
        case std::errc::address_not_available:
            return "give an address of this machine, or 0.0.0.0 for all that it has";
        default:
            return "give another port or address";
    }
}

}  // namespace rs::compositor
