// Chunk CODE: data shared by the coded images of an object; payload in rayspace/codec/stream/coded_chunks.hpp.
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"

namespace rs::object_chunks {
namespace {

Payload shared_payload(const RaySpaceObject& object, std::uint32_t) {
    return codec::code_payload(*object.coded);
}

Status parse_shared(Bytes payload, PartialObject& partial, std::uint32_t) {
    RaySpaceObject& object = partial.object;
    partial.coded = std::make_shared<codec::CodedImages>();
    object.coded = partial.coded;
    return codec::parse_code(payload, object.views.size(), object.width, object.height, *partial.coded);
}

Status check_coded(const RaySpaceObject& object, std::uint32_t) {
    if (object.coded &&
        (object.coded->width != object.width || object.coded->height != object.height ||
         object.coded->images.size() != object.views.size() || object.coded->levels.size() != object.views.size())) {
        return Error{"its coded images do not have the object's size and number"};
    }
    return {};
}

std::int64_t held_by_coded(const RaySpaceObject& object, std::uint32_t) {
    if (!object.coded) return 0;
    const codec::CodedImages& coded = *object.coded;
    std::int64_t bytes = sizeof(codec::CodedImages) + heap_bytes_of(coded.levels) + heap_bytes_of(coded.images);
    for (const codec::CodedImage& image : coded.images)
        bytes += heap_bytes_of(image.tiles) + heap_bytes_of(image.bytes);
    for (const codec::Books& books : coded.board.books) {
        for (const codec::Book& book : books.block) bytes += heap_bytes_of(book);
        for (const codec::Book& book : books.quarter) bytes += heap_bytes_of(book);
    }
    return bytes + heap_bytes_of(coded.board.alpha);
}

}  // namespace

ChunkKind code_chunk() {
    return {.name = kCode,
            .is_present = [](const RaySpaceObject& object, std::uint32_t) { return object.coded != nullptr; },
            .payload = shared_payload,
            .parse = parse_shared,
            .validate = check_coded,
            .heap_bytes = held_by_coded};
}

}  // namespace rs::object_chunks
