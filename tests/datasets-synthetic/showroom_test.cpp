// Geometry of the showroom: size as documented, no degenerate or reversed faces, closed solids, no coplanar overlap,
// supported objects, and a camera path without collisions.

#include "datasets-synthetic/showroom/showroom.hpp"
#include "capture/tracer/scene/scene_file.hpp"
#include "datasets-synthetic/objects.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/showroom/room_builder.hpp"
#include "tests/datasets-synthetic/world_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

const World& showroom() {
    static const World kWorld = make_showroom({.texture_scale = 0.05F});
    return kWorld;
}

const Room& room_named(const std::string& name) {
    const auto& rooms = showroom().rooms;
    const auto found = std::find_if(rooms.begin(), rooms.end(), [&](const Room& room) { return room.name == name; });
    EXPECT_NE(found, rooms.end()) << name;
    return *found;
}

TEST(Showroom, IsAsLargeAsAnnounced) {
    const std::size_t triangles = triangles_of(showroom()).size();
    EXPECT_GE(triangles, 9000U);
    EXPECT_LE(triangles, 13000U);
    EXPECT_GE(showroom().objects.size(), 9U);
    std::set<std::string> names;
    for (const WorldObject& object : showroom().objects) names.insert(object.name);
    std::set<std::string> all;
    for (const ObjectShape& shape : object_shapes()) all.insert(shape.name);
    EXPECT_EQ(names, all) << "each of the objects for the showroom is in it";
}

TEST(Showroom, EveryFaceHasAnAreaAndItsNormals) {
    for (const WorldPart& part : showroom().parts) {
        ASSERT_EQ(part.mesh.normals.size(), part.mesh.positions.size()) << part.look;
        const bool textured = !showroom().looks.at(part.look).texture.empty();
        if (textured) {
            ASSERT_EQ(part.mesh.uvs.size(), part.mesh.positions.size()) << part.look;
        }
        for (const glm::uvec3& t : part.mesh.triangles) {
            const dvec3 a(part.mesh.positions.at(t.x));
            const dvec3 across =
                glm::cross(dvec3(part.mesh.positions.at(t.y)) - a, dvec3(part.mesh.positions.at(t.z)) - a);
            ASSERT_GT(glm::length(across) / 2, 2e-7) << part.look << " has a face without an area";
            for (int k = 0; k < 3; ++k) {
                const dvec3 normal(part.mesh.normals[t[k]]);
                EXPECT_NEAR(glm::length(normal), 1, 1e-4) << part.look;
                EXPECT_GT(glm::dot(normal, glm::normalize(across)), 0.2)
                    << part.look << ": the normal is on the other side";
            }
        }
    }
}

// Edges are identified by their ends, rounded to 0.2 mm.
using Corner = std::tuple<long, long, long>;
Corner corner(const dvec3& p) {
    return {std::lround(p.x * 5000), std::lround(p.y * 5000), std::lround(p.z * 5000)};
}

TEST(Showroom, SolidsAreClosedAndTurnTheirFrontsOutwards) {
    std::map<int, std::vector<WorldTriangle>> solids;
    for (const WorldTriangle& triangle : triangles_of(showroom())) {
        if (triangle.part->solid >= 0) solids[triangle.part->solid].push_back(triangle);
    }
    ASSERT_GT(solids.size(), 100U);
    for (const auto& [number, triangles] : solids) {
        std::map<std::pair<Corner, Corner>, int> edges;
        double volume = 0;
        const dvec3 origin = triangles.front().corners[0];
        for (const WorldTriangle& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) ++edges[{corner(t.corners[k]), corner(t.corners[(k + 1) % 3])}];
            volume += glm::dot(t.corners[0] - origin, glm::cross(t.corners[1] - origin, t.corners[2] - origin)) / 6;
        }
        EXPECT_GT(volume, 0) << triangles.front().part->look << ", solid " << number << ", is inside out";
        for (const auto& [edge, count] : edges) {
            const auto back = edges.find({edge.second, edge.first});
            ASSERT_TRUE(back != edges.end() && back->second == count)
                << triangles.front().part->look << ", solid " << number << ", has a hole";
        }
    }
}

TEST(Showroom, WallsFaceTheirRoom) {
    int seen = 0;
    for (const WorldTriangle& t : triangles_of(showroom())) {
        if (t.part->solid >= 0) continue;
        const Room& room = room_named(t.part->room);
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool high : {false, true}) {
                const double plane = static_cast<double>(high ? room.high[axis] : room.low[axis]);
                const bool lies_in_it = std::all_of(t.corners.begin(), t.corners.end(),
                                                    [&](const dvec3& p) { return std::abs(p[axis] - plane) < 1e-4; });
                if (!lies_in_it) continue;
                EXPECT_GT(t.normal()[axis] * (high ? -1 : 1), 0.99) << t.part->look;
                ++seen;
            }
        }
    }
    EXPECT_GT(seen, 30);
}

TEST(Showroom, NoTwoFacesLieInTheSamePlaceAndFlicker) {
    std::map<std::tuple<int, bool, long>, std::vector<WorldTriangle>> by_plane;
    for (const WorldTriangle& t : triangles_of(showroom())) {
        const dvec3 n = t.normal();
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(n[axis]) < 0.9999) continue;
            by_plane[{axis, n[axis] > 0, std::lround(t.corners[0][axis] * 2000)}].push_back(t);
        }
    }
    ASSERT_GT(by_plane.size(), 100U);
    int compared = 0;
    for (const auto& [plane, triangles] : by_plane) {
        const int axis = std::get<0>(plane);
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t j = i + 1; j < triangles.size(); ++j) {
                if (triangles[i].part == triangles[j].part) continue;
                ++compared;
                EXPECT_FALSE(overlap(triangles[i], triangles[j], axis, 1e-3))
                    << triangles[i].part->look << " and " << triangles[j].part->look << " at "
                    << triangles[i].corners[0].x << ", " << triangles[i].corners[0].y << ", "
                    << triangles[i].corners[0].z;
            }
        }
    }
    EXPECT_GT(compared, 1000);
}

bool stands_on(const WorldTriangle& t, const dvec3& p) {
    if (t.normal().y < 0.999 || std::abs(t.corners[0].y - p.y) > 1e-3) return false;
    for (std::size_t k = 0; k < 3; ++k) {
        const dvec3 edge = t.corners[(k + 1) % 3] - t.corners[k];
        const dvec3 to = p - t.corners[k];
        if (edge.z * to.x - edge.x * to.z < -1e-9) return false;
    }
    return true;
}

TEST(Showroom, ObjectsStandOnALevelSurfaceInsideOfTheirRoom) {
    const std::vector<WorldTriangle> triangles = triangles_of(showroom());
    for (const WorldObject& object : showroom().objects) {
        const ObjectShape& shape = object_shape(object.name);
        const dvec3 foot(object.foot);
        const double foot_radius = static_cast<double>(object.size * shape.foot_radii);
        for (int k = 0; k <= 8; ++k) {
            const double angle = k * 0.7853981634;
            const double out = k == 8 ? 0 : foot_radius;
            const dvec3 p = foot + out * dvec3(std::cos(angle), 0, std::sin(angle));
            EXPECT_TRUE(std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) { return stands_on(t, p); }))
                << object.name << " at " << foot.x << ", " << foot.y << ", " << foot.z << " hangs in the air";
        }
        const Room& room = room_named(object.room);
        const auto radius = static_cast<double>(object.size);
        const double height = radius * static_cast<double>(shape.height_radii);
        for (const int axis : {0, 2}) {
            EXPECT_GT(foot[axis] - radius, static_cast<double>(room.low[axis])) << object.name;
            EXPECT_LT(foot[axis] + radius, static_cast<double>(room.high[axis])) << object.name;
        }
        // Nothing reaches into the upright cylinder around it, but what it stands on.
        const auto is_near = [&](const WorldTriangle& t) {
            for (const int axis : {0, 2}) {
                const auto [low, high] = std::minmax({t.corners[0][axis], t.corners[1][axis], t.corners[2][axis]});
                if (low > foot[axis] + radius || high < foot[axis] - radius) return false;
            }
            return std::max({t.corners[0].y, t.corners[1].y, t.corners[2].y}) > foot.y + 0.004;
        };
        for (const WorldTriangle& t : triangles) {
            if (!is_near(t)) continue;
            for (const dvec3& p : t.samples(0.02)) {
                const bool within_height = p.y > foot.y + 0.004 && p.y < foot.y + height;
                const bool within = within_height && glm::length(dvec2(p.x - foot.x, p.z - foot.z)) < 0.97 * radius;
                ASSERT_FALSE(within) << object.name << " at " << foot.x << ", " << foot.y << ", " << foot.z << " meets "
                                     << t.part->look;
            }
        }
    }
}

TEST(Showroom, ObjectShapesAreThoseOfTheObjects) {
    for (const ObjectShape& shape : object_shapes()) {
        const std::string& name = shape.name;
        const auto recipe = capture::load_scene_file(
            std::filesystem::path(RAYSPACE_SOURCE_DIR) / "datasets-synthetic" / "recipes" / (name + ".json"), generate);
        ASSERT_TRUE(recipe.ok()) << recipe.error().message;
        double radius = 0;
        double low = 1e9;
        double high = -1e9;
        for (const capture::Mesh& mesh : recipe->scene.meshes) {
            for (const vec3& p : mesh.positions) {
                radius = std::max(radius, std::hypot(static_cast<double>(p.x), static_cast<double>(p.z)));
                low = std::min(low, static_cast<double>(p.y));
                high = std::max(high, static_cast<double>(p.y));
            }
        }
        EXPECT_NEAR(static_cast<double>(object_shape(name).height_radii), (high - low) / radius, 0.01) << name;
    }
}

TEST(Showroom, TheWayAndTheViewpointsKeepClearOfEverything) {
    const World& world = showroom();
    ASSERT_GE(world.walk.size(), 8U);
    std::vector<vec3> keys;
    for (const WorldView& view : world.walk) keys.push_back(view.eye);
    std::vector<vec3> eyes = smooth_curve<vec3>(keys, 12);
    for (const WorldView& view : world.viewpoints) {
        eyes.push_back(view.eye);
        EXPECT_FALSE(view.name.empty());
        EXPECT_GT(glm::distance(view.eye, view.at), 0.5F) << view.name;
    }
    std::vector<dvec3> points;
    for (const WorldTriangle& t : triangles_of(world)) {
        for (const dvec3& p : t.samples(0.1)) {
            if (p.y > 0.3 && p.y < 1.9) points.push_back(p);
        }
    }
    std::set<std::string> visited;
    for (const vec3& eye : eyes) {
        EXPECT_GT(eye.y, 1.4F);
        for (const Room& room : world.rooms) {
            if (glm::all(glm::greaterThan(eye, room.low)) && glm::all(glm::lessThan(eye, room.high)))
                visited.insert(room.name);
        }
        for (const dvec3& p : points) {
            ASSERT_GT(glm::length(dvec2(p.x - static_cast<double>(eye.x), p.z - static_cast<double>(eye.z))), 0.25)
                << "at " << eye.x << ", " << eye.z << " the visitor bumps into something at " << p.x << ", " << p.y
                << ", " << p.z;
        }
    }
    EXPECT_EQ(visited.size(), world.rooms.size());
}

}  // namespace
}  // namespace rs::synthetic
