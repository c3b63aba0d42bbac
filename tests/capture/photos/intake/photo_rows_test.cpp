#include "capture/photos/intake/photo_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Names = std::vector<std::string>;
using Rows = std::vector<Names>;

// "label: first..last (count)" of each row.
Names described(Names names) {
    std::ranges::reverse(names);  // the order must come from the names
    Names rows;
    for (const PhotoRow& row : rows_by_name(names)) {
        rows.push_back(row.label + ": " + names[row.photos.front()] + ".." + names[row.photos.back()] + " (" +
                       std::to_string(row.photos.size()) + ")");
    }
    return rows;
}

// Names of rows x columns by a printf format.
Names grid(const char* format, const std::vector<int>& rows, const std::vector<int>& columns) {
    Names names;
    for (const int row : rows) {
        for (const int column : columns) {
            char name[100];
            std::snprintf(name, sizeof name, format, row, column);
            names.emplace_back(name);
        }
    }
    return names;
}

std::vector<int> steps(int first, int last, int step = 1) {
    std::vector<int> values;
    for (int value = first; value <= last; value += step) values.push_back(value);
    return values;
}

Names joined(Names a, const Names& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(PhotoRows, ByKeywords) {
    EXPECT_THAT(
        described(grid("img_r%02d_c%03d.jpg", {1, 2}, steps(1, 13))),
        ElementsAre("r01: img_r01_c001.jpg..img_r01_c013.jpg (13)", "r02: img_r02_c001.jpg..img_r02_c013.jpg (13)"));
    EXPECT_THAT(described(grid("row%d_col%02d.png", {1, 2, 10}, steps(0, 4))),
                ElementsAre("row1: row1_col00.png..row1_col04.png (5)", "row2: row2_col00.png..row2_col04.png (5)",
                            "row10: row10_col00.png..row10_col04.png (5)"));
    EXPECT_THAT(described(grid("Ring %d view %d.JPG", {0, 1}, steps(8, 11))),
                ElementsAre("ring0: Ring 0 view 8.JPG..Ring 0 view 11.JPG (4)",
                            "ring1: Ring 1 view 8.JPG..Ring 1 view 11.JPG (4)"));
    EXPECT_THAT(described(grid("az%2$03d_el%1$02d.png", {0, 30}, steps(0, 330, 30))),
                ElementsAre("el00: az000_el00.png..az330_el00.png (12)", "el30: az000_el30.png..az330_el30.png (12)"));
}

TEST(PhotoRows, ByKeywordsWithUnequalCounts) {
    const Names names = joined(grid("r%d_c%02d.png", {0}, steps(0, 35)), {"r1_c40.png", "r1_c45.png", "r1_c60.png"});
    EXPECT_THAT(described(joined(names, {"r9_c00.png"})),
                ElementsAre("r0: r0_c00.png..r0_c35.png (36)", "r1: r1_c40.png..r1_c60.png (3)",
                            "r9: r9_c00.png..r9_c00.png (1)"));
    EXPECT_THAT(
        described(joined(grid("row%d_%03d.png", {1}, steps(1, 24)), grid("row%d_%03d.png", {2}, steps(25, 48)))),
        ElementsAre("row1: row1_001.png..row1_024.png (24)", "row2: row2_025.png..row2_048.png (24)"))
        << "a counter through all rows";
}

TEST(PhotoRows, ByTwoNumbers) {
    EXPECT_THAT(described(grid("%d-%d.jpg", {1, 2, 3}, steps(1, 24))),
                ElementsAre("1: 1-1.jpg..1-24.jpg (24)", "2: 2-1.jpg..2-24.jpg (24)", "3: 3-1.jpg..3-24.jpg (24)"));
    EXPECT_THAT(described(grid("%d.%02d.jpg", {1, 2}, steps(1, 24))),
                ElementsAre("1: 1.01.jpg..1.24.jpg (24)", "2: 2.01.jpg..2.24.jpg (24)"));
    EXPECT_THAT(described(grid("obj_%d_%d.png", {-10, 0, 30}, steps(0, 350, 10))),
                ElementsAre("-10: obj_-10_0.png..obj_-10_350.png (36)", "0: obj_0_0.png..obj_0_350.png (36)",
                            "30: obj_30_0.png..obj_30_350.png (36)"));
    EXPECT_THAT(described(grid("shoe_v2_%03d_%02d.png", steps(0, 350, 10), {0, 30})),
                ElementsAre("00: shoe_v2_000_00.png..shoe_v2_350_00.png (36)",
                            "30: shoe_v2_000_30.png..shoe_v2_350_30.png (36)"))
        << "the column first, as it has more values";
    EXPECT_THAT(described(grid("%d_%d.png", steps(0, 315, 45), steps(-60, 60, 20))).size(), 7)
        << "azimuth first, as it spans more than half a turn";
    EXPECT_THAT(
        described(joined(grid("%d_%d.png", {0}, steps(0, 350, 10)),
                         joined(grid("%d_%d.png", {60}, steps(0, 330, 30)), {"90_0.png"}))),
        ElementsAre("0: 0_0.png..0_350.png (36)", "60: 60_0.png..60_330.png (12)", "90: 90_0.png..90_0.png (1)"))
        << "fewer photos higher up";
}

TEST(PhotoRows, DecimalAngles) {
    const Names names = {"12.5_0.0.png",  "12.5_22.5.png", "12.5_45.0.png", "12.0_0.0.png", "12.0_22.5.png",
                         "12.0_45.0.png", "-2.5_0.0.png",  "-2.5_22.5.png", "-2.5_45.0.png"};
    EXPECT_THAT(described(names),
                ElementsAre("-2.5: -2.5_0.0.png..-2.5_45.0.png (3)", "12.0: 12.0_0.0.png..12.0_45.0.png (3)",
                            "12.5: 12.5_0.0.png..12.5_45.0.png (3)"));
}

TEST(PhotoRows, ByLettersAndHeights) {
    const auto named = [](const Names& rows, const char* format) {
        Names names;
        for (const std::string& row : rows) {
            for (int column = 1; column <= 24; ++column) {
                char name[100];
                std::snprintf(name, sizeof name, format, row.c_str(), column);
                names.emplace_back(name);
            }
        }
        return names;
    };
    EXPECT_THAT(described(named({"D", "A", "C", "B"}, "%s%02d.jpg")),
                ElementsAre("a: A01.jpg..A24.jpg (24)", "b: B01.jpg..B24.jpg (24)", "c: C01.jpg..C24.jpg (24)",
                            "d: D01.jpg..D24.jpg (24)"));
    EXPECT_THAT(
        described(named({"high", "Low", "middle"}, "cup-%s-%d.jpg")),
        ElementsAre("low: cup-Low-1.jpg..cup-Low-24.jpg (24)", "middle: cup-middle-1.jpg..cup-middle-24.jpg (24)",
                    "high: cup-high-1.jpg..cup-high-24.jpg (24)"));
    EXPECT_THAT(described(named({"H", "L"}, "%s_%d.jpg")),
                ElementsAre("l: L_1.jpg..L_24.jpg (24)", "h: H_1.jpg..H_24.jpg (24)"));
    EXPECT_THAT(described(named({"left", "right"}, "%s_%d.jpg")), IsEmpty());
    EXPECT_THAT(described(named({"L", "R"}, "%s_%d.jpg")), IsEmpty()) << "a stereo pair";
    EXPECT_THAT(described(named({"shoe", "boot"}, "%s_%d.jpg")), IsEmpty()) << "two objects";
}

TEST(PhotoRows, CountersBesideRowAndColumn) {
    Names names;
    int counter = 7;
    for (const int row : {0, 30}) {
        for (const int column : steps(0, 315, 45)) {
            names.push_back("IMG_" + std::to_string(counter++) + "_el" + std::to_string(row) + "_" +
                            std::to_string(column) + ".png");
        }
    }
    EXPECT_THAT(described(names), ElementsAre("el0: IMG_7_el0_0.png..IMG_14_el0_315.png (8)",
                                              "el30: IMG_15_el30_0.png..IMG_22_el30_315.png (8)"));
    names.clear();
    for (const int row : {0, 1}) {
        for (const int column : steps(0, 7)) {
            names.push_back("r" + std::to_string(row) + "_el" + std::to_string(10 + 30 * row) + "_c" +
                            std::to_string(column) + "_az" + std::to_string(45 * column) + ".png");
        }
    }
    EXPECT_THAT(described(names), ElementsAre("r0: r0_el10_c0_az0.png..r0_el10_c7_az315.png (8)",
                                              "r1: r1_el40_c0_az0.png..r1_el40_c7_az315.png (8)"));
}

TEST(PhotoRows, OneRow) {
    const auto one = [](const char* format, const std::vector<int>& values) {
        Names names;
        for (const int value : values) {
            char name[100];
            std::snprintf(name, sizeof name, format, value, value * 10);
            names.emplace_back(name);
        }
        return names;
    };
    for (const char* format :
         {"IMG_%d.JPG", "DSC%05d.jpg", "%d.png", "r_%d.png", "shot2_%02d.jpg", "100_%04d.jpg", "photo (%d).jpg",
          "el%d.png", "view_%d_of_36.png", "%02d_%03ddeg.png", "1920x1080-%d.png", "2024-01-15 %d.jpg",
          "IMG_20240115_%06d.jpg", "c%d.jpg", "row2_col%02d.png"}) {
        EXPECT_THAT(described(one(format, steps(1, 36))), IsEmpty()) << format;
    }
    EXPECT_THAT(described(one("a_%d.png", steps(-30, 30, 5))), IsEmpty()) << "signed angles of one turn";
}

TEST(PhotoRows, NumbersThatAreNoRows) {
    EXPECT_THAT(described(grid("2024-01-15 10.%02d.%02d.jpg", {23, 24}, steps(0, 55, 5))), IsEmpty()) << "a time";
    EXPECT_THAT(described(grid("IMG_202401%02d_1023%02d.jpg", {15, 16}, steps(0, 55, 5))), IsEmpty()) << "two days";
    EXPECT_THAT(described(grid("%02d-%02d-2024.jpg", steps(1, 28), {1, 2})), IsEmpty()) << "a photo a day";
    EXPECT_THAT(described(grid("IMG_%04d_ev%d.jpg", steps(1, 36), {-2, 0, 2})), IsEmpty()) << "exposures";
    EXPECT_THAT(
        described(joined(grid("%d_%04d.jpg", {100}, steps(9980, 9999)), grid("%d_%04d.jpg", {101}, steps(1, 16)))),
        IsEmpty())
        << "the camera's next folder";
    EXPECT_THAT(described(joined(grid("IMG_%d%02d.jpg", {1, 2}, steps(1, 9)), {"IMG_101 (1).jpg"})), IsEmpty())
        << "a copy beside the photos";
    EXPECT_THAT(described(joined(grid("%d-%d.jpg", {1, 2}, steps(1, 9)), {"cover.jpg"})), IsEmpty());
    EXPECT_THAT(described(joined(grid("%d-%d.jpg", {1, 2}, steps(1, 9)), {"1_1.jpg"})), IsEmpty()) << "a pair twice";
    EXPECT_THAT(described(grid("%d-%d.jpg", {1, 2}, {1, 2})), IsEmpty()) << "too few for turns";
    EXPECT_THAT(described({}), IsEmpty());
    EXPECT_THAT(described({"-.jpg", "--.jpg"}), IsEmpty());
    EXPECT_THAT(described({"1.2.3", "", ".", "9999999999999999999999999.jpg"}), IsEmpty());
}

TEST(PhotoRows, ADateBeforeRowAndColumn) {
    EXPECT_THAT(described(grid("2024-01-15_%d-%d.jpg", {1, 2}, steps(1, 24))),
                ElementsAre("1: 2024-01-15_1-1.jpg..2024-01-15_1-24.jpg (24)",
                            "2: 2024-01-15_2-1.jpg..2024-01-15_2-24.jpg (24)"));
}

TEST(PhotoRows, EachPhotoIsInOneRow) {
    const Names names = grid("%d_%d.png", {0, 15, 30, 45}, steps(0, 340, 20));
    std::vector<std::size_t> photos;
    for (const PhotoRow& row : rows_by_name(names)) photos.insert(photos.end(), row.photos.begin(), row.photos.end());
    std::ranges::sort(photos);
    ASSERT_EQ(photos.size(), names.size());
    for (std::size_t i = 0; i < photos.size(); ++i) EXPECT_EQ(photos[i], i);
}

}  // namespace
}  // namespace rs::capture
