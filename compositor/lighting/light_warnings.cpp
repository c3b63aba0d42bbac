#include "compositor/lighting/light_warnings.hpp"

#include "rayspace/light/light_model.hpp"

#include <cmath>

namespace rs::compositor {
namespace {

constexpr std::size_t kMaxTriangles = 500'000;

// Solid angle of a triangle over 4 pi, positive as seen from its back: A. van Oosterom and J. Strackee, "The Solid
// Angle of a Plane Triangle", 1983.
double solid_angle_fraction(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    const double others = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return std::atan2(volume, others) / (2 * kPi);
}

double winding_number(const GeometryNode& node, const glm::dvec3& place) {
    const Mesh& mesh = *node.mesh;
    const bool mirrors = glm::determinant(glm::dmat3(node.world_from_node)) < 0;
    const auto corner = [&](std::size_t i) {
        return glm::dvec3(node.world_from_node * glm::dvec4(mesh.vertices[mesh.indices[i]].position, 1)) - place;
    };
    double sum = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        sum += solid_angle_fraction(corner(i), corner(i + 1), corner(i + 2));
    }
    return mirrors ? -sum : sum;
}

bool may_be_solid(const GeometryNode& node) {
    const Mesh& mesh = *node.mesh;
    return mesh.topology == Topology::kTriangles && !mesh.two_sided && !is_blended(node.material) &&
           mesh.indices.size() / 3 <= kMaxTriangles;
}

bool contains(const BoundingBox& box, const glm::dvec3& place) {
    return !box.empty() && glm::all(glm::lessThan(box.lowest, place)) && glm::all(glm::lessThan(place, box.highest));
}

bool has_power(const Light& light) {
    return light.colour != glm::vec3(0) || light.ambient != glm::vec3(0);
}

class Solids {
public:
    explicit Solids(const Scene& scene) : scene_(scene) {
        for (std::size_t n = 0; n < scene.geometry.size(); ++n) {
            const GeometryNode& node = scene.geometry[n];
            if (may_be_solid(node)) boxes_.emplace_back(n, bounds_of(*node.mesh).moved(node.world_from_node));
        }
    }

    [[nodiscard]] std::string warning(std::size_t i) const {
        const Light& light = scene_.lights[i];
        const std::string name = "light " + std::to_string(i + 1) + (light.name.empty() ? "" : " '" + light.name + "'");
        if (!has_power(light)) return name + " has no power; increase it or remove the light";
        if (model_of(light).form == LightForm::kDistant) return "";
        for (const auto& [n, box] : boxes_) {
            if (contains(box, light.location) && winding_number(scene_.geometry[n], light.location) > 0.5) {
                return name + " is inside a solid, which blocks its light; move it";
            }
        }
        return "";
    }

private:
    const Scene& scene_;
    std::vector<std::pair<std::size_t, BoundingBox>> boxes_;
};

}  // namespace

std::string light_warning(const Scene& scene, std::size_t light) {
    return Solids(scene).warning(light);
}

std::vector<std::string> light_warnings(const Scene& scene) {
    std::vector<std::string> warnings;
    const Solids solids(scene);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (std::string warning = solids.warning(i); !warning.empty()) warnings.push_back(std::move(warning));
    }
    return warnings;
}

}  // namespace rs::compositor
