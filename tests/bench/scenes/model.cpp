#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

std::int64_t triangle_count(const ModelGroup& group) {
    std::int64_t count = 0;
    for (const capture::Mesh& mesh : group.meshes) count += static_cast<std::int64_t>(mesh.triangles.size());
    return count;
}

std::int64_t triangle_count(const Model& model) {
    std::int64_t count = 0;
    for (const ModelNode& node : model.nodes) count += triangle_count(model.groups[node.group]);
    return count;
}

}  // namespace rs::synthetic
