// C interface of the WebAssembly module. A module holds one object. Functions that can fail return 0 or a null pointer;
// web_error() then gives the message. Memory for inputs is allocated by web_allocate() and passed on to the function
// that takes it.

#include "compositor/web/core/web_core.hpp"

#include "compositor/gpu/shader/photo_texels.hpp"
#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "compositor/gpu/shader/texture_layout.hpp"
#include "compositor/gpu/shader/view_uniforms.hpp"
#include "compositor/web/view/shader_inputs.hpp"

#include <xxhash.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::web {
namespace {

std::optional<ObjectView> opened;
std::string last_error;
std::vector<double> description;

// Inputs of WebGL, each valid until the next call of its function.
ShaderInputs shader_inputs;
PreparedView prepared;
ShaderView shader_view;
std::vector<std::int32_t> shader_view_places;
std::vector<compositor::CellPair> cells;
compositor::PhotoTexels photo;
std::string shader_text;

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

// Reads the registers of web_render_registers() into `prepared`.
Status read_registers(std::span<const double> values) {
    if (values.size() < kHead || (values.size() - kHead) % kPlane != 0) {
        return Error{"view: its registers are incomplete"};
    }
    prepared = {{registers_from(values), {}, 0}, {}};
    return engine::check_registers(opened->object(), prepared.rings.nearest);
}

// Address in the module's memory.
std::int32_t place_of(const void* data) {
    return static_cast<std::int32_t>(reinterpret_cast<std::uintptr_t>(data));
}

// Result of web_prepare().
const std::int32_t* places_of(const engine::ViewRegisters& registers) {
    shader_view = shader_inputs.prepare(opened->object(), registers);
    const std::vector<SampledRow> none;
    const std::vector<SampledRow>& rows = prepared.rows ? *prepared.rows : none;
    shader_view_places = {registers.width, registers.height, registers.ring, shader_view.setup_rows,
                          prepared.rings.weight_q8};
    const auto add = [](const auto& values) {
        shader_view_places.insert(shader_view_places.end(),
                                  {place_of(values.data()), static_cast<std::int32_t>(values.size())});
    };
    add(shader_view.setups);
    add(shader_view.uniforms);
    add(shader_view.photos);
    add(rows);
    return shader_view_places.data();
}

}  // namespace

std::optional<ObjectView>& opened_view() {
    return opened;
}

void close_object() {
    opened.reset();
    shader_inputs = {};
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
    close_object();
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
    if (!succeeded(read_registers({values, count}))) return nullptr;
    if (!succeeded(opened->render_registers(prepared.rings.nearest))) return nullptr;
    return opened->image().data();
}

/// Axial depths (q20) of web_render_registers().
WEB_EXPORT const std::int32_t* web_depth() {
    return opened->lambda_q20().data();
}

/// Texts for WebGL: 0: vertex shader, 1: fragment shader of the reconstruction, 2: fragment shader that draws a view
/// onto a canvas, 3: names of the reconstruction's uniforms, separated by spaces.
WEB_EXPORT const char* web_shader_text(int which) {
    using namespace rs::compositor;
    if (which == 0) shader_text = reconstruction_vertex_shader(ShaderDialect::kEmbedded);
    if (which == 1) shader_text = reconstruction_fragment_shader(ShaderDialect::kEmbedded);
    if (which == 2) shader_text = present_shader();
    if (which != 3) return shader_text.c_str();
    shader_text.clear();
    for (const ShaderUniform& uniform : view_uniforms(opened->object(), {})) {
        shader_text += (shader_text.empty() ? "" : " ") + std::string(uniform.name);
    }
    return shader_text.c_str();
}

/// \return 1 if the object's textures are within the limits of WebGL
WEB_EXPORT int web_check_textures(int max_side, int max_layers) {
    return succeeded(rs::compositor::check_texture_limits(
               opened->object(), static_cast<int>(opened->object().views.size()), max_side, max_layers))
               ? 1
               : 0;
}

WEB_EXPORT int web_cell_rows(int ring) {
    return static_cast<int>(rs::compositor::cell_texture_rows(opened->object().rings[std::size_t(ring)].shape));
}

/// Texture of a ring's cells: web_cell_rows() rows of kCellTextureWidth texels of four bytes.
WEB_EXPORT const rs::compositor::CellPair* web_cells(int ring) {
    cells = rs::compositor::cell_pairs(opened->object().rings[std::size_t(ring)].shape);
    return cells.data();
}

/// Decodes a loaded photo. \return its RGBA, row by row
WEB_EXPORT const rs::Rgba8* web_photo(int number) {
    photo = rs::compositor::photo_texels(opened->texels(), number, opened->object().width, opened->object().height);
    return photo.colours.data();
}

/// Details of the last photo of web_photo(), one signed byte per pixel.
WEB_EXPORT const std::int8_t* web_photo_details() {
    return photo.details.data();
}

/// Inputs of the reconstruction shader for a view. \return null, or thirteen numbers: width and height of the image to
/// render, ring, rows of set-ups, weight (q8) of the second ring or 0; address and count of the set-ups (texels of four
/// numbers), of the uniforms (four numbers each), of the photos that the view needs, and of its SampledRows; no set-ups
/// if there would be too many
WEB_EXPORT const std::int32_t* web_prepare(int width, int height, double azimuth_rad, double elevation_rad,
                                           double distance) {
    rs::Result<PreparedView> made = opened->prepare({width, height, azimuth_rad, elevation_rad, distance});
    if (!made) {
        last_error = made.error().message;
        return nullptr;
    }
    prepared = std::move(*made);
    return places_of(prepared.rings.nearest);
}

/// The inputs for the second ring of the last view of web_prepare(), whose weight is above 0. \return as web_prepare()
WEB_EXPORT const std::int32_t* web_prepare_second() {
    return places_of(*prepared.rings.second);
}

/// As web_prepare(), for the view of given registers (web_render_registers()).
WEB_EXPORT const std::int32_t* web_prepare_registers(const double* values, std::size_t count) {
    if (!succeeded(read_registers({values, count}))) return nullptr;
    return places_of(prepared.rings.nearest);
}

/// XXH64 of bytes as 16 hexadecimal digits, as in conformance vectors.
WEB_EXPORT const char* web_hash(const void* bytes, std::size_t size_bytes) {
    static char text[17];
    std::uint64_t hash = XXH64(bytes, size_bytes, 0);
    for (int i = 15; i >= 0; --i, hash >>= 4) text[i] = "0123456789abcdef"[hash & 15];
    return text;
}
