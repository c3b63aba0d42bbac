// Chunk VIEW: views without their lines. object.views has its size from HEAD.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/format/object_ranges.hpp"

namespace rs::object_chunks {

using namespace object_ranges;

namespace {

constexpr std::size_t kView_bytes = 16;
constexpr std::int64_t kMaxColumnOffset_q16 = 32768 * kOne_q16;

Payload views_payload(const RaySpaceObject& object, std::uint32_t) {
    ByteWriter out;
    for (const CapturedView& view : object.views) {
        out.put(view.cx_q16);
        out.put(view.cy_q16);
        out.put(view.fl_y_q16);
        out.put(view.height_q20);
    }
    return out.bytes();
}

Status parse_views(Bytes payload, PartialObject& partial, std::uint32_t) {
    std::vector<CapturedView>& views = partial.object.views;
    if (payload.size() != views.size() * kView_bytes) {
        return wrong_size(payload.size(), views.size() * kView_bytes);
    }
    ByteReader in(payload);
    for (CapturedView& view : views) {
        view.cx_q16 = in.get<std::int32_t>();
        view.cy_q16 = in.get<std::int32_t>();
        view.fl_y_q16 = in.get<std::int32_t>();
        view.height_q20 = in.get<std::int32_t>();
    }
    return {};
}

Status check_view(const CapturedView& view) {
    if (!below(view.cx_q16, kMaxPixels_q16) || !below(view.cy_q16, kMaxPixels_q16)) {
        return Error{"its principal point lies 16384 px or more from the corner"};
    }
    if (view.fl_y_q16 <= 0 || view.fl_y_q16 >= kMaxPixels_q16) {
        return Error{"its focal length is not between 0 and 16384 px"};
    }
    if (!below(view.height_q20, kMaxDistance_q20)) return Error{"its height is 256 object radii or more"};
    for (const CapturedLine& line : view.lines) {
        // |l1| <= 1, since it is the cosine of an angle.
        if (!below(line.l0_q20, kMaxDistance_q20) || !below(line.l1_q30, kOne_q30 + 1)) {
            return Error{"the depth of one of its lines is out of range"};
        }
        if (!below(line.q0_q16, kMaxColumnOffset_q16) || !below(line.q1_q16, kMaxPixels_q16)) {
            return Error{"the columns of one of its lines are out of range"};
        }
    }
    return {};
}

Status check_views(const RaySpaceObject& object, std::uint32_t) {
    for (std::size_t i = 0; i < object.views.size(); ++i) {
        const Status status = check_view(object.views[i]);
        if (!status) return Error{"view " + std::to_string(i) + ": " + status.error().message};
    }
    return {};
}

std::int64_t held_by_views(const RaySpaceObject& object, std::uint32_t) {
    std::int64_t bytes = 0;
    for (const CapturedView& view : object.views) bytes += heap_bytes_of(view.lines);
    return bytes;
}

}  // namespace

ChunkKind views_chunk() {
    return {.name = kViews,
            .payload = views_payload,
            .parse = parse_views,
            .validate = check_views,
            .heap_bytes = held_by_views};
}

}  // namespace rs::object_chunks
