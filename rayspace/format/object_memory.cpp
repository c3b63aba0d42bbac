#include "rayspace/format/object_memory.hpp"

#include <vector>

namespace rs {
namespace {

template <class T>
std::int64_t held_by(const std::vector<T>& list) {
    return static_cast<std::int64_t>(list.capacity() * sizeof(T));
}

std::int64_t held_by(const Image<std::uint8_t>& plane) {
    return std::int64_t{plane.width()} * plane.height();
}

std::int64_t held_by(const codec::CodedPictures& coded) {
    std::int64_t bytes = sizeof(codec::CodedPictures) + held_by(coded.levels) + held_by(coded.pictures);
    for (const codec::CodedPicture& picture : coded.pictures) bytes += held_by(picture.tiles) + held_by(picture.bytes);
    for (const codec::Books& books : coded.board.books) {
        for (const codec::Book& book : books.block) bytes += held_by(book);
        for (const codec::Book& book : books.quarter) bytes += held_by(book);
    }
    return bytes + held_by(coded.board.alpha);
}

}  // namespace

std::int64_t memory_of(const RaySpaceObject& object) {
    std::int64_t bytes = sizeof(RaySpaceObject) + static_cast<std::int64_t>(object.rig_json.capacity()) +
                         held_by(object.views) + held_by(object.rings) + held_by(object.pictures);
    for (const CapturedView& view : object.views) bytes += held_by(view.lines);
    for (const Ring& ring : object.rings) {
        bytes += held_by(ring.views) + held_by(ring.cells) + held_by(ring.shape.gaps) +
                 held_by(ring.shape.normal_lines) + held_by(ring.shape.cells);
    }
    for (const PlanarPicture& picture : object.pictures) {
        bytes += held_by(picture.y) + held_by(picture.u) + held_by(picture.v) + held_by(picture.a);
    }
    if (object.coded) bytes += held_by(*object.coded);
    return bytes;
}

}  // namespace rs
