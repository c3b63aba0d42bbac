#pragma once
// Builds a group from boxes, sheets, lathes, tubes and cushions, in the frame of the piece at hand. Not thread-safe.

#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/grid_surface.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "tests/bench/scenes/model.hpp"

#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {

class GroupBuilder {
public:
    explicit GroupBuilder(std::string name) { group_.name = std::move(name); }

    // What follows stands at `origin`, turned about Y (counter-clockwise from above).
    void stand_at(glm::vec3 origin, float turn_rad = 0.0F);

    // 12 triangles.
    void box(int look, glm::vec3 low, glm::vec3 high);
    // corner + s right + t up; seen where cross(right, up) points. 2 triangles for each field; texture coordinates in
    // metres along both sides, times `uv_per_m`.
    void sheet(int look, glm::vec3 corner, glm::vec3 right, glm::vec3 up, int columns = 1, int rows = 1,
               float uv_per_m = 0.5F);
    // A strip between two polylines of as many points, seen where cross(along, from `a` to `b`) points.
    void strip(int look, std::span<const glm::vec3> a, std::span<const glm::vec3> b);
    // A solid of revolution that stands at `foot`: (radius, height) from the axis at its bottom to that at its top.
    void lathe(int look, glm::vec3 foot, std::span<const glm::vec2> profile, int segments);
    void lathe(int look, glm::vec3 foot, std::initializer_list<glm::vec2> profile, int segments) {
        lathe(look, foot, std::span<const glm::vec2>(profile.begin(), profile.size()), segments);
    }
    void tube(int look, std::span<const glm::vec3> path, float radius, int sides);
    // Fills a box bulging, with round edges and corners: a superellipsoid whose sines and cosines are rooted so many
    // times; 0 is an ellipsoid, 2 nearly a box. columns * (rows - 1) * 2 triangles.
    void cushion(int look, glm::vec3 low, glm::vec3 high, int roots, int columns, int rows);
    // Any grid.
    void surface(int look, Grid grid);
    // Exactly so many triangles (0, or at least 6) of thin bent blades that grow from the disc of radius `spread` about
    // `foot`, about `length` long.
    struct Blades {
        glm::vec3 foot{0.0F};
        glm::vec3 up{0, 1, 0};
        float spread = 0.1F;
        float length = 0.6F;
        float width = 0.05F;
        float bend = 0.5F;
    };
    void blades(int look, const Blades& like, std::int64_t triangles, Random& random);

    [[nodiscard]] std::int64_t triangles() const { return triangle_count(group_); }
    // Leaves nothing behind.
    ModelGroup take() { return std::move(group_); }

private:
    capture::Mesh& mesh_of(int look);
    // Moves what was appended to the mesh since it had so many vertices into the frame.
    void place(capture::Mesh& mesh, std::size_t first) const;

    ModelGroup group_;
    Frame frame_;
};

}  // namespace rs::synthetic
