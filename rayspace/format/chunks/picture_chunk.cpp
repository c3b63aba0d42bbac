// PICT v: a picture, coded if the object's are (rayspace/codec/stream/coded_chunks.hpp), else as its planes are.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"

#include <cstring>

namespace rs::object_chunks {
namespace {

constexpr std::size_t kPictureHeader_bytes = 16;
constexpr std::uint8_t kRawCoding = 0;

Payload raw_payload(const PlanarPicture& picture) {
    ByteWriter out;
    out.reserve(kPictureHeader_bytes + raw_picture_bytes(picture.y.width(), picture.y.height()));
    out.put(kRawCoding);
    out.put_zeros(kPictureHeader_bytes - sizeof kRawCoding);
    for (const Image<std::uint8_t>* plane : {&picture.y, &picture.u, &picture.v, &picture.a}) out.put(plane->pixels());
    return out.bytes();
}

Status parse_raw(Bytes payload, int width, int height, PlanarPicture& picture) {
    ByteReader in(payload);
    const auto coding = in.get<std::uint8_t>();
    if (!in.ok()) return Error{"is empty"};
    if (coding != kRawCoding) {
        return Error{"has picture coding " + std::to_string(coding) + ", which is not known here; update these tools"};
    }
    if (!in.take_zeros(kPictureHeader_bytes - sizeof kRawCoding)) return Error{"has reserved bytes that are not zero"};
    const std::uint64_t expected_bytes = raw_picture_bytes(width, height);
    if (in.left() != expected_bytes) return wrong_size(payload.size(), kPictureHeader_bytes + expected_bytes);
    picture.y = Image<std::uint8_t>(width, height);
    picture.u = Image<std::uint8_t>(half_size(width), half_size(height));
    picture.v = Image<std::uint8_t>(half_size(width), half_size(height));
    picture.a = Image<std::uint8_t>(width, height);
    for (Image<std::uint8_t>* plane : {&picture.y, &picture.u, &picture.v, &picture.a}) {
        const auto bytes = in.take(plane->pixels().size());
        std::memcpy(plane->data(), bytes.data(), bytes.size());
    }
    return {};
}

Payload picture_payload(const RaySpaceObject& object, std::uint32_t view) {
    return object.coded ? codec::coded_picture_payload(*object.coded, view) : raw_payload(object.pictures[view]);
}

Status parse_picture(Bytes payload, UnreadObject& unread, std::uint32_t view) {
    if (unread.coded) return codec::parse_coded_picture(payload, view, *unread.coded);
    RaySpaceObject& object = unread.object;
    return parse_raw(payload, object.width, object.height, object.pictures[view]);
}

bool has_size(const Image<std::uint8_t>& plane, int width, int height) {
    return plane.width() == width && plane.height() == height;
}

Status check_picture(const RaySpaceObject& object, std::uint32_t view) {
    const PlanarPicture& picture = object.pictures[view];
    const int width = object.width;
    const int height = object.height;
    const bool none = picture.y.empty() && picture.u.empty() && picture.v.empty() && picture.a.empty();
    const int chroma_width = picture.chroma_shift == 0 ? width : half_size(width);
    const int chroma_height = picture.chroma_shift == 0 ? height : half_size(height);
    const bool whole = has_size(picture.y, width, height) && has_size(picture.a, width, height) &&
                       has_size(picture.u, chroma_width, chroma_height) &&
                       has_size(picture.v, chroma_width, chroma_height);
    if (none || whole) return {};
    return Error{"its planes do not have the object's picture size"};
}

std::int64_t held_by_picture(const RaySpaceObject& object, std::uint32_t view) {
    const PlanarPicture& picture = object.pictures[view];
    std::int64_t bytes = 0;
    for (const Image<std::uint8_t>* plane : {&picture.y, &picture.u, &picture.v, &picture.a})
        bytes += std::int64_t{plane->width()} * plane->height();
    return bytes;
}

}  // namespace

std::uint64_t raw_picture_bytes(int width, int height) {
    const auto area = [](int w, int h) { return static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h); };
    return 2 * area(width, height) + 2 * area(half_size(width), half_size(height));
}

ChunkKind picture_chunk() {
    return {.name = kPicture,
            .each = OneFor::view,
            .stage = ReadStage::pictures,
            .payload = picture_payload,
            .parse = parse_picture,
            .validate = check_picture,
            .held_bytes = held_by_picture};
}

}  // namespace rs::object_chunks
