#include "rayspace/models/obj_text.hpp"

#include <gtest/gtest.h>

namespace rs {
namespace {

TEST(ObjText, BadIndicesAreFoundByLine) {
    const std::string points = "v 0 0 0\nv 1 0 0\r\nv 0 1 0\nvt 0 0\n";
    EXPECT_EQ(find_bad_obj_index(points + "f 1/1 2/1 3/1\nf -1 -2 -3\n"), "");
    EXPECT_EQ(find_bad_obj_index(points + "\nf 1 2 4"), "line 6: names vertex 4 of 3");
    EXPECT_EQ(find_bad_obj_index(points + "f 1/1 2/2 3/1"), "line 5: names texture coordinate 2 of 1");
    EXPECT_EQ(find_bad_obj_index(points + "f 1//1 2 3"), "line 5: names normal 1 of 0");
    EXPECT_EQ(find_bad_obj_index("v 0 0 0\nf -1 -2 -3\nv 0 0 0\nv 0 0 0\n"), "line 2: names vertex -2 of 1");
    EXPECT_EQ(find_bad_obj_index(points + "f 0 1 2"), "line 5: names vertex 0 of 3");
    EXPECT_EQ(find_bad_obj_index(""), "");
}

TEST(ObjText, NamesAreThoseOfLibrariesAndMaterials) {
    const ObjNames names =
        names_in_obj("mtllib my hall.mtl\r\nusemtl b\n usemtl a c \nusemtl b\nusemtl (null)\nusemtl");
    EXPECT_EQ(names.libraries, std::set<std::string>{"my hall.mtl"});
    EXPECT_EQ(names.materials, (std::set<std::string>{"a c", "b"}));
    EXPECT_FALSE(names.has_free_forms);
    EXPECT_TRUE(names_in_obj("curv2 1 2\n").has_free_forms);
}

}  // namespace
}  // namespace rs
