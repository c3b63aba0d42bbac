#pragma once
// Head tracker for tests: sends datagrams to a local port.

#include "rayspace/base/byte_stream.hpp"

#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::test {

/// A datagram of x, y, z in cm and yaw, pitch, roll in degrees.
inline std::vector<std::byte> head_datagram(const std::array<double, 6>& numbers) {
    ByteWriter writer;
    for (const double number : numbers) writer.put(number);
    return writer.bytes();
}

class UdpSender {
public:
    explicit UdpSender(std::uint16_t port) : to_(asio::ip::address_v4::loopback(), port) {
        socket_.open(asio::ip::udp::v4());
    }
    void send(std::span<const std::byte> bytes) {
        asio::error_code nobody_there;
        socket_.send_to(asio::buffer(bytes.data(), bytes.size()), to_, 0, nobody_there);
    }
    void send(const std::array<double, 6>& head) { send(head_datagram(head)); }

private:
    asio::io_context context_;
    asio::ip::udp::socket socket_{context_};
    asio::ip::udp::endpoint to_;
};

/// Occupies a free local port during its lifetime.
class OccupiedPort {
public:
    [[nodiscard]] std::uint16_t number() const { return socket_.local_endpoint().port(); }

private:
    asio::io_context context_;
    asio::ip::udp::socket socket_{context_, asio::ip::udp::endpoint(asio::ip::address_v4::loopback(), 0)};
};

}  // namespace rs::test
