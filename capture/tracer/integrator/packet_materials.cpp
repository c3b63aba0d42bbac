#include "capture/tracer/integrator/packet_materials.hpp"

#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <map>

namespace rs::capture {

void PacketMaterial::fill(std::size_t lane, MaterialLanes& lanes) const {
    lanes.kind[lane] = static_cast<float>(kind);
    lanes.alpha[lane] = alpha;
    lanes.ior[lane] = ior;
    lanes.translucency[lane] = translucency;
    lanes.base[lane] = base;
    lanes.table[lane] = table;
}

static_assert(AlbedoTable::kSize == kAlbedoNumbers);

PacketMaterials::PacketMaterials(const Scene& scene, const std::vector<SurfaceModel>& models) {
    tables_.assign(AlbedoTable::kSize, 0.0F);  // for materials without a table
    std::map<const AlbedoTable*, std::int32_t> table_offsets = {{nullptr, 0}};
    materials_.reserve(scene.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& source = scene.materials[i];
        const SurfaceModel& model = models[i];
        const AlbedoTable* table = model.albedo.get();
        const auto [entry, is_new] = table_offsets.try_emplace(table, static_cast<std::int32_t>(tables_.size()));
        if (is_new) tables_.insert(tables_.end(), table->values().begin(), table->values().end());
        PacketMaterial material{};
        material.index = static_cast<int>(i);
        material.kind = model.kind;
        material.colour = source.colour;
        material.texture = source.texture < 0 ? nullptr : &scene.textures[static_cast<std::size_t>(source.texture)];
        material.alpha = model.alpha;
        material.ior = model.ior;
        material.translucency = model.translucency;
        material.base = table == nullptr ? 1.0F : std::max(1.0F - table->mean(), 1e-4F);
        material.table = entry->second;
        material.emissive = max_component(source.emission) > 0.0F;
        material.has_relief = source.relief >= 0;
        material.one_sided = source.is_one_sided();
        materials_.push_back(material);
    }
}

void PacketMaterials::set_lane(std::size_t lane, const LightTransport::Vertex& vertex, SurfaceLanes& surfaces) const {
    const glm::vec3& facet = vertex.point.geometric_normal;
    (*this)[vertex.point.material].fill(lane, surfaces.material);
    surfaces.near_start.set(lane, vertex.ray_origin(facet, true));
    surfaces.far_start.set(lane, vertex.ray_origin(-facet, false));
    surfaces.geometric_normal.set(lane, facet);
    surfaces.normal.set(lane, vertex.frame.normal);
    surfaces.tangent.set(lane, vertex.frame.tangent);
    surfaces.bitangent.set(lane, vertex.frame.bitangent);
    surfaces.colour.set(lane, vertex.surface.colour());
    surfaces.viewer.set(lane, vertex.surface.viewer());
    surfaces.albedo[lane] = vertex.surface.albedo();
    surfaces.lambda[lane] = vertex.surface.lambda();
    surfaces.light_group[lane] = vertex.point.light_group;
}

VirtualLight PacketMaterials::make_virtual_light(const LightTransport::Vertex& vertex, const glm::vec3& flux,
                                                 int depth) const {
    const PacketMaterial& material = (*this)[vertex.point.material];
    const glm::vec3& facet = vertex.point.geometric_normal;
    return {material.kind,
            material.alpha,
            material.ior,
            material.translucency,
            material.base,
            material.table,
            vertex.point.position,
            vertex.ray_origin(facet, true),
            facet,
            vertex.frame.normal,
            vertex.frame.tangent,
            vertex.frame.bitangent,
            vertex.surface.colour(),
            vertex.surface.viewer(),
            vertex.step_off,
            flux,
            depth};
}

}  // namespace rs::capture
