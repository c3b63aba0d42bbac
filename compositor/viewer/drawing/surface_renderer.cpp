#include "compositor/viewer/drawing/surface_renderer.hpp"

#include "compositor/scene/normal_map.hpp"
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

// Everything that several nodes share is uploaded once.
class Uploads {
public:
    std::shared_ptr<const gl::VertexArray> mesh(const std::shared_ptr<const Mesh>& mesh) {
        auto& uploaded = meshes_[mesh.get()];
        if (!uploaded) uploaded = upload(*mesh);
        return uploaded;
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
    std::map<const Mesh*, std::shared_ptr<const gl::VertexArray>> meshes_;
    std::map<const SceneTexture*, std::shared_ptr<const gl::Texture>> images_;
    std::map<const NormalMap*, std::shared_ptr<const gl::Texture>> reliefs_;
    std::map<const SceneTexture*, AlphaUse> alphas_;
};

}  // namespace

Result<std::shared_ptr<const gl::Program>> SurfaceRenderer::program(const SurfaceKind& kind) {
    const auto known = programs_.find(kind);
    if (known != programs_.end()) return known->second;
    RS_ASSIGN_OR_RETURN(auto made,
                        gl::Program::create("surface", shaders::kSurfaceVertex,
                                            constants_of(kind) + shaders::kShadowLookUp + shaders::kSurfaceFragment));
    return programs_.emplace(kind, std::make_shared<const gl::Program>(std::move(made))).first->second;
}

// Of lights with a place, which are others from piece to piece and from frame to frame.
void SurfaceRenderer::count_lights(SurfaceKind& kind, Item& item) const {
    const auto room = static_cast<std::size_t>(kMostCountedLights);
    glm::ivec4& counts = item.light_counts;
    glm::ivec4& mapped = item.shadow_counts;
    counts = {kind.directional, kind.points, kind.spots, 0};
    mapped = {kind.shadowed_directional, kind.shadowed_points, kind.narrow_spots, kind.wide_spots};
    while (item.lights.size() > room) {  // more than anybody sees apart
        item.lights.pop_back();
        --(counts.z > 0 ? counts.z : counts.y > 0 ? counts.y : counts.x);
    }
    mapped.x = std::min(mapped.x, counts.x);
    mapped.y = std::min(mapped.y, counts.y);
    mapped.z = std::min(mapped.z, counts.z);
    mapped.w = std::min(mapped.w, counts.z - mapped.z);
    item.shadows.resize(static_cast<std::size_t>(mapped.x + mapped.y + mapped.z + mapped.w));
    const bool shadowed = !item.shadows.empty();
    kind.directional = some_lights_.directional;
    kind.points = some_lights_.points;
    kind.spots = some_lights_.spots;
    kind.shadowed_directional = shadowed ? some_lights_.shadowed_directional : 0;
    kind.shadowed_points = shadowed ? some_lights_.shadowed_points : 0;
    kind.narrow_spots = shadowed ? some_lights_.narrow_spots : 0;
    kind.wide_spots = shadowed ? some_lights_.wide_spots : 0;
    kind.fading = kind.counted = true;
}

// Bounds, lights and the shader for where the node is now.
Status SurfaceRenderer::put(Item& item) {
    const GeometryNode& node = scene_.geometry[item.node];
    item.bounds = item.bounds_in_node.moved(item.world_from_node);
    const SurfaceLights lights =
        node.moving ? lights_near(scene_, node, item.bounds) : lights_of(scene_, node, item.bounds);
    SurfaceKind kind = kind_of(scene_, shadows_, node, item.alpha, lights.lights);
    const std::vector<std::uint32_t> ordered = in_shader_order(scene_, shadows_, lights.lights);
    item.lights = rows_of(scene_, ordered);
    item.shadows = rows_of(shadows_, ordered);
    if ((kind.phong || node.moving) && kind.points + kind.spots > 0) count_lights(kind, item);
    RS_ASSIGN_OR_RETURN(auto made, program(kind));
    item.program = std::move(made);
    SurfaceKind veil{.fog = kind.fog, .veil = true};
    if (kind.image_alpha == AlphaUse::kMask) {
        veil.image = kind.image;
        veil.image_alpha = kind.image_alpha;
    }
    RS_ASSIGN_OR_RETURN(auto veiled, program(veil));
    item.veil = std::move(veiled);
    const glm::vec3 reflected = kind.phong ? phong_terms(node.material).ambient * lights.ambient : lights.ambient;
    item.material.ambient_light = glm::vec4(reflected, 0);
    item.mirrored = glm::determinant(glm::dmat3(item.world_from_node)) < 0;
    return {};
}

void SurfaceRenderer::survey_lights() {
    some_lights_ = {};
    std::vector<std::uint32_t> all(scene_.lights.size());
    std::iota(all.begin(), all.end(), 0U);
    add_lights(scene_, shadows_, all, some_lights_);
    for (int* number :
         {&some_lights_.directional, &some_lights_.points, &some_lights_.spots, &some_lights_.shadowed_directional,
          &some_lights_.shadowed_points, &some_lights_.narrow_spots, &some_lights_.wide_spots}) {
        *number = std::min(*number, 1);
    }
    ambient_light_ = glm::vec3(0);
    for (const Light& light : scene_.lights) {
        if (light.kind == LightKind::kDirectional && light.everywhere) ambient_light_ += light.ambient;
    }
}

Status SurfaceRenderer::make_casters() {
    if (shadows_.faces.empty() || caster_) return {};
    RS_ASSIGN_OR_RETURN(auto caster, gl::Program::create("shadow", shaders::kCasterVertex, shaders::kCasterFragment));
    RS_ASSIGN_OR_RETURN(
        auto masked, gl::Program::create("shadow with holes", shaders::kCasterVertex, shaders::kMaskedCasterFragment));
    caster_.emplace(std::move(caster));
    masked_caster_.emplace(std::move(masked));
    return {};
}

Result<SurfaceRenderer> SurfaceRenderer::create(const Scene& scene, const ShadowPlan& shadows) {
    SurfaceRenderer renderer(scene, shadows);
    RS_TRY(renderer.make_casters());
    renderer.survey_lights();
    Uploads uploads;
    renderer.item_of_node_.resize(scene.geometry.size());
    for (std::size_t i = 0; i < scene.geometry.size(); ++i) {
        const GeometryNode& node = scene.geometry[i];
        if (node.mesh->indices.empty()) continue;
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
        item.throws_shadows = throws_shadows(node);
        item.material = row_of(node.material, scene.shading);
        RS_TRY(renderer.put(item));
        item.texture_transform = node.material.texture_transform;
        item.transparent = node.material.opacity < 1 || item.alpha == AlphaUse::kBlend;
        item.two_sided = node.mesh->two_sided;
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
    return put(item);
}

Status SurfaceRenderer::set_lights(const Scene& scene, const ShadowPlan& shadows) {
    take_lights(scene, scene_);
    shadows_ = shadows;
    if (Status status = make_casters(); !status) return status;
    survey_lights();
    for (Item& item : items_) {
        if (Status status = put(item); !status) return status;
    }
    return {};
}

bool SurfaceRenderer::stands(std::size_t node, const std::optional<glm::dmat4>& world_from_node) const {
    if (!item_of_node_[node]) return true;
    const Item& item = items_[*item_of_node_[node]];
    return world_from_node ? !item.hidden && *world_from_node == item.world_from_node : item.hidden;
}

bool SurfaceRenderer::has_transparent() const {
    return std::ranges::any_of(items_, [](const Item& item) { return item.transparent; });
}

BoundingBox SurfaceRenderer::caster_bounds(std::size_t node) const {
    if (!item_of_node_[node]) return {};
    const Item& item = items_[*item_of_node_[node]];
    return item.hidden || !item.throws_shadows ? BoundingBox{} : item.bounds;
}

void SurfaceRenderer::set_frame(const FrameView& view) const {
    const auto& fog = scene_.fog;
    for (const auto& [kind, program] : programs_) {
        if (program->uses("eye")) program->set("eye", glm::vec3(view.camera.centre()));
        if (program->uses("headlight")) program->set("headlight", glm::vec3(view.camera.forward()));
        if (program->uses("cover_light")) program->set("cover_light", ambient_light_);
        if (!fog) continue;
        if (program->uses("fog")) program->set("fog", fog->colour);
        if (program->uses("fog_visibility")) program->set("fog_visibility", static_cast<float>(fog->visibility));
    }
}

void SurfaceRenderer::draw(const Item& item, const gl::Program& program, const FrameView& view,
                           gl::DrawState state) const {
    const auto set = [&](const char* name, const auto& value) {
        if (program.uses(name)) program.set(name, value);
    };
    program.set("clip_from_node", glm::mat4(view.clip_from_world * item.world_from_node));
    set("world_from_node", glm::mat4(item.world_from_node));
    set("world_normal_from_node", glm::mat3(glm::transpose(glm::inverse(glm::dmat3(item.world_from_node)))));
    set("texture_transform", item.texture_transform);
    // Rows of vec4 without gaps: surface_tables.cpp asserts their sizes.
    set("material", std::span(&item.material.diffuse_opacity, 4));
    if (!item.lights.empty()) set("lights", std::span(&item.lights.front().colour, 5 * item.lights.size()));
    if (!item.shadows.empty()) set("shadows", std::span(&item.shadows.front().u, 4 * item.shadows.size()));
    set("light_counts", item.light_counts);
    set("shadow_counts", item.shadow_counts);
    if (item.image) item.image->bind(0);
    if (item.relief) item.relief->bind(4);
    state.clockwise = item.mirrored;
    gl::draw(program, *item.mesh, state);
}

SurfaceRenderer::InView SurfaceRenderer::in_view(const FrameView& view) {
    InView seen;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        if (item.hidden || !may_be_seen(item.bounds, view.clip_from_world)) continue;
        if (item.transparent) {
            seen.transparent.push_back({i, glm::distance(item.bounds.middle(), view.camera.centre())});
        } else {
            seen.opaque.push_back(i);
        }
    }
    nodes_in_view_ = static_cast<int>(seen.transparent.size() + seen.opaque.size());
    // What hides first, so that what is hidden is not lit: by the farthest corner, for the floor and walls of a room
    // are also near, but behind all that stands in it.
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
                                                                       OpaquePass pass) {
    set_frame(view);
    InView seen = in_view(view);
    if (pass == OpaquePass::kNone) seen.opaque.clear();
    for (const std::size_t i : seen.opaque) {
        const Item& item = items_[i];
        draw(item, pass == OpaquePass::kDepthOnly ? *item.veil : *item.program, view,
             {.culling = item.two_sided || wire_frame ? gl::Culling::kNone : gl::Culling::kBack,
              .wire_frame = wire_frame});
    }
    return std::move(seen.transparent);
}

void SurfaceRenderer::draw_fog(const FrameView& view) const {
    if (!scene_.fog) return;
    for (const Item& item : items_) {
        if (item.hidden || item.transparent || !may_be_seen(item.bounds, view.clip_from_world)) continue;
        draw(item, *item.veil, view,
             {.depth_write = false,
              .blending = gl::Blending::kOverPremultiplied,
              .culling = item.two_sided ? gl::Culling::kNone : gl::Culling::kBack});
    }
}

void SurfaceRenderer::draw_casters(const ShadowPass& pass) const {
    const ShadowFace& face = pass.face;
    for (const Item& item : items_) {
        if (!item.throws_shadows || item.hidden || !may_be_seen(item.bounds, pass.area_from_world, face.perspective))
            continue;
        const bool moving = scene_.geometry[item.node].moving.has_value();
        if (pass.casters == (moving ? Casters::kStill : Casters::kMoving)) continue;
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
    // The inner sides lie behind the outer ones.
    if (item.two_sided) {
        state.culling = gl::Culling::kFront;
        draw(item, *item.program, view, state);
    }
    state.culling = gl::Culling::kBack;
    draw(item, *item.program, view, state);
}

}  // namespace rs::compositor
