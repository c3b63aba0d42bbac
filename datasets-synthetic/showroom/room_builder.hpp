#pragma once
// Builds the parts of a room from boxes, sheets, lathes and tubes, in the local coordinates of the current piece of
// furniture, and appends them to a World. Not thread-safe.

#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/showroom/world.hpp"

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {

// Size of a procedural object in object radii, for placement by height. The object radius is that of the vertical
// bounding cylinder (rayspace/base/conventions.hpp).

struct ObjectShape {
    std::string name;  // of the recipe
    float height_radii = 2.0F;
    float foot_radii = 0.5F;  // approximate radius of the contact area with the ground
};

// The showroom's objects with the recipes' parameters.
const std::vector<ObjectShape>& object_shapes();
const ObjectShape& object_shape(const std::string& name);  // the name must be one of them

// Colour (linear light) of a sheet at a position in metres from its lower left corner, to the right and up.
using Painter = std::function<glm::vec3(glm::vec2 place_m)>;

// A rectangle in space: lower left corner, lower side and left side, seen from the front.
struct SheetFrame {
    glm::vec3 corner{0.0F};
    glm::vec3 right{1, 0, 0};
    glm::vec3 up{0, 1, 0};
};

// Foot radius of an object of this height, in metres.
float foot_radius(const std::string& object, float height_m);

class RoomBuilder {
public:
    // `texture_scale` (0, 1]: factor on the textures' resolutions.
    RoomBuilder(World& world, std::string room, float texture_scale)
        : world_(world), room_(std::move(room)), texture_scale_(texture_scale) {}

    // Sets the frame of the following parts: at `origin`, rotated about Y (counter-clockwise from above).
    void set_frame(glm::vec3 origin, float turn_deg = 0.0F);

    void look(const std::string& name, Look look) { world_.looks[name] = std::move(look); }
    // Adds a look with a texture painted for a rectangle of this size.
    void painted_look(const std::string& name, glm::vec2 size_m, float px_per_m, const Painter& painter,
                      Look look = {});

    // Texture coordinates in metres, u along the grain: the longer edge of each side.
    void box(const std::string& look, glm::vec3 low, glm::vec3 high);
    // A box whose top is a painted sheet with its own texture; `painter`'s origin is the corner (low.x, high.z), its
    // axes are +X and -Z.
    void box_with_top(const std::string& look, const std::string& top_name, glm::vec3 low, glm::vec3 high,
                      float px_per_m, const Painter& painter);
    // A box with bevelled edges; `bevel` must be less than half of the shortest side.
    void soft_box(const std::string& look, glm::vec3 low, glm::vec3 high, float bevel);
    void sheet(const std::string& look, const SheetFrame& place, glm::vec2 uv_low = {0, 0}, glm::vec2 uv_high = {1, 1});
    void painted_sheet(const std::string& name, const SheetFrame& place, float px_per_m, const Painter& painter,
                       Look look = {});
    // A solid of revolution at `foot`: (radius, height) from the axis at its bottom to the axis at its top.
    void lathe(const std::string& look, glm::vec3 foot, std::initializer_list<glm::vec2> profile, int segments = 16,
               float crease_rad = 0.6F);
    // A tube with rounded ends.
    void tube(const std::string& look, std::span<const glm::vec3> path, float radius, int sides = 6);
    // A picture frame around a rectangle on a wall, mitred at its corners: `profile` is (inwards from the outer edge,
    // away from the wall), from the outer edge at the wall to the inner edge at the wall.
    void image_frame(const std::string& look, const SheetFrame& outer, std::span<const glm::vec2> profile);

    // Places the object of recipe `name`, scaled to this height.
    void object(const std::string& name, glm::vec3 foot, float turn_deg, float height_m);

private:
    capture::Mesh& add(const std::string& look, int solid);
    void transform_to_room(capture::Mesh& mesh, std::size_t first_vertex) const;
    [[nodiscard]] int next_solid() const;
    // Texture coordinates in metres, u along the longer edge of each side.
    void append_grained(capture::Mesh& mesh, std::span<const SheetFrame> sides) const;
    void face(capture::Mesh& mesh, const SheetFrame& place, glm::vec2 uv_low, glm::vec2 uv_high) const;

    World& world_;
    std::string room_;
    float texture_scale_;
    Frame frame_;
};

}  // namespace rs::synthetic
