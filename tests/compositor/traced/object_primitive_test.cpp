// A sphere with known geometry as a ray-space object that answers rays.

#include "compositor/traced/object_primitive.hpp"

#include "capture/tracer/integrator/tracer.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/support/random.hpp"
#include "tests/support/sphere_object.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::compositor {
namespace {

std::shared_ptr<const ViewableObject> ball() {
    auto viewable = make_viewable(test::sphere_object(test::sphere_options(), test::Sphere{}));
    RS_CHECK(viewable.ok());
    return std::make_shared<const ViewableObject>(std::move(*viewable));
}

NodeTransform somewhere() {
    NodeTransform place;
    place.translation = {3, -1, 2};
    place.axis = {0, 1, 0};
    place.angle_rad = 1;
    place.scale = 0.5;
    return place;
}

// Horizontal rays from all sides, at the height of the captures, hit the sphere.
TEST(ObjectPrimitive, AnswerWhereTheBallIsAndPassWhereItIsNot) {
    const PlacedObject placed = test::placed_at(ball(), somewhere());
    const ObjectPrimitive rays(placed, 0.25F);
    const test::Sphere sphere;
    test::Random random(5);
    int met = 0, missed = 0, wrong = 0;
    double distance_error = 0, colour_error = 0;
    for (int i = 0; i < 4000; ++i) {
        const double turn = random.real(0, 2 * kPi);
        const glm::dvec3 from(2.5 * std::cos(turn), random.real(-0.2, 0.2), 2.5 * std::sin(turn));
        const glm::dvec3 at(random.real(-0.9, 0.9), random.real(-0.6, 0.7), random.real(-0.9, 0.9));
        const glm::dvec3 along = glm::normalize(at - from);
        const auto expected = test::hit(sphere, from, along);
        const glm::dvec3 world_from = placed.world_from_object.point(from);
        const glm::dvec3 world_along = placed.world_from_object.direction(along);
        const auto answer = rays.answer(glm::vec3(world_from), glm::vec3(world_along));
        const bool inner = expected && expected->leaves - expected->enters > 0.35;  // not at its edge
        if (!inner) {
            const bool outside = !test::hit({sphere.centre, sphere.radius + 0.1}, from, along);
            missed += outside;
            wrong += outside && answer;
            continue;
        }
        ++met;
        if (!answer) {
            ++wrong;
            continue;
        }
        distance_error += std::abs(static_cast<double>(answer->distance) - 0.5 * expected->enters);
        const double grey = test::grey_at(from + expected->enters * along);
        colour_error += std::abs(static_cast<double>(answer->radiance.g) -
                                 0.25 * static_cast<double>(linear_from_srgb8(static_cast<std::uint8_t>(grey))));
    }
    EXPECT_GT(met, 500);
    EXPECT_GT(missed, 500);
    EXPECT_LT(wrong, (met + missed) / 100);
    EXPECT_LT(distance_error / met, 0.01);
    EXPECT_LT(colour_error / met, 0.006);
}

TEST(ObjectPrimitive, StandInTheirBoxAndNotBehindTheOrigin) {
    const PlacedObject placed = test::placed_at(ball(), somewhere());
    const ObjectPrimitive rays(placed, 1);
    const test::Sphere sphere;
    const glm::dvec3 middle = placed.world_from_object.point(sphere.centre);
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1)}) {
        const auto before = rays.answer(glm::vec3(middle - 2.0 * axis), glm::vec3(axis));
        ASSERT_TRUE(before);
        const glm::vec3 there = glm::vec3(middle - 2.0 * axis) + before->distance * glm::vec3(axis);
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(there, rays.bounds().lower)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(there, rays.bounds().upper)));
        EXPECT_FALSE(rays.answer(glm::vec3(middle + 0.6 * axis), glm::vec3(axis)));
    }
}

// A wall behind the sphere, a light in front of it: the shadow is the sphere's.
TEST(ObjectPrimitive, ThrowTheShadowOfTheBall) {
    capture::Scene scene;
    capture::Mesh wall;
    wall.positions = {{-4, -4, -2}, {4, -4, -2}, {4, 4, -2}, {-4, 4, -2}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(wall);
    scene.materials.emplace_back();
    const test::Sphere sphere;
    const glm::dvec3 lamp(0.1, 0.15, 4);
    scene.lights.push_back(point_light(lamp, glm::vec3(30)));
    scene.primitives.push_back(std::make_shared<const ObjectPrimitive>(test::placed_at(ball()), 1.0F));
    auto tracer = capture::Tracer::create(std::move(scene));
    ASSERT_TRUE(tracer);
    int shadow = 0, lit = 0, wrong = 0;
    for (double y = -1.5; y < 1.8; y += 0.05) {
        for (double x = -1.5; x < 1.8; x += 0.05) {
            const glm::dvec3 place(x, y, -1.999);
            const glm::dvec3 along = glm::normalize(lamp - place);
            if (test::hit({sphere.centre, 0.96 * sphere.radius}, place, along)) {
                ++shadow;
                wrong += tracer->is_unoccluded(place, along, glm::distance(lamp, place));
            } else if (!test::hit({sphere.centre, 1.06 * sphere.radius}, place, along)) {
                ++lit;
                wrong += !tracer->is_unoccluded(place, along, glm::distance(lamp, place));
            }
        }
    }
    EXPECT_GT(shadow, 500);
    EXPECT_GT(lit, 1000);
    EXPECT_LT(wrong, (shadow + lit) / 100);
}

}  // namespace
}  // namespace rs::compositor
