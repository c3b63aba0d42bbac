// The objects' recipes are valid, and their cameras show the whole object.

#include "capture/tracer/scene/scene.hpp"
#include "capture/tracer/scene/scene_file.hpp"
#include "datasets-synthetic/objects.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace rs::synthetic {
namespace {

std::filesystem::path recipe_folder() {
    return std::filesystem::path(RAYSPACE_SOURCE_DIR) / "datasets-synthetic" / "recipes";
}

class EveryRecipe : public testing::TestWithParam<std::string> {};

TEST_P(EveryRecipe, IsReadableAndRenderable) {
    const auto file = capture::load_scene_file(recipe_folder() / (GetParam() + ".json"), generate);
    ASSERT_TRUE(file.ok()) << file.error().message;
    const Status check = capture::check_scene(file->scene);
    EXPECT_TRUE(check.ok()) << check.error().message;
    EXPECT_FALSE(file->scene.environment.pixels.empty()) << "no light from anywhere";
    EXPECT_EQ(file->camera.elevation_deg, 0.0);
    EXPECT_EQ(file->toon.has_value(), GetParam().ends_with("-toon"));
}

TEST_P(EveryRecipe, ShowsAllOfTheObject) {
    const auto file = capture::load_scene_file(recipe_folder() / (GetParam() + ".json"), generate);
    ASSERT_TRUE(file.ok()) << file.error().message;
    const capture::CameraRecipe& recipe = file->camera;
    const double fov_x_rad = 2.0 * std::atan(0.5 / recipe.focal_widths);
    for (int view = 0; view < 8; ++view) {
        const double angle_rad = radians(45.0 * view);
        const glm::dvec3 eye{recipe.distance_radii * std::sin(angle_rad), 0.0,
                             recipe.distance_radii * std::cos(angle_rad)};
        const Camera camera =
            look_at_camera(eye, {0, recipe.look_at_height, 0}, fov_x_rad, recipe.width, recipe.height);
        double nearest_edge_px = 1e9;
        for (const capture::Mesh& mesh : file->scene.meshes) {
            for (const glm::vec3& p : mesh.positions) {
                const glm::dvec3 q = camera.project(glm::dvec3(p));
                nearest_edge_px = std::min({nearest_edge_px, q.x, q.y, recipe.width - q.x, recipe.height - q.y});
            }
        }
        EXPECT_GT(nearest_edge_px, 2.0) << "view " << view;
        EXPECT_LT(nearest_edge_px, 0.25 * recipe.height) << "the object is lost in the image";
    }
}

// Recipes of the objects and of their toon versions.
std::vector<std::string> recipe_names() {
    std::vector<std::string> names = object_names();
    names.insert(names.end(), {"blocks-toon", "doll-toon", "vase-toon"});
    return names;
}

INSTANTIATE_TEST_SUITE_P(Recipes, EveryRecipe, testing::ValuesIn(recipe_names()), [](const auto& object) {
    std::string name = object.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

TEST(Recipes, EachBelongsToAnObject) {
    int recipes = 0;
    const std::vector<std::string> names = recipe_names();
    for (const auto& entry : std::filesystem::directory_iterator(recipe_folder())) {
        const std::string name = entry.path().stem().string();
        EXPECT_NE(std::ranges::find(names, name), names.end()) << entry.path();
        ++recipes;
    }
    EXPECT_EQ(recipes, static_cast<int>(names.size()));
}

}  // namespace
}  // namespace rs::synthetic
