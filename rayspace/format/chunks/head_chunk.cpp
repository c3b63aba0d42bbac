// Chunk HEAD: object.name, units_per_radius, width, height, and the numbers of views and rings, which it creates empty.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/utf8.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"

#include <algorithm>
#include <string>

namespace rs::object_chunks {
namespace {

constexpr std::size_t kMaxName_bytes = 255;

Payload head_payload(const RaySpaceObject& object, std::uint32_t) {
    ByteWriter out;
    out.put(static_cast<std::uint32_t>(object.width));
    out.put(static_cast<std::uint32_t>(object.height));
    out.put(static_cast<std::uint32_t>(object.views.size()));
    out.put(static_cast<std::uint32_t>(object.rings.size()));
    out.put(object.units_per_radius);
    out.put(static_cast<std::uint32_t>(object.name.size()));
    out.put(object.name);
    return out.bytes();
}

Status parse_head(Bytes payload, PartialObject& partial, std::uint32_t) {
    RaySpaceObject& object = partial.object;
    ByteReader in(payload);
    const auto width = in.get<std::uint32_t>();
    const auto height = in.get<std::uint32_t>();
    const auto views = in.get<std::uint32_t>();
    const auto rings = in.get<std::uint32_t>();
    object.units_per_radius = in.get_double();
    const auto name_bytes = in.get<std::uint32_t>();
    if (!in.ok()) return Error{"is too short"};
    if (width < 1 || width > kMaxImageSide_px) return out_of_range("the images' width", width, 1, kMaxImageSide_px);
    if (height < 1 || height > kMaxImageSide_px) {
        return out_of_range("the images' height", height, 1, kMaxImageSide_px);
    }
    if (views < 1 || views > kMaxViews) return out_of_range("the number of views", views, 1, kMaxViews);
    if (rings < 1 || rings > kMaxRings) return out_of_range("the number of rings", rings, 1, kMaxRings);
    if (name_bytes > kMaxName_bytes) return out_of_range("the name's length", name_bytes, 0, kMaxName_bytes);
    if (in.left() != name_bytes) return wrong_size(payload.size(), payload.size() - in.left() + name_bytes);
    object.width = static_cast<int>(width);
    object.height = static_cast<int>(height);
    object.views.resize(views);
    object.rings.resize(rings);
    object.images.resize(views);
    const Bytes name = in.take(name_bytes);
    object.name.assign(reinterpret_cast<const char*>(name.data()), name.size());
    return {};
}

bool is_printable_utf8(const std::string& text) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    if (std::any_of(text.begin(), text.end(), is_control)) return false;
    return is_utf8(text);
}

Status check_head(const RaySpaceObject& object, std::uint32_t) {
    const auto is_side = [](int side) { return side >= 1 && side <= kMaxImageSide_px; };
    if (!is_side(object.width) || !is_side(object.height)) {
        return Error{"images of " + std::to_string(object.width) + "x" + std::to_string(object.height) +
                     " pixels; each side must be 1.." + std::to_string(kMaxImageSide_px)};
    }
    if (object.views.empty() || object.views.size() > kMaxViews) {
        return Error{std::to_string(object.views.size()) + " views; 1.." + std::to_string(kMaxViews) + " are possible"};
    }
    if (object.rings.empty() || object.rings.size() > kMaxRings) {
        return Error{std::to_string(object.rings.size()) + " rings; 1.." + std::to_string(kMaxRings) + " are possible"};
    }
    if (object.images.size() != object.views.size()) return Error{"not as many images as views"};
    if (object.name.size() > kMaxName_bytes || !is_printable_utf8(object.name)) {
        return Error{"its name is longer than " + std::to_string(kMaxName_bytes) + " bytes or no printable UTF-8"};
    }
    if (!(object.units_per_radius >= 1e-12 && object.units_per_radius <= 1e12)) {
        return Error{"its units per radius are not within 1e-12..1e12"};
    }
    return {};
}

std::int64_t held_by_head(const RaySpaceObject& object, std::uint32_t) {
    return heap_bytes_of(object.views) + heap_bytes_of(object.rings) + heap_bytes_of(object.images);
}

}  // namespace

ChunkKind head_chunk() {
    return {.name = kHead,
            .payload = head_payload,
            .parse = parse_head,
            .validate = check_head,
            .heap_bytes = held_by_head};
}

}  // namespace rs::object_chunks
