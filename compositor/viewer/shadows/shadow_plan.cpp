#include "compositor/viewer/shadows/shadow_plan.hpp"

#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::compositor {
namespace {

constexpr double kWidestCone_rad = kPi / 3;
constexpr double kMargin_texels = 2;  // border of the maps for interpolation between texels
constexpr int kMapSideStep = 64;
constexpr int kMinMapSide = 64;

ShadowShape shape_of_light(const Light& light) {
    if (!(std::max({light.colour.r, light.colour.g, light.colour.b}) > 0)) return ShadowShape::kNone;
    if (light.kind == LightKind::kDirectional) return ShadowShape::kParallel;
    const bool narrow = light.kind == LightKind::kSpot && light.cut_off_rad <= kWidestCone_rad;
    return narrow ? ShadowShape::kCone : ShadowShape::kCube;
}

// Luminance that the light may give a surface: at its radius, but at most a quarter of the scene's size away.
double brightness_of(const Light& light, double scene_size) {
    const double luminance = glm::dot(glm::dvec3(light.colour), glm::dvec3(0.2126, 0.7152, 0.0722));
    if (light.kind == LightKind::kDirectional) return luminance;
    const double d = std::min(0.25 * scene_size, light.radius);
    const double attenuation = glm::dot(glm::dvec3(light.attenuation), glm::dvec3(1, d, d * d));
    return luminance / std::max({attenuation, static_cast<double>(light.least_attenuation), 1e-9});
}

// Basis along z whose first axis is horizontal.
glm::dmat3 axes_along(const glm::dvec3& z) {
    const glm::dvec3 level(z.z, 0, -z.x);
    const double length = glm::length(level);
    const glm::dvec3 x = length > 1e-6 ? level / length : glm::dvec3(1, 0, 0);
    return {x, glm::cross(z, x), z};
}

int side_for(int maps, int largest) {
    if (maps == 0) return 0;
    const double side = std::sqrt(static_cast<double>(kMaxShadowTexels) / maps);
    return std::clamp(static_cast<int>(side) / kMapSideStep * kMapSideStep, kMinMapSide, largest);
}

// Projection whose clip x, y and w are right, up and axial coordinates relative to `eye`.
glm::dmat4 seen_from(const glm::dvec3& eye, const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& forward,
                     double half_width) {
    const auto row = [&](const glm::dvec3& along) { return glm::dvec4(along, -glm::dot(along, eye)); };
    return glm::transpose(
        glm::dmat4(row(right / half_width), row(up / half_width), glm::dvec4(0, 0, 0, kNear), row(forward)));
}

// Rows that map clip coordinates -1 .. 1 to 0 .. 1 in the map; the first row is its top.
void set_rows(const glm::dmat4& clip_from_world, int depth_row, LightShadow& shadow) {
    const glm::dmat4 rows = glm::transpose(clip_from_world);
    shadow.row_u = 0.5 * rows[3] + 0.5 * rows[0];
    shadow.row_v = 0.5 * rows[3] - 0.5 * rows[1];
    shadow.row_depth = rows[depth_row];
}

class Planner {
public:
    Planner(const Scene& scene, const BoundingBox& casters)
        : scene_(scene), casters_(casters), has_shadows_(lights_with_shadows(scene)) {}

    ShadowPlan plan() {
        plan_.of_light.resize(scene_.lights.size());
        const std::vector<std::uint32_t> planes = brightest(false, kMaxPlaneShadows);
        const std::vector<std::uint32_t> cubes = brightest(true, kMaxCubeShadows);
        plan_.plane_layers = static_cast<int>(planes.size());
        for (const std::uint32_t i : cubes) plan_.cube_layers += faces_of_cube(scene_.lights[i]);
        plan_.plane_side = side_for(plan_.plane_layers, kMaxPlaneSide);
        plan_.cube_side = side_for(plan_.cube_layers, kMaxCubeSide);
        const std::vector<std::uint32_t> cascaded = lights_with_cascades(planes);
        plan_.plane_layers += kCascades * static_cast<int>(cascaded.size());
        plan_.plane_side = side_for(plan_.plane_layers, kMaxPlaneSide);
        int layer = 0;
        for (const std::uint32_t i : planes) {
            add_plane(i, layer++);
            if (std::ranges::find(cascaded, i) != cascaded.end()) layer = add_cascades(i, layer);
        }
        layer = 0;
        for (const std::uint32_t i : cubes) layer = add_cube(i, layer);
        return std::move(plan_);
    }

private:
    static int faces_of_cube(const Light& light) { return light.kind == LightKind::kSpot ? 5 : 6; }

    [[nodiscard]] std::vector<std::uint32_t> brightest(bool cubes, std::size_t most) const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t i = 0; i < scene_.lights.size(); ++i) {
            const ShadowShape shape = shape_of_light(scene_.lights[i]);
            if (shape == ShadowShape::kNone || (shape == ShadowShape::kCube) != cubes) continue;
            if (!has_shadows_[i]) continue;
            found.push_back(i);
        }
        std::ranges::stable_sort(found,
                                 [&](std::uint32_t a, std::uint32_t b) { return brightness(a) > brightness(b); });
        found.resize(std::min(found.size(), most));
        return found;
    }

    // The lights whose single map is too coarse, by brightness.
    [[nodiscard]] std::vector<std::uint32_t> lights_with_cascades(const std::vector<std::uint32_t>& planes) const {
        std::vector<std::uint32_t> cascaded;
        for (const std::uint32_t i : planes) {
            if (cascaded.size() == kMaxCascadedLights) break;
            if (shape_of_light(scene_.lights[i]) != ShadowShape::kParallel) continue;
            const double half_width = std::max(half_size(i).x, half_size(i).y);
            if (2 * half_width / plan_.plane_side > kMaxTexel_rad * eye_height(half_width)) cascaded.push_back(i);
        }
        return cascaded;
    }

    // Positive also for scenes that have none.
    [[nodiscard]] double eye_height(double half_width) const {
        return std::max(scene_.navigation.avatar.y, 1e-4 * half_width);
    }

    // Nodes whose shadows the light casts.
    [[nodiscard]] BoundingBox casters_of(std::uint32_t light) const {
        const BoundingBox scope = scope_of(light);
        return scope.empty() ? casters_ : scope;
    }

    // Half the extents of the casters along the axes of a directional light.
    [[nodiscard]] glm::dvec3 half_size(std::uint32_t light) const {
        const glm::dmat3 axes = axes_along(-scene_.lights[light].towards);
        const BoundingBox box = casters_of(light).moved(glm::dmat4(glm::transpose(axes)));
        return glm::max(0.5 * (box.highest - box.lowest), glm::dvec3(1e-6));
    }

    // The plan's last face is the light's map of all casters. Returns the next free layer.
    int add_cascades(std::uint32_t index, int layer) {
        const ShadowFace whole = plan_.faces.back();
        const glm::dvec3 half = half_size(index);
        const double widest = std::max(half.x, half.y);
        const double eye = eye_height(widest);
        plan_.of_light[index].layer_texel.z = static_cast<float>(plan_.cascades.size());
        plan_.of_light[index].layer_texel.w = kCascades;
        for (int i = 0; i < kCascades; ++i) {
            const double reach = eye * std::pow(widest / eye, (i + 1.0) / (kCascades + 1));
            const double half_width = reach * kCascadeSteps / (kCascadeSteps - 1);  // from half a step off the centre
            plan_.cascades.push_back({plan_.faces.size(), whole.clip_from_world, glm::dvec2(half) / half_width});
            plan_.faces.push_back(whole);
            plan_.faces.back().layer = layer++;
        }
        return layer;
    }

    void add_plane(std::uint32_t index, int layer) {
        const Light& light = scene_.lights[index];
        LightShadow& shadow = plan_.of_light[index];
        shadow.shape = shape_of_light(light);
        const bool cone = shadow.shape == ShadowShape::kCone;
        const double margin = 1 + 2 * kMargin_texels / plan_.plane_side;
        double texel = 0;
        ShadowFace face{.light = index, .layer = layer, .perspective = cone, .scope = scope_of(index)};
        const glm::dmat3 axes = axes_along(-light.towards);  // right, up, back
        if (cone) {
            const double half_width = std::tan(std::max(light.cut_off_rad, 1e-3)) * margin;
            face.clip_from_world = seen_from(light.location, axes[0], axes[1], light.towards, half_width);
            texel = 2 * half_width / plan_.plane_side;
        } else {
            face.clip_from_world = parallel(axes, casters_of(index), margin, texel);
        }
        set_rows(face.clip_from_world, cone ? 3 : 2, shadow);
        shadow.layer_texel = {layer, texel, 0, 0};
        plan_.faces.push_back(face);
    }

    [[nodiscard]] BoundingBox scope_of(std::uint32_t light) const {
        BoundingBox scope;
        if (scene_.lights[light].everywhere) return scope;
        for (const GeometryNode& node : scene_.geometry) {
            if (std::ranges::find(node.lights, light) == node.lights.end()) continue;
            const BoundingBox box = bounds_of(*node.mesh).moved(node.world_from_node);
            if (box.empty()) continue;
            scope.include(box.lowest);
            scope.include(box.highest);
        }
        return scope;
    }

    [[nodiscard]] glm::dmat4 parallel(const glm::dmat3& axes, const BoundingBox& held, double margin,
                                      double& texel) const {
        const BoundingBox box = held.moved(glm::dmat4(glm::transpose(axes)));
        const glm::dvec3 half = glm::max(0.5 * (box.highest - box.lowest), glm::dvec3(1e-6)) * margin;
        texel = 2 * std::max(half.x, half.y) / plan_.plane_side;
        glm::dmat4 rows(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            rows[axis] = glm::dvec4(axes[axis], -box.middle()[axis]) / half[axis];
        }
        // Positions farther back along the light direction are nearer to the light and get greater depths.
        rows[2] = 0.5 * rows[2] + glm::dvec4(0, 0, 0, 0.5);
        rows[3] = glm::dvec4(0, 0, 0, 1);
        return glm::transpose(rows);
    }

    // Returns the next free layer.
    int add_cube(std::uint32_t index, int layer) {
        const Light& light = scene_.lights[index];
        LightShadow& shadow = plan_.of_light[index];
        shadow.shape = ShadowShape::kCube;
        const bool spot = light.kind == LightKind::kSpot;
        const glm::dmat3 axes = axes_along(spot ? light.towards : glm::dvec3(0, 0, 1));
        const glm::dvec3 x = axes[0];
        const glm::dvec3 y = axes[1];
        const glm::dvec3 z = axes[2];
        // Right, up, forward of each face; cube_shadow() selects by this order.
        const std::array<std::array<glm::dvec3, 3>, 6> faces{
            {{-x, y, z}, {z, y, x}, {-z, y, -x}, {x, z, y}, {x, -z, -y}, {x, y, -z}}};
        const double half_width = 1 + 2 * kMargin_texels / plan_.cube_side;
        const BoundingBox scope = scope_of(index);
        shadow.row_u = glm::vec4(x, 0);
        shadow.row_v = glm::vec4(y, 0);
        shadow.row_depth = glm::vec4(z, 0);
        shadow.layer_texel = {layer, 2 * half_width / plan_.cube_side, 0.5 / half_width, 0};
        for (int f = 0; f < faces_of_cube(light); ++f) {
            const auto& [right, up, forward] = faces[static_cast<std::size_t>(f)];
            plan_.faces.push_back(
                {index, true, layer++, seen_from(light.location, right, up, forward, half_width), true, scope});
        }
        return layer;
    }

    [[nodiscard]] double brightness(std::uint32_t light) const {
        return brightness_of(scene_.lights[light], glm::length(casters_.highest - casters_.lowest));
    }

    const Scene& scene_;
    BoundingBox casters_;
    std::vector<bool> has_shadows_;  // [light]
    ShadowPlan plan_;
};

}  // namespace

bool casts_shadows(const GeometryNode& node) {
    return node.mesh->topology == Topology::kTriangles && !node.mesh->indices.empty() && !is_blended(node.material);
}

BoundingBox bounds_of_casters(const Scene& scene) {
    BoundingBox all;
    const auto include = [&](const BoundingBox& box) {
        if (box.empty()) return;
        all.include(box.lowest);
        all.include(box.highest);
    };
    for (const GeometryNode& node : scene.geometry) {
        if (casts_shadows(node)) include(bounds_of(*node.mesh).moved(node.world_from_node));
    }
    for (const RaySpaceNode& object : scene.objects) {
        constexpr double kAbove = 2.2;  // height above the foot, radii
        const BoundingBox box{{-1.1, object.standing ? 0 : -1.1, -1.1}, {1.1, object.standing ? kAbove : 1.1, 1.1}};
        include(box.moved(world_from_node(object.chain).matrix()));
    }
    return all;
}

ShadowPlan plan_shadows(const Scene& scene, const BoundingBox& casters) {
    if (casters.empty()) return {};
    ShadowPlan plan = Planner(scene, casters).plan();
    plan.centre_cascades(casters.middle());
    return plan;
}

std::vector<std::size_t> ShadowPlan::centre_cascades(const glm::dvec3& eye) {
    std::vector<std::size_t> moved;
    for (ShadowCascade& cascade : cascades) {
        const glm::dvec2 step = 2.0 / (static_cast<double>(kCascadeSteps) * cascade.scale);
        const glm::dvec2 step_at = glm::round(glm::dvec2(cascade.clip_from_world * glm::dvec4(eye, 1)) / step);
        glm::dmat4 cascade_from_clip(1.0);
        cascade_from_clip[0][0] = cascade.scale.x;
        cascade_from_clip[1][1] = cascade.scale.y;
        cascade_from_clip[3] = glm::dvec4(-cascade.scale * step * step_at, 0, 1);
        const glm::dmat4 clip_from_world = cascade_from_clip * cascade.clip_from_world;
        if (clip_from_world == faces[cascade.face].clip_from_world) continue;
        faces[cascade.face].clip_from_world = clip_from_world;
        cascade.step_at = step_at;
        moved.push_back(cascade.face);
    }
    return moved;
}

std::vector<glm::vec4> ShadowPlan::cascade_rows() const {
    std::vector<glm::vec4> rows;
    for (const ShadowCascade& cascade : cascades) {
        // In the cascade, clip = scale * clip of all casters - 2 / kCascadeSteps * step_at; v = 0.5 - 0.5 * clip y.
        const glm::dvec2 shift = cascade.step_at / static_cast<double>(kCascadeSteps);
        const glm::dvec2 offset = 0.5 - 0.5 * cascade.scale + glm::dvec2(-shift.x, shift.y);
        rows.emplace_back(glm::vec2(offset), glm::vec2(cascade.scale));
    }
    return rows;
}

}  // namespace rs::compositor
