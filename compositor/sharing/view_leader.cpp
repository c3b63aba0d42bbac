#include "compositor/sharing/view_leader.hpp"

#include "rayspace/base/printable.hpp"

#include <asio/buffer.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <chrono>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

using Message = std::shared_ptr<const std::vector<std::byte>>;

// Limits the outdated views that the system buffers for a follower that does not read.
constexpr int kSendBuffer_bytes = 64 << 10;

Error cannot_share(const NetworkEndpoint& place, const asio::error_code& why) {
    return Error{printable(place.text()) + ": " + why.message() + "; " + bind_remedy(why)};
}

struct ConnectedFollower {
    asio::ip::tcp::socket socket;
    Message sending;  // null: between messages
    std::size_t sent = 0;
    Message lights;  // the last that it was sent
    Message view;

    void select_message(const Message& newest_lights, const Message& newest_view) {
        sent = 0;
        if (lights != newest_lights) {
            sending = lights = newest_lights;
        } else if (view != newest_view) {
            sending = view = newest_view;
        } else {
            sending.reset();
        }
    }
    // False if the connection is lost.
    bool send(const Message& newest_lights, const Message& newest_view) {
        for (;;) {
            if (!sending || sent == sending->size()) select_message(newest_lights, newest_view);
            if (!sending) return true;
            asio::error_code failed;
            sent += socket.write_some(asio::buffer(sending->data() + sent, sending->size() - sent), failed);
            if (failed == asio::error::would_block || failed == asio::error::try_again) return true;
            if (failed) return false;
        }
    }
};

}  // namespace

struct ViewLeader::Network {
    asio::io_context context;
    asio::ip::tcp::acceptor acceptor{context};
    std::vector<ConnectedFollower> followers;
    Message lights;  // null until set
    Message view;
    std::chrono::steady_clock::time_point view_time;

    void accept() {
        while (followers.size() < kMaxFollowers) {
            asio::error_code failed;
            asio::ip::tcp::socket socket(context);
            acceptor.accept(socket, failed);
            if (failed) return;
            asio::error_code ignored;
            socket.set_option(asio::ip::tcp::no_delay(true), ignored);
            socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer_bytes), ignored);
            socket.non_blocking(true, failed);
            if (!failed) followers.push_back({std::move(socket), nullptr, 0, nullptr, nullptr});
        }
    }
};

ViewLeader::ViewLeader(std::unique_ptr<Network> network, NetworkEndpoint place, std::uint64_t scene)
    : network_(std::move(network)), place_(std::move(place)), scene_(scene) {}
ViewLeader::ViewLeader(ViewLeader&&) noexcept = default;
ViewLeader& ViewLeader::operator=(ViewLeader&&) noexcept = default;
ViewLeader::~ViewLeader() = default;

Result<ViewLeader> ViewLeader::listen(const NetworkEndpoint& place, std::uint64_t scene) {
    asio::error_code failed;
    const asio::ip::address address = asio::ip::make_address(place.host, failed);
    if (failed) {
        return Error{printable(place.text()) +
                     ": has no IPv4 or IPv6 address; give one of this machine, or 0.0.0.0 for all that it has"};
    }
    std::unique_ptr<Network> network;
    try {
        network = std::make_unique<Network>();
    } catch (const std::system_error& error) {
        return cannot_share(place, error.code());
    }
    const asio::ip::tcp::endpoint local(address, place.port);
    asio::ip::tcp::acceptor& acceptor = network->acceptor;
    acceptor.open(local.protocol(), failed);
    // Lets a leader that is started again have its port at once.
    if (!failed) acceptor.set_option(asio::socket_base::reuse_address(true), failed);
    if (!failed) acceptor.bind(local, failed);
    if (!failed) acceptor.listen(asio::socket_base::max_listen_connections, failed);
    if (!failed) acceptor.non_blocking(true, failed);
    NetworkEndpoint got = place;
    if (!failed) got.port = acceptor.local_endpoint(failed).port();
    if (failed) return cannot_share(place, failed);
    return ViewLeader(std::move(network), std::move(got), scene);
}

void ViewLeader::set_lights(const std::string& json) {
    network_->lights = std::make_shared<const std::vector<std::byte>>(lights_message(json, scene_));
}

void ViewLeader::publish(const SharedView& view) {
    Network& network = *network_;
    network.accept();
    std::vector<std::byte> message = view_message(view, scene_);
    const std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now();
    if (!network.view || *network.view != message ||
        now - network.view_time >= std::chrono::duration<double>(kHeartbeat_s)) {
        network.view = std::make_shared<const std::vector<std::byte>>(std::move(message));
        network.view_time = now;
    }
    std::erase_if(network.followers,
                  [&](ConnectedFollower& follower) { return !follower.send(network.lights, network.view); });
}

std::size_t ViewLeader::followers() const {
    return network_->followers.size();
}

}  // namespace rs::compositor
