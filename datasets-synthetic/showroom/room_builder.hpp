#pragma once
// Builds the parts of a room from boxes, sheets, lathes and tubes, in the coordinates of the piece of furniture at
// hand. Everything is appended to a World. Not thread-safe.

#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/showroom/world.hpp"

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {

// How large the procedural objects are as images show them, so that they can be placed by their height. In object
// radii: the radius of the upright cylinder around the object (rayspace/base/conventions.hpp).

struct ObjectShape {
    std::string name;  // of the recipe
    float height_radii = 2.0F;
    float foot_radii = 0.5F;  // radius of what touches the ground, about
};

// The objects that the showroom shows, with the recipes' parameters.
const std::vector<ObjectShape>& object_shapes();
const ObjectShape& object_shape(const std::string& name);  // the name must be one of them

// The colour (linear light) of a sheet at a point, in metres from its lower left corner, to the right and up.
using Painter = std::function<glm::vec3(glm::vec2 place_m)>;

// A rectangle in space: its lower left corner, its lower and its left side, seen from the front.
struct SheetPlace {
    glm::vec3 corner{0.0F};
    glm::vec3 right{1, 0, 0};
    glm::vec3 up{0, 1, 0};
};

// Of an object of this height, in metres.
float foot_radius(const std::string& object, float height_m);

class RoomBuilder {
public:
    // `texture_scale` (0, 1]: of the textures' resolutions.
    RoomBuilder(World& world, std::string room, float texture_scale)
        : world_(world), room_(std::move(room)), texture_scale_(texture_scale) {}

    // What follows is given in a frame that stands at `origin`, turned about Y (counter-clockwise from above).
    void stand_at(glm::vec3 origin, float turn_deg = 0.0F);

    void look(const std::string& name, Look look) { world_.looks[name] = std::move(look); }
    // A look with an image of its own, painted as a rectangle of this size.
    void painted_look(const std::string& name, glm::vec2 size_m, float px_per_m, const Painter& painter,
                      Look look = {});

    // Texture coordinates in metres, u along the grain: the longer edge of each side.
    void box(const std::string& look, glm::vec3 low, glm::vec3 high);
    // The top is a painted sheet that gets a texture of its own; `painter` starts at the corner (low.x, high.z) and
    // goes to +X and -Z.
    void box_with_top(const std::string& look, const std::string& top_name, glm::vec3 low, glm::vec3 high,
                      float px_per_m, const Painter& painter);
    // With bevelled edges; `bevel` below half of the shortest side.
    void soft_box(const std::string& look, glm::vec3 low, glm::vec3 high, float bevel);
    void sheet(const std::string& look, const SheetPlace& place, glm::vec2 uv_low = {0, 0}, glm::vec2 uv_high = {1, 1});
    void painted_sheet(const std::string& name, const SheetPlace& place, float px_per_m, const Painter& painter,
                       Look look = {});
    // A solid of revolution that stands at `foot`: (radius, height), from the axis at its bottom to the axis at its
    // top.
    void lathe(const std::string& look, glm::vec3 foot, std::initializer_list<glm::vec2> profile, int segments = 16,
               float crease_rad = 0.6F);
    // A tube with rounded ends.
    void tube(const std::string& look, std::span<const glm::vec3> path, float radius, int sides = 6);
    // A moulding around a rectangle that hangs on a wall, mitred at its corners: `profile` is (inwards from the outer
    // edge, away from the wall), from the outer edge at the wall to the inner edge at the wall.
    void image_frame(const std::string& look, const SheetPlace& outer, std::span<const glm::vec2> profile);

    // `name`: of a recipe. Made as large as to be so high.
    void object(const std::string& name, glm::vec3 foot, float turn_deg, float height_m);

private:
    capture::Mesh& add(const std::string& look, int solid);
    void into_room(capture::Mesh& mesh, std::size_t first_vertex) const;
    [[nodiscard]] int next_solid() const;
    // Texture coordinates in metres, u along the longer edge of each side.
    void append_grained(capture::Mesh& mesh, std::span<const SheetPlace> sides) const;
    void face(capture::Mesh& mesh, const SheetPlace& place, glm::vec2 uv_low, glm::vec2 uv_high) const;

    World& world_;
    std::string room_;
    float texture_scale_;
    Frame frame_;
};

}  // namespace rs::synthetic
