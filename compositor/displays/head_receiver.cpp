#include "compositor/displays/head_receiver.hpp"

#include "compositor/displays/head_datagram.hpp"
#include "rayspace/base/printable.hpp"

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <charconv>
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
    std::string remedy = "give another port or address";
    if (why == asio::error::address_in_use) {
        remedy = "another program has the port: end it, or give another port here and in the tracker";
    } else if (why == asio::error::access_denied) {
        remedy = "give a port from 1024 on";
    } else if (why.value() == static_cast<int>(std::errc::address_not_available)) {
        remedy = "give an address of this machine, or 0.0.0.0 for all that it has";
    }
    return Error{place.text() + ": " + why.message() + "; " + remedy};
}

}  // namespace

std::string UdpEndpoint::text() const {
    const bool is_v6 = address.find(':') != std::string::npos;
    return std::string(kScheme) + (is_v6 ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

bool is_udp_endpoint(const std::string& text) {
    return text.starts_with(kScheme);
}

Result<UdpEndpoint> parse_udp_endpoint(const std::string& text) {
    const Error wrong{printable(text) + ": must be udp:PORT or udp:ADDRESS:PORT, such as udp:4242 or udp:0.0.0.0:4242"};
    if (!is_udp_endpoint(text)) return wrong;
    std::string_view port = std::string_view(text).substr(kScheme.size());
    UdpEndpoint place;
    if (const std::size_t colon = port.rfind(':'); colon != std::string_view::npos) {
        std::string_view address = port.substr(0, colon);
        if (address.starts_with('[') && address.ends_with(']')) address = address.substr(1, address.size() - 2);
        place.address = address;
        port = port.substr(colon + 1);
        asio::error_code failed;
        asio::ip::make_address(place.address, failed);
        if (failed) return wrong;
    }
    const auto [end, failed] = std::from_chars(port.data(), port.data() + port.size(), place.port);
    if (failed != std::errc() || end != port.data() + port.size() || place.port == 0) return wrong;
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
