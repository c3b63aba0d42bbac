#pragma once
// Reads the parts of a recipe that do not depend on the object: materials, lights, environment, camera, toon style. The
// schema is in capture/README.md. Part of scene_file.

#include "capture/tracer/scene/scene.hpp"
#include "capture/tracer/scene/toon_style.hpp"
#include "rayspace/base/json_text.hpp"

#include <filesystem>

namespace rs::capture {

// Default camera of the turntable; the command line overrides it.
struct CameraRecipe {
    double distance_radii = 3.5;  // from the axis, in bounding-sphere radii
    double focal_widths = 1.4;    // focal length over image width
    double elevation_deg = 0;
    double look_at_height = 0;
    int views = 90;
    int width = 512;
    int height = 512;
    int samples_per_pixel = 64;
    double aperture_radii = 0;  // diameter of the aperture; 0 = pinhole
    double focus_radii = 0;     // focus distance from the camera; 0 = the axis
};

// Each function overwrites the members of its last argument that the JSON value contains, and throws MalformedJson on
// errors.
void read_material(JsonObject object, Material& material);
void read_camera(JsonObject object, CameraRecipe& camera);
void read_lights(const JsonValue& list, Scene& scene);
void read_toon(JsonObject object, ToonStyle& style);
// The part of read_toon() for any renderer: without the keys "edge_radius" and "shadow_rays". Ignores unknown keys.
// \param max_depth limit of "edge_depth", in the scene's units
void read_toon_look(JsonObject& object, ToonStyle& style, double max_depth);
// Files are relative to `folder`.
void read_environment(JsonObject object, const std::filesystem::path& folder, Environment& environment);

}  // namespace rs::capture
