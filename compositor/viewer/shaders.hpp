#pragma once
// The GLSL of floors and of objects made of pictures. Colours are linear light; the framebuffer encodes sRGB.

namespace rs::compositor::shaders {

// The floor's square; a disc of it is kept. The checker is averaged over the pixel's footprint, so that it fades to an
// even tone in the distance instead of flickering.
inline constexpr const char* kFloorVertex = R"(#version 450 core
uniform mat4 clip_from_world;
uniform float height;
uniform float radius;
out vec2 on_floor;
void main() {
    on_floor = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1) * radius;
    gl_Position = clip_from_world * vec4(on_floor.x, height, on_floor.y, 1.0);
})";
inline constexpr const char* kFloorFragment = R"(#version 450 core
in vec2 on_floor;
uniform float radius;
uniform float square;
uniform vec3 colour_a;
uniform vec3 colour_b;
uniform vec3 background;
out vec4 result;
void main() {
    float away = length(on_floor) / radius;
    if (away > 1.0) discard;
    vec2 p = on_floor / square;
    vec2 footprint = max(fwidth(p), vec2(1e-4));
    vec2 before = abs(fract((p - 0.5 * footprint) * 0.5) - 0.5);
    vec2 behind = abs(fract((p + 0.5 * footprint) * 0.5) - 0.5);
    vec2 mean = 2.0 * (before - behind) / footprint;
    vec3 checker = mix(colour_a, colour_b, 0.5 - 0.5 * mean.x * mean.y);
    result = vec4(mix(checker, background, smoothstep(0.15, 1.0, away)), 1.0);
})";

// A ray-space node: its rectangle of the screen, pixel for pixel without resampling, at the depth of its two planes.
inline constexpr const char* kObjectVertex = R"(#version 450 core
uniform vec4 rectangle;  // x, y, width, height in pixels
uniform vec2 screen;     // width, height in pixels
void main() {
    vec2 p = rectangle.xy + vec2(gl_VertexID & 1, gl_VertexID >> 1) * rectangle.zw;
    gl_Position = vec4(p.x / screen.x * 2.0 - 1.0, 1.0 - p.y / screen.y * 2.0, 0.0, 1.0);
})";
inline constexpr const char* kObjectFragment = R"(#version 450 core
layout(binding = 0) uniform sampler2D picture;
uniform ivec2 first_pixel;
uniform vec3 facing_depth;  // value in the depth buffer = dot(_, (x, y, 1))
uniform vec3 foot_depth;
uniform int from_above;
uniform vec4 fog;            // colour; w: how much of the object's own light is left
out vec4 result;
void main() {
    vec4 straight = texelFetch(picture, ivec2(gl_FragCoord.xy) - first_pixel, 0);
    if (straight.a == 0.0) discard;
    vec3 place = vec3(gl_FragCoord.xy, 1.0);
    float facing = dot(facing_depth, place);
    float foot = dot(foot_depth, place);
    gl_FragDepth = clamp(from_above != 0 ? max(facing, foot) : min(facing, foot), 0.0, 1.0);
    result = vec4(mix(fog.rgb, straight.rgb, fog.w) * straight.a, straight.a);
})";

}  // namespace rs::compositor::shaders
