// Handles are hit where they are drawn, and drags move lights with the pointer.

#include "compositor/lighting/light_drag.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::compositor {
namespace {

// A camera in general position.
Camera some_camera() {
    return look_at_camera({3, 2.5, 6}, {0.2, 1, -0.4}, radians(55), 640, 480);
}

glm::dvec2 seen_at(const Camera& camera, const glm::dvec3& place) {
    return glm::dvec2(camera.project(place));
}

const SurfaceAt kNothing = [](const glm::dvec2&) { return std::nullopt; };

// Depths of a plane for any camera.
SurfaceAt plane(const Camera& camera, const glm::dvec3& through, const glm::dvec3& normal) {
    return [=](const glm::dvec2& at) -> std::optional<SurfacePoint> {
        const glm::dvec3 ray = camera.ray(at.x, at.y);
        const double t = glm::dot(through - camera.centre(), normal) / glm::dot(ray, normal);
        if (!(t > 0)) return std::nullopt;
        return SurfacePoint{camera.centre() + t * ray, normal};
    };
}

TEST(LightDrag, AlongAnAxisTheLightGoesAsFarAsThePointer) {
    const Camera camera = some_camera();
    const LightEntry light{.location = {0.5, 1, 0}};
    for (const HandlePart axis : kAxisParts) {
        const glm::dvec3 grasped = glm::mix(light.location, axis_end(light, axis, camera), 0.7);
        const LightDrag drag(light, axis, camera, seen_at(camera, grasped), 0.001);
        for (const double far : {-0.8, 0.0, 0.25, 1.5}) {
            const LightEntry moved = drag.to(seen_at(camera, grasped + far * direction_of(axis)), camera, kNothing);
            EXPECT_LT(glm::distance(moved.location, light.location + far * direction_of(axis)), 1e-9);
            EXPECT_EQ(moved.aim, light.aim);
        }
    }
}

TEST(LightDrag, AnAxisSeenFromItsEndMovesNothing) {
    const Camera camera = look_at_camera({0, 1, 5}, {0, 1, 0}, radians(50), 640, 480);
    const LightEntry light{.location = {0, 1, 0}};
    const LightDrag drag(light, HandlePart::kAxisZ, camera, {320, 240}, 0.001);
    EXPECT_EQ(drag.to({322, 240}, camera, kNothing).location, light.location);
}

TEST(LightDrag, OverSurfacesItSnapsAndTurns) {
    const Camera camera = some_camera();
    LightEntry spot;
    spot.kind = LightKind::kSpot;
    spot.location = {0.5, 1.2, 0};
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1, 1, 0.2));
    const SurfaceAt floor = plane(camera, {0, 0, 0}, normal);
    // A grab offset from the handle's centre is preserved.
    const LightDrag drag(spot, HandlePart::kBody, camera, seen_at(camera, spot.location) + glm::dvec2(3, -4), 0.01);
    const glm::dvec2 there = seen_at(camera, {0, 0, 0});
    const LightEntry moved = drag.to(there + glm::dvec2(3, -4), camera, floor);
    EXPECT_LT(glm::distance(moved.location, 0.01 * normal), 1e-9);
    EXPECT_LT(glm::distance(moved.aim, normal), 1e-12);
    // Point lights have no aim.
    const LightEntry point{.location = spot.location};
    const LightDrag of_point(point, HandlePart::kBody, camera, seen_at(camera, point.location), 0.01);
    EXPECT_EQ(of_point.to(there, camera, floor).aim, point.aim);
    // Over the background the light keeps its depth.
    const LightEntry lost = of_point.to({100, 90}, camera, kNothing);
    EXPECT_LT(glm::distance(seen_at(camera, lost.location), glm::dvec2(100, 90)), 1e-9);
    EXPECT_NEAR(camera.project(lost.location).z, camera.project(point.location).z, 1e-9);
}

TEST(LightDrag, AimsAtWhatIsUnderThePointer) {
    const Camera camera = some_camera();
    LightEntry spot;
    spot.kind = LightKind::kSpot;
    spot.location = {0.5, 2, 0};
    const auto grasped = aim_position(spot, camera);
    ASSERT_TRUE(grasped);
    const LightDrag drag(spot, HandlePart::kAim, camera, seen_at(camera, *grasped), 0.01);
    const glm::dvec3 target(-1, 0, 0.5);
    const LightEntry aimed = drag.to(seen_at(camera, target), camera, plane(camera, {0, 0, 0}, {0, 1, 0}));
    EXPECT_LT(glm::distance(aimed.aim, glm::normalize(target - spot.location)), 1e-9);
    EXPECT_EQ(aimed.location, spot.location);
}

TEST(LightDrag, DirectionalLightsTurnAboutTheDome) {
    const Camera camera = some_camera();
    const Dome dome = dome_of(camera);
    for (const glm::dvec3& aim : {glm::dvec3(-1, -2, -1), glm::dvec3(0.3, -1, 2)}) {
        LightEntry sun;
        sun.kind = LightKind::kDirectional;
        sun.aim = aim;
        const LightDrag drag(sun, HandlePart::kBody, camera, seen_at(camera, handle_position(sun, camera)), 0.01);
        const LightEntry still = drag.to(seen_at(camera, handle_position(sun, camera)), camera, kNothing);
        EXPECT_LT(glm::distance(still.aim, glm::normalize(aim)), 1e-6);
        const glm::dvec3 out = glm::normalize(glm::dvec3(0.2, 1, 0.1) * 0.5 - aim / glm::length(aim));
        const LightEntry turned = drag.to(seen_at(camera, dome.centre + dome.radius * out), camera, kNothing);
        EXPECT_LT(glm::distance(turned.aim, -out), 1e-6);
        const LightEntry beside = drag.to({2, 470}, camera, kNothing);
        EXPECT_NEAR(glm::length(beside.aim), 1, 1e-9);
    }
}

TEST(LightHandles, AreFoundWhereTheyAreDrawn) {
    const Camera camera = some_camera();
    LightingState state;
    for (const LightKind kind : {LightKind::kPoint, LightKind::kSpot, LightKind::kRectangle, LightKind::kDisc,
                                 LightKind::kDirectional, LightKind::kLuminaire}) {
        state.entries.push_back(new_light(kind, {0.8 * static_cast<double>(state.entries.size()) - 1.5, 1, 0}));
        state.entries.back().aim = {0.2, -1, 0.1};
    }
    for (std::size_t i = 0; i < state.entries.size(); ++i) {
        const glm::dvec2 at = seen_at(camera, handle_position(state.entries[i], camera));
        EXPECT_EQ(handle_at(state, std::nullopt, camera, at + glm::dvec2(3, 2)), (HandleHit{i, HandlePart::kBody}));
        // Once selected, its axes and aim are there, too, and come before others.
        const auto strokes = light_strokes(state, i, std::nullopt, camera);
        EXPECT_GT(strokes.size(), light_strokes(state, std::nullopt, std::nullopt, camera).size() -
                                      (state.entries[i].kind == LightKind::kDirectional ? 1 : 0));
        if (state.entries[i].kind == LightKind::kDirectional) continue;
        for (const HandlePart axis : kAxisParts) {
            const glm::dvec2 end = seen_at(camera, axis_end(state.entries[i], axis, camera));
            EXPECT_EQ(handle_at(state, i, camera, end), (HandleHit{i, axis}));
        }
        if (const auto aim = aim_position(state.entries[i], camera)) {
            EXPECT_EQ(handle_at(state, i, camera, seen_at(camera, *aim)), (HandleHit{i, HandlePart::kAim}));
        }
    }
    EXPECT_FALSE(handle_at(state, std::nullopt, camera, {5, 470}));
    // A large panel can also be grabbed by its edge.
    state.entries[2].size = {2, 1};
    const LightEntry& panel = state.entries[2];
    const AimedAxes axes = aimed_axes(unit_vector(panel.aim), 0);
    const glm::dvec3 edge = panel.location + axes.across + 0.3 * axes.along;
    EXPECT_EQ(handle_at(state, std::nullopt, camera, seen_at(camera, edge)), (HandleHit{2, HandlePart::kBody}));
}

TEST(LightHandles, BehindTheCameraNothingIsGrasped) {
    const Camera camera = look_at_camera({0, 1, 5}, {0, 1, 0}, radians(50), 640, 480);
    LightingState state;
    state.entries = {LightEntry{.location = {0, 1, 9}}};
    for (double x = 0; x < 640; x += 20) EXPECT_FALSE(handle_at(state, std::nullopt, camera, {x, 240}));
}

TEST(SurfacePoint, PlaneAndNormalAreFoundExactlyAndEdgesDoNotTurnThem) {
    const Camera camera = some_camera();
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 1, -0.2));
    const glm::dvec3 through(0, 0.2, 0);
    const auto inverse_depth = [&](double x, double y) {
        return glm::dot(camera.ray(x, y), normal) / glm::dot(through - camera.centre(), normal);
    };
    for (const int edge : {-3, -2, -1, 1, 2, 3}) {  // beyond it there is something near, or nothing
        for (const double beyond : {0.0, 0.9}) {
            DepthsAround depths{};
            for (int dy = -2; dy <= 2; ++dy) {
                for (int dx = -2; dx <= 2; ++dx) {
                    const bool off = edge < 0 ? dx <= edge : dx >= edge;
                    depths[static_cast<std::size_t>((dy + 2) * kDepthsAcross + dx + 2)] =
                        off ? beyond : inverse_depth(300 + dx + 0.5, 350 + dy + 0.5);
                }
            }
            const auto point = surface_from_depths(camera, 300, 350, depths);
            ASSERT_TRUE(point);
            EXPECT_LT(glm::distance(point->normal, normal), 1e-9) << edge;
            EXPECT_LT(std::abs(glm::dot(point->place - through, normal)), 1e-9);
            EXPECT_LT(glm::distance(seen_at(camera, point->place), glm::dvec2(300.5, 350.5)), 1e-6);
        }
    }
    EXPECT_FALSE(surface_from_depths(camera, 300, 350, {}));
}

}  // namespace
}  // namespace rs::compositor
