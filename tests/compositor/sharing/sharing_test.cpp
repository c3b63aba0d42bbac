// A leader and followers over the loopback interface, at ports chosen by the system.

#include "compositor/sharing/view_follower.hpp"
#include "compositor/sharing/view_leader.hpp"
#include "tests/compositor/sharing/shared_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <asio/buffer.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/write.hpp>
#include <chrono>
#include <functional>
#include <thread>

namespace rs::compositor {
namespace {

using test::kSharedScene;
using test::numbered_view;
using ::testing::HasSubstr;
using Tcp = asio::ip::tcp;

constexpr FollowerTiming kFast{.first_retry_s = 0.01, .last_retry_s = 0.05, .silence_s = 5};

ViewLeader leader_at(std::uint16_t port = 0) {
    auto leader = ViewLeader::listen({"127.0.0.1", port}, kSharedScene);
    RS_CHECK(leader.ok());
    return std::move(*leader);
}

// Repeats `step` until it returns true; false after 20 s.
bool until(const std::function<bool()>& step) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!step()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

bool shows(ViewFollower& follower, std::uint32_t frame) {
    const Status polled = follower.poll();
    EXPECT_TRUE(polled.ok()) << polled.error().message;
    return follower.view() && follower.view()->frame == frame;
}

// Peer that runs no rs-view.
class RawServer {
public:
    [[nodiscard]] NetworkEndpoint place() const { return {"127.0.0.1", acceptor_.local_endpoint().port()}; }
    void answer(const std::vector<std::byte>& bytes) {
        Tcp::socket peer(context_);
        acceptor_.accept(peer);
        asio::write(peer, asio::buffer(bytes));
        peer.shutdown(Tcp::socket::shutdown_send);
        peers_.push_back(std::move(peer));
    }

private:
    asio::io_context context_;
    Tcp::acceptor acceptor_{context_, Tcp::endpoint(asio::ip::address_v4::loopback(), 0)};
    std::vector<Tcp::socket> peers_;
};

TEST(Sharing, TwoFollowersShowTheNewestViewAndLights) {
    ViewLeader leader = leader_at();
    ViewFollower first(leader.place(), kSharedScene, kFast);
    ViewFollower second(leader.place(), kSharedScene, kFast);
    EXPECT_THAT(first.note(), HasSubstr("no leader"));
    leader.set_lights("dusk");
    for (const std::uint32_t frame : {1U, 2U, 300U}) {
        EXPECT_TRUE(until([&] {
            leader.publish(numbered_view(frame));
            const bool first_shows = shows(first, frame);
            return shows(second, frame) && first_shows;
        })) << frame;
    }
    EXPECT_EQ(leader.followers(), 2U);
    EXPECT_EQ(first.note(), "");
    EXPECT_EQ(first.take_lights(), "dusk");
    EXPECT_EQ(second.take_lights(), "dusk");
    EXPECT_FALSE(first.take_lights().has_value());
    leader.set_lights("night");
    EXPECT_TRUE(until([&] {
        leader.publish(numbered_view(300));
        return shows(second, 300) && second.take_lights() == "night";
    }));
}

// No view changes after it has connected.
TEST(Sharing, ALateFollowerGetsTheCurrentState) {
    ViewLeader leader = leader_at();
    leader.set_lights("dusk");
    for (std::uint32_t frame = 0; frame < 50; ++frame) leader.publish(numbered_view(frame));
    ViewFollower late(leader.place(), kSharedScene, kFast);
    EXPECT_TRUE(until([&] {
        leader.publish(numbered_view(49));
        return shows(late, 49);
    }));
    EXPECT_EQ(late.take_lights(), "dusk");
}

TEST(Sharing, AFollowerThatLeavesAndReturnsDoesNotStopTheOthers) {
    ViewLeader leader = leader_at();
    ViewFollower stays(leader.place(), kSharedScene, kFast);
    std::optional<ViewFollower> leaves(std::in_place, leader.place(), kSharedScene, kFast);
    std::uint32_t frame = 0;
    const auto both_show = [&] {
        leader.publish(numbered_view(frame));
        const bool shown = shows(stays, frame);
        return shows(*leaves, frame) && shown;
    };
    ASSERT_TRUE(until(both_show));
    leaves.reset();
    EXPECT_TRUE(until([&] {
        leader.publish(numbered_view(++frame));
        return shows(stays, frame) && leader.followers() == 1;
    }));
    leaves.emplace(leader.place(), kSharedScene, kFast);
    EXPECT_TRUE(until(both_show));
    EXPECT_EQ(leader.followers(), 2U);
}

TEST(Sharing, AFollowerKeepsItsViewAndFindsARestartedLeader) {
    std::optional<ViewLeader> leader(leader_at());
    const NetworkEndpoint place = leader->place();
    ViewFollower follower(place, kSharedScene, kFast);
    ASSERT_TRUE(until([&] {
        leader->publish(numbered_view(1));
        return shows(follower, 1);
    }));
    leader.reset();
    EXPECT_TRUE(until([&] { return shows(follower, 1) && !follower.note().empty(); }));
    EXPECT_THAT(follower.note(), HasSubstr(place.text() + ": no leader ("));
    leader.emplace(leader_at(place.port));
    EXPECT_TRUE(until([&] {
        leader->publish(numbered_view(2));
        return shows(follower, 2);
    }));
    EXPECT_EQ(follower.note(), "");
}

TEST(Sharing, ASilentLeaderIsLost) {
    RawServer silent;
    ViewFollower follower(silent.place(), kSharedScene,
                          {.first_retry_s = 0.01, .last_retry_s = 0.05, .silence_s = 0.2});
    EXPECT_TRUE(
        until([&] { return !shows(follower, 0) && follower.note().find("no message in") != std::string::npos; }));
}

// The stalled peer fills its buffers with lights of 3 MiB and views, and finally gets the newest view without those of
// the time in between.
TEST(Sharing, AStalledFollowerDoesNotBlockTheLeader) {
    ViewLeader leader = leader_at();
    asio::io_context context;
    Tcp::socket stalled(context);
    stalled.open(Tcp::v4());
    stalled.set_option(asio::socket_base::receive_buffer_size(8 << 10));
    stalled.connect({asio::ip::address_v4::loopback(), leader.place().port});
    ViewFollower reads(leader.place(), kSharedScene, kFast);
    leader.set_lights(std::string(3 << 20, 'x'));
    ASSERT_TRUE(until([&] {
        leader.publish(numbered_view(0));
        return shows(reads, 0) && leader.followers() == 2;
    }));
    constexpr std::uint32_t kLast = 20000;
    double longest_s = 0;
    for (std::uint32_t frame = 1; frame <= kLast; ++frame) {
        const auto begin = std::chrono::steady_clock::now();
        leader.publish(numbered_view(frame));
        longest_s =
            std::max(longest_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    EXPECT_LT(longest_s, 2);
    EXPECT_TRUE(until([&] {
        leader.publish(numbered_view(kLast));
        return shows(reads, kLast);
    }));
    EXPECT_EQ(leader.followers(), 2U);
    SharedViewReader reader(kSharedScene);
    stalled.non_blocking(true);
    std::vector<std::byte> bytes(1 << 20);
    std::size_t received = 0;
    EXPECT_TRUE(until([&] {
        leader.publish(numbered_view(kLast));
        asio::error_code failed;
        const std::size_t size = stalled.read_some(asio::buffer(bytes), failed);
        received += size;
        EXPECT_TRUE(reader.take(std::span(bytes).first(size)).ok());
        const auto view = reader.take_view();
        return view && view->frame == kLast;
    }));
    EXPECT_LT(received, (3U << 20U) + kLast * kMessageHeader_bytes) << "outdated views were queued";
}

TEST(Sharing, WrongPeersAreRefusedByName) {
    std::vector<std::byte> other_version = view_message(numbered_view(1), kSharedScene);
    other_version[4] = std::byte{7};
    std::vector<std::byte> garbage(200, std::byte{'<'});
    struct Case {
        std::vector<std::byte> answer;
        const char* fault;
    };
    for (const Case& wrong : {Case{other_version, "version 7"}, Case{garbage, "is not a leading rs-view"},
                              Case{view_message(numbered_view(1), kSharedScene + 1), "another scene"}}) {
        RawServer server;
        ViewFollower follower(server.place(), kSharedScene, kFast);
        std::thread answering([&] { server.answer(wrong.answer); });
        std::string fault;
        EXPECT_TRUE(until([&] {
            const Status polled = follower.poll();
            if (!polled) fault = polled.error().message;
            return !polled;
        }));
        answering.join();
        EXPECT_THAT(fault, HasSubstr("--follow " + server.place().text() + ": ")) << wrong.fault;
        EXPECT_THAT(fault, HasSubstr(wrong.fault));
    }
}

TEST(Sharing, APortInUseAndForeignAddressesAreRefused) {
    const ViewLeader first = leader_at();
    const auto second = ViewLeader::listen(first.place(), kSharedScene);
    ASSERT_FALSE(second.ok());
    EXPECT_THAT(second.error().message, HasSubstr(first.place().text() + ": "));
    EXPECT_THAT(second.error().message, HasSubstr("another program has the port: end it, or give another port"));
    const auto foreign = ViewLeader::listen({"192.0.2.1", 0}, kSharedScene);
    ASSERT_FALSE(foreign.ok());
    EXPECT_THAT(foreign.error().message, HasSubstr("give an address of this machine"));
    EXPECT_FALSE(ViewLeader::listen({"nowhere", 0}, kSharedScene).ok());
}

// A label of more than 63 characters is no name, so that no name server is asked.
TEST(Sharing, AHostThatDoesNotExistIsNoted) {
    ViewFollower follower({std::string(70, 'a'), 4250}, kSharedScene, kFast);
    EXPECT_TRUE(until([&] {
        EXPECT_TRUE(follower.poll().ok());
        return follower.note().find("no leader (") != std::string::npos;
    }));
}

}  // namespace
}  // namespace rs::compositor
