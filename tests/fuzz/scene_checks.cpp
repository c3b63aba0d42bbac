#include "tests/fuzz/scene_checks.hpp"

#include "rayspace/api/types/check.hpp"

#include <cmath>

namespace rs::fuzz {
namespace {

bool is_finite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(m[column][row])) return false;
        }
    }
    return true;
}

}  // namespace

void check_scene(const compositor::Scene& scene) {
    for (const compositor::GeometryNode& node : scene.geometry) {
        RS_CHECK(node.mesh != nullptr && is_finite(node.world_from_node));
        for (const std::uint32_t index : node.mesh->indices) RS_CHECK(index < node.mesh->vertices.size());
        for (const std::uint32_t light : node.lights) RS_CHECK(light < scene.lights.size());
    }
    for (const compositor::RaySpaceNode& object : scene.objects) {
        RS_CHECK(compositor::world_from_node(object.chain).scale > 0);
    }
    for (const compositor::Viewpoint& viewpoint : scene.viewpoints) {
        RS_CHECK(is_finite(viewpoint.world_from_camera) && viewpoint.field_of_view_rad > 0);
    }
    for (const std::string& warning : scene.warnings) RS_CHECK(warning.find('\n') == std::string::npos);
}

}  // namespace rs::fuzz
