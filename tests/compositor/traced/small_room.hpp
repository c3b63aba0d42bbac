#pragma once
// Room with a few boxes, for tests of the tracer.

#include "compositor/traced/traced_renderer.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <memory>

namespace rs::compositor {

inline GeometryNode box_node(const glm::dvec3& size, const glm::dvec3& at, const glm::vec3& diffuse) {
    GeometryNode node;
    node.mesh = std::make_shared<const Mesh>(box_mesh(size));
    node.material.diffuse = diffuse;
    node.world_from_node[3] = glm::dvec4(at, 1);
    return node;
}

// White floor, red block on it, lamp above.
inline Scene small_room() {
    Scene scene;
    scene.lights = {point_light({1, 3, 1}, glm::vec3(9))};
    scene.geometry = {box_node({20, 0.2, 20}, {0, -0.1, 0}, glm::vec3(0.6F)),
                      box_node({1, 1, 1}, {0, 0.5, 0}, {0.7F, 0.1F, 0.1F})};
    return scene;
}

inline Camera looking_from(const glm::dvec3& eye, const glm::dvec3& at, int side) {
    const glm::dvec3 back = glm::normalize(eye - at);
    const glm::dvec3 right =
        glm::normalize(glm::cross(std::abs(back.y) > 0.99 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0), back));
    Camera camera;
    camera.width = camera.height = side;
    camera.fl_x = camera.fl_y = side;
    camera.cx = camera.cy = side / 2.0;
    camera.world_from_camera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0),
                                          glm::dvec4(back, 0), glm::dvec4(eye, 1));
    return camera;
}

inline Result<TracedRenderer> renderer_of(const Scene& scene, double exposure_ev = 0) {
    return TracedRenderer::create(scene, {}, {.exposure_ev = exposure_ev});
}

}  // namespace rs::compositor
