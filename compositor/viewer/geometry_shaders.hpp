#pragma once
// The GLSL of the scene's geometry: VRML97's lighting (ISO/IEC 14772-1, 4.14.4) at every pixel, in linear light.
//
//   colour = fog * (1 - f) + f * (emissive + sum over lights: attenuation * spot * (ambient + diffuse + specular))

namespace rs::compositor::shaders {

inline constexpr const char* kSurfaceVertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texture_place;
layout(location = 3) in vec4 colour;
uniform mat4 clip_from_node;
uniform mat4 world_from_node;
uniform mat3 world_normal_from_node;
uniform mat3 texture_transform;  // of (s, t, 1)
out vec3 place_in_world;
out vec3 normal_in_world;
out vec2 place_on_texture;
out vec4 vertex_colour;
void main() {
    gl_Position = clip_from_node * vec4(position, 1.0);
    place_in_world = (world_from_node * vec4(position, 1.0)).xyz;
    normal_in_world = world_normal_from_node * normal;
    vec3 st = texture_transform * vec3(texture_place, 1.0);
    place_on_texture = vec2(st.s, 1.0 - st.t);  // rows begin at the top
    vertex_colour = colour;
})";

inline constexpr const char* kSurfaceFragment = R"(#version 450 core
struct Light {
    vec4 colour;       // w: kind, 0 directional, 1 point, 2 spot
    vec4 ambient;      // w: radius
    vec4 location;     // w: cut-off angle
    vec4 towards;      // w: beam width
    vec4 attenuation;
};
struct Material {
    vec4 diffuse;        // w: opacity
    vec4 specular;       // w: exponent
    vec4 emissive;       // w: ambient
};
layout(std430, binding = 0) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 1) readonly buffer LightLists { uint light_list[]; };
layout(std430, binding = 2) readonly buffer Materials { Material materials[]; };
layout(binding = 0) uniform sampler2D surface_picture;
uniform int material_index;
// A uniform, not in the table: where pictures are read all pixels of a block must go the same way.
uniform ivec4 material_flags;  // lit; picture: 0 none, 1 replaces, 2 modulates; its alpha: 0 none, 1 mask, 2 blend; colours
uniform ivec2 light_range;   // first, count in light_list
uniform vec3 eye;
uniform vec3 headlight;      // its direction of travel, or 0
uniform vec4 fog;            // colour; w: 0 none, 1 linear, 2 exponential
uniform float fog_visibility;
in vec3 place_in_world;
in vec3 normal_in_world;
in vec2 place_on_texture;
in vec4 vertex_colour;
out vec4 result;

vec3 reflected(Material material, vec3 diffuse, vec3 n, vec3 to_eye, vec3 to_light, vec3 colour) {
    float facing = max(dot(n, to_light), 0.0);
    vec3 sum = diffuse * facing;
    if (facing > 0.0) {
        vec3 between = to_light + to_eye;
        float along = max(dot(n, between) * inversesqrt(max(dot(between, between), 1e-12)), 0.0);
        sum += material.specular.rgb * (along > 0.0 ? pow(along, material.specular.w) : material.specular.w == 0.0 ? 1.0 : 0.0);
    }
    return sum * colour;
}

vec3 lit(Material material, vec3 diffuse, vec3 n, vec3 to_eye) {
    vec3 sum = material.emissive.rgb;
    if (headlight != vec3(0.0)) sum += reflected(material, diffuse, n, to_eye, -headlight, vec3(1.0));
    for (int i = 0; i < light_range.y; ++i) {
        Light light = lights[light_list[light_range.x + i]];
        vec3 to_light = -light.towards.xyz;
        float strength = 1.0;
        if (light.colour.w > 0.5) {
            vec3 way = light.location.xyz - place_in_world;
            float d = length(way);
            if (d > light.ambient.w) continue;
            to_light = d > 0.0 ? way / d : n;
            strength = 1.0 / max(dot(light.attenuation.xyz, vec3(1.0, d, d * d)), 1.0);
            if (light.colour.w > 1.5) {
                float angle = acos(clamp(dot(-to_light, light.towards.xyz), -1.0, 1.0));
                if (angle > light.location.w) continue;
                if (angle > light.towards.w) strength *= (light.location.w - angle) / (light.location.w - light.towards.w);
            }
        }
        sum += strength * (light.ambient.rgb * diffuse * material.emissive.w +
                           reflected(material, diffuse, n, to_eye, to_light, light.colour.rgb));
    }
    return sum;
}

void main() {
    Material material = materials[material_index];
    ivec4 flags = material_flags;
    vec3 diffuse = flags.w != 0 ? vertex_colour.rgb : material.diffuse.rgb;
    float opacity = material.diffuse.w;
    if (flags.y != 0) {
        vec4 texel = texture(surface_picture, place_on_texture);
        diffuse = flags.y == 2 ? diffuse * texel.rgb : texel.rgb;
        if (flags.z == 1 && texel.a < 0.5) discard;
        if (flags.z == 2) opacity = flags.y == 2 ? opacity * texel.a : texel.a;
    }
    vec3 colour = diffuse;
    vec3 to_eye = eye - place_in_world;
    if (flags.x != 0 && normal_in_world != vec3(0.0)) {
        vec3 n = normalize(normal_in_world) * (gl_FrontFacing ? 1.0 : -1.0);
        colour = lit(material, diffuse, n, normalize(to_eye));
    }
    if (fog.w > 0.5) {
        float d = length(to_eye);
        float kept = d >= fog_visibility ? 0.0
                   : fog.w > 1.5 ? exp(-d / (fog_visibility - d)) : (fog_visibility - d) / fog_visibility;
        colour = mix(fog.rgb, colour, kept);
    }
    result = vec4(colour * opacity, opacity);
})";

}  // namespace rs::compositor::shaders
