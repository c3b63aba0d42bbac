#include "tests/compositor/occlusion_scene.hpp"

#include "capture/tracer/scene/scene_transform.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/compositor/truth_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <random>
#include <utility>

namespace rs::test {
namespace {

void add_block(capture::Scene& scene, const glm::vec3& size, const glm::vec3& centre, const glm::vec3& colour) {
    const compositor::Mesh box = compositor::box_mesh(glm::dvec3(size));
    capture::Mesh mesh;
    for (const compositor::MeshVertex& vertex : box.vertices) {
        mesh.positions.push_back(centre + vertex.position);
        mesh.normals.push_back(vertex.normal);
        mesh.uvs.push_back(vertex.texture);
    }
    for (std::size_t i = 0; i < box.indices.size(); i += 3) {
        mesh.triangles.emplace_back(box.indices[i], box.indices[i + 1], box.indices[i + 2]);
    }
    mesh.material = static_cast<int>(scene.materials.size());
    capture::Material material;
    material.colour = colour;
    material.texture = 0;
    scene.materials.push_back(material);
    scene.meshes.push_back(std::move(mesh));
}

// Spots, as texture for depth estimation.
capture::Texture spots() {
    constexpr int kSide = 16;
    std::mt19937_64 random(5);
    capture::Texture texture{"spots", Image<RgbaF>(kSide, kSide)};
    for (RgbaF& pixel : texture.pixels.pixels()) {
        const float v = 0.35F + 0.65F * static_cast<float>(random() >> 40) / static_cast<float>(1 << 24);
        pixel = {v, v, v, 1};
    }
    return texture;
}

Signpost make_signpost() {
    const TemporaryFolder folder;
    const TruthCapture capture{.elevations_deg = {10}, .views = 40, .side_px = 144, .samples = 6};
    const Status written = write_captured_object("signpost", signpost(), capture, folder.path());
    RS_CHECK(written.ok());
    Result<RaySpaceObject> object = read_object(folder / "signpost.rso");
    RS_CHECK(object.ok());
    Result<compositor::ViewableObject> viewable = compositor::make_viewable(std::move(*object));
    RS_CHECK(viewable.ok());
    auto traced = traced_object(signpost());
    RS_CHECK(traced.ok());
    return {std::make_shared<const compositor::ViewableObject>(std::move(*viewable)), std::move(*traced)};
}

}  // namespace

capture::SceneFile signpost() {
    capture::SceneFile object;
    object.scene.name = "signpost";
    object.scene.textures.push_back(spots());
    add_block(object.scene, {1.3F, 0.25F, 0.9F}, {0, 0.125F, 0}, {0.35F, 0.36F, 0.38F});
    add_block(object.scene, {0.3F, 1.1F, 0.3F}, {-0.35F, 0.8F, -0.1F}, {0.75F, 0.12F, 0.1F});
    add_block(object.scene, {0.95F, 0.25F, 0.2F}, {0.1F, 1.475F, -0.1F}, {0.1F, 0.2F, 0.75F});
    add_block(object.scene, {0.35F, 0.35F, 0.35F}, {0.35F, 0.425F, 0.2F}, {0.85F, 0.7F, 0.1F});
    object.scene.environment.pixels = Image<RgbaF>(8, 4, RgbaF{0.55F, 0.56F, 0.58F, 1});
    object.scene.lights.push_back(directional_light(glm::normalize(glm::vec3(-0.5F, -0.8F, -0.7F)), glm::vec3(1.2F)));
    const Result<double> radius = capture::normalise_meshes(object.scene);
    RS_CHECK(radius.ok());
    object.object_radius = *radius;
    object.ground_height = capture::ground_height(object.scene);
    return object;
}

const Signpost& captured_signpost() {
    static const Signpost signpost = make_signpost();
    return signpost;
}

compositor::Scene empty_room() {
    compositor::Scene scene;
    scene.background.sky = {{0.6F, 0.65F, 0.7F}};
    return scene;
}

void add_box(compositor::Scene& scene, const glm::dvec3& size, const glm::dvec3& centre, const glm::vec3& colour,
             double turn_rad) {
    compositor::GeometryNode box;
    box.mesh = std::make_shared<const compositor::Mesh>(compositor::box_mesh(size));
    box.material.diffuse = colour;
    box.material.ambient = 1;
    box.world_from_node = glm::rotate(glm::translate(glm::dmat4(1.0), centre), turn_rad, glm::dvec3(0, 1, 0));
    scene.geometry.push_back(std::move(box));
}

}  // namespace rs::test
