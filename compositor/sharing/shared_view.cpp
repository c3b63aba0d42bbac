#include "compositor/sharing/shared_view.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::uint32_t kMagic = 0x53565352;  // "RSVS"
constexpr std::uint16_t kViewKind = 1;
constexpr std::uint16_t kLightsKind = 2;
constexpr std::uint8_t kMaxRenderer = 4;
constexpr double kMaxSharedCoordinate = 1e9;
constexpr double kMaxSharedAngle_rad = 1e6;
constexpr double kMaxExposure_ev = 40;
constexpr double kMaxRotationError = 1e-6;

// Bits of the view's flags.
constexpr std::uint8_t kShadowsBit = 1;
constexpr std::uint8_t kWireFrameBit = 2;
constexpr std::uint8_t kRoomBit = 4;
constexpr std::uint8_t kWeatherBit = 8;

void put_vector(ByteWriter& writer, const glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) writer.put(v[i]);
}

std::vector<std::byte> framed_message(std::uint16_t kind, std::span<const std::byte> payload, std::uint64_t scene) {
    ByteWriter writer;
    writer.reserve(kMessageHeader_bytes + payload.size());
    writer.put(kMagic);
    writer.put(kSharingVersion);
    writer.put(kind);
    writer.put(static_cast<std::uint32_t>(payload.size()));
    writer.put(scene);
    writer.put(payload);
    return writer.bytes();
}

void put_room(ByteWriter& writer, const SharedView::Room& room) {
    put_vector(writer, room.place.position);
    writer.put(room.place.heading_rad);
    writer.put(room.place.units_per_metre);
    put_vector(writer, room.head.position);
    for (const double angle : {room.head.heading_rad, room.head.pitch_rad, room.head.roll_rad}) writer.put(angle);
}

void put_weather(ByteWriter& writer, const Weather& weather) {
    for (const bool is_on : {weather.rain, weather.snow, weather.fog}) writer.put(static_cast<std::uint8_t>(is_on));
    writer.put(weather.seed);
    put_vector(writer, weather.wind);
    writer.put(weather.visibility);
}

// Reads numbers with limits. The first fault is kept.
class ViewParser {
public:
    explicit ViewParser(std::span<const std::byte> payload) : reader_(payload) {}

    double number(const char* name, double lowest, double highest) {
        const double value = reader_.get_double();
        if (!(value >= lowest && value <= highest) && fault_.empty()) {
            fault_ = std::string("has a ") + name + " that is not a number within its limits";
        }
        return value;
    }
    double angle(const char* name) { return number(name, -kMaxSharedAngle_rad, kMaxSharedAngle_rad); }
    glm::dvec3 vector(const char* name, double limit = kMaxSharedCoordinate) {
        glm::dvec3 v{0};
        for (int i = 0; i < 3; ++i) v[i] = number(name, -limit, limit);
        return v;
    }
    template <std::integral T>
    T whole(const char* name, T highest) {
        const T value = reader_.get<T>();
        if (value > highest && fault_.empty()) fault_ = std::string("has a ") + name + " beyond its limit";
        return value;
    }
    void expect(bool condition, const char* fault) {
        if (!condition && fault_.empty()) fault_ = fault;
    }

    [[nodiscard]] std::size_t left() const { return reader_.left(); }
    [[nodiscard]] Status finish() {
        expect(reader_.at_end(), "has a wrong length");
        return fault_.empty() ? Status() : Status(Error{fault_});
    }

private:
    ByteReader reader_;
    std::string fault_;
};

glm::dmat4 read_pose(ViewParser& parser) {
    glm::dmat4 pose(1.0);
    for (int column = 0; column < 3; ++column) pose[column] = glm::dvec4(parser.vector("camera axis", 2), 0);
    pose[3] = glm::dvec4(parser.vector("camera position"), 1);
    const glm::dmat3 axes(pose);
    const glm::dmat3 error = glm::transpose(axes) * axes - glm::dmat3(1.0);
    double largest = std::abs(glm::determinant(axes) - 1);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(error[column][row]));
    }
    parser.expect(largest <= kMaxRotationError, "has a camera whose axes are not a rotation");
    return pose;
}

SharedView::Room read_shared_room(ViewParser& parser) {
    SharedView::Room room;
    room.place.position = parser.vector("room position");
    room.place.heading_rad = parser.angle("room heading");
    room.place.units_per_metre = parser.number("scale of the room", 1e-9, kMaxSharedCoordinate);
    room.head.position = parser.vector("head position", 100);
    room.head.heading_rad = parser.angle("head heading");
    room.head.pitch_rad = parser.angle("head pitch");
    room.head.roll_rad = parser.angle("head roll");
    return room;
}

Weather read_weather(ViewParser& parser) {
    Weather weather;
    for (bool* const is_on : {&weather.rain, &weather.snow, &weather.fog}) {
        *is_on = parser.whole<std::uint8_t>("kind of weather", 1) != 0;
    }
    parser.expect(!(weather.rain && weather.snow), "has both rain and snow");
    weather.seed = parser.whole<std::uint32_t>("seed", 1'000'000'000);
    weather.wind = parser.vector("wind", 1000);
    weather.visibility = parser.number("visibility", 1, 100'000);
    return weather;
}

Result<SharedView> view_from_payload(std::span<const std::byte> payload) {
    ViewParser parser(payload);
    SharedView view;
    const auto flags = parser.whole<std::uint8_t>("flag", kShadowsBit | kWireFrameBit | kRoomBit | kWeatherBit);
    view.shadows = (flags & kShadowsBit) != 0;
    view.wire_frame = (flags & kWireFrameBit) != 0;
    view.renderer = parser.whole<std::uint8_t>("renderer", kMaxRenderer);
    view.frame = parser.whole<std::uint32_t>("frame", 1'000'000);
    view.world_from_camera = read_pose(parser);
    view.field_of_view_rad = parser.number("field of view", 0, kPi - 1e-3);
    view.exposure_ev = parser.number("exposure", -kMaxExposure_ev, kMaxExposure_ev);
    if ((flags & kRoomBit) != 0) view.room = read_shared_room(parser);
    if ((flags & kWeatherBit) != 0) view.weather = read_weather(parser);
    const auto turns = parser.whole<std::uint32_t>("number of turns", kMaxSharedTurns);
    parser.expect(parser.left() == turns * sizeof(double), "has a wrong length");
    for (std::size_t left = parser.left(); left >= sizeof(double); left = parser.left()) {
        view.turns_rad.push_back(parser.angle("turn"));
    }
    RS_TRY(parser.finish());
    return view;
}

}  // namespace

std::vector<std::byte> view_message(const SharedView& view, std::uint64_t scene) {
    RS_CHECK(view.turns_rad.size() <= kMaxSharedTurns && view.renderer <= kMaxRenderer);
    const int flags = (view.shadows ? kShadowsBit : 0) | (view.wire_frame ? kWireFrameBit : 0) |
                      (view.room ? kRoomBit : 0) | (view.weather ? kWeatherBit : 0);
    ByteWriter writer;
    writer.put(static_cast<std::uint8_t>(flags));
    writer.put(view.renderer);
    writer.put(view.frame);
    for (int column = 0; column < 4; ++column) put_vector(writer, glm::dvec3(view.world_from_camera[column]));
    writer.put(view.field_of_view_rad);
    writer.put(view.exposure_ev);
    if (view.room) put_room(writer, *view.room);
    if (view.weather) put_weather(writer, *view.weather);
    writer.put(static_cast<std::uint32_t>(view.turns_rad.size()));
    for (const double turn : view.turns_rad) writer.put(turn);
    return framed_message(kViewKind, writer.bytes(), scene);
}

std::vector<std::byte> lights_message(const std::string& json, std::uint64_t scene) {
    RS_CHECK(json.size() <= kMaxLightsMessage_bytes);
    return framed_message(kLightsKind, std::as_bytes(std::span(json)), scene);
}

Status SharedViewReader::take(std::span<const std::byte> bytes) {
    pending_.insert(pending_.end(), bytes.begin(), bytes.end());
    std::span<const std::byte> left(pending_);
    while (left.size() >= kMessageHeader_bytes) {
        ByteReader header(left.first(kMessageHeader_bytes));
        if (header.get<std::uint32_t>() != kMagic) {
            return Error{"is not a leading rs-view; give the address of one that runs with --share"};
        }
        if (const auto version = header.get<std::uint16_t>(); version != kSharingVersion) {
            return Error{"shares views in version " + std::to_string(version) + ", and this rs-view in version " +
                         std::to_string(kSharingVersion) + "; install the same release on both machines"};
        }
        const auto kind = header.get<std::uint16_t>();
        const auto size = header.get<std::uint32_t>();
        if (header.get<std::uint64_t>() != scene_) {
            return Error{"shows another scene; open the same scene file on both machines"};
        }
        if (kind != kViewKind && kind != kLightsKind) {
            return Error{"sent a message of unknown kind " + std::to_string(kind)};
        }
        if (size > (kind == kViewKind ? kMaxViewMessage_bytes : kMaxLightsMessage_bytes)) {
            return Error{"sent a message of " + std::to_string(size) + " bytes, which exceeds the limit"};
        }
        if (left.size() < kMessageHeader_bytes + size) break;
        const std::span<const std::byte> payload = left.subspan(kMessageHeader_bytes, size);
        if (kind == kViewKind) {
            Result<SharedView> view = view_from_payload(payload);
            if (!view) return Error{"sent a view that " + view.error().message};
            view_ = std::move(*view);
        } else {
            lights_.emplace(reinterpret_cast<const char*>(payload.data()), payload.size());
        }
        left = left.subspan(kMessageHeader_bytes + size);
    }
    pending_.erase(pending_.begin(), pending_.end() - static_cast<std::ptrdiff_t>(left.size()));
    return {};
}

std::optional<SharedView> SharedViewReader::take_view() {
    return std::exchange(view_, std::nullopt);
}

std::optional<std::string> SharedViewReader::take_lights() {
    return std::exchange(lights_, std::nullopt);
}

}  // namespace rs::compositor
