#include "compositor/viewer/drawing/surface_renderer.hpp"

#include "compositor/scene/material.hpp"
#include "compositor/viewer/drawing/geometry_shaders.hpp"
#include "compositor/viewer/shadows/shadow_shaders.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace rs::compositor {

namespace {

gl::Primitive primitive_of(Topology topology) {
    switch (topology) {
        case Topology::kLines:
            return gl::Primitive::kLines;
        case Topology::kPoints:
            return gl::Primitive::kPoints;
        case Topology::kTriangles:
            break;
    }
    return gl::Primitive::kTriangles;
}

std::shared_ptr<const gl::VertexArray> upload(const Mesh& mesh) {
    return std::make_shared<const gl::VertexArray>(std::as_bytes(std::span(mesh.vertices)),
                                                   static_cast<int>(sizeof(MeshVertex)),
                                                   std::vector<gl::VertexAttribute>{{3, offsetof(MeshVertex, position)},
                                                                                    {3, offsetof(MeshVertex, normal)},
                                                                                    {2, offsetof(MeshVertex, texture)},
                                                                                    {4, offsetof(MeshVertex, colour)}},
                                                   mesh.indices, primitive_of(mesh.topology));
}

// Cache of uploads: meshes and images shared by several nodes are uploaded once.
class UploadCache {
public:
    std::shared_ptr<const gl::VertexArray> mesh(const std::shared_ptr<const Mesh>& mesh) {
        auto& uploaded = meshes_[mesh.get()];
        if (!uploaded) uploaded = upload(*mesh);
        return uploaded;
    }

    // The mesh with normals on the sides of its winding, as in traced images (RayScene).
    std::shared_ptr<const Mesh> oriented(const std::shared_ptr<const Mesh>& mesh) {
        auto& known = oriented_[mesh];
        if (!known) {
            known =
                has_contradicting_normals(*mesh) ? std::make_shared<const Mesh>(with_normals_in_front(*mesh)) : mesh;
        }
        return known;
    }

    std::shared_ptr<const gl::Texture> image(const SceneTexture& texture) {
        auto& uploaded = images_[&texture];
        if (!uploaded) {
            uploaded = std::make_shared<const gl::Texture>(texture.image.view(),
                                                           gl::TextureWrap{texture.repeat_s, texture.repeat_t});
        }
        return uploaded;
    }

    std::shared_ptr<const gl::Texture> relief(const NormalMap& map) {
        auto& uploaded = reliefs_[&map];
        if (!uploaded) {
            uploaded =
                std::make_shared<const gl::Texture>(map.directions.view(), gl::TextureWrap{map.repeat_s, map.repeat_t});
        }
        return uploaded;
    }

    AlphaUse alpha(const SceneTexture& texture) {
        const auto [found, is_new] = alphas_.try_emplace(&texture, AlphaUse::kNone);
        if (is_new) found->second = alpha_use(texture);
        return found->second;
    }

    [[nodiscard]] int count() const { return static_cast<int>(meshes_.size() + images_.size() + reliefs_.size()); }

private:
    std::map<std::shared_ptr<const Mesh>, std::shared_ptr<const Mesh>> oriented_;
    std::map<const Mesh*, std::shared_ptr<const gl::VertexArray>> meshes_;
    std::map<const SceneTexture*, std::shared_ptr<const gl::Texture>> images_;
    std::map<const NormalMap*, std::shared_ptr<const gl::Texture>> reliefs_;
    std::map<const SceneTexture*, AlphaUse> alphas_;
};

}  // namespace

Result<std::shared_ptr<const gl::Program>> SurfaceRenderer::program(const SurfaceKind& kind) {
    const auto known = programs_.find(kind);
    if (known != programs_.end()) return known->second;
    RS_ASSIGN_OR_RETURN(auto made, gl::Program::create("surface", shaders::kSurfaceVertex,
                                                       constants_of(kind) + shaders::kShadowLookUp +
                                                           shaders::kLighting + shaders::kSurfaceFragment));
    return programs_.emplace(kind, std::make_shared<const gl::Program>(std::move(made))).first->second;
}

// Replaces the light counts of the kind by uniforms, for counts that differ between nodes or frames.
void SurfaceRenderer::count_lights(SurfaceKind& kind, Item& item) const {
    const auto room = static_cast<std::size_t>(kMaxCountedLights);
    glm::ivec4& counts = item.light_counts;
    glm::ivec4& mapped = item.shadow_counts;
    counts = {kind.directional, kind.points, kind.spots, 0};
    mapped = {kind.shadowed_directional, kind.shadowed_points, kind.narrow_spots, kind.wide_spots};
    while (item.lights.size() > room) {  // over capacity: drops the last lights
        item.lights.pop_back();
        --(counts.z > 0 ? counts.z : counts.y > 0 ? counts.y : counts.x);
    }
    mapped.x = std::min(mapped.x, counts.x);
    mapped.y = std::min(mapped.y, counts.y);
    mapped.z = std::min(mapped.z, counts.z);
    mapped.w = std::min(mapped.w, counts.z - mapped.z);
    item.shadows.resize(static_cast<std::size_t>(mapped.x + mapped.y + mapped.z + mapped.w));
    const bool shadowed = !item.shadows.empty();
    kind.directional = available_lights_.directional;
    kind.points = available_lights_.points;
    kind.spots = available_lights_.spots;
    kind.shadowed_directional = shadowed ? available_lights_.shadowed_directional : 0;
    kind.shadowed_points = shadowed ? available_lights_.shadowed_points : 0;
    kind.narrow_spots = shadowed ? available_lights_.narrow_spots : 0;
    kind.wide_spots = shadowed ? available_lights_.wide_spots : 0;
    kind.cascades = shadowed && available_lights_.cascades;
    kind.fading = kind.counted = true;
}

// Updates bounds, lights and shader for the node's transform.
Status SurfaceRenderer::update_item(Item& item) {
    const GeometryNode& node = scene_.geometry[item.node];
    item.bounds = item.bounds_in_node.moved(item.world_from_node);
    const SurfaceLights lights =
        node.moving ? lights_near(scene_, node, item.bounds) : lights_of(scene_, node, item.bounds);
    SurfaceKind kind = kind_of(scene_, shadows_, node, item.alpha, lights.lights);
    const std::vector<std::uint32_t> ordered = sort_for_shader(scene_, shadows_, lights.lights);
    item.lights = rows_of(scene_, ordered);
    item.shadows = rows_of(shadows_, ordered);
    if ((kind.phong || node.moving) && kind.points + kind.spots > 0) count_lights(kind, item);
    RS_ASSIGN_OR_RETURN(auto made, program(kind));
    item.program = std::move(made);
    SurfaceKind fog_kind{.fog = kind.fog, .fog_only = true};
    if (kind.image_alpha == AlphaUse::kMask) {
        fog_kind.image = kind.image;
        fog_kind.image_alpha = kind.image_alpha;
    }
    RS_ASSIGN_OR_RETURN(auto fog_program, program(fog_kind));
    item.fog_program = std::move(fog_program);
    const glm::vec3 reflected = kind.phong ? phong_terms(node.material).ambient * lights.ambient : lights.ambient;
    item.material.ambient_light = glm::vec4(reflected, 0);
    item.mirrored = glm::determinant(glm::dmat3(item.world_from_node)) < 0;
    return {};
}

void SurfaceRenderer::summarize_lights() {
    available_lights_ = {};
    std::vector<std::uint32_t> all(scene_.lights.size());
    std::iota(all.begin(), all.end(), 0U);
    add_lights(scene_, shadows_, all, available_lights_);
    for (int* number : {&available_lights_.directional, &available_lights_.points, &available_lights_.spots,
                        &available_lights_.shadowed_directional, &available_lights_.shadowed_points,
                        &available_lights_.narrow_spots, &available_lights_.wide_spots}) {
        *number = std::min(*number, 1);
    }
    ambient_light_ = glm::vec3(0);
    for (const Light& light : scene_.lights) {
        if (light.kind == LightKind::kDirectional && light.everywhere) ambient_light_ += light.ambient;
    }
}

Status SurfaceRenderer::create_caster_programs() {
    if (shadows_.faces.empty() || caster_) return {};
    RS_ASSIGN_OR_RETURN(auto caster, gl::Program::create("shadow", shaders::kCasterVertex, shaders::kCasterFragment));
    RS_ASSIGN_OR_RETURN(
        auto masked, gl::Program::create("shadow with holes", shaders::kCasterVertex, shaders::kMaskedCasterFragment));
    caster_.emplace(std::move(caster));
    masked_caster_.emplace(std::move(masked));
    return {};
}

Result<SurfaceRenderer> SurfaceRenderer::create(const Scene& scene, const ShadowPlan& shadows,
                                                const std::optional<IrradianceHarmonics>& environment) {
    SurfaceRenderer renderer(scene, shadows);
    renderer.environment_ = environment;
    RS_TRY(renderer.create_caster_programs());
    renderer.summarize_lights();
    UploadCache uploads;
    renderer.item_of_node_.resize(scene.geometry.size());
    for (std::size_t i = 0; i < scene.geometry.size(); ++i) {
        GeometryNode& node = renderer.scene_.geometry[i];
        if (node.mesh->indices.empty()) continue;
        node.mesh = uploads.oriented(node.mesh);
        Item item;
        item.node = i;
        item.mesh = uploads.mesh(node.mesh);
        item.world_from_node = node.world_from_node;
        item.bounds_in_node = bounds_of(*node.mesh);
        if (node.material.texture) {
            item.image = uploads.image(*node.material.texture);
            item.alpha = uploads.alpha(*node.material.texture);
        }
        if (node.material.lit && node.material.normals) item.relief = uploads.relief(*node.material.normals);
        item.casts_shadows = casts_shadows(node);
        item.material = row_of(node.material, scene.shading);
        RS_TRY(renderer.update_item(item));
        item.texture_transform = node.material.texture_transform;
        item.transparent = node.material.opacity < 1 || item.alpha == AlphaUse::kBlend;
        item.traced_glass = item.transparent && is_traced(node);
        item.two_sided = node.mesh->two_sided;
        item.reflective = reflection_of(node.material, scene.shading) != Reflection::kNone;
        renderer.item_of_node_[i] = renderer.items_.size();
        renderer.items_.push_back(std::move(item));
    }
    renderer.uploads_ = uploads.count();
    return renderer;
}

Status SurfaceRenderer::move(std::size_t node, const std::optional<glm::dmat4>& world_from_node) {
    RS_CHECK(node < scene_.geometry.size() && scene_.geometry[node].moving);
    if (!item_of_node_[node]) return {};
    Item& item = items_[*item_of_node_[node]];
    item.hidden = !world_from_node;
    if (item.hidden || *world_from_node == item.world_from_node) return {};
    item.world_from_node = *world_from_node;
    return update_item(item);
}

Status SurfaceRenderer::set_lights(const Scene& scene, const ShadowPlan& shadows,
                                   const std::optional<IrradianceHarmonics>& environment) {
    copy_lights(scene, scene_);
    environment_ = environment;
    shadows_ = shadows;
    RS_TRY(create_caster_programs());
    summarize_lights();
    for (Item& item : items_) {
        RS_TRY(update_item(item));
    }
    return {};
}

bool SurfaceRenderer::is_at(std::size_t node, const std::optional<glm::dmat4>& world_from_node) const {
    if (!item_of_node_[node]) return true;
    const Item& item = items_[*item_of_node_[node]];
    return world_from_node ? !item.hidden && *world_from_node == item.world_from_node : item.hidden;
}

BoundingBox SurfaceRenderer::reflective_bounds() const {
    BoundingBox all;
    for (const Item& item : items_) {
        if (!item.reflective || item.bounds.empty()) continue;
        all.include(item.bounds.lowest);
        all.include(item.bounds.highest);
    }
    return all;
}

bool SurfaceRenderer::has_transparent() const {
    return std::ranges::any_of(items_, [](const Item& item) { return item.transparent; });
}

BoundingBox SurfaceRenderer::caster_bounds(std::size_t node) const {
    if (!item_of_node_[node]) return {};
    const Item& item = items_[*item_of_node_[node]];
    return item.hidden || !item.casts_shadows ? BoundingBox{} : item.bounds;
}

void SurfaceRenderer::set_frame(const FrameView& view) const {
    const auto& fog = scene_.fog;
    for (const auto& [kind, program] : programs_) {
        if (program->has_uniform("eye")) program->set("eye", glm::vec3(view.camera.centre()));
        if (program->has_uniform("headlight")) program->set("headlight", glm::vec3(view.camera.forward()));
        if (program->has_uniform("cover_light")) program->set("cover_light", ambient_light_);
        if (environment_ && program->has_uniform("environment")) {
            program->set("environment", std::span(environment_->factors));
        }
        if (!cascades_.empty() && program->has_uniform("cascades")) program->set("cascades", std::span(cascades_));
        if (!fog) continue;
        if (program->has_uniform("fog")) program->set("fog", fog->colour);
        if (program->has_uniform("fog_visibility")) program->set("fog_visibility", static_cast<float>(fog->visibility));
    }
}

void SurfaceRenderer::draw(const Item& item, const gl::Program& program, const FrameView& view,
                           gl::DrawState state) const {
    const auto set = [&](const char* name, const auto& value) {
        if (program.has_uniform(name)) program.set(name, value);
    };
    program.set("clip_from_node", glm::mat4(view.clip_from_world * item.world_from_node));
    set("world_from_node", glm::mat4(item.world_from_node));
    set("world_normal_from_node", glm::mat3(glm::transpose(glm::inverse(glm::dmat3(item.world_from_node)))));
    set("texture_transform", item.texture_transform);
    // Rows of vec4 without padding; surface_tables.cpp asserts their sizes.
    set("material", std::span(&item.material.diffuse_opacity, kMaterialRows));
    if (!item.lights.empty()) set("lights", std::span(&item.lights.front().colour, 5 * item.lights.size()));
    if (!item.shadows.empty()) set("shadows", std::span(&item.shadows.front().u, 4 * item.shadows.size()));
    set("light_counts", item.light_counts);
    set("shadow_counts", item.shadow_counts);
    if (item.image) item.image->bind(0);
    if (item.relief) item.relief->bind(4);
    if (item.reflective && reflections_) reflections_->bind(5);
    state.clockwise = item.mirrored;
    gl::draw(program, *item.mesh, state);
}

SurfaceRenderer::VisibleItems SurfaceRenderer::collect_visible(const FrameView& view, bool traced) {
    VisibleItems seen;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        if (item.hidden || !can_be_visible(item.bounds, view.clip_from_world)) continue;
        if (item.transparent && !(traced && item.traced_glass)) {
            seen.transparent.push_back({i, glm::distance(item.bounds.middle(), view.camera.centre())});
        } else {
            seen.opaque.push_back(i);
        }
    }
    nodes_in_view_ = static_cast<int>(seen.transparent.size() + seen.opaque.size());
    // Front to back by the farthest corner, to shade few hidden pixels: floor and walls of a room are near as well, but
    // behind everything in it.
    const auto distance = [&](std::size_t i) {
        const BoundingBox& box = items_[i].bounds;
        const glm::dvec3& eye = view.camera.centre();
        return glm::length(glm::max(glm::abs(box.lowest - eye), glm::abs(box.highest - eye)));
    };
    std::stable_sort(seen.opaque.begin(), seen.opaque.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    return seen;
}

std::vector<SurfaceRenderer::Transparent> SurfaceRenderer::draw_opaque(const FrameView& view, bool wire_frame,
                                                                       OpaqueMode mode) {
    set_frame(view);
    const bool surroundings = mode == OpaqueMode::kSurroundings;
    VisibleItems seen = collect_visible(view, mode != OpaqueMode::kLit && !surroundings);
    if (mode == OpaqueMode::kNone) seen.opaque.clear();
    for (const std::size_t i : seen.opaque) {
        const Item& item = items_[i];
        if (surroundings && item.reflective) continue;
        const bool all_sides = (item.two_sided && !surroundings) || wire_frame;
        draw(item, mode == OpaqueMode::kDepthOnly ? *item.fog_program : *item.program, view,
             {.culling = all_sides ? gl::Culling::kNone : gl::Culling::kBack, .wire_frame = wire_frame});
    }
    return std::move(seen.transparent);
}

void SurfaceRenderer::draw_fog(const FrameView& view) const {
    if (!scene_.fog) return;
    for (const Item& item : items_) {
        if (item.hidden || (item.transparent && !item.traced_glass) ||
            !can_be_visible(item.bounds, view.clip_from_world))
            continue;
        draw(item, *item.fog_program, view,
             {.depth_write = false,
              .blending = gl::Blending::kOverPremultiplied,
              .culling = item.two_sided ? gl::Culling::kNone : gl::Culling::kBack});
    }
}

void SurfaceRenderer::draw_casters(const ShadowPass& pass) const {
    const ShadowFace& face = pass.face;
    for (const Item& item : items_) {
        if (!item.casts_shadows || item.hidden || !can_be_visible(item.bounds, pass.area_from_world, face.perspective))
            continue;
        const bool moving = scene_.geometry[item.node].moving.has_value();
        if (pass.casters == (moving ? Casters::kStatic : Casters::kMoving)) continue;
        const std::vector<std::uint32_t>& own_lights = scene_.geometry[item.node].lights;
        if (!scene_.lights[face.light].everywhere && std::ranges::find(own_lights, face.light) == own_lights.end()) {
            continue;
        }
        const bool masked = item.alpha == AlphaUse::kMask;
        const gl::Program& program = masked ? *masked_caster_ : *caster_;
        program.set("clip_from_node", glm::mat4(face.clip_from_world * item.world_from_node));
        if (masked) {
            program.set("texture_transform", item.texture_transform);
            item.image->bind(0);
        }
        gl::draw(program, *item.mesh,
                 {.culling = item.two_sided ? gl::Culling::kNone : gl::Culling::kBack, .clockwise = item.mirrored});
    }
}

void SurfaceRenderer::draw_transparent(const Transparent& transparent, const FrameView& view, bool wire_frame) const {
    const Item& item = items_[transparent.index];
    gl::DrawState state{.depth_write = false, .blending = gl::Blending::kOverPremultiplied, .wire_frame = wire_frame};
    set_frame(view);
    // Back faces lie behind front faces.
    if (item.two_sided) {
        state.culling = gl::Culling::kFront;
        draw(item, *item.program, view, state);
    }
    state.culling = gl::Culling::kBack;
    draw(item, *item.program, view, state);
}

}  // namespace rs::compositor
