#include "compositor/viewer/shadows/shadow_maps.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/shadows/object_shell.hpp"
#include "compositor/viewer/shadows/shadow_shaders.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace rs::compositor {
namespace {

constexpr unsigned kPlaneUnit = 2;  // texture units in shadow_shaders.hpp
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

bool box_contains(const BoundingBox& box, const glm::dvec3& p) {
    return glm::clamp(p, box.lowest, box.highest) == p;
}

bool affects_map(const BoundingBox& box, const ShadowFace& face) {
    return can_be_visible(box, face.clip_from_world, face.perspective) &&
           (face.scope.empty() || box_contains(face.scope, box.middle()));
}

// Texels that a box may cover in a map: the whole map if the box extends behind the light.
gl::TexelArea area_of(const BoundingBox& box, const ShadowFace& face, int side) {
    glm::dvec2 lowest(1);
    glm::dvec2 highest(-1);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? box.highest.x : box.lowest.x,
                           (corner & 2) != 0 ? box.highest.y : box.lowest.y,
                           (corner & 4) != 0 ? box.highest.z : box.lowest.z);
        const glm::dvec4 clip = face.clip_from_world * glm::dvec4(p, 1);
        if (clip.w < kNear && face.perspective) return {0, 0, side, side};
        const glm::dvec2 on_map = glm::clamp(glm::dvec2(clip.x, -clip.y) / clip.w, -1.0, 1.0);  // rows run downwards
        lowest = glm::min(lowest, on_map);
        highest = glm::max(highest, on_map);
    }
    constexpr int kRim = 1;  // for rasterisation rounding
    const auto first = [&](double at) { return std::max(static_cast<int>((at + 1) / 2 * side) - kRim, 0); };
    const auto end = [&](double at) { return std::min(static_cast<int>((at + 1) / 2 * side) + 1 + kRim, side); };
    const int x = first(lowest.x);
    const int y = first(lowest.y);
    return {x, y, end(highest.x) - x, end(highest.y) - y};
}

bool overlap(const gl::TexelArea& a, const gl::TexelArea& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

gl::TexelArea bounding_area(const gl::TexelArea& a, const gl::TexelArea& b) {
    const int x = std::min(a.x, b.x);
    const int y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

// Adds an area; overlapping areas are merged, so that no texel belongs to two.
void add_area(gl::TexelArea area, std::vector<gl::TexelArea>& areas) {
    for (;;) {
        const auto other = std::ranges::find_if(areas, [&](const gl::TexelArea& a) { return overlap(a, area); });
        if (other == areas.end()) break;
        area = bounding_area(area, *other);
        areas.erase(other);
    }
    areas.push_back(area);
}

// Projection onto this area of the face's map.
glm::dmat4 area_from_world(const ShadowFace& face, const gl::TexelArea& area, int side) {
    const glm::dvec2 size(area.width, area.height);
    const glm::dvec2 middle = (glm::dvec2(area.x, area.y) + 0.5 * size) * (2.0 / side) - 1.0;
    const glm::dvec2 scale = static_cast<double>(side) / size;
    glm::dmat4 area_from_map(1.0);
    area_from_map[0][0] = scale.x;
    area_from_map[1][1] = scale.y;
    area_from_map[3] = glm::dvec4(-middle.x * scale.x, middle.y * scale.y, 0, 1);
    return area_from_map * face.clip_from_world;
}

}  // namespace

Result<ShadowMaps> ShadowMaps::create(ShadowPlan plan) {
    RS_ASSIGN_OR_RETURN(auto program,
                        gl::Program::create("shadow of an object", shaders::kCasterVertex, shaders::kCasterFragment));
    ShadowMaps maps(std::move(plan), std::move(program));
    const ShadowPlan& planned = maps.plan_;
    for (const auto& [side, layers, array] : {std::tuple{planned.plane_side, planned.plane_layers, &maps.planes_.all},
                                              std::tuple{planned.cube_side, planned.cube_layers, &maps.cubes_.all}}) {
        if (layers == 0) continue;
        RS_ASSIGN_OR_RETURN(auto made, gl::DepthArray::create(side, layers));
        array->emplace(std::move(made));
    }
    maps.valid_.resize(planned.faces.size());
    maps.static_cached_.resize(planned.faces.size());
    return maps;
}

ShadowMaps::CasterState ShadowMaps::caster_state(const std::optional<PlacedObject>& placed) const {
    if (!placed) return {};
    CasterState state{true, placed->object, placed->world_from_object.matrix(), box_of(*placed), nullptr};
    const auto known = std::ranges::find_if(
        objects_, [&](const CasterState& before) { return before.there && before.object.lock() == placed->object; });
    state.shell = known != objects_.end() ? known->shell : upload(object_shell(*placed->object));
    return state;
}

// Previous and current boxes of the casters that have changed since the last call.
std::vector<BoundingBox> ShadowMaps::take_changed_boxes(const std::vector<std::optional<PlacedObject>>& objects) {
    objects_.resize(objects.size());
    std::vector<BoundingBox> changed = std::exchange(invalid_boxes_, {});
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const bool same = objects[i] ? objects_[i].there && objects_[i].object.lock() == objects[i]->object &&
                                           objects_[i].world_from_object == objects[i]->world_from_object.matrix()
                                     : !objects_[i].there;
        if (same) continue;
        CasterState now = caster_state(objects[i]);
        if (objects_[i].there) changed.push_back(objects_[i].box);
        if (now.there) changed.push_back(now.box);
        objects_[i] = std::move(now);
    }
    return changed;
}

int ShadowMaps::update(const glm::dvec3& eye, const std::vector<std::optional<PlacedObject>>& objects,
                       const DrawGeometry& draw_geometry) {
    for (const std::size_t face : plan_.centre_cascades(eye)) valid_[face] = static_cached_[face] = false;
    const std::vector<BoundingBox> changed = take_changed_boxes(objects);
    int count = 0;
    for (std::size_t i = 0; i < plan_.faces.size(); ++i) count += update_map(i, changed, draw_geometry) ? 1 : 0;
    return count;
}

// Returns true if the map was outdated.
bool ShadowMaps::update_map(std::size_t index, const std::vector<BoundingBox>& changed,
                            const DrawGeometry& draw_geometry) {
    const ShadowFace& face = plan_.faces[index];
    const int side = side_of(face);
    std::vector<gl::TexelArea> areas;
    if (!valid_[index]) areas.push_back({0, 0, side, side});
    for (const BoundingBox& box : changed) {
        if (affects_map(box, face)) add_area(area_of(box, face, side), areas);
    }
    if (areas.empty()) return false;
    // Scenes in which nothing has ever changed need no cache.
    const bool caches = valid_[index] || maps_of(face).static_geometry;
    if (caches && cache_static_geometry(index, draw_geometry)) {
        draw_areas(face, areas, draw_geometry);
    } else {
        redraw_map(face, draw_geometry);
    }
    valid_[index] = true;
    return true;
}

void ShadowMaps::invalidate(const BoundingBox& box) {
    constexpr std::size_t kMaxInvalidBoxes = 4096;  // maps may stay outdated for long, e.g. under traced images
    if (box.empty()) return;
    invalid_boxes_.push_back(box);
    if (invalid_boxes_.size() < kMaxInvalidBoxes) return;
    invalid_boxes_.clear();
    valid_.assign(valid_.size(), false);
}

void ShadowMaps::draw_objects(const ShadowPass& pass) const {
    for (const CasterState& state : objects_) {
        if (!state.shell || !affects_map(state.box, pass.face) ||
            !can_be_visible(state.box, pass.area_from_world, pass.face.perspective)) {
            continue;
        }
        program_.set("clip_from_node", glm::mat4(pass.face.clip_from_world * state.world_from_object));
        gl::draw(program_, *state.shell, {});
    }
}

void ShadowMaps::redraw_map(const ShadowFace& face, const DrawGeometry& draw_geometry) const {
    const ShadowPass pass{face, Casters::kAll, face.clip_from_world};
    maps_of(face).all->begin(face.layer);
    draw_geometry(pass);
    draw_objects(pass);
}

// Draws the static casters of a map into its cache. False if the driver has no memory for the cache.
bool ShadowMaps::cache_static_geometry(std::size_t index, const DrawGeometry& draw_geometry) {
    if (static_cached_[index]) return true;
    const ShadowFace& face = plan_.faces[index];
    Maps& maps = maps_of(face);
    if (!maps.static_geometry) {
        auto made = gl::DepthArray::create(maps.all->side(), maps.all->layers());
        if (!made) return false;
        maps.static_geometry.emplace(std::move(*made));
    }
    maps.static_geometry->begin(face.layer);
    draw_geometry({face, Casters::kStatic, face.clip_from_world});
    static_cached_[index] = true;
    return true;
}

void ShadowMaps::draw_areas(const ShadowFace& face, const std::vector<gl::TexelArea>& areas,
                            const DrawGeometry& draw_geometry) const {
    const Maps& maps = maps_of(face);
    for (const gl::TexelArea& area : areas) maps.all->copy(*maps.static_geometry, face.layer, area);
    maps.all->resume(face.layer);
    for (const gl::TexelArea& area : areas) {
        const gl::Scissor scissor(area);
        const ShadowPass pass{face, Casters::kMoving, area_from_world(face, area, side_of(face))};
        draw_geometry(pass);
        draw_objects(pass);
    }
}

void ShadowMaps::bind() const {
    if (planes_.all) planes_.all->bind(kPlaneUnit);
    if (cubes_.all) cubes_.all->bind(kCubeUnit);
}

Image<float> ShadowMaps::read(const ShadowFace& face) const {
    return maps_of(face).all->read(face.layer);
}

}  // namespace rs::compositor
