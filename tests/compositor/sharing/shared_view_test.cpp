#include "compositor/sharing/shared_view.hpp"

#include "tests/compositor/sharing/shared_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace rs::compositor {
namespace {

using test::full_view;
using test::kSharedScene;
using test::numbered_view;
using ::testing::HasSubstr;

std::string fault_of(const std::vector<std::byte>& bytes) {
    SharedViewReader reader(kSharedScene);
    const Status read = reader.take(bytes);
    return read ? std::string() : read.error().message;
}

std::string fault_with(const std::function<void(SharedView&)>& change) {
    SharedView view = full_view();
    change(view);
    return fault_of(view_message(view, kSharedScene));
}

TEST(SharedView, AllFieldsAreTransmitted) {
    const SharedView sent = full_view();
    SharedViewReader reader(kSharedScene);
    ASSERT_TRUE(reader.take(view_message(sent, kSharedScene)).ok());
    EXPECT_FALSE(reader.take_lights().has_value());
    const auto view = reader.take_view();
    ASSERT_TRUE(view.has_value());
    EXPECT_EQ(view->world_from_camera, sent.world_from_camera);
    EXPECT_EQ(view->field_of_view_rad, sent.field_of_view_rad);
    ASSERT_TRUE(view->room.has_value());
    EXPECT_EQ(view->room->place.position, sent.room->place.position);
    EXPECT_EQ(view->room->place.units_per_metre, 1.5);
    EXPECT_EQ(view->room->head.roll_rad, 0.05);
    EXPECT_EQ(view->renderer, 4);
    EXPECT_EQ(view->frame, 17U);
    EXPECT_EQ(view->weather, sent.weather);
    EXPECT_EQ(view->exposure_ev, -1.5);
    EXPECT_FALSE(view->shadows);
    EXPECT_TRUE(view->wire_frame);
    EXPECT_EQ(view->turns_rad, sent.turns_rad);
    EXPECT_FALSE(reader.take_view().has_value());
    // The same bytes again.
    EXPECT_EQ(view_message(*view, kSharedScene), view_message(sent, kSharedScene));
}

TEST(SharedView, TheNewestOfAStreamIsKeptHoweverItIsSplit) {
    std::vector<std::byte> stream;
    for (const auto& message :
         {view_message(numbered_view(1), kSharedScene), lights_message("{\"lights\": []}", kSharedScene),
          view_message(full_view(), kSharedScene), view_message(numbered_view(3), kSharedScene)}) {
        stream.insert(stream.end(), message.begin(), message.end());
    }
    for (const std::size_t part : {std::size_t{1}, std::size_t{7}, std::size_t{100}, stream.size()}) {
        SharedViewReader reader(kSharedScene);
        for (std::size_t at = 0; at < stream.size(); at += part) {
            ASSERT_TRUE(reader.take(std::span(stream).subspan(at, std::min(part, stream.size() - at))).ok());
        }
        const auto view = reader.take_view();
        ASSERT_TRUE(view.has_value()) << part;
        EXPECT_EQ(view->frame, 3U);
        EXPECT_EQ(reader.take_lights(), "{\"lights\": []}");
    }
}

TEST(SharedView, AnIncompleteMessageIsNoView) {
    const std::vector<std::byte> message = view_message(full_view(), kSharedScene);
    for (std::size_t size = 0; size < message.size(); ++size) {
        SharedViewReader reader(kSharedScene);
        EXPECT_TRUE(reader.take(std::span(message).first(size)).ok());
        EXPECT_FALSE(reader.take_view().has_value());
    }
}

TEST(SharedView, OtherStreamsVersionsAndScenesAreRefused) {
    std::vector<std::byte> message = view_message(full_view(), kSharedScene);
    const auto with_byte = [&](std::size_t at, int value) {
        std::vector<std::byte> changed = message;
        changed[at] = static_cast<std::byte>(value);
        return fault_of(changed);
    };
    EXPECT_EQ(fault_of(message), "");
    EXPECT_THAT(with_byte(0, 'G'), HasSubstr("is not a leading rs-view; give the address of one that runs with"));
    EXPECT_THAT(with_byte(4, 9), HasSubstr("version 9, and this rs-view in version 1; install the same release"));
    EXPECT_THAT(with_byte(12, 0), HasSubstr("another scene; open the same scene file"));
    EXPECT_THAT(with_byte(6, 3), HasSubstr("unknown kind 3"));
    EXPECT_THAT(with_byte(11, 1), HasSubstr("exceeds the limit"));  // before the payload is awaited
    message[8] ^= std::byte{1};                                     // a payload that is a byte shorter or longer
    message.push_back(std::byte{0});
    EXPECT_THAT(fault_of(message), HasSubstr("wrong length"));
}

TEST(SharedView, ValuesBeyondTheirLimitsAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(fault_with([&](SharedView& view) { view.world_from_camera[3].y = nan; }), HasSubstr("camera position"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.world_from_camera[0].x += 0.1; }), HasSubstr("not a rotation"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.world_from_camera[0] *= -1; }), HasSubstr("not a rotation"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.field_of_view_rad = 3.2; }), HasSubstr("field of view"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.exposure_ev = 41; }), HasSubstr("exposure"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.room->place.units_per_metre = 0; }), HasSubstr("scale"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.room->head.position.x = 101; }), HasSubstr("head position"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.weather->snow = true; }), HasSubstr("both rain and snow"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.turns_rad[1] = nan; }), HasSubstr("turn"));
    EXPECT_THAT(fault_with([&](SharedView& view) { view.frame = 1'000'001; }), HasSubstr("frame"));
}

}  // namespace
}  // namespace rs::compositor
