#include "compositor/displays/head_datagram.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/support/udp_sender.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace rs::compositor {
namespace {

using ::testing::HasSubstr;

std::string fault_of(const std::array<double, 6>& numbers) {
    const auto head = head_from_datagram(test::head_datagram(numbers));
    return head ? std::string() : head.error().message;
}

TEST(HeadDatagram, IsCentimetresAndDegrees) {
    const auto head = head_from_datagram(test::head_datagram({10, -20, 35, 90, -15, 5}));
    ASSERT_TRUE(head.ok()) << head.error().message;
    EXPECT_NEAR(glm::distance(head->position, glm::dvec3(0.1, -0.2, 0.35)), 0, 1e-15);
    EXPECT_DOUBLE_EQ(head->heading_rad, kPi / 2);
    EXPECT_DOUBLE_EQ(head->pitch_rad, radians(-15));
    EXPECT_DOUBLE_EQ(head->roll_rad, radians(5));
}

TEST(HeadDatagram, HasTheBytesOfTheProtocol) {
    // 1.5 and -2 in IEEE 754, little-endian.
    std::array<std::uint8_t, 48> bytes{};
    bytes[6] = 0xF8;
    bytes[7] = 0x3F;
    bytes[31] = 0xC0;
    const auto head = head_from_datagram(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(head.ok()) << head.error().message;
    EXPECT_DOUBLE_EQ(head->position.x, 0.015);
    EXPECT_DOUBLE_EQ(head->heading_rad, radians(-2));
}

TEST(HeadDatagram, WhatIsNoHeadIsNamed) {
    const std::vector<std::byte> good = test::head_datagram({0, 0, 0, 0, 0, 0});
    for (const std::size_t size : {0U, 1U, 24U, 47U}) {
        const auto cut = head_from_datagram(std::span(good).first(size));
        ASSERT_FALSE(cut.ok());
        EXPECT_THAT(cut.error().message, HasSubstr("has " + std::to_string(size) + " bytes; a head is 48"));
    }
    std::vector<std::byte> longer = good;
    longer.resize(49);
    EXPECT_FALSE(head_from_datagram(longer).ok());
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    EXPECT_THAT(fault_of({0, kNone, 0, 0, 0, 0}), HasSubstr("y that is not finite"));
    EXPECT_THAT(fault_of({0, 0, 0, 0, 0, -kEndless}), HasSubstr("roll that is not finite"));
    EXPECT_THAT(fault_of({10000.1, 0, 0, 0, 0, 0}), HasSubstr("x beyond 100 m"));
    EXPECT_EQ(fault_of({10000, 0, 0, 0, 0, 0}), "");
    EXPECT_THAT(fault_of({0, 0, 0, 0, 36001, 0}), HasSubstr("pitch beyond a hundred turns"));
}

TEST(HeadDatagram, TheTrackersZeroIsAPlaceInTheRoom) {
    const Head zero{.position = {1, 1.5, 2}, .heading_rad = radians(90), .pitch_rad = 7, .roll_rad = 7};
    const Head there = head_in_room({.position = {0, 0, 0}, .pitch_rad = 0.1, .roll_rad = 0.2}, zero);
    EXPECT_EQ(there.position, zero.position);
    EXPECT_DOUBLE_EQ(there.heading_rad, kPi / 2);
    EXPECT_EQ(there.pitch_rad, 0.1);
    EXPECT_EQ(there.roll_rad, 0.2);
    // A head that faces -X has its right at -Z, lower when it rolls there, and moves to +X when it steps back.
    EXPECT_NEAR(glm::distance(there.right(), glm::dvec3(0, -0.2, -0.98)), 0, 0.03);
    const Head moved = head_in_room({.position = {0.2, 0.1, 0.3}, .heading_rad = 0.5}, zero);
    EXPECT_NEAR(glm::distance(moved.position, glm::dvec3(1.3, 1.6, 1.8)), 0, 1e-12);
    EXPECT_DOUBLE_EQ(moved.heading_rad, kPi / 2 + 0.5);
}

}  // namespace
}  // namespace rs::compositor
