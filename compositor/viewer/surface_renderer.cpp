#include "compositor/viewer/surface_renderer.hpp"

#include "compositor/viewer/geometry_shaders.hpp"
#include "compositor/viewer/surface_tables.hpp"

#include <map>
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

// A table is never empty, as buffers cannot be.
template <class Row>
gl::Buffer table(std::vector<Row> rows) {
    if (rows.empty()) rows.emplace_back();
    return gl::Buffer(std::as_bytes(std::span(rows)));
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

    AlphaUse alpha(const SceneTexture& texture) {
        const auto [found, is_new] = alphas_.try_emplace(&texture, AlphaUse::kNone);
        if (is_new) found->second = alpha_use(texture);
        return found->second;
    }

private:
    std::map<const Mesh*, std::shared_ptr<const gl::VertexArray>> meshes_;
    std::map<const SceneTexture*, std::shared_ptr<const gl::Texture>> pictures_;
    std::map<const SceneTexture*, AlphaUse> alphas_;
};

}  // namespace

Result<SurfaceRenderer> SurfaceRenderer::create(const Scene& scene) {
    auto program = gl::Program::create("surface", shaders::kSurfaceVertex, shaders::kSurfaceFragment);
    if (!program) return program.error();
    SurfaceRenderer renderer(std::move(*program));
    renderer.fog_ = scene.fog;
    renderer.headlight_ = scene.navigation.headlight;
    std::vector<LightRow> lights;
    for (const Light& light : scene.lights) lights.push_back(row_of(light));
    std::vector<std::uint32_t> light_lists;
    std::vector<MaterialRow> materials;
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
        item.material = static_cast<int>(materials.size());
        materials.push_back(row_of(node.material));
        item.material_flags = flags_of(node.material, node.mesh->has_colours, alpha);
        item.texture_transform = node.material.texture_transform;
        const std::vector<std::uint32_t> near = lights_that_reach(scene, node, item.bounds);
        item.light_range = {static_cast<int>(light_lists.size()), static_cast<int>(near.size())};
        light_lists.insert(light_lists.end(), near.begin(), near.end());
        item.transparent = node.material.opacity < 1 || alpha == AlphaUse::kBlend;
        item.two_sided = node.mesh->two_sided;
        item.mirrored = glm::determinant(glm::dmat3(node.world_from_node)) < 0;
        renderer.items_.push_back(std::move(item));
    }
    renderer.lights_.emplace(table(std::move(lights)));
    renderer.light_lists_.emplace(table(std::move(light_lists)));
    renderer.materials_.emplace(table(std::move(materials)));
    return renderer;
}

void SurfaceRenderer::set_frame(const FrameView& view) const {
    lights_->bind_table(0);
    light_lists_->bind_table(1);
    materials_->bind_table(2);
    program_.set("eye", glm::vec3(view.camera.centre()));
    program_.set("headlight", headlight_ ? glm::vec3(view.camera.forward()) : glm::vec3(0));
    const float fog_kind = !fog_ ? 0.0F : fog_->kind == FogKind::kLinear ? 1.0F : 2.0F;
    program_.set("fog", glm::vec4(fog_ ? fog_->colour : glm::vec3(0), fog_kind));
    program_.set("fog_visibility", fog_ ? static_cast<float>(fog_->visibility) : 1.0F);
}

void SurfaceRenderer::draw(const Item& item, const FrameView& view, gl::DrawState state) const {
    program_.set("clip_from_node", glm::mat4(view.clip_from_world * item.world_from_node));
    program_.set("world_from_node", glm::mat4(item.world_from_node));
    program_.set("world_normal_from_node", glm::mat3(glm::transpose(glm::inverse(glm::dmat3(item.world_from_node)))));
    program_.set("material_index", item.material);
    program_.set("material_flags", item.material_flags);
    program_.set("texture_transform", item.texture_transform);
    program_.set("light_range", item.light_range);
    if (item.picture) item.picture->bind(0);
    state.clockwise = item.mirrored;
    gl::draw(program_, *item.mesh, state);
}

std::vector<SurfaceRenderer::Transparent> SurfaceRenderer::draw_opaque(const FrameView& view, bool wire_frame) {
    set_frame(view);
    nodes_in_view_ = 0;
    std::vector<Transparent> transparent;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        if (!may_be_seen(item.bounds, view)) continue;
        ++nodes_in_view_;
        if (item.transparent) {
            transparent.push_back({i, glm::distance(item.bounds.middle(), view.camera.centre())});
            continue;
        }
        const gl::Culling culling = item.two_sided || wire_frame ? gl::Culling::kNone : gl::Culling::kBack;
        draw(item, view, {.culling = culling, .wire_frame = wire_frame});
    }
    return transparent;
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
