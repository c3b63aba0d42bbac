// C interface of the WebAssembly module for scenes (compositor/web/scene): one object per module, seen from an eye
// point of the scene. Functions that can fail return null; web_scene_error() then gives the message.

#include "compositor/web/view/scene_view.hpp"

#include <emscripten/emscripten.h>

#include <optional>
#include <string>
#include <vector>

namespace rs::web {
namespace {

std::optional<SceneObject> scene_object;
SceneView scene_view;
std::string scene_error;
std::vector<double> scene_numbers;

constexpr std::size_t kMatrixNumbers = 16;

void append(const glm::dvec3& v) {
    scene_numbers.insert(scene_numbers.end(), {v.x, v.y, v.z});
}

void append(const glm::dmat3& m) {
    for (int column = 0; column < 3; ++column) append(m[column]);
}

// In the order of SceneCore.view (scene_core.ts).
void describe_view() {
    const compositor::ObjectView& view = scene_view.view;
    const Camera& screen = scene_view.screen;
    const glm::dvec3 origin = screen.ray(0, 0);
    scene_numbers = {double(scene_view.image.width()),
                     double(scene_view.image.height()),
                     double(view.rectangle.x),
                     double(view.rectangle.y),
                     double(view.rectangle.width),
                     double(view.rectangle.height),
                     double(view.samples_across),
                     view.smooth ? 1.0 : 0.0,
                     view.from_above ? 1.0 : 0.0,
                     view.units_per_rig_unit,
                     view.plane_distance};
    append(view.inverse_depth_facing);
    append(view.inverse_depth_foot);
    append(view.image_from_screen);
    append(screen.centre());
    append(glm::dmat3(screen.ray(1, 0) - origin, screen.ray(0, 1) - origin, origin));
}

}  // namespace
}  // namespace rs::web

using namespace rs::web;

/// Message of the last failure; valid until the next call.
extern "C" EMSCRIPTEN_KEEPALIVE const char* web_scene_error() {
    return scene_error.c_str();
}

/// Opens the .rso file `bytes`. \return radius, bottom and top of its bounds, bottom and top of the object itself, in
/// object radii
extern "C" EMSCRIPTEN_KEEPALIVE const double* web_scene_open(const std::byte* bytes, std::size_t size_bytes,
                                                             const char* name) {
    rs::Result<SceneObject> opened = SceneObject::open({bytes, bytes + size_bytes}, name);
    if (!opened) {
        scene_error = opened.error().message;
        return nullptr;
    }
    scene_object.emplace(std::move(*opened));
    const rs::compositor::ViewableObject& object = scene_object->object();
    scene_numbers = {object.bounds.radius, object.bounds.bottom, object.bounds.top, object.extent.bottom,
                     object.extent.top};
    return scene_numbers.data();
}

/// Renders what an eye sees.
/// \param values the node's matrix, column by column; 1 if the object stands on the node's origin; the eye; the focal
/// length in pixels; the largest number of pixels
/// \return numbers about the view (describe_view); all 0 in the first if nothing is seen
extern "C" EMSCRIPTEN_KEEPALIVE const double* web_scene_render(const double* values) {
    SceneSight sight;
    for (std::size_t i = 0; i < kMatrixNumbers; ++i) {
        sight.world_from_node[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = values[i];
    }
    values += kMatrixNumbers;
    sight.standing = values[0] != 0;
    sight.eye = {values[1], values[2], values[3]};
    sight.focal_px = values[4];
    sight.max_pixels = static_cast<int>(values[5]);
    const rs::Result<bool> seen = scene_object->render(sight, scene_view);
    if (!seen) {
        scene_error = seen.error().message;
        return nullptr;
    }
    if (*seen) {
        describe_view();
    } else {
        scene_numbers.assign(1, 0.0);
    }
    return scene_numbers.data();
}

/// Pixels of the last view: straight RGBA.
extern "C" EMSCRIPTEN_KEEPALIVE const rs::Rgba8* web_scene_image() {
    return scene_view.image.data();
}

/// Axial depths of the last view, in rig units.
extern "C" EMSCRIPTEN_KEEPALIVE const float* web_scene_depths() {
    return scene_view.depths.data();
}
