// Placement of mirrored objects in scene files: as geometry below the same transforms.

#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/viewer/views/object_view.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace rs::compositor {
namespace {

Scene read_text(const test::TemporaryFolder& folder, const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    Result<Scene> scene = read_scene(folder / name);
    RS_CHECK(scene.ok());
    return std::move(*scene);
}

void expect_like_geometry(const Scene& scene, bool mirrors) {
    ASSERT_EQ(scene.geometry.size(), 1U);
    ASSERT_EQ(scene.objects.size(), 1U);
    const Similarity place = world_from_node(scene.objects[0].chain);
    EXPECT_EQ(place.mirrors(), mirrors);
    for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0.3, -0.2, 0.9}}) {
        EXPECT_LT(glm::distance(place.point(p), glm::dvec3(scene.geometry[0].world_from_node * glm::dvec4(p, 1))),
                  1e-5);
    }
}

TEST(MirroredNodes, OfVrmlStandLikeGeometry) {
    const test::TemporaryFolder folder;
    for (const auto& [signs, mirrors] : {std::pair{"-2 2 2", true},
                                         {"2 -2 2", true},
                                         {"2 2 -2", true},
                                         {"-2 -2 2", false},
                                         {"2 -2 -2", false},
                                         {"-2 -2 -2", true}}) {
        for (const char* turned : {"", "scaleOrientation 1 2 -1 0.7"}) {
            const Scene scene = read_text(folder, "mirrored.wrl",
                                          std::string("#VRML V2.0 utf8\nTransform { translation 1 2 3 center 0 0.5 0 "
                                                      "rotation 0 1 0.2 0.8 scale ") +
                                              signs + " " + turned +
                                              " children [ Shape { geometry Box { } } RaySpace { url \"a.rso\" } ] }");
            EXPECT_THAT(scene.warnings, ::testing::IsEmpty());
            expect_like_geometry(scene, mirrors);
        }
    }
}

TEST(MirroredNodes, AnUnevenScaleIsSaidWhateverItsSigns) {
    const test::TemporaryFolder folder;
    const Scene scene = read_text(folder, "uneven.wrl",
                                  "#VRML V2.0 utf8\nTransform { scale -2 -2 -1 children RaySpace { url \"a.rso\" } }");
    EXPECT_THAT(scene.warnings, ::testing::ElementsAre(::testing::HasSubstr("is stretched more along one axis")));
}

TEST(MirroredNodes, OfGltfAreMirrored) {
    const test::TemporaryFolder folder;
    const Scene scene = read_text(folder, "mirrored.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"translation": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8], "scale": [2, -2, 2],
                   "extras": {"RaySpace": {"url": "a.rso"}}}]})");
    ASSERT_EQ(scene.objects.size(), 1U);
    const Similarity place = world_from_node(scene.objects[0].chain);
    EXPECT_TRUE(place.mirrors());
    // About half a turn about Y is 2 atan2(0.6, 0.8): cosine 0.28, sine 0.96.
    EXPECT_LT(glm::distance(place.point({1, 1, 0}), glm::dvec3(1 + 2 * 0.28, 2 - 2, 3 - 2 * 0.96)), 1e-6);
}

TEST(ObjectView, TakesSeveralSamplesWhereCapturedPixelsAreSmaller) {
    const auto object = test::drum();
    const auto samples_at = [&](double distance, int most) {
        const Camera camera = look_at_camera({0, 0, distance}, {0, 0, 0}, radians(50), 400, 400);
        const auto view = view_of_object(test::placed_at(object), camera, {.max_samples_across = most});
        RS_CHECK(view.has_value());
        EXPECT_EQ(view->camera.width, view->rectangle.width * view->samples_across);
        EXPECT_EQ(view->camera.height, view->rectangle.height * view->samples_across);
        return view->samples_across;
    };
    // Captured at 60 / 3.5 pixels per radius, displayed at 429 / distance.
    EXPECT_EQ(samples_at(5, 4), 1);
    EXPECT_EQ(samples_at(30, 4), 1);
    EXPECT_EQ(samples_at(50, 4), 2);
    EXPECT_EQ(samples_at(75, 4), 3);
    EXPECT_EQ(samples_at(190, 4), 4);
    EXPECT_EQ(samples_at(190, 2), 2);
    EXPECT_EQ(samples_at(190, 1), 1);
}

}  // namespace
}  // namespace rs::compositor
