#include "compositor/scene/vrml/graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <utility>

namespace rs::compositor::vrml {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Graph read(const std::string& body) {
    Result<Graph> graph = read_graph("#VRML V2.0 utf8\n" + body, "hall.wrl");
    EXPECT_TRUE(graph) << graph.error().message << "\nin " << body;
    return graph ? std::move(*graph) : Graph{};
}

std::string reading_error(const std::string& body) {
    const Result<Graph> graph = read_graph("#VRML V2.0 utf8\n" + body, "hall.wrl");
    return graph ? "no error" : graph.error().message;
}

// "Group { children [ Shape { } ] }", given fields in alphabetical order.
std::string to_text(const std::vector<NodePointer>& nodes) {
    std::ostringstream text;
    const char* between = "";
    for (const NodePointer& node : nodes) {
        text << between << (node->name.empty() ? "" : "DEF " + node->name + " ") << node->type << " {";
        for (const auto& [name, value] : node->fields) {
            text << " " << name << " [";
            for (const double number : value.numbers) text << " " << number;
            for (const std::string& string : value.texts) text << " \"" << string << '"';
            text << (value.nodes.empty() ? "" : " ") << to_text(value.nodes) << " ]";
        }
        text << " }";
        between = ", ";
    }
    return text.str();
}

TEST(VrmlGraph, KeepsWhatItKnows) {
    const Graph graph = read("Shape { geometry DEF Ball Sphere { radius +2.5e0 } } # end\nGroup{children[USE Ball]}");
    EXPECT_EQ(to_text(graph.roots),
              "Shape { geometry [ DEF Ball Sphere { radius [ 2.5 ] } ] }, Group { children [ ] }");
    EXPECT_EQ(graph.roots.at(0)->node("geometry")->line, 2);
    EXPECT_THAT(graph.warnings, ElementsAre("hall.wrl: line 3: USE 'Ball': is no child node; left out"));
}

TEST(VrmlGraph, DropsUnknownFieldsOfAnyTypeWithLineAndName) {
    for (const char* value : {"1", "1 2 3", "TRUE", "\"a\"", "[ 1 2 [ ] ]", "Sphere { radius [ { } ] }",
                              "DEF X Box { }", "USE X", "NULL", "[ Box { } Box { } ]", "[ ]"}) {
        const Graph graph = read(std::string("Group {\n mirror ") + value + "\n children [ Group { } ] }");
        EXPECT_THAT(graph.warnings, ElementsAre("hall.wrl: line 3: Group has no field 'mirror'; left out")) << value;
        EXPECT_EQ(to_text(graph.roots), "Group { children [ Group { } ] }") << value;
    }
}

TEST(VrmlGraph, ShowsTheChildrenOfUnknownNodes) {
    const Graph graph = read("Vendor { gloss 1 children [ Shape { } ] }\nShape { geometry Teapot { size 3 } }");
    EXPECT_EQ(to_text(graph.roots), "Group { children [ Shape { } ] }, Shape { geometry [ ] }");
    EXPECT_THAT(graph.warnings,
                ElementsAre("hall.wrl: line 2: 'Vendor' is an unknown node; only its children are drawn",
                            "hall.wrl: line 3: 'Teapot' is an unknown node; left out"));
}

TEST(VrmlGraph, LeavesOutWhatOnlyMattersInTime) {
    const Graph graph = read(
        "DEF T TimeSensor { loop TRUE } DEF S Script { url \"javascript: { } \" field SFNode n USE T eventIn SFBool b "
        "}\n"
        "ROUTE T.time TO S.set Sound { source AudioClip { } } Group { ROUTE a.b TO c.d children [ ROUTE e TO f ] }");
    EXPECT_EQ(to_text(graph.roots), "Group { children [ ] }");
    EXPECT_THAT(graph.warnings, IsEmpty());
}

TEST(VrmlGraph, BreaksRings) {
    const Graph graph = read("DEF A Group { children [ DEF B Group { children [ USE A USE B ] } USE B ] }\nUSE A");
    ASSERT_EQ(graph.roots.size(), 2U);
    EXPECT_EQ(graph.roots[0], graph.roots[1]);
    EXPECT_EQ(to_text({graph.roots[0]}),
              "DEF A Group { children [ DEF B Group { children [ ] }, DEF B Group { children [ ] } ] }");
    EXPECT_THAT(graph.warnings, ElementsAre(HasSubstr("USE 'A' is inside of that node itself"),
                                            HasSubstr("USE 'B' is inside of that node itself")));
}

TEST(VrmlGraph, NamesInsideOfDroppedNodesStay) {
    const Graph graph = read("Shape { geometry Group { children DEF A Shape { } } }\nUSE A");
    EXPECT_EQ(to_text(graph.roots), "Shape { geometry [ ] }, DEF A Shape { }");
    EXPECT_THAT(graph.warnings, ElementsAre(HasSubstr("'Group' is not allowed as geometry")));
}

TEST(VrmlGraph, ANodeThatIsNotGivenAFieldHasItsDefault) {
    const Graph graph = read("Viewpoint { description \"a\\\"b\\\\\" }");
    EXPECT_EQ(graph.roots.at(0)->triple("position"), glm::dvec3(0, 0, 10));
    EXPECT_EQ(graph.roots.at(0)->text("description"), "a\"b\\");
    EXPECT_TRUE(graph.roots.at(0)->flag("jump"));
}

TEST(VrmlGraph, PrototypesUnfold) {
    const Graph graph = read(
        "PROTO Ball [ field SFFloat r 1 eventIn SFBool in ] { Shape { geometry Sphere { radius IS r } } Script { in IS "
        "in } }\n"
        "Group { children [ Ball { r 2 in 3 q 4 } DEF B Ball { } USE B ] }");
    EXPECT_EQ(to_text(graph.roots),
              "Group { children [ Shape { geometry [ Sphere { radius [ 2 ] } ] }, "
              "Shape { geometry [ Sphere { radius [ 1 ] } ] }, Shape { geometry [ Sphere { radius [ 1 ] } ] } ] }");
    EXPECT_EQ(graph.roots.at(0)->field("children").nodes.at(1), graph.roots[0]->field("children").nodes.at(2));
    EXPECT_THAT(graph.warnings, ElementsAre("hall.wrl: line 3: Ball has no field 'q'; left out"));
}

TEST(VrmlGraph, InstancesInsideOfPrototypesTakeTheFieldsAroundThem) {
    const Graph graph = read(
        "PROTO In [ field SFFloat r 1 field MFNode more [ ] ] {\n"
        "  Group { children [ DEF S Shape { geometry Sphere { radius IS r } } USE S Group { children IS more } ] } }\n"
        "PROTO Out [ field SFFloat size 5 ] { In { r IS size more [ In { r IS size } Shape { } ] } }\n"
        "Out { size 7 } Out { }");
    const auto expected = [](const std::string& radius) {
        const std::string ball = "DEF S Shape { geometry [ Sphere { radius [ " + radius + " ] } ] }";
        const auto in = [&](const std::string& more) {
            return "Group { children [ " + ball + ", " + ball + ", Group { children [ " + more + "] } ] }";
        };
        return in(in("") + ", Shape { } ");
    };
    EXPECT_EQ(to_text(graph.roots), expected("7") + ", " + expected("5"));
    const auto& children = graph.roots.at(0)->field("children").nodes;
    EXPECT_EQ(children.at(0), children.at(1)) << "USE is of the same instance's node";
    EXPECT_NE(children.at(0), graph.roots.at(1)->field("children").nodes.at(0));
    EXPECT_THAT(graph.warnings, IsEmpty());
}

TEST(VrmlGraph, WhatComesThroughAPrototypesFieldsMustFit) {
    const Graph graph = read(
        "PROTO P [ field SFNode shape NULL ] { Shape { geometry IS shape } }\nP { shape Sphere { } }\n"
        "P { shape Group { } }");
    EXPECT_EQ(to_text(graph.roots), "Shape { geometry [ Sphere { } ] }, Shape { geometry [ ] }");
    EXPECT_THAT(graph.warnings, ElementsAre("hall.wrl: line 2: Shape: Group is not allowed as geometry; left out"));
}

TEST(VrmlGraph, AFieldOfAPrototypeMustBeOfTheSameType) {
    const Graph graph =
        read("PROTO P [ field SFColor c 1 1 1 ] { Shape { geometry Sphere { radius IS c } } } P { } Box { IS IS IS }");
    EXPECT_THAT(graph.warnings, ElementsAre(HasSubstr("'c' is SFColor but should be SFFloat"),
                                            HasSubstr("'Box' is not allowed as child")));
}

TEST(VrmlGraph, RefusesWithTheLine) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"Group {\n children [\n", "line 3: the list of children is not closed"},
        {"Group {\n\n", "line 2: the { is not closed"},
        {"\n}", "line 3: expected a node, not '}'"},
        {"Shape { geometry\nSphere { radius \"wide\" } }", "line 3: radius takes SFFloat, not 'wide'"},
        {"Shape { geometry Sphere { radius [ 1 ] } }", "line 2: radius takes SFFloat"},
        {"Transform { translation 1 2 }", "line 2: translation takes SFVec3f, not '}'"},
        {"Transform { translation 1 2 1e39 }", "line 2: translation: '1e39' is not a number in range"},
        {"Transform { translation 1 2 3x }", "line 2: translation: '3x' is not a number in range"},
        {"Switch { whichChoice 1.5 }", "line 2: whichChoice takes SFInt32"},
        {"Switch { whichChoice 99999999999 }", "line 2: whichChoice takes SFInt32"},
        {"Collision { collide true }", "line 2: collide takes SFBool"},
        {"Inline { url \"a\n\n", "line 2: the string that begins here is not closed"},
        {"Shape { appearance Appearance { texture PixelTexture { image 100000 100000 3 0 } } }", "cannot be read"},
        {"PROTO P [ field SFFlaot r 1 ] { Group { } }", "line 2: 'SFFlaot' is not a field type"},
        {"PROTO P [ field SFFloat r 1 field SFFloat r 1 ] { Group { } }", "two fields 'r'"},
    };
    for (const auto& [body, expected] : cases) {
        EXPECT_THAT(reading_error(body), AllOf(HasSubstr("hall.wrl: "), HasSubstr(expected), Not(HasSubstr("\n"))))
            << body;
    }
}

TEST(VrmlGraph, RefusesOtherFormatsByName) {
    for (const char* text : {"", "#VRML V1.0 ascii\n", "#Inventor V2.1 ascii\n", "<X3D/>", "\x1f\x8b"}) {
        const Result<Graph> graph = read_graph(text, "hall.wrl");
        ASSERT_FALSE(graph) << text;
        EXPECT_THAT(graph.error().message, AllOf(HasSubstr("hall.wrl: line 1: "), HasSubstr("VRML97")));
    }
}

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

TEST(VrmlGraph, RefusesWhatNestsOrUnfoldsTooFar) {
    EXPECT_THAT(reading_error(repeated("Group { children ", 300)), HasSubstr("deep"));
    EXPECT_THAT(reading_error(repeated("PROTO P [ ] { ", 300)), HasSubstr("deep"));
    EXPECT_EQ(reading_error("Vendor { x " + repeated("[", 100000) + repeated("]", 100000) + " }"), "no error");
    // Each level doubles the one before.
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
    EXPECT_THAT(reading_error(doubling), HasSubstr("expand to too many nodes"));
    EXPECT_THAT(reading_error(prototypes + "P63 { }"), HasSubstr("expand to too many nodes"));
    EXPECT_THAT(reading_error(deep), HasSubstr("more than 1000 deep"));
    // Without limits these would expand to 2^64 nodes, or need a stack as deep as the text is long.
    std::string fields = "PROTO P0 [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } } ";
    std::string chain = fields;
    for (int i = 1; i < 2000; ++i) {
        const std::string inner = "P" + std::to_string(i - 1) + " { r IS r }";
        const std::string head = "PROTO P" + std::to_string(i) + " [ field SFFloat r 1 ] { ";
        if (i < 64) fields += head + "Group { children [ " + inner + " " + inner + " ] } }\n";
        chain += head + inner + " }\n";
    }
    EXPECT_THAT(reading_error(fields + "P63 { }"), HasSubstr("expand to too many nodes"));
    EXPECT_THAT(reading_error(chain + "P1999 { }"), HasSubstr("deep"));
    // Large list that each instance of a PROTO would copy; parts that do not differ are shared.
    const std::string list = "[ field SFFloat r 1 field MFVec3f l [ " + repeated("1 2 3 ", 100000) +
                             "] ] { Shape { geometry PointSet { coord ";
    const std::string copied = "PROTO L " + list + "Coordinate { point IS l } } } }\n";
    EXPECT_EQ(reading_error(copied + repeated("L { } ", 10)), "no error");
    EXPECT_THAT(reading_error(copied + repeated("L { } ", 200)), HasSubstr("expand to too many nodes"));
    EXPECT_EQ(reading_error("PROTO L " + list + "Coordinate { } } } }\n" + repeated("L { } ", 200)), "no error");
}

TEST(VrmlGraph, CountsTheWarningsThatItDoesNotShow) {
    const Graph graph = read(repeated("Group { a 1 }\n", 200));
    ASSERT_EQ(graph.warnings.size(), kMaxWarnings + 1);
    EXPECT_THAT(graph.warnings.back(), HasSubstr("and 150 more warnings"));
}

}  // namespace
}  // namespace rs::compositor::vrml
