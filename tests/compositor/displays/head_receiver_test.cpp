// Datagrams over the loopback interface, at ports chosen by the system.

#include "compositor/displays/head_receiver.hpp"

#include "tests/support/udp_sender.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

namespace rs::compositor {
namespace {

using ::testing::HasSubstr;

HeadReceiver opened() {
    auto receiver = HeadReceiver::listen({});
    RS_CHECK(receiver.ok());
    return std::move(*receiver);
}

TEST(HeadReceiver, ReadsWhereToListen) {
    EXPECT_TRUE(is_udp_endpoint("udp:4242"));
    EXPECT_FALSE(is_udp_endpoint("heads.json"));
    const auto text = [](const std::string& asked) {
        const auto place = parse_udp_endpoint(asked);
        return place ? place->text() : place.error().message;
    };
    EXPECT_EQ(text("udp:4242"), "udp:127.0.0.1:4242");
    EXPECT_EQ(text("udp:0.0.0.0:65535"), "udp:0.0.0.0:65535");
    EXPECT_EQ(text("udp:[::1]:1"), "udp:[::1]:1");
    EXPECT_EQ(text("udp:::1:7"), "udp:[::1]:7");
    for (const char* const wrong : {"udp:", "udp:0", "udp:65536", "udp:-1", "udp:4242x", "udp: 4242", "udp::4242",
                                    "udp:somewhere:4242", "udp:1.2.3:4242", "udp:127.0.0.1:", "tcp:4242"}) {
        EXPECT_THAT(text(wrong), HasSubstr("must be udp:PORT or udp:ADDRESS:PORT")) << wrong;
    }
    EXPECT_EQ(text("udp:\x1b:1").find('\x1b'), std::string::npos);
}

TEST(HeadReceiver, TheNewestHeadCounts) {
    HeadReceiver receiver = opened();
    ASSERT_GT(receiver.place().port, 0);
    EXPECT_FALSE(receiver.newest().has_value());
    test::UdpSender tracker(receiver.place().port);
    for (const double x : {10.0, 20.0, 30.0}) tracker.send({x, 0, 0, 0, 0, 0});
    const std::optional<Head> head = receiver.wait_for_newest(10);
    ASSERT_TRUE(head.has_value());
    EXPECT_DOUBLE_EQ(head->position.x, 0.3);
    EXPECT_EQ(receiver.received(), 3);
    // Each head is returned once.
    EXPECT_FALSE(receiver.newest().has_value());
}

TEST(HeadReceiver, WhatIsNoHeadIsDroppedAndCounted) {
    HeadReceiver receiver = opened();
    test::UdpSender tracker(receiver.place().port);
    const std::vector<std::byte> longer(2000);
    tracker.send({40, 0, 0, 0, 0, 0});
    tracker.send(std::span(longer).first(20));
    tracker.send(std::span(longer).first(0));
    tracker.send(longer);
    tracker.send({std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 0});
    tracker.send({0, 1e6, 0, 0, 0, 0});
    const std::optional<Head> head = receiver.wait_for_newest(10);
    ASSERT_TRUE(head.has_value());
    EXPECT_DOUBLE_EQ(head->position.x, 0.4);
    EXPECT_EQ(receiver.received(), 6);
    EXPECT_EQ(receiver.dropped(), 5);
    EXPECT_THAT(receiver.first_error(), HasSubstr("has 20 bytes"));
}

TEST(HeadReceiver, WaitsNoLongerThanItIsTold) {
    HeadReceiver receiver = opened();
    test::UdpSender tracker(receiver.place().port);
    tracker.send(std::vector<std::byte>(3));  // does not end the wait
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_FALSE(receiver.wait_for_newest(0.2).has_value());
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(200));
    EXPECT_EQ(receiver.dropped(), 1);
    // A datagram that arrives during the wait ends it.
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        tracker.send({0, 0, 5, 0, 0, 0});
    });
    const std::optional<Head> head = receiver.wait_for_newest(60);
    later.join();
    ASSERT_TRUE(head.has_value());
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(50));
    EXPECT_DOUBLE_EQ(head->position.z, 0.05);
}

TEST(HeadReceiver, AFloodEnds) {
    HeadReceiver receiver = opened();
    test::UdpSender tracker(receiver.place().port);
    for (int i = 0; i < 20000; ++i) tracker.send({1, 2, 3, 0, 0, 0});
    EXPECT_TRUE(receiver.newest().has_value());
    EXPECT_LE(receiver.received(), 4096);
}

TEST(HeadReceiver, SaysWhyItCannotListen) {
    const test::OccupiedPort taken;
    const auto in_use = HeadReceiver::listen({.port = taken.number()});
    ASSERT_FALSE(in_use.ok());
    EXPECT_THAT(in_use.error().message, HasSubstr("udp:127.0.0.1:" + std::to_string(taken.number()) + ": "));
    EXPECT_THAT(in_use.error().message, HasSubstr("another program has the port: end it, or give another port"));
    const auto elsewhere = HeadReceiver::listen({.address = "192.0.2.1"});
    ASSERT_FALSE(elsewhere.ok());
    EXPECT_THAT(elsewhere.error().message, HasSubstr("give an address of this machine"));
    EXPECT_FALSE(HeadReceiver::listen({.address = "nowhere"}).ok());
}

}  // namespace
}  // namespace rs::compositor
