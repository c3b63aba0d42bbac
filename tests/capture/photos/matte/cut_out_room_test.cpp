// Objects on a turntable in a room, with furniture behind them and people beside them.

#include "capture/photos/matte/cut_out.hpp"
#include "capture/photos/matte/object_mask.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/capture/photos/backdrop_behind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kRoom_width = 240, kRoom_height = 180, kRoomViews = 16;

// A wall with pictures, which the object sweeps over; six photographs or more show each.
Rgba8 room_at(int x, int y) {
    struct Thing {
        int left, top, right, bottom;
        Rgba8 colour;
    };
    static const std::vector<Thing> things{
        {46, 46, 78, 74, {200, 190, 60, 255}},    {54, 54, 70, 66, {30, 30, 34, 255}},
        {152, 50, 184, 82, {60, 130, 70, 255}},   {50, 84, 78, 120, {150, 60, 140, 255}},
        {152, 92, 178, 124, {90, 200, 210, 255}},
    };
    Rgba8 seen{170, 160, 150, 255};
    for (const Thing& thing : things) {
        if (x >= thing.left && x < thing.right && y >= thing.top && y < thing.bottom) seen = thing.colour;
    }
    return seen;
}

// A red blade that turns about an upright axis: seen from its edge it is narrow, from its side wide.
bool is_blade(int view, int x, int y) {
    const double turn = 2 * kPi * view / kRoomViews;
    const double a = 120 + 56 * std::cos(turn), b = 120 - 30 * std::cos(turn);
    return x >= std::min(a, b) - 8 && x < std::max(a, b) + 8 && y >= 40 && y < 130;
}

template <class Room>
std::vector<Image<Rgba8>> photos_before(Room room) {
    std::vector<Image<Rgba8>> photos;
    for (int view = 0; view < kRoomViews; ++view) {
        std::minstd_rand random(static_cast<unsigned>(view) + 1);
        Image<Rgba8> photo(kRoom_width, kRoom_height);
        for (int y = 0; y < kRoom_height; ++y) {
            for (int x = 0; x < kRoom_width; ++x) {
                Rgba8& p = photo(x, y);
                p = is_blade(view, x, y) ? Rgba8{190, 40, 30, 255} : room(x, y);
                const auto noise = static_cast<std::uint8_t>(random() % 3);
                p = {static_cast<std::uint8_t>(p.r + noise), static_cast<std::uint8_t>(p.g + noise),
                     static_cast<std::uint8_t>(p.b + noise), 255};
            }
        }
        photos.push_back(photo);
    }
    return photos;
}

std::vector<Image<Rgba8>> photos_in_the_room() {
    return photos_before(room_at);
}

struct RoomErrors {
    int lost = 0, added = 0;  // px
};

RoomErrors errors_of(const Image<Rgba8>& cut, int view) {
    RoomErrors errors;
    for (int y = 0; y < kRoom_height; ++y) {
        for (int x = 0; x < kRoom_width; ++x) {
            const bool solid = cut(x, y).a >= 128;
            errors.lost += is_blade(view, x, y) && !solid ? 1 : 0;
            errors.added += !is_blade(view, x, y) && solid ? 1 : 0;
        }
    }
    return errors;
}

TEST(CutOutInARoom, WhatStandsBehindTheObjectIsNoObject) {
    const std::vector<Image<Rgba8>> photos = photos_in_the_room();
    const Result<Backdrop> backdrop = test::backdrop_behind(photos);
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    const ObjectCutter cutter(*backdrop, kRoom_width, kRoom_height);
    for (int view = 0; view < kRoomViews; ++view) {
        SCOPED_TRACE(view);
        const RoomErrors errors = errors_of(cutter.cut(photos[static_cast<std::size_t>(view)]), view);
        EXPECT_LE(errors.lost, 60);
        EXPECT_LE(errors.added, 60);
    }
}

// A thing on a striped wall, which looks the same on both sides of the axis, to be seen past the waist of the blade in
// all photographs; what turns sweeps around it.
TEST(CutOutInARoom, WhatIsAlwaysSeenPastTheObjectDoesNotHideTheRoom) {
    const auto wall = [](int x, int y) {
        if (x >= 74 && x < 94 && y >= 82 && y < 88) return Rgba8{60, 90, 190, 255};
        return x / 12 % 2 == 0 ? Rgba8{170, 160, 150, 255} : Rgba8{110, 100, 90, 255};
    };
    std::vector<Image<Rgba8>> photos = photos_before(wall);
    for (int y = 80; y < 90; ++y) {
        for (int x = 0; x < kRoom_width; ++x) {
            if (x >= 112 && x < 128) continue;
            for (Image<Rgba8>& photo : photos) photo(x, y) = wall(x, y);
        }
    }
    const Result<Backdrop> backdrop = test::backdrop_behind(photos);
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    ASSERT_FALSE(backdrop->hidden.empty());
    EXPECT_EQ(backdrop->untouched(84, 85), 0) << "within what the blade sweeps";
    EXPECT_EQ(backdrop->hidden(84, 85), 0);
    EXPECT_NE(backdrop->known(84, 85), 0);
}

TEST(CutOutInARoom, WhoTurnsTheTableIsNoObject) {
    std::vector<Image<Rgba8>> photos = photos_in_the_room();
    for (int y = 120; y < 160; ++y) {
        for (int x = 214; x < kRoom_width; ++x) photos[8](x, y) = {220, 170, 150, 255};  // a hand
    }
    const Result<Backdrop> backdrop = test::backdrop_behind(photos);
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    const RoomErrors errors = errors_of(ObjectCutter(*backdrop, kRoom_width, kRoom_height).cut(photos[8]), 8);
    EXPECT_LE(errors.added, 60) << "of which 1040 are the hand's";
    EXPECT_LE(errors.lost, 60);
}

// A part that is cut off by the same side as the rest stays, and so does a large one.
TEST(ObjectMask, WhatReachesIntoARoomIsNoObject) {
    Image<Rgba8> photo(120, 90, Rgba8{90, 110, 160, 255});
    const auto paint = [&](int left, int top, int right, int bottom) {
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) photo(x, y) = {200, 60, 30, 255};
        }
    };
    paint(40, 10, 80, 90);    // the object, cut off below
    paint(86, 70, 96, 90);    // ... in two parts
    paint(108, 20, 120, 40);  // a hand
    CleanPlateView plate;
    plate.behind = SeenLight(Image<LinearRgb>(120, 90, linear_rgb({90, 110, 160, 255})));
    MaskOptions options;
    EXPECT_EQ(find_object(photo, plate, options)(114, 30), 255);
    options.is_room = true;
    paint(2, 20, 20, 70);  // the other shoe
    const Image<std::uint8_t> mask = find_object(photo, plate, options);
    EXPECT_EQ(mask(10, 40), 255);
    EXPECT_EQ(mask(60, 50), 255);
    EXPECT_EQ(mask(90, 80), 255);
    EXPECT_EQ(mask(114, 30), 0);
}

TEST(ObjectMask, WhatRestsWhereverTheObjectStandsIsNoPartOfIt) {
    Image<Rgba8> photo(120, 90, Rgba8{90, 110, 160, 255});
    for (int y = 30; y < 60; ++y) {
        for (int x = 20; x < 60; ++x) photo(x, y) = {200, 60, 30, 255};
        for (int x = 80; x < 95; ++x) photo(x, y) = {40, 160, 60, 255};
    }
    CleanPlateView plate;
    plate.behind = SeenLight(Image<LinearRgb>(120, 90, linear_rgb({90, 110, 160, 255})));
    EXPECT_EQ(find_object(photo, plate, {})(88, 45), 255);
    plate.still = Image<std::uint8_t>(120, 90);
    for (int y = 30; y < 60; ++y) {
        for (int x = 80; x < 95; ++x) plate.still(x, y) = 255;
        for (int x = 20; x < 60; ++x) plate.still(x, y) = 255;  // of the object, where it is largest, it says nothing
    }
    const Image<std::uint8_t> mask = find_object(photo, plate, {});
    EXPECT_EQ(mask(88, 45), 0);
    EXPECT_EQ(mask(40, 45), 255);
}

// What never moves right above the object may be its lip; what hangs from the ceiling is not.
TEST(ObjectMask, ALipIsRightAboveTheRest) {
    Image<Rgba8> photo(120, 90, Rgba8{90, 110, 160, 255});
    CleanPlateView plate;
    plate.behind = SeenLight(Image<LinearRgb>(120, 90, linear_rgb({90, 110, 160, 255})));
    plate.still = plate.hidden = Image<std::uint8_t>(120, 90);
    const auto paint = [&](int top, int bottom, bool rests) {
        for (int y = top; y < bottom; ++y) {
            for (int x = 40; x < 80; ++x) {
                photo(x, y) = {200, 60, 30, 255};
                if (rests) plate.still(x, y) = plate.hidden(x, y) = 255;
            }
        }
    };
    paint(50, 85, false);
    paint(38, 46, true);
    paint(10, 16, true);
    const Image<std::uint8_t> mask = find_object(photo, plate, {});
    EXPECT_EQ(mask(60, 70), 255);
    EXPECT_EQ(mask(60, 42), 255);
    EXPECT_EQ(mask(60, 13), 0);
}

}  // namespace
}  // namespace rs::capture
