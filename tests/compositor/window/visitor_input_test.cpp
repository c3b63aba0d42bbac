// Events become movement and commands.

#include "compositor/window/visitor_input.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

TEST(VisitorInput, KeysCountForAsLongAsTheyAreHeld) {
    VisitorInput input;
    input.take(KeyEvent{Key::kForward, true});
    input.take(KeyEvent{Key::kFast, true});
    EXPECT_EQ(input.movement(0.1).forward, 1);
    EXPECT_TRUE(input.movement(0.1).fast);
    EXPECT_EQ(input.movement(0.25).seconds, 0.25);
    input.take(KeyEvent{Key::kBack, true});
    EXPECT_EQ(input.movement(0.1).forward, 0);  // both
    input.take(KeyEvent{Key::kForward, false});
    EXPECT_EQ(input.movement(0.1).forward, -1);
    EXPECT_TRUE(input.commands().empty());
}

TEST(VisitorInput, KeysAreLetGoWhenTheWindowLosesTheFocus) {
    VisitorInput input;
    input.take(KeyEvent{Key::kRight, true});
    input.take(KeyEvent{Key::kUp, true});
    input.take(KeyEvent{Key::kTurnLeft, true});
    EXPECT_EQ(input.movement(0.1).right, 1);
    EXPECT_EQ(input.movement(0.1).up, 1);
    EXPECT_EQ(input.movement(0.1).turn_left, 1);
    input.take(LostFocusEvent{});
    EXPECT_EQ(input.movement(0.1).right, 0);
    EXPECT_EQ(input.movement(0.1).up, 0);
    EXPECT_EQ(input.movement(0.1).turn_left, 0);
}

TEST(VisitorInput, CommandsComeOnceAndInOrder) {
    VisitorInput input;
    for (const Key key : {Key::kScreenshot, Key::kHelp, Key::kScreenshot}) {
        input.take(KeyEvent{key, true});
        input.take(KeyEvent{key, false});
    }
    EXPECT_EQ(input.commands(), (std::vector<Key>{Key::kScreenshot, Key::kHelp, Key::kScreenshot}));
    EXPECT_TRUE(input.commands().empty());
}

TEST(VisitorInput, DragsAddUpUntilTheyAreAskedFor) {
    VisitorInput input;
    input.take(MoveEvent{{10, 10}});
    EXPECT_EQ(input.movement(0.1).look_px, glm::dvec2(0));  // nothing is pressed
    input.take(ButtonEvent{Button::kLeft, true, {10, 10}});
    input.take(MoveEvent{{20, 12}});
    input.take(MoveEvent{{25, 20}});
    EXPECT_EQ(input.movement(0.1).look_px, glm::dvec2(15, 10));
    input.take(MoveEvent{{24, 20}});
    const NavigationInput second = input.movement(0.1);
    EXPECT_EQ(second.look_px, glm::dvec2(-1, 0));
    EXPECT_EQ(second.pan_px, glm::dvec2(0));
    input.take(ButtonEvent{Button::kLeft, false, {24, 20}});
    EXPECT_FALSE(input.click().has_value());
    input.take(ButtonEvent{Button::kRight, true, {0, 0}});
    input.take(MoveEvent{{0, 9}});
    EXPECT_EQ(input.movement(0.1).pan_px, glm::dvec2(0, 9));
}

TEST(VisitorInput, AClickMayShakeALittle) {
    VisitorInput input;
    input.take(ButtonEvent{Button::kLeft, true, {50, 60}});
    input.take(MoveEvent{{52, 61}});
    EXPECT_EQ(input.movement(0.1).look_px, glm::dvec2(0));
    input.take(ButtonEvent{Button::kLeft, false, {52, 61}});
    ASSERT_TRUE(input.click().has_value());
    EXPECT_FALSE(input.click().has_value());
}

TEST(VisitorInput, WheelNotchesAddUp) {
    VisitorInput input;
    input.take(WheelEvent{1});
    input.take(WheelEvent{1.5});
    EXPECT_EQ(input.movement(0.1).wheel, 2.5);
    EXPECT_EQ(input.movement(0.1).wheel, 0);
}

}  // namespace
}  // namespace rs::compositor
