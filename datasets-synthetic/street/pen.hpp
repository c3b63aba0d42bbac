#pragma once
// Builds the parts of a street in a World: sheets, boxes, cylinders and other surfaces, in the current local frame. A
// world's "rooms" become the objects of the OBJ file. Not thread-safe.

#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/showroom/world.hpp"

#include <glm/glm.hpp>

#include <array>
#include <functional>
#include <span>
#include <string>

namespace rs::synthetic {

struct Cylinder {
    glm::vec3 foot{0, 0, 0};
    glm::vec3 axis{0, 1, 0};  // unit length, from the foot
    float radius = 1;         // at the foot
    float length = 1;
    int segments = 8;
    float end_radius_share = 1;  // radius at the end, as a share of that at the foot
};

class Pen {
public:
    Pen(World& world, std::string object) : world_(world), object_(std::move(object)) {}

    // Sets the frame of the following parts: at `origin`, rotated about Y.
    void set_frame(glm::vec3 origin, float turn_deg = 0);
    [[nodiscard]] glm::vec3 point(glm::vec3 p) const { return frame_.point(p); }

    // Corners counter-clockwise as seen from the front, with their texture coordinates.
    void quad(const std::string& look, const std::array<glm::vec3, 4>& corners,
              const std::array<glm::vec2, 4>& uvs = {glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    // A vertical sheet facing +Z; texture coordinates in metres divided by `tile_m`.
    void wall(const std::string& look, glm::vec2 low, glm::vec2 high, float z, float tile_m);
    // A box without its lower side; texture coordinates in metres divided by `tile_m`.
    void box(const std::string& look, glm::vec3 low, glm::vec3 high, float tile_m = 1);
    // A closed cylinder or frustum of a cone.
    void cylinder(const std::string& look, const Cylinder& shape);
    // Any other surface: `append` appends triangles with normals and texture coordinates in the local frame.
    void surface(const std::string& look, const std::function<void(capture::Mesh&)>& append);

private:
    capture::Mesh& add(const std::string& look);
    void finish(capture::Mesh& mesh) const;

    World& world_;
    std::string object_;
    Frame frame_;
};

}  // namespace rs::synthetic
