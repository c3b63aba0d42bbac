#pragma once
// A furnished world as data, before it is written as a file: parts with their looks, textures, places for objects made
// of images, lights and viewpoints.
//
// Metres, Y up, the visitor's floor at y = 0. Colours of looks and lights are sRGB, 0xRRGGBB, as VRML97 has them.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rs::synthetic {

// Where it has a texture, that replaces `diffuse`.
struct Look {
    std::uint32_t diffuse = 0xCCCCCC;
    std::uint32_t specular = 0x000000;
    std::uint32_t emissive = 0x000000;
    float shininess = 0.2F;  // times 128: the exponent of the highlight
    std::string texture{};   // key of World::textures; empty = none
};

struct WorldPart {
    std::string room;
    std::string look;    // key of World::looks
    int solid = -1;      // parts of one number >= 0 close a solid together; -1: a sheet, seen from its front only
    capture::Mesh mesh;  // with normals; with texture coordinates where the look has a texture
};

// An object of recipes/NAME.json, once it is encoded.
struct WorldObject {
    std::string room;
    std::string name;      // of the recipe
    glm::vec3 foot{0.0F};  // stands here
    float turn_deg = 0;    // about Y
    float size = 0.2F;     // its radius
};

enum class WorldLightKind { directional, point };
struct WorldLight {
    WorldLightKind kind = WorldLightKind::directional;
    std::uint32_t colour = 0xFFFFFF;
    float intensity = 1.0F;     // 0..1
    float ambient = 0.0F;       // 0..1
    glm::vec3 place{0, -1, 0};  // of a point; the direction of travel of a directional light, which shines in its room
    float falloff_per_m2 = 1.0F;  // of a point: strength 1 / max(1, that times the squared distance)
    float reach_m = 4.0F;         // of a point: no light beyond
};

struct Room {
    std::string name;
    glm::vec3 low{0.0F};  // the space between floor, walls and ceiling
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
    std::vector<WorldView> viewpoints;             // the first is where a visit begins
    std::vector<WorldView> walk;                   // the keys of a smooth way through all rooms
    int walk_frames = 1;                           // of the whole way, at 30 a second
};

}  // namespace rs::synthetic
