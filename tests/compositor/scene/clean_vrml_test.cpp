#include "compositor/scene/vrml/clean_vrml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rs::compositor::vrml {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

CleanVrml cleaned(const std::string& body) {
    const Result<CleanVrml> clean = clean_vrml("#VRML V2.0 utf8\n" + body, "hall.wrl");
    EXPECT_TRUE(clean) << clean.error().message << "\nin " << body;
    return clean ? *clean : CleanVrml{};
}

std::string cleaning_error(const std::string& body) {
    const Result<CleanVrml> clean = clean_vrml("#VRML V2.0 utf8\n" + body, "hall.wrl");
    return clean ? "no error" : clean.error().message;
}

TEST(CleanVrml, KeepsWhatItKnows) {
    const CleanVrml clean =
        cleaned("Shape { geometry DEF Ball Sphere { radius +2.5e0 } } # end\nGroup{children[USE Ball]}");
    EXPECT_EQ(clean.text,
              "#VRML V2.0 utf8\n Shape { geometry DEF n0 Sphere { radius 2.5 } }\n Group { children [ ] }\n");
    ASSERT_EQ(clean.nodes.size(), 1U);
    EXPECT_EQ(clean.nodes[0].name, "Ball");
    EXPECT_EQ(clean.nodes[0].line, 2);
    EXPECT_THAT(clean.warnings, ElementsAre("hall.wrl: line 3: USE 'Ball': is no child node; left out"));
}

TEST(CleanVrml, DropsUnknownFieldsOfAnyTypeWithLineAndName) {
    for (const char* value : {"1", "1 2 3", "TRUE", "\"a\"", "[ 1 2 [ ] ]", "Sphere { radius [ { } ] }",
                              "DEF X Box { }", "USE X", "NULL", "[ Box { } Box { } ]", "[ ]"}) {
        const CleanVrml clean = cleaned(std::string("Group {\n mirror ") + value + "\n children [ Group { } ] }");
        EXPECT_THAT(clean.warnings, ElementsAre("hall.wrl: line 3: Group has no field 'mirror'; left out")) << value;
        EXPECT_EQ(clean.text, "#VRML V2.0 utf8\n Group { children [ Group { } ] }\n") << value;
    }
}

TEST(CleanVrml, ShowsTheChildrenOfUnknownNodes) {
    const CleanVrml clean = cleaned("Vendor { gloss 1 children [ Shape { } ] }\nShape { geometry Teapot { size 3 } }");
    EXPECT_EQ(clean.text, "#VRML V2.0 utf8\n Group { children [ Shape { } ] }\n Shape { geometry NULL }\n");
    EXPECT_THAT(clean.warnings, ElementsAre("hall.wrl: line 2: 'Vendor' is no known node; only its children are shown",
                                            "hall.wrl: line 3: 'Teapot' is no known node; left out"));
}

TEST(CleanVrml, LeavesOutWhatOnlyMattersInTime) {
    const CleanVrml clean = cleaned(
        "DEF T TimeSensor { loop TRUE } DEF S Script { url \"javascript: { } \" field SFNode n USE T eventIn SFBool b "
        "}\n"
        "ROUTE T.time TO S.set Sound { source AudioClip { } } Group { ROUTE a.b TO c.d children [ ROUTE e TO f ] }");
    EXPECT_EQ(clean.text, "#VRML V2.0 utf8\n Group { children [ ] }\n");
    EXPECT_THAT(clean.warnings, IsEmpty());
}

TEST(CleanVrml, BreaksRings) {
    const CleanVrml clean =
        cleaned("DEF A Group { children [ DEF B Group { children [ USE A USE B ] } USE B ] }\nUSE A");
    EXPECT_EQ(clean.text,
              "#VRML V2.0 utf8\n DEF n0 Group { children [ DEF n1 Group { children [ ] } USE n1 ] }\n USE n0\n");
    EXPECT_THAT(clean.warnings, ElementsAre(HasSubstr("USE 'A' stands inside of that node itself"),
                                            HasSubstr("USE 'B' stands inside of that node itself")));
}

TEST(CleanVrml, NamesInsideOfDroppedNodesAreGone) {
    const CleanVrml clean = cleaned("Shape { geometry Group { children DEF A Shape { } } }\nUSE A");
    EXPECT_EQ(clean.text, "#VRML V2.0 utf8\n Shape { geometry NULL }\n");
    EXPECT_THAT(clean.warnings, ElementsAre(HasSubstr("'Group' cannot stand as geometry"), HasSubstr("USE 'A'")));
}

TEST(CleanVrml, PrototypesGoFirstWithPlainNames) {
    const CleanVrml clean = cleaned(
        "PROTO Ball [ field SFFloat r 1 eventIn SFBool in ] { Shape { geometry Sphere { radius IS r } } Script { in IS "
        "in } }\n"
        "Group { children Ball { r 2 in 3 q 4 } }");
    EXPECT_EQ(clean.text,
              "#VRML V2.0 utf8\nPROTO p0 [ field SFFloat f0 1 ] { Shape { geometry DEF n0 Sphere { radius IS f0 } } }\n"
              " Group { children [ p0 { f0 2 } ] }\n");
    EXPECT_THAT(clean.warnings, ElementsAre("hall.wrl: line 3: Ball has no field 'q'; left out"));
}

TEST(CleanVrml, AFieldOfAPrototypeMustBeOfTheSameType) {
    const CleanVrml clean = cleaned(
        "PROTO P [ field SFColor c 1 1 1 ] { Shape { geometry Sphere { radius IS c } } } P { } Box { IS IS IS }");
    EXPECT_THAT(clean.warnings, ElementsAre(HasSubstr("'c' is SFColor but should be SFFloat"),
                                            HasSubstr("'Box' cannot stand as child")));
}

TEST(CleanVrml, RefusesWithTheLine) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"Group {\n children [\n", "line 3: the list of children is not closed"},
        {"Group {\n\n", "line 2: the { is not closed"},
        {"\n}", "line 3: a node should stand here, not '}'"},
        {"Shape { geometry\nSphere { radius \"wide\" } }", "line 3: radius takes SFFloat, not 'wide'"},
        {"Shape { geometry Sphere { radius [ 1 ] } }", "line 2: radius takes SFFloat"},
        {"Transform { translation 1 2 }", "line 2: translation takes SFVec3f, not '}'"},
        {"Transform { translation 1 2 1e39 }", "line 2: translation: '1e39' is no number that fits"},
        {"Transform { translation 1 2 3x }", "line 2: translation: '3x' is no number that fits"},
        {"Switch { whichChoice 1.5 }", "line 2: whichChoice takes SFInt32"},
        {"Switch { whichChoice 99999999999 }", "line 2: whichChoice takes SFInt32"},
        {"Collision { collide true }", "line 2: collide takes SFBool"},
        {"Inline { url \"a\n\n", "line 2: the text that begins here has no end"},
        {"Shape { appearance Appearance { texture PixelTexture { image 100000 100000 3 0 } } }", "cannot be read"},
        {"PROTO P [ field SFFlaot r 1 ] { Group { } }", "line 2: 'SFFlaot' is no type"},
        {"PROTO P [ field SFFloat r 1 field SFFloat r 1 ] { Group { } }", "two fields 'r'"},
    };
    for (const auto& [body, expected] : cases) {
        EXPECT_THAT(cleaning_error(body), AllOf(HasSubstr("hall.wrl: "), HasSubstr(expected), Not(HasSubstr("\n"))))
            << body;
    }
}

TEST(CleanVrml, RefusesOtherFormatsByName) {
    for (const char* text :
         {"", "#VRML V1.0 ascii\n", "#X3D V3.0 utf8\n", "#Inventor V2.1 ascii\n", "<X3D/>", "\x1f\x8b"}) {
        const Result<CleanVrml> clean = clean_vrml(text, "hall.wrl");
        ASSERT_FALSE(clean) << text;
        EXPECT_THAT(clean.error().message, AllOf(HasSubstr("hall.wrl: line 1: "), HasSubstr("VRML97")));
    }
}

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

TEST(CleanVrml, RefusesWhatNestsOrUnfoldsTooFar) {
    EXPECT_THAT(cleaning_error(repeated("Group { children ", 300)), HasSubstr("deep"));
    EXPECT_THAT(cleaning_error(repeated("PROTO P [ ] { ", 300)), HasSubstr("deep"));
    EXPECT_EQ(cleaning_error("Vendor { x " + repeated("[", 100000) + repeated("]", 100000) + " }"), "no error");
    // Each doubles the one before.
    std::string doubling = "DEF N0 Group { } ";
    std::string prototypes = "PROTO P0 [ ] { Group { } } ";
    std::string deep = "DEF D0 Group { } ";
    for (int i = 1; i < 64; ++i) {
        const std::string before = std::to_string(i - 1);
        const std::string now = std::to_string(i);
        doubling += "DEF N" + now + " Group { children [ USE N" + before + " USE N" + before + " ] }\n";
        prototypes += "PROTO P" + now + " [ ] { Group { children [ P" + before + " { } P" + before + " { } ] } }\n";
        deep += "DEF D" + now + " " + repeated("Group { children ", 50) + "USE D" + before + repeated(" }", 50) + "\n";
    }
    EXPECT_THAT(cleaning_error(doubling), HasSubstr("unfold to too much"));
    EXPECT_THAT(cleaning_error(prototypes + "P63 { }"), HasSubstr("unfold to too much"));
    EXPECT_THAT(cleaning_error(deep), HasSubstr("more than 1000 deep"));
    // A large list that each instance of a PROTO would copy.
    const std::string list = "PROTO L [ ] { Shape { geometry PointSet { coord Coordinate { point [ " +
                             repeated("1 2 3 ", 100000) + "] } } } }\n";
    EXPECT_EQ(cleaning_error(list + repeated("L { } ", 10)), "no error");
    EXPECT_THAT(cleaning_error(list + repeated("L { } ", 200)), HasSubstr("unfold to too much"));
}

TEST(CleanVrml, CountsTheWarningsThatItDoesNotShow) {
    const CleanVrml clean = cleaned(repeated("Group { a 1 }\n", 200));
    ASSERT_EQ(clean.warnings.size(), kMaxWarnings + 1);
    EXPECT_THAT(clean.warnings.back(), HasSubstr("and 150 more warnings"));
}

}  // namespace
}  // namespace rs::compositor::vrml
