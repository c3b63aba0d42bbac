#pragma once
// GLSL of floors, area lights and image-based objects. Colours are linear light; the framebuffer encodes sRGB.

#include <string>

namespace rs::compositor::shaders {

// Constants for the head of a shader source, after its "#version".

inline std::string shader_constant(const std::string& name, int value) {
    return "const int " + name + " = " + std::to_string(value) + ";\n";
}

inline std::string shader_constant(const std::string& name, bool value) {
    return "const bool " + name + (value ? " = true;\n" : " = false;\n");
}

// Floor: a square cut to a disc. The checker is box-filtered over the pixel's footprint, so that it fades to its mean
// colour in the distance instead of aliasing.
inline constexpr const char* kFloorVertex = R"(#version 450 core
uniform mat4 clip_from_world;
uniform float height;
uniform float radius;
out vec3 place_in_world;
void main() {
    vec2 on_floor = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1) * radius;
    place_in_world = vec3(on_floor.x, height, on_floor.y);
    gl_Position = clip_from_world * vec4(place_in_world, 1.0);
})";
// Preceded by kLighting (geometry_shaders.hpp).
inline constexpr const char* kFloorFragment = R"(
uniform float radius;
uniform float square;
uniform vec3 colour_a;
uniform vec3 colour_b;
uniform vec3 background;
out vec4 result;
void main() {
    float away = length(place_in_world.xz) / radius;
    if (away > 1.0) discard;
    vec2 p = place_in_world.xz / square;
    vec2 footprint = max(fwidth(p), vec2(1e-4));
    vec2 before = abs(fract((p - 0.5 * footprint) * 0.5) - 0.5);
    vec2 behind = abs(fract((p + 0.5 * footprint) * 0.5) - 0.5);
    vec2 mean = 2.0 * (before - behind) / footprint;
    vec3 checker = mix(colour_a, colour_b, 0.5 - 0.5 * mean.x * mean.y);
    const vec3 n = vec3(0.0, 1.0, 0.0);
    vec3 ambient = material[3].rgb;
    if (kEnvironment) ambient += environment_light(n);
    vec3 shown = lit(checker, ambient * checker, n, n, normalize(eye - place_in_world));
    result = vec4(mix(shown, background, smoothstep(0.15, 1.0, away)), 1.0);
})";

// Area light: the parallelogram centre +- half_u +- half_v, counter-clockwise seen from the side that it shines to.
inline constexpr const char* kAreaLightVertex = R"(#version 450 core
uniform mat4 clip_from_world;
uniform vec3 centre;
uniform vec3 half_u;
uniform vec3 half_v;
out vec2 on_light;
void main() {
    on_light = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1);
    gl_Position = clip_from_world * vec4(centre + half_u * on_light.x + half_v * on_light.y, 1.0);
    gl_Position.z *= 1.0005;  // in front of a ceiling in the same plane
})";
inline constexpr const char* kAreaLightFragment = R"(#version 450 core
in vec2 on_light;
uniform vec3 radiance;
uniform int is_disc;
out vec4 result;
void main() {
    float r = length(on_light);
    float covered = is_disc != 0 ? clamp(0.5 + (1.0 - r) / max(fwidth(r), 1e-6), 0.0, 1.0) : 1.0;
    result = vec4(radiance * covered, covered);
})";

// Ray-space node: the covered parts of its image (image_coverage.hpp). Each pixel is the mean of samples_across *
// samples_across samples, at the depth of the two planes or of its pixels (object_view.hpp).
inline constexpr const char* kObjectVertex = R"(#version 450 core
layout(location = 0) in vec3 corner;  // homogeneous, in pixels
uniform vec2 screen;                  // width, height in pixels
void main() {
    gl_Position = vec4(corner.x / screen.x * 2.0 - corner.z, corner.z - corner.y / screen.y * 2.0, 0.0, corner.z);
})";
// Preceded by "#version" and the constants kPixelDepth, kOpaque (all texels that are read are opaque), kSamplesAcross
// and kSmooth (bilinear samples); unrolled loops halve the cost in software rendering.
inline constexpr const char* kObjectFragment = R"(
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform isampler2D depths;  // kPixelDepth: axial depth, q20, object radii; 0 if none
uniform ivec2 picture_size;  // used part of the texture
uniform mat3 picture_from_screen;
uniform vec3 facing_depth;   // value in the depth buffer = dot(_, (x, y, 1))
uniform vec3 foot_depth;
uniform int from_above;
uniform double to_viewpoint;  // engine::DepthScale
uniform double units_per_radius;
uniform float near_of_depths;  // value in the depth buffer = near_of_depths / depth
uniform vec2 alphas;  // draws pixels with alpha in [x, y)
uniform vec4 fog;  // colour; w: transmittance
uniform float opacity;  // multiplies the image's alpha
uniform int relit;
uniform vec4 gain[9];  // by the normal of an ellipsoid, which is the unit sphere in the space of the ray
uniform vec3 eye;
uniform mat3 ray_from_screen;
uniform vec3 normal_from_point;
out vec4 result;
vec3 relighting() {
    vec3 along = normalize(ray_from_screen * vec3(gl_FragCoord.xy, 1.0));
    vec3 point = eye - dot(eye, along) * along;
    point -= sqrt(max(1.0 - dot(point, point), 0.0)) * along;
    vec3 n = normalize(point * normal_from_point);
    vec4 sum = gain[0] + gain[1] * n.y + gain[2] * n.x + gain[3] * n.z + gain[4] * (3.0 * n.y * n.y - 1.0) +
               gain[5] * (n.x * n.y) + gain[6] * (n.y * n.z) + gain[7] * (n.x * n.z) +
               gain[8] * (n.z * n.z - n.x * n.x);
    return max(sum.rgb, 0.0);
}
vec4 sum = vec4(0.0);      // premultiplied
float nearness = 0.0;  // 1 / depth, weighted like sum.a
void add(ivec2 at, float weight, float depth_of_picture) {
    ivec2 inside = kOpaque ? at : clamp(at, ivec2(0), picture_size - 1);
    vec4 straight = texelFetch(picture, inside, 0);
    float a = kOpaque ? weight : inside == at ? straight.a * weight : 0.0;
    sum += vec4(straight.rgb * a, a);
    if (kPixelDepth) {
        int lambda = texelFetch(depths, inside, 0).r;
        float depth = float((double(lambda) * 9.5367431640625e-07lf + to_viewpoint) * units_per_radius);
        if (lambda != 0 && depth > 0.0) nearness += a * depth_of_picture / depth;
    }
}
void main() {
    for (int j = 0; j < kSamplesAcross; ++j) {
        for (int i = 0; i < kSamplesAcross; ++i) {
            vec2 part = (vec2(i, j) + 0.5) / float(kSamplesAcross) - 0.5;
            vec3 p = picture_from_screen * vec3(gl_FragCoord.xy + part, 1.0);
            vec2 at = p.xy / p.z;
            if (kSmooth) {
                vec2 first = floor(at - 0.5);
                vec2 f = at - 0.5 - first;
                ivec2 t = ivec2(first);
                add(t, (1.0 - f.x) * (1.0 - f.y), p.z);
                add(t + ivec2(1, 0), f.x * (1.0 - f.y), p.z);
                add(t + ivec2(0, 1), (1.0 - f.x) * f.y, p.z);
                add(t + ivec2(1, 1), f.x * f.y, p.z);
            } else {
                add(ivec2(floor(at)), 1.0, p.z);
            }
        }
    }
    const float samples = float(kSamplesAcross * kSamplesAcross);
    float covered = kOpaque ? samples : sum.a;
    float alpha = covered / samples;
    if (!kOpaque && (alpha == 0.0 || alpha < alphas.x || alpha >= alphas.y)) discard;
    vec3 place = vec3(gl_FragCoord.xy, 1.0);
    float depth = dot(facing_depth, place);
    if (kPixelDepth && nearness > 0.0) depth = near_of_depths * nearness / covered;
    float foot = dot(foot_depth, place);
    gl_FragDepth = clamp(from_above != 0 ? max(depth, foot) : min(depth, foot), 0.0, 1.0);
    alpha *= opacity;
    vec3 colour = sum.rgb / covered;
    if (relit != 0) colour *= relighting();
    result = vec4(mix(fog.rgb, colour, fog.w) * alpha, alpha);
})";

}  // namespace rs::compositor::shaders
