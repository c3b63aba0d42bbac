#include "compositor/viewer/drawing/surface_renderer.hpp"

#include "compositor/scene/normal_map.hpp"
#include "compositor/viewer/drawing/geometry_shaders.hpp"
#include "compositor/viewer/drawing/shaders.hpp"
#include "compositor/viewer/shadows/shadow_shaders.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace rs::compositor {

SurfaceKind kind_of(const Scene& scene, const ShadowPlan& shadows, const GeometryNode& node, AlphaUse alpha,
                    const std::vector<std::uint32_t>& lights) {
    SurfaceKind kind;
    kind.lit = node.material.lit;
    if (kind.lit) {
        for (const std::uint32_t i : lights) {
            const LightKind light = scene.lights[i].kind;
            ++(light == LightKind::kDirectional ? kind.directional
               : light == LightKind::kPoint     ? kind.points
                                                : kind.spots);
            switch (shadows.shape_of(i)) {
                case ShadowShape::kNone:
                    break;
                case ShadowShape::kParallel:
                    ++kind.shadowed_directional;
                    break;
                case ShadowShape::kCone:
                    ++kind.narrow_spots;
                    break;
                case ShadowShape::kCube:
                    ++(light == LightKind::kPoint ? kind.shadowed_points : kind.wide_spots);
                    break;
            }
            kind.fading |= light != LightKind::kDirectional && scene.lights[i].attenuation != glm::vec3(1, 0, 0);
        }
        kind.headlight = scene.navigation.headlight;
        kind.shiny = node.material.specular != glm::vec3(0);
    }
    kind.picture = !node.material.texture ? 0 : node.material.texture->modulates ? 2 : 1;
    kind.picture_alpha = alpha;
    kind.colours = node.mesh->has_colours;
    kind.relief = kind.lit && node.material.normals != nullptr;
    if (scene.fog) kind.fog = scene.fog->kind == FogKind::kLinear ? 1 : 2;
    return kind;
}

std::string constants_of(const SurfaceKind& kind) {
    return "#version 450 core\n" + shaders::shader_constant("kDirectional", kind.directional) +
           shaders::shader_constant("kPoints", kind.points) + shaders::shader_constant("kSpots", kind.spots) +
           shaders::shader_constant("kShadowedDirectional", kind.shadowed_directional) +
           shaders::shader_constant("kShadowedPoints", kind.shadowed_points) +
           shaders::shader_constant("kNarrowSpots", kind.narrow_spots) +
           shaders::shader_constant("kWideSpots", kind.wide_spots) +
           shaders::shader_constant(
               "kShadows", kind.shadowed_directional + kind.shadowed_points + kind.narrow_spots + kind.wide_spots) +
           "const float kNear = " + std::to_string(kNear) + ";\n" + shaders::shader_constant("kFading", kind.fading) +
           shaders::shader_constant("kHeadlight", kind.headlight) + shaders::shader_constant("kLit", kind.lit) +
           shaders::shader_constant("kShiny", kind.shiny) + shaders::shader_constant("kPicture", kind.picture) +
           shaders::shader_constant("kPictureAlpha", static_cast<int>(kind.picture_alpha)) +
           shaders::shader_constant("kColours", kind.colours) + shaders::shader_constant("kRelief", kind.relief) +
           shaders::shader_constant("kFog", kind.fog);
}

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

    std::shared_ptr<const gl::Texture> picture(const SceneTexture& texture) {
        auto& uploaded = pictures_[&texture];
        if (!uploaded) {
            uploaded = std::make_shared<const gl::Texture>(texture.picture.view(),
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

    Result<std::shared_ptr<const gl::Program>> program(const SurfaceKind& kind) {
        auto& made = programs_[kind];
        if (!made) {
            auto program = gl::Program::create("surface", shaders::kSurfaceVertex,
                                               constants_of(kind) + shaders::kShadowLookUp + shaders::kSurfaceFragment);
            if (!program) return program.error();
            made = std::make_shared<const gl::Program>(std::move(*program));
        }
        return made;
    }
    [[nodiscard]] std::vector<std::shared_ptr<const gl::Program>> programs() const {
        std::vector<std::shared_ptr<const gl::Program>> all;
        for (const auto& [kind, program] : programs_) all.push_back(program);
        return all;
    }

private:
    std::map<SurfaceKind, std::shared_ptr<const gl::Program>> programs_;
    std::map<const Mesh*, std::shared_ptr<const gl::VertexArray>> meshes_;
    std::map<const SceneTexture*, std::shared_ptr<const gl::Texture>> pictures_;
    std::map<const NormalMap*, std::shared_ptr<const gl::Texture>> reliefs_;
    std::map<const SceneTexture*, AlphaUse> alphas_;
};

}  // namespace

Result<SurfaceRenderer> SurfaceRenderer::create(const Scene& scene, const ShadowPlan& shadows) {
    SurfaceRenderer renderer;
    if (!shadows.faces.empty()) {
        auto caster = gl::Program::create("shadow", shaders::kCasterVertex, shaders::kCasterFragment);
        if (!caster) return caster.error();
        auto masked = gl::Program::create("shadow with holes", shaders::kCasterVertex, shaders::kMaskedCasterFragment);
        if (!masked) return masked.error();
        renderer.caster_.emplace(std::move(*caster));
        renderer.masked_caster_.emplace(std::move(*masked));
    }
    for (const Light& light : scene.lights) renderer.everywhere_.push_back(light.everywhere ? 1 : 0);
    renderer.fog_ = scene.fog;
    renderer.headlight_ = scene.navigation.headlight;
    Uploads uploads;
    for (const GeometryNode& node : scene.geometry) {
        if (node.mesh->indices.empty()) continue;
        Item item;
        item.mesh = uploads.mesh(node.mesh);
        item.world_from_node = node.world_from_node;
        item.bounds = bounds_of(*node.mesh).moved(node.world_from_node);
        AlphaUse alpha = AlphaUse::kNone;
        if (node.material.texture) {
            item.picture = uploads.picture(*node.material.texture);
            alpha = uploads.alpha(*node.material.texture);
        }
        if (node.material.lit && node.material.normals) item.relief = uploads.relief(*node.material.normals);
        const SurfaceLights lights = lights_of(scene, node, item.bounds);
        auto program = uploads.program(kind_of(scene, shadows, node, alpha, lights.lights));
        if (!program) return program.error();
        item.program = std::move(*program);
        item.material = row_of(node.material);
        item.material.ambient_light = glm::vec4(lights.ambient, 0);
        const std::vector<std::uint32_t> ordered = in_shader_order(scene, shadows, lights.lights);
        item.lights = rows_of(scene, ordered);
        item.shadows = rows_of(shadows, ordered);
        item.own_lights = node.lights;
        item.throws_shadows = throws_shadows(node);
        item.masked = alpha == AlphaUse::kMask;
        item.texture_transform = node.material.texture_transform;
        item.transparent = node.material.opacity < 1 || alpha == AlphaUse::kBlend;
        item.two_sided = node.mesh->two_sided;
        item.mirrored = glm::determinant(glm::dmat3(node.world_from_node)) < 0;
        renderer.items_.push_back(std::move(item));
    }
    renderer.programs_ = uploads.programs();
    return renderer;
}

void SurfaceRenderer::set_frame(const FrameView& view) const {
    for (const auto& program : programs_) {
        if (program->uses("eye")) program->set("eye", glm::vec3(view.camera.centre()));
        if (program->uses("headlight")) program->set("headlight", glm::vec3(view.camera.forward()));
        if (!fog_) continue;
        if (program->uses("fog")) program->set("fog", fog_->colour);
        if (program->uses("fog_visibility")) program->set("fog_visibility", static_cast<float>(fog_->visibility));
    }
}

void SurfaceRenderer::draw(const Item& item, const FrameView& view, gl::DrawState state) const {
    const gl::Program& program = *item.program;
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
    if (item.picture) item.picture->bind(0);
    if (item.relief) item.relief->bind(4);
    state.clockwise = item.mirrored;
    gl::draw(program, *item.mesh, state);
}

std::vector<SurfaceRenderer::Transparent> SurfaceRenderer::draw_opaque(const FrameView& view, bool wire_frame) {
    set_frame(view);
    nodes_in_view_ = 0;
    std::vector<Transparent> transparent;
    std::vector<std::size_t> opaque;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        if (!may_be_seen(item.bounds, view)) continue;
        ++nodes_in_view_;
        if (item.transparent) {
            transparent.push_back({i, glm::distance(item.bounds.middle(), view.camera.centre())});
        } else {
            opaque.push_back(i);
        }
    }
    const auto state_of = [&](const Item& item) {
        return gl::DrawState{.culling = item.two_sided || wire_frame ? gl::Culling::kNone : gl::Culling::kBack,
                             .wire_frame = wire_frame};
    };
    // What hides first, so that what is hidden is not lit: by the farthest corner, for the floor and walls of a room
    // are also near, but behind all that stands in it.
    const auto distance = [&](std::size_t i) {
        const BoundingBox& box = items_[i].bounds;
        const glm::dvec3& eye = view.camera.centre();
        return glm::length(glm::max(glm::abs(box.lowest - eye), glm::abs(box.highest - eye)));
    };
    std::stable_sort(opaque.begin(), opaque.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    for (const std::size_t i : opaque) draw(items_[i], view, state_of(items_[i]));
    return transparent;
}

void SurfaceRenderer::draw_casters(const ShadowFace& face) const {
    for (const Item& item : items_) {
        if (!item.throws_shadows || !may_throw(item.bounds, face)) continue;
        if (everywhere_[face.light] == 0 && std::ranges::find(item.own_lights, face.light) == item.own_lights.end()) {
            continue;
        }
        const gl::Program& program = item.masked ? *masked_caster_ : *caster_;
        program.set("clip_from_node", glm::mat4(face.clip_from_world * item.world_from_node));
        if (item.masked) {
            program.set("texture_transform", item.texture_transform);
            item.picture->bind(0);
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
        draw(item, view, state);
    }
    state.culling = gl::Culling::kBack;
    draw(item, view, state);
}

}  // namespace rs::compositor
