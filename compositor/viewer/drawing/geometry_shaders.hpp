#pragma once
// GLSL of the scene's geometry: VRML97 lighting (ISO/IEC 14772-1, 4.14.4) per pixel, in linear light.
//
//   colour = fog * (1 - f) + f * (emissive + sum over lights: attenuation * spot * (ambient + s * (diffuse +
//   specular)))
//
// where s is the visibility from the light by its shadow map (shadow_shaders.hpp), 1 without a map. The environment is
// one more ambient light, whose value depends on the normal (irradiance_harmonics.hpp).
//
// Metals, coats and glass (kReflection) reflect their surroundings: split-sum approximation (B. Karis, Real Shading in
// Unreal Engine 4, SIGGRAPH 2013), with an analytic second factor (B. Karis, Physically Based Shading on Mobile, 2014).
//
// Shading::kPhong replaces this by Phong's formula, whose ambient term belongs to the material.
//
// One shader per surface kind (surface_renderer.hpp): kinds differ in constants at the head of the source, so that
// light loops unroll and unused features cost nothing. In software rendering this is several times faster than
// branches.

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

// Lighting of surfaces and of the floor. Preceded by the constants of constants_of(SurfaceKind) and kShadowLookUp.
inline constexpr const char* kLighting = R"(
const int kLights = kDirectional + kPoints + kSpots;
// Five rows per light, in the order directional, point, spot: colour; ambient, radius; location, cut-off angle;
// towards, beam width; attenuation, its minimum.
uniform vec4 lights[5 * (kCounted ? kMostCounted : max(kLights, 1))];
uniform ivec4 light_counts;  // kCounted: directional, point and spot lights
uniform ivec4 shadow_counts;  // lights with maps: directional, point, narrow spot, wide spot
// diffuse, opacity; specular, exponent; emissive, ambient; ambient light of directional lights; reflectance of the
// environment's light; reflection: metallic, roughness, dielectric reflectance
uniform vec4 material[6];
uniform vec4 environment[9];  // IrradianceHarmonics
uniform vec3 eye;
uniform vec3 headlight;  // direction of travel
in vec3 place_in_world;

// Specular term: the material's, or that of the water film on it.
vec3 specular = material[1].rgb;
float exponent = material[1].w;

// to_eye and to_light are unit vectors; the half vector (to_light + to_eye) / |to_light + to_eye| enters only by its
// dot product with the normal.
vec3 reflected(vec3 diffuse, vec3 n, vec3 to_eye, float eye_facing, vec3 to_light, vec3 colour) {
    float facing = dot(n, to_light);
    vec3 sum = diffuse * max(facing, 0.0);
    if (kPhong && kShiny) {
        // (to the light) . (to the eye, reflected)
        float along = 2.0 * facing * eye_facing - dot(to_light, to_eye);
        sum += specular * (facing > 0.0 && along > 0.0 ? pow(along, exponent) : 0.0);
    } else if (kShiny) {
        float along = (facing + eye_facing) * inversesqrt(max(2.0 + 2.0 * dot(to_light, to_eye), 1e-12));
        float gloss = pow(max(along, 1e-20), exponent);
        sum += specular * (facing > 0.0 ? gloss : 0.0);
    }
    return sum * colour;
}

// Irradiance / pi of the environment.
vec3 environment_light(vec3 n) {
    vec3 even = environment[0].rgb + environment[4].rgb * (3.0 * n.y * n.y - 1.0) +
                environment[8].rgb * (n.z * n.z - n.x * n.x);
    vec3 along = environment[1].rgb * n.y + environment[2].rgb * n.x + environment[3].rgb * n.z;
    vec3 across = environment[5].rgb * (n.x * n.y) + environment[6].rgb * (n.y * n.z) + environment[7].rgb * (n.x * n.z);
    return max(even + along + across, vec3(0.0));
}

// Light count: a constant, or with kCounted a uniform, for which the constant only states if such lights are possible.
int number_of(int constant, int given) {
    return kCounted && constant > 0 ? given : constant;
}

// Visibility from the light; the rows of its map start at index `shadow`.
float open_to_light(int first, bool is_spot, int shadow, int shape, vec3 n) {
    if (kShadowedDirectional > 0 && shape == 1) return parallel_shadow(4 * shadow, place_in_world, n, lights[first + 3].xyz);
    if (kNarrowSpots > 0 && shape == 2) return cone_shadow(4 * shadow, place_in_world, n, lights[first + 3].xyz);
    if (kShadowedPoints + kWideSpots > 0 && shape == 3) return cube_shadow(4 * shadow, is_spot, place_in_world, n, lights[first + 2].xyz);
    return 1.0;
}

vec3 from_light(int first, bool has_place, bool is_spot, int shadow, int shape, vec3 diffuse, vec3 n, vec3 even,
                vec3 to_eye, float eye_facing) {
    vec3 to_light = -lights[first + 3].xyz;
    float strength = 1.0;
    if (has_place) {
        vec3 way = lights[first + 2].xyz - place_in_world;
        float d = length(way);
        to_light = d > 0.0 ? way / d : n;
        // Computed without branches: branches cost more than they save.
        strength = d > lights[first + 1].w ? 0.0 : 1.0;
        if (kFading) strength /= max(dot(lights[first + 4].xyz, vec3(1.0, d, d * d)), lights[first + 4].w);
        if (is_spot) {
            float cut_off = lights[first + 2].w;
            float beam = lights[first + 3].w;
            float angle = acos(clamp(dot(-to_light, lights[first + 3].xyz), -1.0, 1.0));
            float within = angle > beam ? (cut_off - angle) / (cut_off - beam) : 1.0;
            strength = angle > cut_off ? 0.0 : strength * within;
        }
    }
    vec3 ambient = has_place && !kPhong ? lights[first + 1].rgb * diffuse * material[2].w : vec3(0.0);
    vec3 direct = reflected(diffuse, n, to_eye, eye_facing, to_light, lights[first].rgb);
    if (shape != 0) direct *= open_to_light(first, is_spot, shadow, shape, even);
    return strength * (ambient + direct);
}

// `even`: interpolated normal without the normal map.
vec3 lit(vec3 diffuse, vec3 ambient, vec3 n, vec3 even, vec3 to_eye) {
    vec3 sum = material[2].rgb + ambient;
    float eye_facing = dot(n, to_eye);
    if (kHeadlight) sum += reflected(diffuse, n, to_eye, eye_facing, -headlight, vec3(1.0));
    int directional = number_of(kDirectional, light_counts.x);
    int points = number_of(kPoints, light_counts.y);
    int spots = number_of(kSpots, light_counts.z);
    // Directional lights with a map, point lights, spots with one map, spots with a cube map.
    ivec4 mapped = ivec4(number_of(kShadowedDirectional, shadow_counts.x), number_of(kShadowedPoints, shadow_counts.y),
                         number_of(kNarrowSpots, shadow_counts.z), number_of(kWideSpots, shadow_counts.w));
    for (int i = 0; i < directional; ++i) {
        sum += from_light(5 * i, false, false, i, i < mapped.x ? 1 : 0, diffuse, n, even, to_eye, eye_facing);
    }
    for (int i = 0; i < points; ++i) {
        sum += from_light(5 * (directional + i), true, false, mapped.x + i, i < mapped.y ? 3 : 0, diffuse, n, even, to_eye,
                          eye_facing);
    }
    for (int i = 0; i < spots; ++i) {
        sum += from_light(5 * (directional + points + i), true, true, mapped.x + mapped.y + i,
                          i < mapped.z ? 2 : i < mapped.z + mapped.w ? 3 : 0, diffuse, n, even, to_eye, eye_facing);
    }
    return sum;
}
)";

// Preceded by kLighting.
inline constexpr const char* kSurfaceFragment = R"(
layout(binding = 0) uniform sampler2D surface_picture;
layout(binding = 4) uniform sampler2D relief_map;  // NormalMap
layout(binding = 5) uniform sampler2D reflection_map;  // prefiltered_reflections.hpp
uniform vec3 cover_light;  // ambient light on snow
uniform vec3 fog;
uniform float fog_visibility;
in vec3 normal_in_world;
in vec2 place_on_texture;
in vec4 vertex_colour;
out vec4 result;

// Normal perturbed by the normal map, in the tangent frame of the triangle's texture coordinates.
vec3 in_relief(vec3 n) {
    vec3 direction = texture(relief_map, place_on_texture).xyz;
    vec3 px = dFdx(place_in_world), py = dFdy(place_in_world);
    vec2 tx = dFdx(place_on_texture), ty = dFdy(place_on_texture);
    float area = tx.x * ty.y - ty.x * tx.y;
    vec3 s = (px * ty.y - py * tx.y) * sign(area);
    vec3 t = (px * ty.x - py * tx.x) * sign(area);  // up: rows go down
    s -= n * dot(n, s);
    t -= n * dot(n, t);
    bool flat_there = direction.xy == vec2(0.0) || area == 0.0;
    vec3 sum = s * (direction.x * inversesqrt(max(dot(s, s), 1e-30))) +
               t * (direction.y * inversesqrt(max(dot(t, t), 1e-30))) + n * direction.z;
    return flat_there || dot(sum, sum) < 1e-12 ? n : normalize(sum);
}

// Scale and bias of the reflectance at normal incidence: the mean of the BRDF over a uniform hemisphere.
vec2 reflectance_terms(float roughness, float facing) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * facing)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a + r.zw;
}

// Mean radiance of the lobe about a unit direction. Smooth surfaces are filtered over the pixel's footprint, by a lobe
// of about its width.
vec3 surroundings(vec3 d, float roughness) {
    float footprint = max(length(dFdx(d)), length(dFdy(d)));
    float level = max(roughness, sqrt(0.25 * footprint)) * float(kReflectionLevels - 1);
    float azimuth = d.x == 0.0 && d.z == 0.0 ? 0.0 : atan(d.x, -d.z);
    return textureLod(reflection_map, vec2(0.5 + azimuth / 6.28318531, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265), level).rgb;
}

// Share of light that the surface reflects towards the eye. Rough metals reflect again what hits other facets.
vec3 reflectance(vec3 base, float facing) {
    vec3 at_normal = mix(vec3(material[5].z), base, material[5].x);
    if (kReflection == 2) return at_normal + (1.0 - at_normal) * pow(1.0 - facing, 5.0);
    vec2 terms = reflectance_terms(material[5].y, facing);
    float whole = terms.x + terms.y;
    return (at_normal * terms.x + terms.y) * (1.0 + material[5].x * at_normal * (1.0 - whole) / whole);
}

void main() {
    vec3 diffuse = kColours ? vertex_colour.rgb : material[0].rgb;
    float opacity = material[0].w;
    vec3 shade = vec3(1.0);  // texture colour in the ambient term
    if (kPicture != 0) {
        vec4 texel = texture(surface_picture, place_on_texture);
        diffuse = kPicture == 2 ? diffuse * texel.rgb : texel.rgb;
        if (kPhong) shade = texel.rgb;
        if (kPictureAlpha == 1 && texel.a < 0.5) discard;
        if (kPictureAlpha == 2) opacity = kPicture == 2 ? opacity * texel.a : texel.a;
    }
    vec3 colour = diffuse;
    vec3 to_eye = eye - place_in_world;
    if (kLit && normal_in_world != vec3(0.0)) {
        float side = gl_FrontFacing ? 1.0 : -1.0;
        vec3 even = normalize(normal_in_world) * side;
        vec3 n = kRelief ? in_relief(even * side) * side : even;
        vec3 view = normalize(to_eye);
        vec3 mirrored = vec3(0.0);
        if (kReflection != 0) {
            vec3 share = reflectance(diffuse, clamp(dot(n, view), 0.0, 1.0));
            mirrored = share * surroundings(reflect(-view, n), material[5].y);
            specular = mix(specular, diffuse, material[5].x);  // metals: with texture and vertex colours
            diffuse *= (1.0 - share) * (1.0 - material[5].x);
            if (kReflection == 2) {
                diffuse *= opacity;
                opacity = mix(opacity, 1.0, share.g);
            }
        }
        vec3 ambient = kPhong ? material[3].rgb * shade : material[3].rgb * diffuse * material[2].w;
        vec3 from_sky = kEnvironment ? environment_light(n) : vec3(0.0);
        if (kEnvironment) ambient += from_sky * material[4].rgb * (kPhong ? shade : diffuse);
        if (kCover == 1) {  // wet: darker, with a sharp highlight
            float up = smoothstep(0.6, 0.95, even.y);
            diffuse *= 1.0 - 0.45 * up;
            ambient *= 1.0 - 0.45 * up;
            specular = mix(specular, vec3(0.35), up);
            exponent = mix(exponent, 90.0, up);
        } else if (kCover == 2) {
            float up = 0.9 * smoothstep(0.55, 0.85, even.y);
            diffuse = mix(diffuse, vec3(0.86), up);
            ambient = mix(ambient, vec3(0.86) * (cover_light + from_sky), up);
            specular *= 1.0 - up;
        }
        colour = lit(diffuse, ambient, n, even, view) + mirrored;
    }
    // Glass is premultiplied: its reflections are opaque.
    if (kReflection != 2) colour *= opacity;
    float kept = 1.0;
    if (kFog != 0) {
        float d = length(to_eye);
        kept = d >= fog_visibility ? 0.0
                   : kFog == 2 ? exp(-d / (fog_visibility - d)) : (fog_visibility - d) / fog_visibility;
        colour = mix(fog * opacity, colour, kept);
    }
    result = kVeil ? vec4(fog * (1.0 - kept), 1.0 - kept) : vec4(colour, opacity);
})";

}  // namespace rs::compositor::shaders
