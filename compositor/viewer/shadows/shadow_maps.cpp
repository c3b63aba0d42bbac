#include "compositor/viewer/shadows/shadow_maps.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/shadows/object_shell.hpp"
#include "compositor/viewer/shadows/shadow_shaders.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <tuple>
#include <utility>

namespace rs::compositor {
namespace {

constexpr unsigned kPlaneUnit = 2;  // as shadow_shaders.hpp has them
constexpr unsigned kCubeUnit = 3;

std::shared_ptr<const gl::VertexArray> upload(const ObjectShell& shell) {
    if (shell.triangles.empty()) return nullptr;
    return std::make_shared<const gl::VertexArray>(std::as_bytes(std::span(shell.corners)),
                                                   static_cast<int>(sizeof(glm::vec3)),
                                                   std::vector<gl::VertexAttribute>{{3, 0}}, shell.triangles);
}

BoundingBox box_of(const PlacedObject& placed) {
    const BoundingCylinder& bounds = placed.object->bounds;
    if (bounds.empty()) return {};
    const BoundingBox box{{-bounds.radius, bounds.bottom, -bounds.radius}, {bounds.radius, bounds.top, bounds.radius}};
    return box.moved(placed.world_from_object.matrix());
}

bool holds(const BoundingBox& box, const glm::dvec3& p) {
    return glm::clamp(p, box.lowest, box.highest) == p;
}

bool throws_on(const BoundingBox& box, const ShadowFace& face) {
    return may_be_seen(box, face.clip_from_world, face.perspective) &&
           (face.scope.empty() || holds(face.scope, box.middle()));
}

}  // namespace

Result<ShadowMaps> ShadowMaps::create(ShadowPlan plan) {
    auto program = gl::Program::create("shadow of an object", shaders::kCasterVertex, shaders::kCasterFragment);
    if (!program) return program.error();
    ShadowMaps maps(std::move(plan), std::move(*program));
    const ShadowPlan& planned = maps.plan_;
    for (const auto& [side, layers, array] : {std::tuple{planned.plane_side, planned.plane_layers, &maps.planes_},
                                              std::tuple{planned.cube_side, planned.cube_layers, &maps.cubes_}}) {
        if (layers == 0) continue;
        auto made = gl::DepthArray::create(side, layers);
        if (!made) return made.error();
        array->emplace(std::move(*made));
    }
    return maps;
}

ShadowMaps::Thrown ShadowMaps::thrown_by(const std::optional<PlacedObject>& placed) const {
    if (!placed) return {};
    Thrown thrown{true, placed->object, placed->world_from_object.matrix(), box_of(*placed), nullptr};
    const auto known = std::ranges::find_if(
        objects_, [&](const Thrown& before) { return before.there && before.object.lock() == placed->object; });
    thrown.shell = known != objects_.end() ? known->shell : upload(object_shell(*placed->object));
    return thrown;
}

int ShadowMaps::update(const std::vector<std::optional<PlacedObject>>& objects,
                       const std::function<void(const ShadowFace&)>& draw_geometry) {
    objects_.resize(objects.size());
    std::vector<BoundingBox> changed = std::exchange(touched_, {});  // what was or is there
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const bool same = objects[i] ? objects_[i].there && objects_[i].object.lock() == objects[i]->object &&
                                           objects_[i].world_from_object == objects[i]->world_from_object.matrix()
                                     : !objects_[i].there;
        if (same) continue;
        Thrown now = thrown_by(objects[i]);
        if (objects_[i].there) changed.push_back(objects_[i].box);
        if (now.there) changed.push_back(now.box);
        objects_[i] = std::move(now);
    }
    int count = 0;
    for (const ShadowFace& face : plan_.faces) {
        const bool is_new =
            !drawn_ || std::ranges::any_of(changed, [&](const BoundingBox& box) { return throws_on(box, face); });
        if (!is_new) continue;
        draw_face(face, draw_geometry);
        ++count;
    }
    drawn_ = true;
    return count;
}

void ShadowMaps::draw_face(const ShadowFace& face, const std::function<void(const ShadowFace&)>& draw_geometry) const {
    (face.of_cube ? *cubes_ : *planes_).begin(face.layer);
    draw_geometry(face);
    for (const Thrown& thrown : objects_) {
        if (!thrown.shell || !throws_on(thrown.box, face)) continue;
        program_.set("clip_from_node", glm::mat4(face.clip_from_world * thrown.world_from_object));
        gl::draw(program_, *thrown.shell, {});
    }
}

void ShadowMaps::bind() const {
    if (planes_) planes_->bind(kPlaneUnit);
    if (cubes_) cubes_->bind(kCubeUnit);
}

Image<float> ShadowMaps::read(const ShadowFace& face) const {
    return (face.of_cube ? *cubes_ : *planes_).read(face.layer);
}

}  // namespace rs::compositor
