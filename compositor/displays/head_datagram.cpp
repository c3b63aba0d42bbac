#include "compositor/displays/head_datagram.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"

#include <array>
#include <cmath>

namespace rs::compositor {
namespace {

constexpr double kCentimetre_m = 0.01;
constexpr double kMaxTrackedTurn_deg = 36000;

}  // namespace

Result<Head> head_from_datagram(std::span<const std::byte> bytes) {
    if (bytes.size() != kHeadDatagram_bytes) {
        return Error{"has " + std::to_string(bytes.size()) + " bytes; a head is " +
                     std::to_string(kHeadDatagram_bytes) +
                     ": x, y, z in cm and yaw, pitch, roll in degrees, doubles (opentrack: UDP over network)"};
    }
    ByteReader reader(bytes);
    std::array<double, 6> numbers{};
    for (double& number : numbers) number = reader.get_double();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        static constexpr std::array<const char*, 6> kNames{"x", "y", "z", "yaw", "pitch", "roll"};
        if (!std::isfinite(numbers[i])) return Error{std::string("has a ") + kNames[i] + " that is not finite"};
        const bool is_length = i < 3;
        if (std::abs(numbers[i]) <= (is_length ? kMaxHeadDistance_m / kCentimetre_m : kMaxTrackedTurn_deg)) continue;
        return Error{std::string("has a ") + kNames[i] +
                     (is_length ? " beyond 100 m; it must be in centimetres" : " beyond a hundred turns")};
    }
    Head head;
    head.position = kCentimetre_m * glm::dvec3(numbers[0], numbers[1], numbers[2]);
    head.heading_rad = radians(numbers[3]);
    head.pitch_rad = radians(numbers[4]);
    head.roll_rad = radians(numbers[5]);
    return head;
}

Head head_in_room(const Head& tracked, const Head& zero) {
    const RoomPose axes{.position = zero.position, .heading_rad = zero.heading_rad};
    Head head = tracked;
    head.position = axes.in_scene(tracked.position);
    head.heading_rad += zero.heading_rad;
    return head;
}

}  // namespace rs::compositor
