#pragma once
// In-memory representation of a furnished world: parts with their looks (appearances), textures, placements of
// ray-space objects, lights and viewpoints.
//
// Metres, Y up, the floor at y = 0. Colours of looks and lights are sRGB, 0xRRGGBB, as in VRML97.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rs::synthetic {

// Appearance of a part. A texture replaces `diffuse`.
struct Look {
    std::uint32_t diffuse = 0xCCCCCC;
    std::uint32_t specular = 0x000000;
    std::uint32_t emissive = 0x000000;
    float shininess = 0.2F;  // exponent of the highlight / 128
    std::string texture{};   // key of World::textures; empty = none
};

struct WorldPart {
    std::string room;
    std::string look;    // key of World::looks
    int solid = -1;      // parts with the same number >= 0 form a closed solid; -1: one-sided sheet
    capture::Mesh mesh;  // with normals, and texture coordinates if the look has a texture
};

// Placement of the encoded ray-space object of recipes/NAME.json.
struct WorldObject {
    std::string room;
    std::string name;      // of the recipe
    glm::vec3 foot{0.0F};  // centre of its base
    float turn_deg = 0;    // about Y
    float size = 0.2F;     // its radius
};

enum class WorldLightKind { directional, point };
struct WorldLight {
    WorldLightKind kind = WorldLightKind::directional;
    std::uint32_t colour = 0xFFFFFF;
    float intensity = 1.0F;  // 0..1
    float ambient = 0.0F;    // 0..1
    glm::vec3 place{0, -1,
                    0};  // location of a point; direction of travel of a directional light, which lights its room only
    float falloff_per_m2 = 1.0F;  // point: factor 1 / max(1, falloff_per_m2 * squared distance)
    float reach_m = 4.0F;         // point: no light beyond
};

struct Room {
    std::string name;
    glm::vec3 low{0.0F};  // interior between floor, walls and ceiling
    glm::vec3 high{0.0F};
    std::vector<WorldLight> lights{};
};

struct WorldView {
    std::string name;
    glm::vec3 eye{0.0F};
    glm::vec3 at{0.0F};
};

struct World {
    std::vector<Room> rooms;
    std::vector<WorldPart> parts;
    std::vector<WorldObject> objects;
    std::map<std::string, Look> looks;
    std::map<std::string, Image<Rgba8>> textures;  // file name -> image
    std::vector<WorldView> viewpoints;             // the first is the initial one
    std::vector<WorldView> walk;                   // keys of a smooth camera path through all rooms
    int walk_frames = 1;                           // of the whole path, at 30 frames per second
};

}  // namespace rs::synthetic
