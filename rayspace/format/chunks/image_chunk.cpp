// Chunk PICT v: an image, coded (rayspace/codec/stream/coded_chunks.hpp) or as raw planes.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"

#include <cstring>

namespace rs::object_chunks {
namespace {

constexpr std::size_t kImageHeader_bytes = 16;
constexpr std::uint8_t kRawCoding = 0;

Payload raw_payload(const PlanarImage& image) {
    ByteWriter out;
    out.reserve(kImageHeader_bytes + raw_image_bytes(image.y.width(), image.y.height()));
    out.put(kRawCoding);
    out.put_zeros(kImageHeader_bytes - sizeof kRawCoding);
    for (const Image<std::uint8_t>* plane : {&image.y, &image.u, &image.v, &image.a}) out.put(plane->pixels());
    return out.bytes();
}

Status parse_raw(Bytes payload, int width, int height, PlanarImage& image) {
    ByteReader in(payload);
    const auto coding = in.get<std::uint8_t>();
    if (!in.ok()) return Error{"is empty"};
    if (coding != kRawCoding) {
        return Error{"has image coding " + std::to_string(coding) + ", which is not known here; update these tools"};
    }
    if (!in.take_zeros(kImageHeader_bytes - sizeof kRawCoding)) return Error{"has reserved bytes that are not zero"};
    const std::uint64_t expected_bytes = raw_image_bytes(width, height);
    if (in.left() != expected_bytes) return wrong_size(payload.size(), kImageHeader_bytes + expected_bytes);
    image.y = Image<std::uint8_t>(width, height);
    image.u = Image<std::uint8_t>(half_size(width), half_size(height));
    image.v = Image<std::uint8_t>(half_size(width), half_size(height));
    image.a = Image<std::uint8_t>(width, height);
    for (Image<std::uint8_t>* plane : {&image.y, &image.u, &image.v, &image.a}) {
        const auto bytes = in.take(plane->pixels().size());
        std::memcpy(plane->data(), bytes.data(), bytes.size());
    }
    return {};
}

Payload image_payload(const RaySpaceObject& object, std::uint32_t view) {
    return object.coded ? codec::coded_image_payload(*object.coded, view) : raw_payload(object.images[view]);
}

Status parse_image(Bytes payload, PartialObject& partial, std::uint32_t view) {
    if (partial.coded) return codec::parse_coded_image(payload, view, *partial.coded);
    RaySpaceObject& object = partial.object;
    return parse_raw(payload, object.width, object.height, object.images[view]);
}

bool has_size(const Image<std::uint8_t>& plane, int width, int height) {
    return plane.width() == width && plane.height() == height;
}

Status check_image(const RaySpaceObject& object, std::uint32_t view) {
    const PlanarImage& image = object.images[view];
    const int width = object.width;
    const int height = object.height;
    const bool none = image.y.empty() && image.u.empty() && image.v.empty() && image.a.empty();
    const int chroma_width = image.chroma_shift == 0 ? width : half_size(width);
    const int chroma_height = image.chroma_shift == 0 ? height : half_size(height);
    const bool whole = has_size(image.y, width, height) && has_size(image.a, width, height) &&
                       has_size(image.u, chroma_width, chroma_height) && has_size(image.v, chroma_width, chroma_height);
    if (none || whole) return {};
    return Error{"its planes do not have the object's image size"};
}

std::int64_t held_by_image(const RaySpaceObject& object, std::uint32_t view) {
    const PlanarImage& image = object.images[view];
    std::int64_t bytes = 0;
    for (const Image<std::uint8_t>* plane : {&image.y, &image.u, &image.v, &image.a})
        bytes += std::int64_t{plane->width()} * plane->height();
    return bytes;
}

}  // namespace

std::uint64_t raw_image_bytes(int width, int height) {
    const auto area = [](int w, int h) { return static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h); };
    return 2 * area(width, height) + 2 * area(half_size(width), half_size(height));
}

ChunkKind image_chunk() {
    return {.name = kImage,
            .each = ChunkScope::view,
            .stage = ReadStage::images,
            .payload = image_payload,
            .parse = parse_image,
            .validate = check_image,
            .heap_bytes = held_by_image};
}

}  // namespace rs::object_chunks
