#pragma once
// GLSL of rain and snow: particles that fall through a box centred on the eye. Particles wrap around at the sides of
// the box, so that they are fixed to the world instead of the camera; their start positions depend on their index and
// the seed alone. Each particle is a strip of two triangles along its path during the exposure.

namespace rs::compositor::shaders {

inline constexpr const char* kWeatherVertex = R"(#version 450 core
uniform mat4 clip_from_world;
uniform vec3 eye;
uniform vec2 screen_px;
uniform float focal_px;
uniform int seed;
uniform float seconds;
uniform vec3 velocity;  // m/s, mean
uniform vec4 particle;  // shutter s, width m, sway m, opacity
uniform float side;  // of the box
uniform vec2 range;  // drawn distances from the eye, [nearest, beyond)
uniform vec3 sky_light;
uniform int lamp_count;
uniform vec4 lamps[3 * 16];  // location, radius; colour, quadratic attenuation; towards, cosine of the cut-off angle
out vec2 place;           // across, along: -1 .. 1
out vec4 tint;

uint mixed(uint h) {  // "lowbias32", C. Wellons, 2018
    h = (h ^ (h >> 16)) * 0x7FEB352Du;
    h = (h ^ (h >> 15)) * 0x846CA68Bu;
    return h ^ (h >> 16);
}
float share(uint id, uint which) { return float(mixed(id * 8u + which + uint(seed) * 0x9E3779B9u) >> 8) / 16777216.0; }

vec3 light_at(vec3 p) {
    vec3 sum = sky_light;
    for (int i = 0; i < lamp_count; ++i) {
        vec3 way = p - lamps[3 * i].xyz;
        float d = length(way);
        float lit = d < lamps[3 * i].w && dot(way, lamps[3 * i + 2].xyz) > lamps[3 * i + 2].w * d ? 1.0 : 0.0;
        sum += lit * lamps[3 * i + 1].rgb / max(1.0, lamps[3 * i + 1].w * d * d);
    }
    return sum;
}

void main() {
    uint id = uint(gl_VertexID / 6);
    int corner = clamp(gl_VertexID % 6 - 1, 0, 3);
    vec3 way = velocity * (0.8 + 0.4 * share(id, 3u));
    vec3 p = vec3(share(id, 0u), share(id, 1u), share(id, 2u)) * side + way * seconds;
    float phase = 6.2831853 * share(id, 4u);
    p.xz += particle.z * vec2(sin(phase + 2.1 * seconds), cos(1.7 * phase + 1.6 * seconds));
    p = eye + (fract((p - eye) / side + 0.5) - 0.5) * side;
    float d = distance(p, eye);
    vec4 head = clip_from_world * vec4(p, 1.0);
    vec4 tail = clip_from_world * vec4(p - way * particle.x, 1.0);
    place = vec2(0.0);
    tint = vec4(0.0);
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // clipped
    const float kNearest = 0.5;
    if (min(head.w, tail.w) < kNearest || d < range.x || d >= range.y) return;
    vec2 along = (head.xy / head.w - tail.xy / tail.w) * screen_px;
    along = length(along) > 1e-3 ? normalize(along) : vec2(0.0, 1.0);
    vec2 across = vec2(-along.y, along.x);
    float seen_px = particle.y * focal_px / head.w;
    float drawn_px = max(seen_px, 1.2);
    place = vec2((corner & 1) * 2 - 1, (corner >> 1) * 2 - 1);
    vec4 end = place.y > 0.0 ? head : tail;
    vec2 shift_px = (across * place.x + along * place.y) * drawn_px / 2.0;
    gl_Position = end;
    gl_Position.xy += shift_px * 2.0 / screen_px * end.w;
    float faded = 1.0 - smoothstep(0.35 * side, 0.5 * side, d);
    // Particles thinner than the minimum width are drawn more transparent.
    tint = vec4(light_at(p), particle.w * faded * clamp(seen_px / drawn_px, 0.25, 1.0));
})";

inline constexpr const char* kWeatherFragment = R"(#version 450 core
uniform float round_ends;  // 0 streaks, 1 flakes
in vec2 place;
in vec4 tint;
out vec4 result;
void main() {
    float r = mix(abs(place.x), length(place), round_ends);
    float alpha = tint.a * clamp(1.5 - 1.5 * r * r, 0.0, 1.0) * mix(1.0 - 0.5 * abs(place.y), 1.0, round_ends);
    result = vec4(tint.rgb * alpha, alpha);
})";

}  // namespace rs::compositor::shaders
