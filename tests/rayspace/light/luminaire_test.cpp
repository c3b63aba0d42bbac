// Photometric files of all editions and layouts against reference values of another program.

#include "rayspace/light/luminaire.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace rs {
namespace {

const std::string kHead = "IESNA:LM-63-2002\r\n[TEST]none\r\n[MORE]at all\r\n[OTHER]the word TILTED, TILT=MAYBE\r\n";
const std::string kNumbers =
    "\r\n2 -1 2 3\r\n2 1 2 .3 , .6 0\r\n.5 1 60\r\n0 45\r\n\r\n90 0,90\r\n4 2\r\n0 8\r\n4 0\r\n";

TEST(IesFile, NumbersMayBeWrappedAnywhereAndFactorsAreAllTaken) {
    const auto read = parse_ies(kHead + "TILT=NONE" + kNumbers, "a.ies");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->format, "LM-63-2002");
    EXPECT_EQ(read->keyword("TEST"), "none at all");
    EXPECT_EQ(read->keyword("OTHER"), "the word TILTED, TILT=MAYBE");
    EXPECT_EQ(read->lumens_per_lamp, -1);
    EXPECT_NEAR(read->web.candela({0, -1, 0}), 4 * 2 * 0.5, 1e-12);
    EXPECT_NEAR(read->web.candela({0, -1, -1}), 4, 1e-12);  // plane 90 at 45 degrees
    EXPECT_NEAR(read->web.candela({1, -1, 0}), 2, 1e-12);
    EXPECT_EQ(read->opening.shape, OpeningShape::kRectangle);
    EXPECT_NEAR(read->opening.along_m, 0.6, 1e-12);
    EXPECT_EQ(read->input_w, 60);
}

TEST(IesFile, SpacesCaseBlankLinesAndByteOrderMarksOfEditorsAreAccepted) {
    for (const std::string head : {"\xEF\xBB\xBFIESNA:LM-63-2002\n", "\n  \nIESNA:LM-63-2002\n", "IESNA: LM-63-2002\n",
                                   "iesna : lm-63-2002 \n"}) {
        for (const std::string tilt : {"TILT=NONE", " tilt = none ", "TILT = NONE"}) {
            const auto read = parse_ies(head + "[TEST] 1\n" + tilt + kNumbers, "a.ies");
            ASSERT_TRUE(read) << head << tilt << read.error().message;
            EXPECT_EQ(read->format, "LM-63-2002") << head;
            EXPECT_EQ(read->keywords.size(), 1U) << head;
        }
    }
    const auto broken = parse_ies("\n\nIESNA:LM-63-2002\nTILT=NONE\n1 x", "a.ies");
    ASSERT_FALSE(broken);
    EXPECT_NE(broken.error().message.find("line 5"), std::string::npos) << broken.error().message;
}

TEST(IesFile, Utf16IsRefusedByName) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a.ies", "a.ldt"}) {
        ASSERT_TRUE(write_file(folder / name, std::string("\xff\xfeI\0", 4)));
        const auto read = read_luminaire(folder / name);
        ASSERT_FALSE(read);
        EXPECT_NE(read.error().message.find("is UTF-16 text; save it as UTF-8"), std::string::npos);
    }
}

TEST(IesFile, TiltStandsInTheFileOrBesideIt) {
    const std::string table = "\n1\n3 0 45\n90\n1 .9 .7\n";
    const auto included = parse_ies(kHead + "TILT=INCLUDE" + table + kNumbers.substr(2), "a.ies");
    ASSERT_TRUE(included) << included.error().message;
    EXPECT_NEAR(included->tilt.factor(60), 0.9 - 0.2 / 3, 1e-12);
    EXPECT_NEAR(included->tilt.factor(-5), 1, 1e-12);
    EXPECT_NEAR(included->tilt.factor(120), 0.7, 1e-12);
    EXPECT_NEAR(included->web.candela({0, -1, 0}), 4, 1e-12);

    const test::TemporaryFolder scratch;
    ASSERT_TRUE(write_file(scratch / "a.ies", kHead + "TILT=lamp.tlt" + kNumbers));
    const auto missing = read_luminaire(scratch / "a.ies");
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("line 5: TILT= names another file, 'lamp.tlt'"), std::string::npos)
        << missing.error().message;
    ASSERT_TRUE(write_file(scratch / "lamp.tlt", table));
    const auto beside = read_luminaire(scratch / "a.ies");
    ASSERT_TRUE(beside) << beside.error().message;
    EXPECT_NEAR(beside->tilt.factor(90), 0.7, 1e-12);
}

TEST(IesFile, EditionsDifferInLabelsFactorsAndShapes) {
    const auto nth = [](const std::string& head, const std::string& numbers) {
        auto read = parse_ies(head + "TILT=NONE\n" + numbers, "a.ies");
        EXPECT_TRUE(read) << (read ? "" : read.error().message);
        return std::move(read).value();
    };
    const std::string web = "0 90\n0\n10 0\n";
    const Luminaire oldest = nth("Made by hand\nin 1987 \xE4\n", "1 1000 1 2 1 1 1 1 0 0 .9 .5 60\n" + web);
    EXPECT_EQ(oldest.format, "LM-63-1986");
    EXPECT_EQ(oldest.keywords.back().second, "in 1987 \xC3\xA4");
    EXPECT_NEAR(oldest.web.candela({0, -1, 0}), 10 * 0.9 * 0.5, 1e-12);
    EXPECT_NEAR(oldest.opening.across_m, 0.3048, 1e-12);
    EXPECT_EQ(nth("IESNA91\n", "1 1000 1 2 1 1 1 1 0 0 .9 .5 60\n" + web).format, "LM-63-1991");
    const Luminaire newest = nth("IES:LM-63-2019\n", "1 -1 1 2 1 1 2 1 0 0 1 1.1 60\n" + web);
    EXPECT_NEAR(newest.web.candela({0, -1, 0}), 10, 1e-12);  // 1.1 says how the file was made

    struct Case {
        const char* edition;
        const char* size;
        OpeningShape shape;
        std::array<double, 3> metres;
    };
    for (const Case& c : {
             Case{"1995", "0 0 0", OpeningShape::kPoint, {0, 0, 0}},
             Case{"1995", "2 3 0", OpeningShape::kRectangle, {2, 3, 0}},
             Case{"1995", "2 3 1", OpeningShape::kBox, {2, 3, 1}},
             Case{"1995", "-2 0 0", OpeningShape::kDisc, {2, 2, 0}},
             Case{"2002", "-2 -2 0", OpeningShape::kDisc, {2, 2, 0}},
             Case{"2002", "-2 -3 0", OpeningShape::kDisc, {2, 3, 0}},
             Case{"1995", "-2 0 1", OpeningShape::kCylinder, {2, 2, 1}},
             Case{"2002", "-2 -2 1", OpeningShape::kCylinder, {2, 2, 1}},
             Case{"1995", "-2 3 1", OpeningShape::kCylinder, {2, 3, 1}},
             Case{"1995", "-2 0 -2", OpeningShape::kEllipsoid, {2, 2, 2}},
             Case{"2002", "-2 -2 -2", OpeningShape::kEllipsoid, {2, 2, 2}},
             Case{"1995", "-2 3 -1", OpeningShape::kEllipsoid, {2, 3, 1}},
             Case{"1995", "0 3 -1", OpeningShape::kCylinderAlong, {1, 3, 1}},
             Case{"1995", "3 0 -1", OpeningShape::kCylinderAcross, {3, 1, 1}},
             Case{"2002", "-1 3 -1", OpeningShape::kCylinderAlong, {1, 3, 1}},
             Case{"2002", "3 -1 -1", OpeningShape::kCylinderAcross, {3, 1, 1}},
         }) {
        const Luminaire read = nth(std::string("IESNA:LM-63-") + c.edition + "\n",
                                   std::string("1 -1 1 2 1 1 2 ") + c.size + " 1 1 60\n" + web);
        EXPECT_EQ(read.opening.shape, c.shape) << c.edition << ": " << c.size;
        EXPECT_EQ((std::array{read.opening.across_m, read.opening.along_m, read.opening.height_m}), c.metres)
            << c.edition << ": " << c.size;
    }
}

TEST(IesFile, ErrorsNameTheLineAndWhatShouldStandThere) {
    const auto message = [](const std::string& text) {
        const auto read = parse_ies(text, "a.ies");
        return read ? std::string("read") : read.error().message;
    };
    EXPECT_EQ(message(""), "a.ies: no line begins with TILT=; use an IES file (LM-63)");
    EXPECT_EQ(message("IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1\n60\n0 ninety\n"),
              "a.ies: line 5: 'ninety' is not a number; expected vertical angle 2");
    EXPECT_EQ(message("IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 60\n0 90\n0\n5"),
              "a.ies: line 6: the file ends before intensity 2; check that it is complete");
    EXPECT_NE(message("TILT=NONE\n1 -1 0 2 1 1 2 0 0 0 1 1 60\n0 90 0 1 1").find("line 2: the candela multiplier"),
              std::string::npos);
    EXPECT_NE(message("TILT=NONE\n1 -1 1 99999 1 1 2").find("line 2: the number of vertical angles"),
              std::string::npos);
    EXPECT_NE(message("TILT=NONE\n1 -1 1 4000 4000 1 2 0 0 0 1 1 60").find("too many"), std::string::npos);
    EXPECT_EQ(message("TILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 60\n0 90 0 0 0"),
              "a.ies: has no light, or more than can be represented");
}

// Lines 1..26, a lamp set, ten ratios, angles, intensities.
std::string eulumdat(int symmetry, int planes, const std::string& lamp_set, const std::string& intensities) {
    std::string text = "Maker\r\n2\r\n" + std::to_string(symmetry) + "\r\n" + std::to_string(planes) + "\r\n" +
                       std::to_string(360 / planes) + "\r\n3\r\n45\r\nReport\r\nLamp\r\nNo 1\r\nfile\r\ndate\r\n";
    for (const char* line : {"600", "300", "80", "500", "0", "0", "0", "0", "0", "100", "80,5", "1.0", "0", "1"}) {
        text += std::string(line) + "\r\n";
    }
    text += lamp_set;
    for (int i = 0; i < 10; ++i) text += "0.5\r\n";
    for (int i = 0; i < planes; ++i) text += std::to_string(i * 360 / planes) + "\r\n";
    return text + "0\r\n45\r\n90\r\n" + intensities;
}

TEST(EulumdatFile, IsReadByItsLinesAndMirroredByItsSymmetry) {
    const std::string lamps = "2\r\nLED\r\n3000\r\n4000 K\r\n80\r\n25\r\n";
    const auto axial = parse_eulumdat(eulumdat(1, 4, lamps, "100\n50\n0\n"), "a.ldt");
    ASSERT_TRUE(axial) << axial.error().message;
    EXPECT_NEAR(axial->web.candela({0, -1, 0}), 300, 1e-9);
    EXPECT_EQ(axial->opening.shape, OpeningShape::kDisc);
    EXPECT_NEAR(axial->opening.across_m, 0.5, 1e-12);
    EXPECT_EQ(axial->input_w, 25);
    EXPECT_EQ(axial->lumens_per_lamp, 1500);

    const auto at = [](const Luminaire& lamp, double horizontal_deg) {
        return candela_in_plane(lamp.web, horizontal_deg, radians(45)) / 3;
    };
    // Planes 270, 0 and 90; 180 equals 0.
    const auto fore = parse_eulumdat(eulumdat(3, 4, lamps, "9 \n1\n0\n9\n2\n0\n9\n3\n0\n"), "a.ldt");
    ASSERT_TRUE(fore) << fore.error().message;
    EXPECT_NEAR(at(*fore, 270), 1, 1e-9);
    EXPECT_NEAR(at(*fore, 0), 2, 1e-9);
    EXPECT_NEAR(at(*fore, 180), 2, 1e-9);
    EXPECT_NEAR(at(*fore, 90), 3, 1e-9);
    const auto side = parse_eulumdat(eulumdat(2, 4, lamps, "9\n1\n0\n9\n2\n0\n9\n3\n0\n"), "a.ldt");
    ASSERT_TRUE(side);
    EXPECT_NEAR(at(*side, 270), 2, 1e-9);
    EXPECT_NEAR(at(*side, 180), 3, 1e-9);
    const auto none = parse_eulumdat(eulumdat(0, 4, lamps, "9\n1\n0\n9\n2\n0\n9\n3\n0\n9\n4\n0\n"), "a.ldt");
    ASSERT_TRUE(none);
    EXPECT_NEAR(at(*none, 315), 2.5, 1e-9);

    const auto cut = parse_eulumdat(eulumdat(1, 4, lamps, "100\n50\n"), "a.ldt");
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().message, "a.ldt: ends before line 52, an intensity; check that it is complete");
    const auto odd = parse_eulumdat(eulumdat(4, 6, lamps, "1\n"), "a.ldt");
    ASSERT_FALSE(odd);
    EXPECT_NE(odd.error().message.find("a.ldt: line 4: 6 C planes cannot be mirrored"), std::string::npos);
}

TEST(Luminaire, SpreadIsBetweenTheOutermostDirectionsOfHalfTheIntensity) {
    const auto read = parse_ies("TILT=NONE\n1 -1 1 4 1 1 2 0 0 0 1 1 9\n0 20 40 90\n0\n100 100 0 0", "a.ies");
    ASSERT_TRUE(read);
    const BeamSpread spread = beam_spread(read->web, 0);
    EXPECT_NEAR(degrees(spread.beam_rad), 60, 0.03);
    EXPECT_NEAR(degrees(spread.field_rad), 76, 0.03);
}

TEST(Luminaire, SpreadOfDirectIndirectOnesIsOfEachSide) {
    const std::string lambertian = "1000 500 0 300 600";  // at 0, 60, 90, 120, 180 degrees
    const auto read = parse_ies("TILT=NONE\n1 -1 1 5 1 1 2 0 0 0 1 1 9\n0 60 90 120 180\n0\n" + lambertian, "a.ies");
    ASSERT_TRUE(read);
    EXPECT_TRUE(is_direct_indirect(read->web));
    EXPECT_NEAR(degrees(beam_spread(read->web, 0, BeamPart::kTowardsAim).beam_rad), 120, 0.03);
    EXPECT_NEAR(degrees(beam_spread(read->web, 0, BeamPart::kOpposite).beam_rad), 120, 0.03);
    const auto down = parse_ies("TILT=NONE\n1 -1 1 4 1 1 2 0 0 0 1 1 9\n0 60 90 180\n0\n1000 500 50 0", "a.ies");
    ASSERT_TRUE(down);
    EXPECT_FALSE(is_direct_indirect(down->web));
}

TEST(LuminaireRealData, LumensAreThoseOfAnIndependentProgram) {
    const auto folder = RS_REAL_DATA_OR_SKIP("ies");
    constexpr std::array kLumens = {9217.18, 5834.2, 13359.57, 5821.76, 753.8, 9230.16, 531.98, 828.32};
    for (std::size_t i = 0; i < kLumens.size(); ++i) {
        const auto read = read_luminaire(folder / (std::to_string(i + 1) + ".IES"));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_NEAR(read->web.zonal_lumens(), kLumens[i], 0.02);
        EXPECT_NEAR(read->web.lumens(), kLumens[i], 0.002 * kLumens[i]);
    }
    int read_all = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "lm63-1995")) {
        const auto read = read_luminaire(entry.path());
        EXPECT_TRUE(read) << (read ? "" : read.error().message);
        read_all += read.ok();
    }
    EXPECT_EQ(read_all, 19);
}

}  // namespace
}  // namespace rs
