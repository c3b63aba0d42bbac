// Walks through rooms: what is wanted, what is there, what is shown meanwhile.

#include "compositor/viewer/showroom.hpp"

#include "engine/model/board.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/compositor/six_rooms.hpp"
#include "tests/compositor/slow_source.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace rs::compositor {
namespace {

using test::SlowSource;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string name_of_file(int room, int number) {
    return std::to_string(room) + "-" + std::to_string(number);
}

std::int64_t bytes_for(int objects) {
    return objects * SlowSource::object_bytes() + SlowSource::reading_bytes();
}

std::vector<bool> there(const Showroom& showroom, std::size_t room) {
    std::vector<bool> objects;
    for (std::size_t n = 0; n < test::kObjectsInRoom; ++n) {
        objects.push_back((*showroom.nodes())[room * test::kObjectsInRoom + n].object.has_value());
    }
    return objects;
}

TEST(RoomPlan, TheVisitorsRoomComesFirstThenTheOnesAhead) {
    Scene scene = test::six_rooms(name_of_file);
    scene.objects.front().room.reset();  // belongs to none
    const RoomPlan plan(scene);
    ASSERT_EQ(plan.files().size(), scene.objects.size());
    const auto room_wish = [&](const glm::dvec3& eye, const glm::dvec3& soon, std::size_t room) {
        return plan.priorities({eye, soon})[room * test::kObjectsInRoom + 1];
    };
    const glm::dvec3 eye(0, 1.5, -2.5 * test::kRoomSide);
    EXPECT_EQ(plan.priorities({eye, eye})[0].room, LoadPriority::kAlways);
    EXPECT_EQ(room_wish(eye, eye, 2).room, LoadPriority::kHere);
    EXPECT_NEAR(room_wish(eye, eye, 1).room, test::kRoomSide / 2, 1e-9);
    EXPECT_NEAR(room_wish(eye, eye, 3).room, test::kRoomSide / 2, 1e-9);
    const glm::dvec3 ahead = eye - glm::dvec3(0, 0, 2);
    EXPECT_LT(room_wish(eye, ahead, 3), room_wish(eye, ahead, 1));
    EXPECT_LT(room_wish(eye, ahead, 2), room_wish(eye, ahead, 3));
    EXPECT_LT(room_wish(eye, ahead, 1), room_wish(eye, ahead, 5));
}

TEST(RoomPlan, AFileOfSeveralNodesIsWantedByTheNearest) {
    const Scene scene = test::six_rooms([](int, int number) { return name_of_file(0, number); });
    const RoomPlan plan(scene);
    ASSERT_EQ(plan.files().size(), static_cast<std::size_t>(test::kObjectsInRoom));
    for (const LoadPriority& priority : plan.priorities({{0, 1, -20}, {0, 1, -20}}))
        EXPECT_EQ(priority.room, LoadPriority::kHere);
}

class Walk : public ::testing::Test {
protected:
    void make(std::int64_t budget, test::SlowSourceOptions options = {}, bool waits = false) {
        const Scene scene = test::six_rooms(name_of_file);
        showroom_ = std::make_unique<Showroom>(scene, ShowroomOptions{.memory_bytes = budget, .waits = waits}, nullptr,
                                               std::make_unique<SlowSource>(log_, std::move(options)));
    }
    void step(double z, double seconds = 1.0 / 30) { ASSERT_TRUE(showroom_->update({0, 1.5, z}, seconds)); }
    // Frames at one place until all that is wanted there has come.
    void stay(double z) {
        for (int n = 0; n < 2000; ++n) {
            step(z);
            if (showroom_->settled()) return;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        FAIL() << "it does not settle";
    }

    std::shared_ptr<test::SourceLog> log_ = std::make_shared<test::SourceLog>();
    std::unique_ptr<Showroom> showroom_;
};

TEST_F(Walk, ABudgetOfTwoRoomsHasEveryRoomReadBeforeItIsEntered) {
    const std::int64_t budget = bytes_for(2 * test::kObjectsInRoom);
    make(budget);
    double seen_from = 0;
    std::size_t room = 0;
    for (double z = -0.5; z > -test::kRooms * test::kRoomSide + 0.5; z -= 0.05) {
        step(z, 0.05);  // 1 unit a second
        // Reading goes on for as long as it takes; a walk of the same speed on a slower machine.
        for (int n = 0; n < 200 && !showroom_->settled(); ++n) {
            std::this_thread::sleep_for(std::chrono::microseconds(100));
            step(z, 0);
        }
        EXPECT_LE(showroom_->statistics().used_bytes, budget);
        if (test::room_at(z) != room) {
            room = test::room_at(z);
            EXPECT_THAT(there(*showroom_, room), Each(true)) << "room " << room;
            EXPECT_LT(z, seen_from);
        }
        seen_from = z;
    }
    EXPECT_EQ(room, test::kRooms - 1U);
    EXPECT_THAT(there(*showroom_, 0), Each(false));
    const CacheStatistics statistics = showroom_->statistics();
    EXPECT_LE(statistics.peak_bytes, budget);
    EXPECT_EQ(statistics.loads, test::kRooms * test::kObjectsInRoom) << "each once: no thrashing";
    const std::lock_guard lock(log_->mutex);
    EXPECT_LE(log_->most_alive_bytes, budget);
}

TEST_F(Walk, StandingInADoorTheRoomsDoNotTakeTurns) {
    make(bytes_for(test::kObjectsInRoom));
    stay(-test::kRoomSide + 0.1);
    const int loads = showroom_->statistics().loads;
    for (int n = 0; n < 40; ++n) stay(-test::kRoomSide + (n % 2 == 0 ? 0.1 : -0.1));
    EXPECT_EQ(showroom_->statistics().loads, loads);
    stay(-test::kRoomSide - 2);
    EXPECT_GT(showroom_->statistics().loads, loads);
    EXPECT_THAT(there(*showroom_, 1), Each(true));
}

TEST_F(Walk, APlaceholderFadesIntoItsObject) {
    test::SlowSourceOptions options;
    options.reading = std::chrono::milliseconds(20);
    make(bytes_for(48), options);
    step(-1);
    const DisplayedNode& node = (*showroom_->nodes())[0];
    EXPECT_FALSE(node.object);
    ASSERT_TRUE(node.placeholder);
    EXPECT_EQ(node.placeholder->opacity, 1);
    EXPECT_EQ(node.placeholder->bottom, 0);
    EXPECT_THAT(showroom_->absence(0), ::testing::AnyOf("not in memory", "being read"));
    for (int n = 0; n < 2000 && !node.object; ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        step(-1, 0);
    }
    ASSERT_TRUE(node.object);
    EXPECT_EQ(node.opacity, 0);
    step(-1, 0.1);
    EXPECT_NEAR(node.opacity, 0.25, 1e-6);
    ASSERT_TRUE(node.placeholder);
    EXPECT_NEAR(node.placeholder->opacity, 0.75, 1e-6);
    step(-1, 0.5);
    EXPECT_EQ(node.opacity, 1);
    EXPECT_FALSE(node.placeholder);
}

TEST_F(Walk, WhatCannotBeReadIsLeftOut) {
    test::SlowSourceOptions options;
    options.broken = {name_of_file(0, 3)};
    make(bytes_for(48), options);
    stay(-1);
    step(-1, 1);
    EXPECT_THAT(showroom_->take_warnings(), ElementsAre("0-3: is broken; shown without this object"));
    EXPECT_THAT(showroom_->take_warnings(), IsEmpty());
    EXPECT_FALSE((*showroom_->nodes())[3].object);
    EXPECT_FALSE((*showroom_->nodes())[3].placeholder);
    EXPECT_EQ(showroom_->absence(3), "cannot be shown");
    EXPECT_TRUE((*showroom_->nodes())[4].object);
}

TEST_F(Walk, ARequiredObjectThatCannotBeReadIsAnError) {
    Scene scene;
    RaySpaceNode node;
    node.file = "gone";
    node.required = true;
    scene.objects.push_back(node);
    test::SlowSourceOptions options;
    options.gone = {"gone"};
    Showroom showroom(scene, {.memory_bytes = bytes_for(1), .waits = true}, nullptr,
                      std::make_unique<SlowSource>(log_, options));
    const Status status = showroom.update({0, 0, 0}, 0);
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, HasSubstr("gone: is not there"));
}

// Two nodes show a file with a shape map, which prototype-2000 does not render; one shows a file without.
TEST(ShowroomOnABoard, AnObjectThatTheCoreDrawsIsReportedOnce) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "shaped.rso", test::small_object_with_shape()));
    ASSERT_TRUE(write_object(folder / "plain.rso", test::small_object()));
    Scene scene;
    for (const char* name : {"shaped.rso", "plain.rso", "shaped.rso"}) {
        RaySpaceNode node;
        node.file = folder / name;
        scene.objects.push_back(node);
    }
    const auto config = engine::model::read_board_config("prototype-2000");
    ASSERT_TRUE(config);
    Showroom showroom(scene, {.waits = true}, engine::model::make_simulated_board(*config, true));
    ASSERT_TRUE(showroom.update({0, 0, 5}, 0));
    const Camera camera = look_at_camera({0, 0, 10}, {0, 0, 0}, 0.6, 12, 10);
    const auto draw_all = [&] {
        std::vector<engine::ViewRequest> views;
        for (const DisplayedNode& node : *showroom.nodes()) views.push_back({node.handle, camera});
        const auto cycle = showroom.engine()->submit(views);
        ASSERT_TRUE(cycle) << cycle.error().message;
        ASSERT_TRUE(showroom.engine()->retrieve(*cycle));
    };
    draw_all();
    EXPECT_THAT(showroom.take_warnings(),
                ElementsAre(AllOf(HasSubstr("has a shape map"), HasSubstr("--raymap plane"),
                                  HasSubstr("drawn by the core, not by board:prototype-2000"))));
    draw_all();
    EXPECT_THAT(showroom.take_warnings(), IsEmpty());
}

TEST_F(Walk, WaitingFramesAreComplete) {
    test::SlowSourceOptions options;
    options.reading = std::chrono::milliseconds(1);
    make(bytes_for(2 * test::kObjectsInRoom), options, true);
    for (double z = -1; z > -test::kRooms * test::kRoomSide; z -= 2) {
        step(z);
        EXPECT_THAT(there(*showroom_, test::room_at(z)), Each(true)) << z;
        for (const DisplayedNode& node : *showroom_->nodes()) {
            EXPECT_TRUE(!node.object || node.opacity == 1);
        }
    }
}

}  // namespace
}  // namespace rs::compositor
