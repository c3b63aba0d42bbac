#include "capture/tracer/scene/surroundings.hpp"

#include "capture/tracer/scene/flatten.hpp"
#include "rayspace/api/types/check.hpp"

#include <iterator>
#include <utility>

namespace rs::capture {

namespace {

template <class Element>
void append(std::vector<Element>& to, std::vector<Element> from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void add_surroundings(Scene& object, Scene room, const glm::dmat4& object_from_room) {
    RS_CHECK(!object.has_surroundings());
    room = flattened(std::move(room));
    const auto materials = static_cast<int>(object.materials.size());
    const auto textures = static_cast<int>(object.textures.size());
    const auto reliefs = static_cast<int>(object.reliefs.size());
    for (Material& material : room.materials) {
        if (material.texture >= 0) material.texture += textures;
        if (material.emission_texture >= 0) material.emission_texture += textures;
        if (material.relief >= 0) material.relief += reliefs;
    }
    for (const Mesh& mesh : room.meshes) {
        object.meshes.push_back(transform_mesh(mesh, object_from_room));
        object.meshes.back().material += materials;
    }
    object.first_surrounding_material = materials;
    append(object.materials, std::move(room.materials));
    append(object.textures, std::move(room.textures));
    append(object.reliefs, std::move(room.reliefs));
}

}  // namespace rs::capture
