#include "compositor/sharing/view_follower.hpp"

#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <array>
#include <asio/buffer.hpp>
#include <asio/connect.hpp>
#include <asio/error.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <chrono>
#include <span>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::size_t kReadBuffer_bytes = 64U << 10U;
// Reads per call, so that a flood cannot stop the frames.
constexpr int kMaxReadsPerCall = 256;

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

struct ViewFollower::Connection {
    explicit Connection(std::uint64_t scene) : reader(scene) {}

    // Handlers run in context.poll() only, and end with the context, whose destructor waits for a look-up.
    asio::io_context context;
    asio::ip::tcp::resolver resolver{context};
    asio::ip::tcp::socket socket{context};
    SharedViewReader reader;
    bool is_resolved = false;
    bool is_open = false;
    bool has_view = false;
    asio::error_code failed;
    double last_heard_s = steady_seconds();
};

ViewFollower::ViewFollower(NetworkEndpoint leader, std::uint64_t scene, FollowerTiming timing)
    : leader_(std::move(leader)), scene_(scene), timing_(timing), retry_s_(timing.first_retry_s) {}
ViewFollower::ViewFollower(ViewFollower&&) noexcept = default;
ViewFollower& ViewFollower::operator=(ViewFollower&&) noexcept = default;
ViewFollower::~ViewFollower() = default;

void ViewFollower::connect() {
    try {
        connection_ = std::make_unique<Connection>(scene_);
    } catch (const std::system_error& error) {
        lose(error.code().message());
        return;
    }
    Connection* const connection = connection_.get();
    const auto on_connect = [connection](const asio::error_code& failed, const asio::ip::tcp::endpoint&) {
        connection->failed = failed;
        if (!failed) connection->socket.non_blocking(true, connection->failed);
        connection->is_open = !connection->failed;
    };
    const auto on_resolve = [connection, on_connect](const asio::error_code& failed,
                                                     const asio::ip::tcp::resolver::results_type& places) {
        connection->failed = failed;
        connection->is_resolved = true;
        connection->last_heard_s = steady_seconds();
        if (!failed) asio::async_connect(connection->socket, places, on_connect);
    };
    connection->resolver.async_resolve(leader_.host, std::to_string(leader_.port), on_resolve);
}

void ViewFollower::lose(const std::string& why) {
    fault_ = why;
    connection_.reset();
    next_attempt_s_ = steady_seconds() + retry_s_;
    retry_s_ = std::min(2 * retry_s_, timing_.last_retry_s);
}

Status ViewFollower::receive() {
    std::array<std::byte, kReadBuffer_bytes> bytes{};
    for (int i = 0; i < kMaxReadsPerCall; ++i) {
        const std::size_t size = connection_->socket.read_some(asio::buffer(bytes), connection_->failed);
        if (connection_->failed == asio::error::would_block || connection_->failed == asio::error::try_again) {
            connection_->failed.clear();
            break;
        }
        if (connection_->failed) break;
        connection_->last_heard_s = steady_seconds();
        if (const Status read = connection_->reader.take(std::span(bytes).first(size)); !read) {
            return Error{"--follow " + printable(leader_.text()) + ": " + read.error().message};
        }
    }
    if (auto view = connection_->reader.take_view()) {
        view_ = std::move(view);
        connection_->has_view = true;
        retry_s_ = timing_.first_retry_s;
    }
    if (auto lights = connection_->reader.take_lights()) lights_ = std::move(lights);
    return {};
}

Status ViewFollower::poll() {
    if (!connection_) {
        if (steady_seconds() < next_attempt_s_) return {};
        connect();
        if (!connection_) return {};
    }
    connection_->context.poll();
    if (connection_->is_open) {
        RS_TRY(receive());
    }
    if (connection_->failed) {
        lose(connection_->failed == asio::error::eof ? "it has ended" : connection_->failed.message());
    } else if (connection_->is_resolved && steady_seconds() - connection_->last_heard_s > timing_.silence_s) {
        lose("no message in " + std::to_string(static_cast<int>(timing_.silence_s)) + " s");
    }
    return {};
}

std::optional<std::string> ViewFollower::take_lights() {
    return std::exchange(lights_, std::nullopt);
}

std::string ViewFollower::note() const {
    if (connection_ && connection_->has_view) return {};
    return printable(leader_.text()) + ": no leader" + (fault_.empty() ? "" : " (" + fault_ + ")") +
           "; trying again until one answers";
}

}  // namespace rs::compositor
