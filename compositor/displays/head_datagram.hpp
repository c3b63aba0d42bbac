#pragma once
// Tracked head poses in the datagrams of opentrack's output "UDP over network": six little-endian doubles, 48 bytes.
//
//     byte   0   8  16    24   32    40
//            x   y   z   yaw  pitch roll       cm, degrees
//
// Axes of the tracker: x to the visitor's right, y up, z backwards, away from the display; yaw increases to the left,
// pitch upwards, roll to the right, as in Head. Pure; thread-safe.

#include "compositor/displays/wall.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>

namespace rs::compositor {

inline constexpr std::size_t kHeadDatagram_bytes = 48;
/// Maximum of each coordinate of a valid head position.
inline constexpr double kMaxHeadDistance_m = 100;

/// Head pose in the tracker's axes, metres and radians. Fails on a wrong length, values that are not finite, positions
/// beyond kMaxHeadDistance_m and angles beyond 100 turns.
Result<Head> head_from_datagram(std::span<const std::byte> bytes);

/// Transforms a tracked head into the room: rotated by the heading of `zero`, the tracker's origin, then translated to
/// it. Pitch and roll are the tracker's.
Head head_in_room(const Head& tracked, const Head& zero);

}  // namespace rs::compositor
