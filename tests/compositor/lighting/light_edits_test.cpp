// Lighting edits and undo; number steps; warnings.

#include "compositor/lighting/light_edits.hpp"
#include "compositor/lighting/light_warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

LightingState two_points() {
    LightingState state;
    state.entries = {LightEntry{.name = "left", .power = 10, .location = {-1, 2, 0}},
                     LightEntry{.name = "right", .power = 20, .location = {1, 2, 0}}};
    return state;
}

TEST(LightEdits, EveryStepIsUndoneAndDoneAgain) {
    LightEdits edits(two_points());
    std::vector<LightingState> states = {edits.state()};
    LightEntry moved = edits.state().entries[0];
    moved.location.x = -3;
    edits.set_light(0, moved);
    states.push_back(edits.state());
    edits.select(1);
    edits.duplicate({0.5, 0, 0});
    states.push_back(edits.state());
    EXPECT_EQ(edits.selected(), 2U);
    EXPECT_EQ(edits.state().entries[2].name, "right 2");
    EXPECT_EQ(edits.state().entries[2].location, glm::dvec3(1.5, 2, 0));
    edits.select(0);
    edits.remove_selected();
    states.push_back(edits.state());
    EXPECT_FALSE(edits.selected());
    EXPECT_EQ(edits.state().entries.size(), 2U);
    LightingState brighter = edits.state();
    brighter.exposure_ev = 2;
    edits.set(brighter);
    states.push_back(edits.state());
    for (std::size_t i = states.size() - 1; i-- > 0;) {
        ASSERT_TRUE(edits.undo());
        EXPECT_EQ(edits.state(), states[i]) << i;
    }
    EXPECT_FALSE(edits.undo());
    for (std::size_t i = 1; i < states.size(); ++i) {
        ASSERT_TRUE(edits.redo());
        EXPECT_EQ(edits.state(), states[i]) << i;
    }
    EXPECT_FALSE(edits.redo());
    // A new step clears the redo history.
    ASSERT_TRUE(edits.undo());
    edits.add(new_light(LightKind::kSpot, {0, 1, 0}));
    EXPECT_FALSE(edits.can_redo());
}

TEST(LightEdits, AGestureIsOneStepAndWhatChangesNothingIsNone) {
    LightEdits edits(two_points());
    const LightingState before = edits.state();
    edits.begin_gesture();
    for (int i = 1; i <= 50; ++i) {
        LightEntry moved = edits.state().entries[1];
        moved.location.y = i;
        edits.set_light(1, moved);
    }
    EXPECT_FALSE(edits.undo());  // not in the middle of it
    edits.end_gesture();
    EXPECT_EQ(edits.state().entries[1].location.y, 50);
    ASSERT_TRUE(edits.undo());
    EXPECT_EQ(edits.state(), before);
    EXPECT_FALSE(edits.can_undo());
    const auto revision = edits.revision();
    edits.begin_gesture();
    edits.end_gesture();
    edits.set(before);
    edits.set_light(0, before.entries[0]);
    edits.set_light(9, before.entries[0]);
    edits.remove_selected();
    EXPECT_FALSE(edits.can_undo());
    EXPECT_EQ(edits.revision(), revision);
    edits.begin_gesture();
    edits.select(0);
    edits.remove_selected();
    edits.cancel_gesture();
    EXPECT_EQ(edits.state(), before);
    EXPECT_FALSE(edits.can_undo());
}

TEST(LightEdits, StepsAreKeptWithinReason) {
    LightEdits edits(two_points());
    for (int i = 1; i <= 1000; ++i) {
        LightEntry moved = edits.state().entries[0];
        moved.power = i;
        edits.set_light(0, moved);
    }
    int undone = 0;
    while (edits.undo()) ++undone;
    EXPECT_EQ(undone, 256);
}

TEST(LightEdits, ListsGoInAndOut) {
    LightingState state = two_points();
    state.exposure_ev = 3;
    state.headlight = true;
    const LightList list = list_of(state);
    EXPECT_TRUE(list.replace);
    EXPECT_EQ(list.lights[1].location, state.entries[1].location);
    EXPECT_EQ(state_of(list, 3), state);
}

TEST(LightEdits, LabelsAreNamesOrKindsWithNumbers) {
    LightEntry entry;
    entry.kind = LightKind::kSpot;
    EXPECT_EQ(light_label(entry, 2), "spot 3");
    entry.name = "desk\nlamp";
    EXPECT_EQ(light_label(entry, 2), "desk\\x0Alamp");
    entry = new_light(LightKind::kLuminaire, {0, 0, 0});
    entry.file = "lamps/tube.ies";
    EXPECT_EQ(light_label(entry, 0), "luminaire 1 (tube.ies)");
}

TEST(NumberStep, FactorsKeepFourDigitsAndGoBothWays) {
    EXPECT_EQ(scaled(300, 10, 1, 0, 1e12), 3000);
    EXPECT_EQ(scaled(300, 0.1, 1, 0, 1e12), 30);
    EXPECT_EQ(scaled(300, 1.1, 1, 0, 1e12), 330);
    EXPECT_EQ(scaled(0.003, 10, 1, 0, 1e12), 0.03);
    EXPECT_EQ(scaled(1234.5678, 1.1, 1, 0, 1e12), 1358);
    EXPECT_EQ(scaled(0, 10, 7, 0, 1e12), 7);
    EXPECT_EQ(scaled(0, 0.1, 7, 0, 1e12), 0);
    EXPECT_EQ(scaled(5e11, 10, 1, 0, 1e12), 1e12);
    double value = 1;
    for (int i = 0; i < 9; ++i) value = scaled(value, 10, 1, 0, 1e12);
    EXPECT_EQ(value, 1e9);
    for (int i = 0; i < 12; ++i) value = scaled(value, 0.1, 1, 0, 1e12);
    EXPECT_EQ(value, 1e-3);
}

TEST(NumberStep, StepsAddUpExactly) {
    double value = 0;
    for (int i = 0; i < 10; ++i) value = shifted(value, -1, 1, -10, 10);
    EXPECT_EQ(value, 1);
    for (int i = 0; i < 25; ++i) value = shifted(value, -2, -1, -10, 10);
    EXPECT_EQ(value, 0.75);
    EXPECT_EQ(shifted(9, 1, 1, -10, 10), 10);
    EXPECT_EQ(shifted(1.25, 0, -3, -10, 10), -1.75);
    EXPECT_EQ(shifted(100, 2, 2, -1000, 1000), 300);
}

GeometryNode box_at(const glm::dvec3& size, const glm::dvec3& at, bool inside_out) {
    Mesh mesh = box_mesh(size);
    mesh.two_sided = false;
    if (inside_out) std::ranges::reverse(mesh.indices);
    GeometryNode node;
    node.mesh = std::make_shared<const Mesh>(std::move(mesh));
    node.world_from_node[3] = glm::dvec4(at, 1);
    return node;
}

TEST(LightWarnings, NameLightsThatNobodySees) {
    Scene scene;
    scene.geometry = {box_at({10, 4, 10}, {0, 2, 0}, true), box_at({1, 1, 1}, {2, 0.5, 0}, false)};
    Light lamp = point_light({0, 2, 0}, glm::vec3(1));
    lamp.name = "lamp";
    Light buried = lamp;
    buried.location = {2.2, 0.4, 0.1};
    buried.name = "buried";
    Light dark = lamp;
    dark.colour = glm::vec3(0);
    Light sun = directional_light({0, -1, 0}, glm::vec3(1));
    scene.lights = {lamp, buried, dark, sun};
    const auto warnings = light_warnings(scene);
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_NE(warnings[0].find("light 2 'buried' is inside a solid"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("light 3 'lamp' has no power"), std::string::npos) << warnings[1];
    EXPECT_EQ(light_warning(scene, 0), "");
    // A mirrored box is solid, too.
    scene.geometry[1].world_from_node[0] = {-1, 0, 0, 0};
    EXPECT_EQ(light_warnings(scene).size(), 2U);
    // A two-sided box may be a lampshade.
    Mesh shade = *scene.geometry[1].mesh;
    shade.two_sided = true;
    scene.geometry[1].mesh = std::make_shared<const Mesh>(std::move(shade));
    EXPECT_EQ(light_warnings(scene).size(), 1U);
}

}  // namespace
}  // namespace rs::compositor
