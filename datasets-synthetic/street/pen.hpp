#pragma once
// Draws the parts of a street into a World: sheets, boxes, prisms, cylinders and crowns of leaves, in the frame of what
// is built at the time. A world's "rooms" are the objects of the OBJ that is written. Not thread-safe.

#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/showroom/world.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace rs::synthetic {

class Pen {
public:
    Pen(World& world, std::string object) : world_(world), object_(std::move(object)) {}

    // What follows stands in a frame at `origin`, turned about Y.
    void stand_at(glm::vec3 origin, float turn_deg = 0);
    [[nodiscard]] glm::vec3 point(glm::vec3 p) const { return frame_.point(p); }

    // Counter-clockwise from the front; texture coordinates of the corners.
    void quad(const std::string& look, const std::array<glm::vec3, 4>& corners,
              const std::array<glm::vec2, 4>& uvs = {glm::vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    // An upright sheet that faces +Z, its texture in metres divided by `tile_m`.
    void wall(const std::string& look, glm::vec2 low, glm::vec2 high, float z, float tile_m);
    // All sides but the lower one; texture in metres divided by `tile_m`.
    void box(const std::string& look, glm::vec3 low, glm::vec3 high, float tile_m = 1);
    // A profile in the plane of x and y, counter-clockwise seen from +Z, from z_low to z_high. The ends are as convex
    // outlines; `inset` takes the points above `inset_from` in from both ends, as roofs of cars are narrower.
    void prism(const std::string& look, std::span<const glm::vec2> profile, float z_low, float z_high, float inset = 0,
               float inset_from = 0);
    // From `foot` along `axis` (a unit vector), with both ends.
    void cylinder(const std::string& look, glm::vec3 foot, glm::vec3 axis, float radius, float length, int segments,
                  float end_radius_share = 1);
    // An uneven ball.
    void crown(const std::string& look, glm::vec3 middle, glm::vec3 radii, int columns, int rows, std::uint32_t seed);

private:
    capture::Mesh& add(const std::string& look);
    void finish(capture::Mesh& mesh) const;

    World& world_;
    std::string object_;
    Frame frame_;
};

}  // namespace rs::synthetic
