#include "compositor/displays/head_receiver.hpp"

#include "compositor/displays/head_datagram.hpp"
#include "compositor/displays/network_endpoint.hpp"
#include "rayspace/base/printable.hpp"

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <chrono>
#include <span>
#include <string_view>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::string_view kScheme = "udp:";
// Datagrams read per call, so that a flood cannot stop the frames.
constexpr int kMaxDatagramsPerCall = 4096;
// Longer than a head, so that longer datagrams are detected.
constexpr std::size_t kMaxDatagram_bytes = 512;
static_assert(kMaxDatagram_bytes > kHeadDatagram_bytes);

Error cannot_listen(const UdpEndpoint& place, const asio::error_code& why) {
    return Error{place.text() + ": " + why.message() + "; " + bind_remedy(why)};
}

}  // namespace

std::string UdpEndpoint::text() const {
    return std::string(kScheme) + NetworkEndpoint{address, port}.text();
}

bool is_udp_endpoint(const std::string& text) {
    return text.starts_with(kScheme);
}

Result<UdpEndpoint> parse_udp_endpoint(const std::string& text) {
    const Error wrong{printable(text) + ": must be udp:PORT or udp:ADDRESS:PORT, such as udp:4242 or udp:0.0.0.0:4242"};
    if (!is_udp_endpoint(text)) return wrong;
    const auto endpoint = parse_network_endpoint(std::string_view(text).substr(kScheme.size()));
    if (!endpoint) return wrong;
    UdpEndpoint place;
    place.port = endpoint->port;
    if (endpoint->host.empty()) return place;
    asio::error_code failed;
    asio::ip::make_address(endpoint->host, failed);
    if (failed) return wrong;
    place.address = endpoint->host;
    return place;
}

struct HeadReceiver::Socket {
    asio::io_context context;
    asio::ip::udp::socket udp{context};
};

HeadReceiver::HeadReceiver(std::unique_ptr<Socket> socket, UdpEndpoint place)
    : socket_(std::move(socket)), place_(std::move(place)) {}
HeadReceiver::HeadReceiver(HeadReceiver&&) noexcept = default;
HeadReceiver& HeadReceiver::operator=(HeadReceiver&&) noexcept = default;
HeadReceiver::~HeadReceiver() = default;

Result<HeadReceiver> HeadReceiver::listen(const UdpEndpoint& place) {
    asio::error_code failed;
    const asio::ip::address address = asio::ip::make_address(place.address, failed);
    if (failed) return Error{printable(place.text()) + ": has no IPv4 or IPv6 address"};
    const asio::ip::udp::endpoint local(address, place.port);
    std::unique_ptr<Socket> socket;
    try {
        socket = std::make_unique<Socket>();
    } catch (const std::system_error& error) {
        return cannot_listen(place, error.code());
    }
    socket->udp.open(local.protocol(), failed);
    if (!failed) socket->udp.bind(local, failed);
    if (!failed) socket->udp.non_blocking(true, failed);
    UdpEndpoint got = place;
    if (!failed) got.port = socket->udp.local_endpoint(failed).port();
    if (failed) return cannot_listen(place, failed);
    return HeadReceiver(std::move(socket), got);
}

std::optional<Head> HeadReceiver::newest() {
    std::optional<Head> newest;
    std::array<std::byte, kMaxDatagram_bytes> bytes{};
    for (int i = 0; i < kMaxDatagramsPerCall; ++i) {
        asio::error_code failed;
        asio::ip::udp::endpoint sender;
        const std::size_t size = socket_->udp.receive_from(asio::buffer(bytes.data(), bytes.size()), sender, 0, failed);
        if (failed) break;
        ++received_;
        Result<Head> head = head_from_datagram(std::span(bytes).first(size));
        if (head) {
            newest = *head;
            continue;
        }
        if (dropped_++ == 0) first_fault_ = head.error().message;
    }
    return newest;
}

std::optional<Head> HeadReceiver::wait_for_newest(double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    for (;;) {
        if (std::optional<Head> head = newest()) return head;
        if (Clock::now() >= end) return std::nullopt;
        socket_->udp.async_wait(asio::ip::udp::socket::wait_read, [](const asio::error_code&) {});
        socket_->context.restart();
        if (socket_->context.run_until(end) == 0) {
            asio::error_code failed;
            socket_->udp.cancel(failed);
            socket_->context.restart();
            socket_->context.run();
        }
    }
}

}  // namespace rs::compositor
