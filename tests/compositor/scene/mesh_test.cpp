#include "compositor/scene/mesh.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace rs::compositor {
namespace {

TEST(MeshNormals, OnlyTrianglesWhoseNormalsContradictTheWindingAreChanged) {
    Mesh mesh = box_mesh({1, 2, 3});
    EXPECT_FALSE(has_contradicting_normals(mesh));
    std::swap(mesh.indices[1], mesh.indices[2]);  // one triangle of the first side, which shares two vertices
    ASSERT_TRUE(has_contradicting_normals(mesh));
    const Mesh turned = with_normals_in_front(mesh);
    EXPECT_FALSE(has_contradicting_normals(turned));
    EXPECT_EQ(turned.vertices.size(), mesh.vertices.size() + 3);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const MeshVertex& before = mesh.vertices[mesh.indices[i]];
        const MeshVertex& after = turned.vertices[turned.indices[i]];
        EXPECT_EQ(after.position, before.position);
        EXPECT_EQ(after.normal, i < 3 ? -before.normal : before.normal) << i;
    }
}

}  // namespace
}  // namespace rs::compositor
