#pragma once
// GLSL of the background: colour gradients by the angles from the zenith and the nadir, covered by the images of a
// cube; or the map of an environment.

namespace rs::compositor::shaders {

inline constexpr const char* kWholeFrameVertex = R"(#version 450 core
void main() {
    gl_Position = vec4((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1, 0.0, 1.0);
})";

// Copies an image with straight alpha, texel by texel.
inline constexpr const char* kImageFragment = R"(#version 450 core
layout(binding = 1) uniform sampler2D picture;
out vec4 result;
void main() {
    vec4 texel = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
    result = vec4(texel.rgb * texel.a, texel.a);
})";

// Preceded by "#version" and the constants kSkyStops, kGroundStops and kShownPictures (bit i: image i exists). The
// constants remove the code of missing images, which makes the shader several times faster.
inline constexpr const char* kBackgroundFragment = R"(
layout(std430, binding = 3) readonly buffer Gradients { vec4 stops[]; };  // colour; w: angle; the sky's, then the ground's
layout(binding = 1) uniform sampler2D pictures[6];
uniform mat3 direction_from_pixel;  // (x, y, 1) -> direction in the background's coordinates
out vec4 result;

vec3 gradient(int first, int count, float angle) {
    vec4 before = stops[first];
    for (int i = 1; i < count; ++i) {
        vec4 next = stops[first + i];
        if (angle <= next.w) return mix(before.rgb, next.rgb, next.w > before.w ? (angle - before.w) / (next.w - before.w) : 1.0);
        before = next;
    }
    return before.rgb;
}

// Cube faces are viewed from inside, upright; top and bottom as seen when looking up or down from the front.
vec4 texel(vec3 d) {
    vec3 a = abs(d);
    int face;
    vec2 p;
    if (a.z >= a.x && a.z >= a.y) {
        face = d.z < 0.0 ? 0 : 1;
        p = vec2(d.z < 0.0 ? d.x : -d.x, d.y) / a.z;
    } else if (a.x >= a.y) {
        face = d.x < 0.0 ? 2 : 3;
        p = vec2(d.x < 0.0 ? -d.z : d.z, d.y) / a.x;
    } else {
        face = d.y > 0.0 ? 4 : 5;
        p = vec2(d.x, d.y > 0.0 ? d.z : -d.z) / a.y;
    }
    if ((kShownPictures & (1 << face)) == 0) return vec4(0.0);
    vec2 uv = vec2(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y);
    switch (face) {
        case 0: return textureLod(pictures[0], uv, 0.0);
        case 1: return textureLod(pictures[1], uv, 0.0);
        case 2: return textureLod(pictures[2], uv, 0.0);
        case 3: return textureLod(pictures[3], uv, 0.0);
        case 4: return textureLod(pictures[4], uv, 0.0);
        default: return textureLod(pictures[5], uv, 0.0);
    }
}

void main() {
    vec3 d = normalize(direction_from_pixel * vec3(gl_FragCoord.xy, 1.0));
    float from_zenith = acos(clamp(d.y, -1.0, 1.0));
    float from_nadir = 3.14159265 - from_zenith;
    vec3 colour = gradient(0, kSkyStops, from_zenith);
    if (kGroundStops > 1 && from_nadir <= stops[kSkyStops + kGroundStops - 1].w) {
        colour = gradient(kSkyStops, kGroundStops, from_nadir);
    }
    vec4 over = kShownPictures != 0 ? texel(d) : vec4(0.0);
    result = vec4(mix(colour, over.rgb, over.a), 1.0);
})";

// EnvironmentLight, bilinear without mipmaps, as traced renderers show it.
inline constexpr const char* kEnvironmentFragment = R"(#version 450 core
layout(binding = 1) uniform sampler2D environment;
uniform mat3 direction_from_pixel;  // (x, y, 1) -> direction in the scene's coordinates
uniform vec2 scale_turn;
out vec4 result;
void main() {
    vec3 d = normalize(direction_from_pixel * vec3(gl_FragCoord.xy, 1.0));
    float azimuth = d.x == 0.0 && d.z == 0.0 ? 0.0 : atan(d.x, -d.z);  // from -Z towards +X
    vec2 uv = vec2(0.5 + (azimuth + scale_turn.y) / 6.28318531, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265);
    result = vec4(textureLod(environment, uv, 0.0).rgb * scale_turn.x, 1.0);
})";

}  // namespace rs::compositor::shaders
