#pragma once
// The view that a leading rs-view shares with followers on other machines, and its messages. A leader sends messages
// over TCP, all little-endian, and reads nothing:
//
//     byte  0       4        6     8     12      20
//           "RSVS"  version  kind  size  scene   payload of `size` bytes
//
// `scene` is a digest of the scene, which must be the follower's. Kinds: 1 view (SharedView, at most
// kMaxViewMessage_bytes), 2 lights (a JSON light list, scene/light/lights_file.hpp, at most kMaxLightsMessage_bytes).
// A follower uses the newest of each kind.

#include "compositor/displays/wall.hpp"
#include "compositor/scene/weather.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs::compositor {

inline constexpr std::uint16_t kSharingVersion = 1;
inline constexpr std::size_t kMessageHeader_bytes = 20;
inline constexpr std::size_t kMaxViewMessage_bytes = 64U << 10U;
inline constexpr std::size_t kMaxLightsMessage_bytes = 4U << 20U;
/// Objects whose turns fit into a message.
inline constexpr std::size_t kMaxSharedTurns = 4096;

/// View of a frame, except for its lights. Pixels and fields of view of walls are the followers' own.
struct SharedView {
    /// Room and head of a leader with walls.
    struct Room {
        RoomPose place;
        Head head;
    };

    glm::dmat4 world_from_camera{1.0};  // rigid; columns are right, up, back, centre, as in Viewpoint
    double field_of_view_rad = 0;       // along the shorter image side; 0: the follower's own
    std::optional<Room> room{};
    std::uint8_t renderer = 0;         // 0: raster; else 1 + index in kTracedMethods, at most 4
    std::uint32_t frame = 0;           // of the sequence, if the scene is one
    std::optional<Weather> weather{};  // likewise
    double exposure_ev = 0;
    bool shadows = true;
    bool wire_frame = false;
    std::vector<double> turns_rad{};  // [object]; at most kMaxSharedTurns
};

/// Messages with header. Programmer error beyond the limits.
std::vector<std::byte> view_message(const SharedView& view, std::uint64_t scene);
std::vector<std::byte> lights_message(const std::string& json, std::uint64_t scene);

/// Reads a stream of messages. Memory is limited to the largest message and the bytes of one take().
class SharedViewReader {
public:
    explicit SharedViewReader(std::uint64_t scene) : scene_(scene) {}

    /// Appends received bytes and reads all messages that are complete. Fails for a stream that is not a leader's, of
    /// another version or scene, and for values outside of their limits; the reader must not be used afterwards.
    Status take(std::span<const std::byte> bytes);

    /// Newest of the messages read since the last call.
    std::optional<SharedView> take_view();
    std::optional<std::string> take_lights();

private:
    std::uint64_t scene_;
    std::vector<std::byte> pending_;  // start of an incomplete message
    std::optional<SharedView> view_;
    std::optional<std::string> lights_;
};

}  // namespace rs::compositor
