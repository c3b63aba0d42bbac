#include "compositor/viewer/drawing/surface_tables.hpp"

#include "compositor/viewer/drawing/surface_kind.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {

static_assert(sizeof(LightRow) == 80 && sizeof(MaterialRow) == 96 && sizeof(ShadowRow) == 64);

namespace {

// False only if the cone of a spot misses the box's bounding sphere. True for other lights.
bool cone_may_meet(const Light& light, const BoundingBox& box) {
    constexpr double kMargin_rad = 1e-3;
    const double cut_off = light.cut_off_rad + kMargin_rad;
    if (light.kind != LightKind::kSpot || cut_off >= kPi / 2) return true;
    const glm::dvec3 way = box.middle() - light.location;
    const double along = glm::dot(way, light.towards);
    const double across = std::sqrt(std::max(glm::dot(way, way) - along * along, 0.0));
    const double beside = across * std::cos(cut_off) - along * std::sin(cut_off);  // distance from the cone's surface
    return beside <= 0.5 * glm::distance(box.lowest, box.highest);
}

// Triangle corners and normals of a node in world coordinates, as in its shader.
class WorldSurface {
public:
    explicit WorldSurface(const GeometryNode& node) : mesh_(*node.mesh) {
        const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(node.world_from_node)));
        for (const MeshVertex& vertex : mesh_.vertices) {
            places_.emplace_back(node.world_from_node * glm::dvec4(vertex.position, 1));
            const glm::dvec3 normal = turn * glm::dvec3(vertex.normal);
            const double length = glm::length(normal);
            normals_.push_back(length > 0 ? normal / length : normal);
        }
    }

    // True if the light may be reflected at some point of a triangle. Positions and normals are convex combinations of
    // those of the corners, and normal . (light - position) is linear in each of them.
    [[nodiscard]] bool may_reflect(const Light& light) const {
        if (mesh_.topology != Topology::kTriangles) return true;
        if (light.kind == LightKind::kDirectional) {
            return mesh_.two_sided || std::any_of(mesh_.indices.begin(), mesh_.indices.end(), [&](std::uint32_t i) {
                       return -glm::dot(normals_[i], light.towards) > -kGrazing;
                   });
        }
        if (mesh_.two_sided && light.kind == LightKind::kPoint) return true;
        for (std::size_t first = 0; first + 2 < mesh_.indices.size(); first += 3) {
            if (may_face(light, first) && may_be_in_cone(light, first)) return true;
        }
        return false;
    }

private:
    static constexpr double kGrazing = 1e-4;  // tolerance for the shader's single precision

    [[nodiscard]] bool may_face(const Light& light, std::size_t first) const {
        if (mesh_.two_sided) return true;
        for (std::size_t corner = 0; corner < 9; ++corner) {
            const glm::dvec3& normal = normals_[mesh_.indices[first + corner / 3]];
            const glm::dvec3 way = light.location - places_[mesh_.indices[first + corner % 3]];
            if (glm::dot(normal, way) > -kGrazing * glm::length(way)) return true;
        }
        return false;
    }

    [[nodiscard]] bool may_be_in_cone(const Light& light, std::size_t first) const {
        BoundingBox box;
        for (std::size_t corner = 0; corner < 3; ++corner) box.include(places_[mesh_.indices[first + corner]]);
        return cone_may_meet(light, box);
    }

    const Mesh& mesh_;
    std::vector<glm::dvec3> places_;
    std::vector<glm::dvec3> normals_;  // unit length, or 0
};

}  // namespace

LightRow row_of(const Light& light) {
    return {{light.colour, 0},
            {light.ambient, static_cast<float>(light.radius)},
            {glm::vec3(light.location), static_cast<float>(light.cut_off_rad)},
            {glm::vec3(light.towards), static_cast<float>(light.beam_width_rad)},
            {light.attenuation, light.least_attenuation}};
}

namespace {

// Metals and mirrors have neither a diffuse colour nor an ambient one: their colour is their reflectance.
MaterialRow reflective_row(const Material& material, MaterialRow row) {
    const SurfaceProperties& surface = *material.surface;
    const bool metallic = surface.kind == rs::SurfaceKind::metal || surface.kind == rs::SurfaceKind::mirror;
    const float root = (surface.ior - 1) / (surface.ior + 1);
    const bool smooth = surface.kind == rs::SurfaceKind::mirror || surface.kind == rs::SurfaceKind::glass;
    row.reflection = {metallic ? 1 : 0, smooth ? 0 : surface.roughness, root * root, 0};
    if (metallic) {
        row.diffuse_opacity = {surface.colour, material.opacity};
        const float alpha2 = std::pow(std::max(smooth ? 0 : surface.roughness, 0.2F), 4.0F);
        row.specular_exponent = {surface.colour, 2 / alpha2 - 2};
    }
    return row;
}

}  // namespace

MaterialRow row_of(const Material& material, Shading shading) {
    if (shading == Shading::kPhong) {
        return {{material.diffuse, material.opacity},
                {material.specular, phong_terms(material).exponent},
                {material.emissive, 0},
                {},
                {phong_terms(material).ambient, 0}};
    }
    const MaterialRow row{{material.diffuse, material.opacity},
                          {material.specular, material.shininess * 128},
                          {material.emissive, material.ambient},
                          {},
                          {glm::vec3(material.ambient), 0}};
    return reflection_of(material, shading) == Reflection::kNone ? row : reflective_row(material, row);
}

namespace {

std::vector<std::uint32_t> lights_that_reach(const Scene& scene, const GeometryNode& node,
                                             const BoundingBox& box_in_world) {
    std::vector<std::uint32_t> reaching = node.lights;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (!light.everywhere) continue;
        const glm::dvec3 nearest = glm::clamp(light.location, box_in_world.lowest, box_in_world.highest);
        if (light.kind == LightKind::kDirectional ||
            (glm::distance(nearest, light.location) <= light.radius && cone_may_meet(light, box_in_world))) {
            reaching.push_back(i);
        }
    }
    return reaching;
}

}  // namespace

SurfaceLights lights_near(const Scene& scene, const GeometryNode& node, const BoundingBox& box_in_world) {
    SurfaceLights found{lights_that_reach(scene, node, box_in_world), glm::vec3(0)};
    for (const std::uint32_t i : found.lights) {
        if (scene.lights[i].kind == LightKind::kDirectional) found.ambient += scene.lights[i].ambient;
    }
    return found;
}

SurfaceLights lights_of(const Scene& scene, const GeometryNode& node, const BoundingBox& box_in_world) {
    SurfaceLights found;
    const WorldSurface surface(node);
    for (const std::uint32_t i : lights_that_reach(scene, node, box_in_world)) {
        const Light& light = scene.lights[i];
        const bool directional = light.kind == LightKind::kDirectional;
        if (directional) found.ambient += light.ambient;
        const bool ambient_is_counted = directional || light.ambient == glm::vec3(0);
        if (ambient_is_counted && !surface.may_reflect(light)) continue;
        found.lights.push_back(i);
    }
    return found;
}

std::vector<std::uint32_t> sort_for_shader(const Scene& scene, const ShadowPlan& shadows,
                                           std::vector<std::uint32_t> lights) {
    const auto place = [&](std::uint32_t i) {
        const LightKind kind = scene.lights[i].kind;
        const ShadowShape shape = shadows.shape_of(i);
        return std::pair(kind == LightKind::kDirectional ? 0
                         : kind == LightKind::kPoint     ? 1
                                                         : 2,
                         shape == ShadowShape::kNone   ? 2
                         : shape == ShadowShape::kCube ? 1
                                                       : 0);
    };
    std::ranges::stable_sort(lights, {}, place);
    return lights;
}

std::vector<LightRow> rows_of(const Scene& scene, const std::vector<std::uint32_t>& lights) {
    std::vector<LightRow> rows;
    for (const std::uint32_t i : lights) rows.push_back(row_of(scene.lights[i]));
    return rows;
}

std::vector<ShadowRow> rows_of(const ShadowPlan& shadows, const std::vector<std::uint32_t>& lights) {
    std::vector<ShadowRow> rows;
    for (const std::uint32_t i : lights) {
        if (shadows.shape_of(i) == ShadowShape::kNone) continue;
        const LightShadow& shadow = shadows.of_light[i];
        rows.push_back({shadow.row_u, shadow.row_v, shadow.row_depth, shadow.layer_texel});
    }
    return rows;
}

}  // namespace rs::compositor
