#pragma once
// Builds a group from boxes, sheets, lathes, tubes and cushions, in the current local frame. Not thread-safe.

#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"
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

    /// Sets the local frame of the following shapes: origin, and rotation about Y (counter-clockwise from above).
    void set_frame(glm::vec3 origin, float turn_rad = 0.0F);

    // 12 triangles.
    void box(int material, glm::vec3 low, glm::vec3 high);
    /// Parallelogram corner + s right + t up that faces cross(right, up). 2 triangles per cell; texture coordinates are
    /// metres along both sides times `uv_per_m`.
    void sheet(int material, glm::vec3 corner, glm::vec3 right, glm::vec3 up, int columns = 1, int rows = 1,
               float uv_per_m = 0.5F);
    /// Strip between two polylines of equal length that faces cross(along, from `a` to `b`).
    void strip(int material, std::span<const glm::vec3> a, std::span<const glm::vec3> b);
    /// Solid of revolution above `foot`; the profile is (radius, height), from the axis at the bottom to that at the
    /// top.
    void lathe(int material, glm::vec3 foot, std::span<const glm::vec2> profile, int segments);
    void lathe(int material, glm::vec3 foot, std::initializer_list<glm::vec2> profile, int segments) {
        lathe(material, foot, std::span<const glm::vec2>(profile.begin(), profile.size()), segments);
    }
    void tube(int material, std::span<const glm::vec3> path, float radius, int sides);
    /// Superellipsoid that fills a box. columns * (rows - 1) * 2 triangles.
    /// \param roots number of square roots applied to its sines and cosines: 0 is an ellipsoid, 2 nearly a box
    void cushion(int material, glm::vec3 low, glm::vec3 high, int roots, int columns, int rows);
    void surface(int material, Grid grid);
    /// Thin bent blades of about the given length that grow from a disc of radius `spread` around `foot`.
    struct Blades {
        glm::vec3 foot{0.0F};
        glm::vec3 up{0, 1, 0};
        float spread = 0.1F;
        float length = 0.6F;
        float width = 0.05F;
        float bend = 0.5F;
    };
    /// \param triangles exact number, 0 or at least 6
    void blades(int material, const Blades& like, std::int64_t triangles, Random& random);

    [[nodiscard]] std::int64_t triangles() const { return triangle_count(group_); }
    /// Moves the group out of the builder.
    ModelGroup take() { return std::move(group_); }

private:
    capture::Mesh& mesh_of(int material);
    // Transforms the vertices from `first` on from the local frame to the group.
    void place(capture::Mesh& mesh, std::size_t first) const;

    ModelGroup group_;
    Frame frame_;
};

}  // namespace rs::synthetic
