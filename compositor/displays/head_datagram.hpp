#pragma once
// What a tracker reports about a head, in the datagrams of opentrack's output "UDP over network": six little-endian
// doubles, 48 bytes.
//
//     byte   0   8  16    24   32    40
//            x   y   z   yaw  pitch roll       cm, degrees
//
// In the axes of the tracker: x to the visitor's right, y up, z backwards, away from what is looked at; yaw grows to
// the left, pitch is up, roll leans to the right, as a Head has them. Pure; thread-safe.

#include "compositor/displays/wall.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>

namespace rs::compositor {

inline constexpr std::size_t kHeadDatagram_bytes = 48;
// A head that is farther from the tracker's zero along an axis is none, metres.
inline constexpr double kFarthestTrackedHead_m = 100;

// In the axes of the tracker, metres and radians. Fails at another length, at numbers that are none, beyond
// kFarthestTrackedHead_m and beyond a hundred turns.
Result<Head> head_from_datagram(std::span<const std::byte> bytes);

// Where a head is in the room, that the tracker has at `tracked` and whose zero is `zero`: turned by its heading, then
// moved there. Pitch and roll are the tracker's.
Head tracked_in_room(const Head& tracked, const Head& zero);

}  // namespace rs::compositor
