// Shapes whose triangulation would take minutes are omitted at once, with a warning.

#include "compositor/scene/reader/vrml_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

namespace rs::compositor {
namespace {

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

std::string faces(const std::string& points, const std::string& indices, const std::string& more = "") {
    return "Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + points + " ] } coordIndex [ " + indices +
           " ] " + more + " } }";
}

TEST(VrmlWork, WhatTakesTooLongIsLeftOut) {
    // Faces that all meet at one point; faces with thousands of corners; coincident points; a large grid.
    const std::vector<std::string> shapes = {
        faces("0 0 0, 1 0 0, 0 1 0", repeated("0 1 2 -1 ", 40000), "creaseAngle 1"),
        faces("0 0 0, 1 0 0, 0 1 0", repeated(repeated("0 1 2 ", 1300) + "-1 ", 200), "convex FALSE"),
        "Shape { geometry Extrusion { crossSection [ " + repeated("0 0 ", 250) + "] spine [ " +
            repeated("0 0 0 ", 400) + "] } }",
        "Shape { geometry Extrusion { scale 0 0 crossSection [ " + repeated("0 1 1 0 ", 125) + "] spine [ " +
            repeated("0 0 0 0 1 0 ", 200) + "] } }",
        "Shape { geometry ElevationGrid { xDimension 1000 zDimension 1000 height [ " + repeated("0 1 ", 500000) +
            "] } }"};
    for (const std::string& shape : shapes) {
        const Result<Scene> scene =
            scene_from_vrml("#VRML V2.0 utf8\n" + shape + "\nShape { geometry Box { } }", "hall.wrl");
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->geometry.size(), 1U) << "the box is shown";
        EXPECT_THAT(scene->warnings,
                    ::testing::ElementsAre(::testing::AllOf(::testing::HasSubstr("line 2: "),
                                                            ::testing::HasSubstr("would take too long"))));
    }
}

TEST(VrmlWork, WhatIsOnlyLargeIsShown) {
    std::string points;
    std::string indices;
    constexpr int kSide = 120;
    for (int i = 0; i < kSide * kSide; ++i) {
        points += std::to_string(i % kSide) + " " + std::to_string(i / kSide) + " 0 ";
        if (i % kSide == kSide - 1 || i / kSide == kSide - 1) continue;
        for (const int corner : {0, 1, kSide + 1, kSide}) indices += std::to_string(i + corner) + " ";
        indices += "-1 ";
    }
    const Result<Scene> scene =
        scene_from_vrml("#VRML V2.0 utf8\n" + faces(points, indices, "creaseAngle 3"), "hall.wrl");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, ::testing::IsEmpty());
    EXPECT_EQ(scene->geometry.at(0).mesh->indices.size(), std::size_t{(kSide - 1) * (kSide - 1) * 6});
    EXPECT_EQ(scene->geometry[0].mesh->vertices.size(), std::size_t{kSide * kSide}) << "corners are shared";
}

}  // namespace
}  // namespace rs::compositor
