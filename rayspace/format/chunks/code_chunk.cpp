// Chunk CODE: data shared by the coded images of an object; payload in rayspace/codec/stream/coded_chunks.hpp.
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"

namespace rs::object_chunks {
namespace {

Payload shared_payload(const RaySpaceObject& object, std::uint32_t) {
    return codec::code_payload(*object.coded);
}

Status parse_shared(Bytes payload, UnreadObject& unread, std::uint32_t) {
    RaySpaceObject& object = unread.object;
    unread.coded = std::make_shared<codec::CodedImages>();
    object.coded = unread.coded;
    return codec::parse_code(payload, object.views.size(), object.width, object.height, *unread.coded);
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
    std::int64_t bytes = sizeof(codec::CodedImages) + held_by(coded.levels) + held_by(coded.images);
    for (const codec::CodedImage& image : coded.images) bytes += held_by(image.tiles) + held_by(image.bytes);
    for (const codec::Books& books : coded.board.books) {
        for (const codec::Book& book : books.block) bytes += held_by(book);
        for (const codec::Book& book : books.quarter) bytes += held_by(book);
    }
    return bytes + held_by(coded.board.alpha);
}

}  // namespace

ChunkKind code_chunk() {
    return {.name = kCode,
            .is_there = [](const RaySpaceObject& object, std::uint32_t) { return object.coded != nullptr; },
            .payload = shared_payload,
            .parse = parse_shared,
            .validate = check_coded,
            .held_bytes = held_by_coded};
}

}  // namespace rs::object_chunks
