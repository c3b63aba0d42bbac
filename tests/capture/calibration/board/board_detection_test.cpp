// The board's corners in pictures that are drawn through the turntable's model, lens distortion included.

#include "capture/calibration/board/board_calibration.hpp"
#include "capture/calibration/board/board_sheet.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/capture/calibration/board_turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rs::capture {
namespace {

constexpr int kSamples = 3;  // per pixel and direction

// The board as a function of a point on it, in squares from the top left; 0 ink, 1 paper.
class PrintedBoard {
public:
    explicit PrintedBoard(const BoardDesign& design) : design_(design), across_(marker_cells_across(design)) {
        for (int y = 0; y < design.squares_y; ++y) {
            for (int x = 0; x < design.squares_x; ++x) {
                const int marker = marker_of_square(design, x, y);
                if (marker >= 0) cells_[marker] = black_marker_cells(design, marker);
            }
        }
    }
    [[nodiscard]] float paper(double u, double v) const {
        const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
        if (!square_is_printed(design_, x, y)) return 1;
        if (square_is_black(x, y)) return 0;
        const double share = design_.marker_share;
        const double cu = (u - x - 0.5 * (1 - share)) / share * across_;
        const double cv = (v - y - 0.5 * (1 - share)) / share * across_;
        if (cu < 0 || cv < 0 || cu >= across_ || cv >= across_) return 1;
        const auto cell = static_cast<std::size_t>(static_cast<int>(cv) * across_ + static_cast<int>(cu));
        return cells_.at(marker_of_square(design_, x, y))[cell] ? 0 : 1;
    }

private:
    BoardDesign design_;
    int across_;
    std::map<int, std::vector<bool>> cells_;
};

// The turn of make_turn() with a smaller picture.
BoardTurn small_turn(const test::TurnOptions& options, std::uint32_t seed) {
    BoardTurn turn = test::make_turn(options, seed);
    Lens& lens = turn.model.lens;
    lens.width = 1024, lens.height = 768;
    lens.cx = 512, lens.cy = 384;
    lens.f_px *= 0.64;
    return turn;
}

// Paper and ink are grey, around the board is table; a disc of `hidden_mm` radius upright in the middle hides what is
// behind it, as an object does.
Image<Rgba8> drawn(const BoardTurn& turn, const BoardDesign& design, std::size_t view, double hidden_mm = 0) {
    const PrintedBoard printed(design);
    const Lens& lens = turn.model.lens;
    std::mt19937 random(static_cast<std::uint32_t>(view) + 50);
    std::normal_distribution<float> noise(0, 1.5F);
    Image<Rgba8> picture(lens.width, lens.height);
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            float light = 0;
            for (int s = 0; s < kSamples * kSamples; ++s) {
                const glm::dvec2 p(x + (s % kSamples + 0.5) / kSamples, y + (s / kSamples + 0.5) / kSamples);
                const auto ray = table_ray(lens, turn.model.pose, p);
                if (!ray) continue;
                const double angle = -turn.model.angles_rad[view];  // into the object's frame
                const glm::dvec3 from = turned({0, 0, 1}, angle), along = turned(*ray, angle);
                const glm::dvec3& normal = turn.board.object_from_board[1];
                const double t = glm::dot(normal, turn.board.middle - from) / glm::dot(normal, along);
                const glm::dvec3 on_board = glm::transpose(turn.board.object_from_board) *
                                            (from + t * along - turn.board.middle) / turn.board.units_per_mm;
                const double u = on_board.x / design.square_mm + 0.5 * design.squares_x;
                const double v = on_board.z / design.square_mm + 0.5 * design.squares_y;
                const bool on_paper =
                    t > 0 && std::min(u, v) > -1 && u < design.squares_x + 1 && v < design.squares_y + 1;
                const bool hidden = hidden_mm > 0 && std::hypot(p.x - 0.5 * lens.width, p.y - 0.5 * lens.height) <
                                                         hidden_mm * turn.board.units_per_mm * lens.f_px;
                light += hidden ? 0.3F : on_paper ? 0.04F + 0.66F * printed.paper(u, v) : 0.2F;
            }
            const float grey = srgb8_from_linear(light / (kSamples * kSamples)) + noise(random);
            const auto code = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
            picture(x, y) = {code, code, code, 255};
        }
    }
    return picture;
}

struct Found {
    double rms_px = 0, worst_px = 0;
    std::size_t count = 0;
};

Found compare(const BoardCorners& seen, const BoardTurn& turn, const BoardDesign& design, std::size_t view) {
    Found found;
    for (const SeenCorner& one : seen.corners) {
        const auto p = project(turn.model.lens, turn.model.pose, test::corner_in_table(turn, design, one.corner, view));
        const double off = p ? glm::length(*p - one.p) : 1e9;
        found.rms_px += off * off;
        found.worst_px = std::max(found.worst_px, off);
        ++found.count;
    }
    found.rms_px = std::sqrt(found.rms_px / static_cast<double>(std::max<std::size_t>(1, found.count)));
    return found;
}

struct Scene {
    const char* name;
    double elevation_deg;
    double roll_deg;
    std::size_t fewest;
};
class BoardDetection : public testing::TestWithParam<Scene> {};

TEST_P(BoardDetection, FindsCornersWithinATenthOfAPixel) {
    test::TurnOptions options;
    options.elevation_deg = GetParam().elevation_deg;
    options.roll_rad = radians(GetParam().roll_deg);
    const BoardTurn turn = small_turn(options, 2);
    for (const std::size_t view : {std::size_t{0}, std::size_t{4}}) {
        SCOPED_TRACE("view " + std::to_string(view));
        const auto seen = detect_board(drawn(turn, {}, view).view(), {});
        ASSERT_TRUE(seen) << seen.error().message;
        const Found found = compare(*seen, turn, {}, view);
        EXPECT_GE(found.count, GetParam().fewest);
        EXPECT_LT(found.rms_px, 0.1);
        EXPECT_LT(found.worst_px, 0.4);
        RecordProperty("rms_px", std::to_string(found.rms_px));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, BoardDetection,
                         testing::Values(Scene{"Grazing", 15, 0.5, 50}, Scene{"Twenty", 20, 0.5, 60},
                                         Scene{"Sideways", 20, 90, 55}, Scene{"Fortyfive", 45, 0.5, 64},
                                         Scene{"Steep", 70, 0.5, 60}),
                         [](const auto& scene) { return scene.param.name; });

TEST(BoardDetectionOfHidden, WhatAnObjectHidesIsNotSeen) {
    test::TurnOptions options;
    options.elevation_deg = 40;
    const BoardTurn turn = small_turn(options, 3);
    const double hidden_mm = 25;
    const auto seen = detect_board(drawn(turn, {}, 5, hidden_mm).view(), {});
    ASSERT_TRUE(seen);
    const Found found = compare(*seen, turn, {}, 5);
    EXPECT_GE(found.count, 24U);
    EXPECT_LT(found.rms_px, 0.1);
    const double radius_px = hidden_mm * turn.board.units_per_mm * turn.model.lens.f_px;
    for (const SeenCorner& one : seen->corners) {
        EXPECT_GT(glm::length(one.p - glm::dvec2(512, 384)), radius_px - 1) << one.corner;
    }
}

TEST(BoardDetectionOfHidden, ABlankBoardIsFoundByEitherDesign) {
    test::TurnOptions options;
    options.elevation_deg = 40;
    const BoardTurn turn = small_turn(options, 3);
    BoardDesign blank;
    blank.blank_mm = 60;
    const Image<Rgba8> picture = drawn(turn, blank, 2);
    for (const BoardDesign& design : {blank, BoardDesign{}}) {
        const auto seen = detect_board(picture.view(), design);
        ASSERT_TRUE(seen);
        const Found found = compare(*seen, turn, design, 2);
        EXPECT_GE(found.count, 24U);
        EXPECT_LT(found.rms_px, 0.1);
        // Without its marker a white square still is one, so only a missing black square takes a corner away.
        for (const SeenCorner& one : seen->corners) {
            const int x = one.corner % 8, y = one.corner / 8;
            for (const int dx : {0, 1}) {
                for (const int dy : {0, 1}) {
                    EXPECT_TRUE(!square_is_black(x + dx, y + dy) || square_is_printed(blank, x + dx, y + dy))
                        << one.corner;
                }
            }
        }
    }
}

TEST(BoardDetectionOfHidden, APictureWithoutABoardShowsNone) {
    std::mt19937 random(1);
    Image<std::uint8_t> noise(320, 240);
    for (std::uint8_t& pixel : noise.pixels()) pixel = static_cast<std::uint8_t>(random());
    const auto seen = detect_board(std::as_const(noise).view(), {});
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->corners.empty());
    EXPECT_TRUE(detect_board(ConstImageView<std::uint8_t>(), {})->corners.empty());
    BoardDesign wrong;
    wrong.dictionary = "none";
    EXPECT_FALSE(detect_board(std::as_const(noise).view(), wrong));
}

TEST(BoardDetectionOfPrint, ThePrintedPictureIsItselfDetected) {
    BoardDesign blank;
    blank.blank_mm = 50;
    BoardDesign other{7, 11, 12, 0.6, "5x5_50", 0};
    for (const BoardDesign& design : {BoardDesign{}, blank, other}) {
        const double dpi = 96;
        const auto picture = board_picture(design, dpi);
        ASSERT_TRUE(picture) << picture.error().message;
        const auto seen = detect_board(picture->view(), design);
        ASSERT_TRUE(seen);
        std::size_t printed = 0;
        for (int i = 0; i < corner_count(design); ++i) printed += corner_is_printed(design, i) ? 1 : 0;
        EXPECT_EQ(seen->corners.size(), printed);
        const glm::dvec2 middle = design.square_mm * glm::dvec2(0.5 * design.squares_x + 1, 0.5 * design.squares_y + 1);
        for (const SeenCorner& one : seen->corners) {
            const glm::dvec2 truth = (corner_mm(design, one.corner) + middle) * (dpi / 25.4);
            EXPECT_LT(glm::length(one.p - truth), 0.1) << one.corner;
        }
    }
}

TEST(BoardDetectionOfTurn, PicturesGiveTheModel) {
    test::TurnOptions options;
    options.views = 6;
    options.elevation_deg = 30;
    options.step_rad = radians(60);
    const BoardTurn turn = small_turn(options, 4);
    const auto load = [&](int view) -> Result<Image<Rgba8>> {
        return drawn(turn, {}, static_cast<std::size_t>(view), 20);
    };
    const auto views = detect_boards(options.views, load, {}, nullptr);
    ASSERT_TRUE(views) << views.error().message;
    const auto found = calibrate_with_board(*views, {}, 1024, 768, {});
    ASSERT_TRUE(found) << found.error().message;
    const Calibration& c = found->calibration;
    EXPECT_LT(c.rms_px, 0.15);
    EXPECT_NEAR(c.model.lens.f_px / turn.model.lens.f_px, 1, 0.006);
    EXPECT_NEAR(degrees(c.model.pose.tilt_rad), degrees(turn.model.pose.tilt_rad), 0.1);
    EXPECT_NEAR(degrees(c.model.angles_rad[3]), degrees(turn.model.angles_rad[3]), 0.05);

    const auto failing = [&](int view) -> Result<Image<Rgba8>> {
        return Error{"picture " + std::to_string(view) + " is damaged"};
    };
    EXPECT_FALSE(detect_boards(3, failing, {}, nullptr));
}

}  // namespace
}  // namespace rs::capture
