// C interface of the WebAssembly module. A module holds one object. Functions that can fail return 0 or a null pointer;
// web_error() then gives the message. Memory for inputs is allocated by web_allocate() and passed on to the function
// that takes it.

#include "compositor/web/core/web_core.hpp"

#include <xxhash.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>

namespace rs::web {
namespace {

std::optional<ObjectView> opened;
std::string last_error;
std::vector<double> description;

engine::LinearForm next_form(std::span<const double>& values) {
    const auto take = [&](std::size_t i) { return static_cast<std::int64_t>(values[i]); };
    const engine::LinearForm form{take(0), take(1), take(2)};
    values = values.subspan(3);
    return form;
}

constexpr std::size_t kHead = 8;   // width, height, ring, filter, b, rise
constexpr std::size_t kPlane = 8;  // a, c, along_normal, along_tangent

engine::ViewRegisters registers_from(std::span<const double> values) {
    engine::ViewRegisters registers;
    registers.width = static_cast<int>(values[0]);
    registers.height = static_cast<int>(values[1]);
    registers.ring = static_cast<int>(values[2]);
    registers.filter = static_cast<engine::TexelFilter>(values[3]);
    registers.b_q20 = static_cast<std::int32_t>(values[4]);
    values = values.subspan(5);
    registers.rise = next_form(values);
    while (values.size() >= kPlane) {
        engine::PlaneRegisters& plane = registers.planes.emplace_back();
        plane.a_q20 = static_cast<std::int32_t>(values[0]);
        plane.c_q20 = static_cast<std::int32_t>(values[1]);
        values = values.subspan(2);
        plane.along_normal = next_form(values);
        plane.along_tangent = next_form(values);
    }
    return registers;
}

}  // namespace

std::optional<ObjectView>& opened_view() {
    return opened;
}

bool succeeded(const Status& status) {
    if (!status) last_error = status.error().message;
    return status.ok();
}

}  // namespace rs::web

using namespace rs::web;

/// Message of the last failure; valid until the next call.
WEB_EXPORT const char* web_error() {
    return last_error.c_str();
}

WEB_EXPORT void* web_allocate(std::size_t size_bytes) {
    return std::malloc(size_bytes);
}

WEB_EXPORT void web_free(void* memory) {
    std::free(memory);
}

/// Opens the .rso file `bytes`, and closes the one opened before. \return 1 on success
WEB_EXPORT int web_open(const std::byte* bytes, std::size_t size_bytes, const char* name, int max_level) {
    opened.reset();
    rs::Result<ObjectView> made = ObjectView::open({bytes, bytes + size_bytes}, name, max_level);
    if (!made) {
        last_error = made.error().message;
        return 0;
    }
    opened.emplace(std::move(*made));
    return 1;
}

/// Numbers about the object: width and height of its photos, photos, rings; then for each ring its captured distance
/// and target height (object radii), elevation and azimuth (radians).
WEB_EXPORT const double* web_describe() {
    const rs::RaySpaceObject& object = opened->object();
    description = {double(object.width), double(object.height), double(object.views.size()),
                   double(object.rings.size())};
    for (const CapturedCamera& ring : opened->captured()) {
        description.insert(description.end(),
                           {ring.distance, ring.target_height, ring.elevation_rad, ring.azimuth_rad});
    }
    return description.data();
}

WEB_EXPORT const char* web_name() {
    return opened->object().name.c_str();
}

/// Renders a view. \return its width x height RGBA pixels, valid until the next call, or null
WEB_EXPORT const rs::Rgba8* web_render(int width, int height, double azimuth_rad, double elevation_rad,
                                       double distance) {
    if (!succeeded(opened->render({width, height, azimuth_rad, elevation_rad, distance}))) return nullptr;
    return opened->image().data();
}

/// Renders the view of given registers: width, height, ring, filter, b, and the three numbers of `rise`; then for each
/// plane a, c, and the three numbers of `along_normal` and of `along_tangent`. \return as web_render()
WEB_EXPORT const rs::Rgba8* web_render_registers(const double* values, std::size_t count) {
    if (count < kHead || (count - kHead) % kPlane != 0) {
        last_error = "view: its registers are incomplete";
        return nullptr;
    }
    if (!succeeded(opened->render_registers(registers_from({values, count})))) return nullptr;
    return opened->image().data();
}

/// Axial depths (q20) of web_render_registers().
WEB_EXPORT const std::int32_t* web_depth() {
    return opened->lambda_q20().data();
}

/// XXH64 of bytes as 16 hexadecimal digits, as in conformance vectors.
WEB_EXPORT const char* web_hash(const void* bytes, std::size_t size_bytes) {
    static char text[17];
    std::uint64_t hash = XXH64(bytes, size_bytes, 0);
    for (int i = 15; i >= 0; --i, hash >>= 4) text[i] = "0123456789abcdef"[hash & 15];
    return text;
}
