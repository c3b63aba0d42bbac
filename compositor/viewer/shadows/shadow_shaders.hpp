#pragma once
// GLSL of shadow maps: casters and lookups.
//
// The lookup is percentage-closer filtering (W. Reeves and others 1987) with bilinear weights of the nearest four
// texels, a kernel two texels wide. (Four such taps are smoother, but cost a third of a frame per light in software
// rendering.) The position is offset along the surface normal by the amount that the surface may rise towards the light
// within the kernel: kernel size in texels times the sine of the angle between the surface and the map. This avoids
// self-shadowing at any angle, as a slope-scaled depth bias does, and keeps contact shadows.
//
// Map-based selection: the nearest cascade of a directional light that contains the position is looked up.
// Cascades are not blended: a second look-up costs more than the step in sharpness disturbs.

namespace rs::compositor::shaders {

// Geometry and object shells.
inline constexpr const char* kCasterVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 texture_place;
uniform mat4 clip_from_node;
uniform mat3 texture_transform;
out vec2 place_on_texture;
void main() {
    gl_Position = clip_from_node * vec4(position, 1.0);
    vec3 st = texture_transform * vec3(texture_place, 1.0);
    place_on_texture = vec2(st.s, 1.0 - st.t);
})";
inline constexpr const char* kCasterFragment = R"(#version 450 core
void main() {})";
// With the alpha mask of the texture.
inline constexpr const char* kMaskedCasterFragment = R"(#version 450 core
layout(binding = 0) uniform sampler2D surface_picture;
in vec2 place_on_texture;
void main() {
    if (texture(surface_picture, place_on_texture).a < 0.5) discard;
})";

// Preceded by the constants kShadows: number of lights with rows, four rows each (LightShadow); kCascades: cascades per
// light that has some, 0 without such lights; kMaxCascadedLights.
inline constexpr const char* kShadowLookUp = R"(
layout(binding = 2) uniform sampler2DArrayShadow plane_maps;
layout(binding = 3) uniform sampler2DArrayShadow cube_maps;
uniform vec4 shadows[4 * max(kShadows, 1)];
uniform vec4 cascades[max(kCascades * kMaxCascadedLights, 1)];  // ShadowPlan::cascade_rows()
const float kReach = 1.42;  // kernel radius in texels: 1 along both axes
const float kLeast = 0.2;  // texels; covers the rounding of the maps

float off_surface(float along) {
    return kLeast + kReach * sqrt(max(1.0 - along * along, 0.0));
}

// Visibility by an orthographic map, or by the nearest cascade.
float parallel_shadow(int first, vec3 place, vec3 n, vec3 towards) {
    vec4 at = shadows[first + 3];  // layer, texel, first row of cascades, their number
    vec4 fit = vec4(0.0, 0.0, 1.0, 1.0);
    float layer = at.x;
    if (kCascades > 0) {
        const float kInside = 0.49;  // leaves room for the offset and the kernel
        vec2 middle = vec2(dot(shadows[first], vec4(place, 1.0)), dot(shadows[first + 1], vec4(place, 1.0)));
        for (int i = kCascades - 1; i >= 0; --i) {
            vec4 row = cascades[int(at.z) + i];
            vec2 off = abs(row.xy + row.zw * middle - 0.5);
            bool inside = at.w > 0.0 && max(off.x, off.y) < kInside;
            fit = inside ? row : fit;
            layer = inside ? at.x + float(i + 1) : layer;
        }
    }
    float texel = kCascades > 0 ? at.y / max(fit.z, fit.w) : at.y;
    vec4 p = vec4(place + n * (texel * off_surface(dot(n, towards))), 1.0);
    vec2 uv = vec2(dot(shadows[first], p), dot(shadows[first + 1], p));
    if (kCascades > 0) uv = fit.xy + fit.zw * uv;
    float depth = clamp(dot(shadows[first + 2], p), 0.0, 1.0);
    return texture(plane_maps, vec4(uv, layer, depth));
}
)"
                                             R"(
// Visibility by the single map of a spot; kNear is the numerator of depths.
float cone_shadow(int first, vec3 place, vec3 n, vec3 towards) {
    vec4 at = shadows[first + 3];
    float axial = max(dot(shadows[first + 2], vec4(place, 1.0)), 0.0);
    vec4 p = vec4(place + n * (axial * at.y * off_surface(dot(n, towards))), 1.0);
    float nearness = 1.0 / max(dot(shadows[first + 2], p), 1e-6);
    vec2 uv = vec2(dot(shadows[first], p), dot(shadows[first + 1], p)) * nearness;
    float depth = min(kNear * nearness, 1.0);
    return texture(plane_maps, vec4(uv, at.x, depth));
}

// Visibility by a cube map: faces +Z, +X, -X, +Y, -Y, -Z of its axes, which are the scene's unless `turned`.
float cube_shadow(int first, bool turned, vec3 place, vec3 n, vec3 location) {
    vec4 at = shadows[first + 3];  // layer, texel at depth 1, half the reciprocal width of a face at depth 1
    vec3 l = place - location;
    vec3 m = n;
    if (turned) {
        mat3 axes = mat3(shadows[first].xyz, shadows[first + 1].xyz, shadows[first + 2].xyz);
        l *= axes;
        m *= axes;
    }
    vec3 a = abs(l);
    bool z_most = a.z >= max(a.x, a.y);
    bool x_most = a.x >= a.y;
    float along = z_most ? m.z : x_most ? m.x : m.y;
    l += m * (max(a.z, max(a.x, a.y)) * at.y * off_surface(along));
    float most = z_most ? l.z : x_most ? l.x : l.y;
    float side = most < 0.0 ? -1.0 : 1.0;
    vec2 uv = z_most ? vec2(-side * l.x, l.y) : x_most ? vec2(side * l.z, l.y) : vec2(l.x, side * l.z);
    float face = z_most ? (side < 0.0 ? 5.0 : 0.0) : (x_most ? 1.0 : 3.0) + (side < 0.0 ? 1.0 : 0.0);
    float nearness = 1.0 / max(abs(most), 1e-6);
    uv = 0.5 + vec2(at.z, -at.z) * nearness * uv;
    float depth = min(kNear * nearness, 1.0);
    return texture(cube_maps, vec4(uv, at.x + face, depth));
}
)";

}  // namespace rs::compositor::shaders
