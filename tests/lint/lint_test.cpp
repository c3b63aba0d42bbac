// Rules of the house that a compiler does not keep: which folder may know which, who may touch OpenGL, that libraries
// neither print nor exit, that files stay readable in one sitting.

#include "tests/lint/doors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

using rs::lint::kDoors;
using rs::lint::means;
using rs::lint::room_of;

const fs::path kRoot = RAYSPACE_SOURCE_DIR;
constexpr int kMostLines = 400;

bool is_within(const std::string& path, const std::string& folder) {
    return path.rfind(folder + "/", 0) == 0;
}

std::vector<fs::path> sources() {
    std::vector<fs::path> found;
    for (const char* folder :
         {"rayspace", "capture", "encode", "engine", "compositor", "datasets-synthetic", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            const auto extension = entry.path().extension();
            if (extension == ".cpp" || extension == ".hpp" || extension == ".inl")
                found.push_back(fs::relative(entry.path(), kRoot));
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::string> lines_of(const fs::path& source) {
    std::ifstream file(kRoot / source);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

struct Include {
    std::string name;
    bool system = false;
    std::size_t line = 0;
};

std::vector<Include> includes_of(const std::vector<std::string>& lines) {
    static const std::regex kInclude(R"(^\s*#\s*include\s+([<"])([^>"]+)[>"])");
    std::vector<Include> includes;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (std::regex_search(lines[i], match, kInclude)) includes.push_back({match[2], match[1] == "<", i + 1});
    }
    return includes;
}

// Empty when `path` may include `header`.
std::string broken_door(const std::string& path, const std::string& header) {
    const std::string room = room_of(path);
    const std::string entered = room_of(header);
    if (room.empty() || room == entered) return "";  // tests may know everybody
    for (const std::string& entry : kDoors.at(room)) {
        if (means(entry, entered)) return "";
    }
    return room + " must not know " + header;
}

TEST(Doors, TheRuleItselfTellsRightFromWrong) {
    EXPECT_EQ(broken_door("engine/core/fast/renderer.cpp", "rayspace/image/image.hpp"), "");
    EXPECT_NE(broken_door("engine/core/fast/renderer.cpp", "encode/build.hpp"), "");
    EXPECT_NE(broken_door("rayspace/geometry/rig.cpp", "engine/core/fast/renderer.hpp"), "");
    EXPECT_NE(broken_door("capture/tracer/scene/scene_check.cpp", "datasets-synthetic/objects.hpp"), "");
    EXPECT_EQ(broken_door("capture/tools/synth_command.cpp", "datasets-synthetic/objects.hpp"), "");
    EXPECT_EQ(broken_door("encode/tools/evaluation.cpp", "engine/core/fast/renderer.hpp"), "");
    EXPECT_NE(broken_door("encode/build.cpp", "engine/core/fast/renderer.hpp"), "");
    EXPECT_EQ(broken_door("compositor/viewer/residency/load_priority.cpp", "engine/core/fast/renderer.hpp"), "");
    EXPECT_NE(broken_door("engine/model/blocks/texels/texel_tags.cpp", "engine/core/fast/renderer.hpp"), "");
    EXPECT_NE(broken_door("rayspace/codec/deblocking.cpp", "rayspace/codec/stream/decode_picture.hpp"), "");
}

TEST(Doors, EveryProductFileStandsInARoom) {
    for (const fs::path& source : sources()) {
        EXPECT_TRUE(is_within(source.string(), "tests") || !room_of(source.string()).empty()) << source;
    }
}

// Rooms can be understood one after the other: who may enter whom has no circle.
TEST(Doors, LeadOneWay) {
    std::set<std::string> understood;
    for (std::size_t before = 1; before != understood.size();) {
        before = understood.size();
        for (const auto& [room, may_enter] : kDoors) {
            bool all = true;
            for (const auto& [other, doors] : kDoors) {
                const bool enters = other != room && std::ranges::any_of(may_enter, [&, &name = other](const auto& e) {
                                        return means(e, name);
                                    });
                all = all && (!enters || understood.contains(other));
            }
            if (all) understood.insert(room);
        }
    }
    for (const auto& [room, may_enter] : kDoors) EXPECT_TRUE(understood.contains(room)) << room;
}

TEST(Doors, RoomsKnowOnlyWhomTheyMay) {
    ASSERT_GT(sources().size(), 40U);
    for (const fs::path& source : sources()) {
        for (const Include& include : includes_of(lines_of(source))) {
            if (include.system) continue;
            EXPECT_EQ(broken_door(source.string(), include.name), "") << source.string() << ":" << include.line;
            EXPECT_TRUE(fs::exists(kRoot / include.name))
                << source.string() << ":" << include.line
                << ": includes are written from the project's root: " << include.name;
        }
    }
}

TEST(Rooms, AreNotLargerThanOneCanSurvey) {
    constexpr int kMostFiles = 30;
    std::map<std::string, int> files;
    for (const fs::path& source : sources()) ++files[source.parent_path().string()];
    for (const auto& [folder, count] : files) EXPECT_LE(count, kMostFiles) << folder;
}

TEST(Doors, OnlyTheCompositorTouchesOpenGl) {
    static const std::regex kGl(R"(^(GL|EGL|GLES\d*|GLFW|epoxy)/)");
    for (const fs::path& source : sources()) {
        // A window is shaken, too.
        if (is_within(source.string(), "tests/hostile")) continue;
        if (is_within(source.string(), "compositor") || is_within(source.string(), "tests/compositor")) continue;
        for (const Include& include : includes_of(lines_of(source))) {
            EXPECT_FALSE(std::regex_search(include.name, kGl)) << source.string() << ":" << include.line;
        }
    }
}

TEST(Libraries, NeitherPrintNorExit) {
    static const std::regex kPrints(R"(\bstd::c(out|err|log)\b|\b(std::)?(f?printf|puts|exit|quick_exit)\s*\()");
    const std::vector<std::string> kMay = {"rayspace/base/check.hpp", "rayspace/base/progress.cpp",
                                           "rayspace/tool/tool_main.cpp"};
    for (const fs::path& source : sources()) {
        const std::string path = source.string();
        if (is_within(path, "tests") || path.find("/tools/") != std::string::npos) continue;
        if (std::find(kMay.begin(), kMay.end(), path) != kMay.end()) continue;
        const std::vector<std::string> lines = lines_of(source);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::string code = lines[i].substr(0, lines[i].find("//"));
            EXPECT_FALSE(std::regex_search(code, kPrints)) << path << ":" << i + 1 << ": " << lines[i];
        }
    }
}

// Names with two underscores, or that begin with one and a capital letter.
TEST(Names, AreNotTheCompilersOwn) {
    static const std::regex kReserved(R"(\b(_[A-Z]\w*|\w*__\w*)\b)");
    const std::set<std::string> kKnown = {"__int128",
                                          "__extension__",
                                          "__builtin_prefetch",
                                          "__builtin_bswap32",
                                          "__LINE__",
                                          "__FILE__",
                                          "_SC_PHYS_PAGES",
                                          "_SC_PAGESIZE",
                                          "_SC_PAGE_SIZE",
                                          "_SC_NPROCESSORS_ONLN",
                                          "__lsan_default_suppressions",
                                          "_INDEXED"};
    for (const fs::path& source : sources()) {
        if (source == "tests/lint/lint_test.cpp") continue;  // the list above
        const std::vector<std::string> lines = lines_of(source);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::string code = lines[i].substr(0, lines[i].find("//"));
            if (code.find('_') == std::string::npos) continue;
            for (std::sregex_iterator name(code.begin(), code.end(), kReserved), end; name != end; ++name) {
                EXPECT_TRUE(kKnown.contains(name->str())) << source.string() << ":" << i + 1 << ": " << name->str();
            }
        }
    }
}

// clang-tidy says it of a main source only, and it reads many as one.
TEST(Names, ThatAreTakenFromElsewhereAreUsed) {
    static const std::regex kUsing(R"(^\s*using (?:\w+::)+(\w+);)");
    std::size_t seen = 0;
    for (const fs::path& source : sources()) {
        if (source.extension() != ".cpp") continue;  // a header may hand names on
        const std::vector<std::string> lines = lines_of(source);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::smatch taken;
            if (!std::regex_search(lines[i], taken, kUsing)) continue;
            ++seen;
            const std::regex name("\\b" + taken[1].str() + "\\b");
            const auto uses = std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
                return &line != &lines[i] && std::regex_search(line.substr(0, line.find("//")), name);
            });
            EXPECT_GT(uses, 0) << source.string() << ":" << i + 1 << ": " << lines[i];
        }
    }
    EXPECT_GT(seen, 100U) << "the pattern finds none";
}

TEST(Files, AreReadInOneSitting) {
    for (const fs::path& source : sources()) {
        EXPECT_LE(lines_of(source).size(), static_cast<std::size_t>(kMostLines)) << source.string();
    }
}

TEST(Files, HaveTellingNames) {
    static const std::regex kVague(R"((^|_)(utils?|common|manager|helpers?|misc)(_|\.))");
    for (const fs::path& source : sources()) {
        EXPECT_FALSE(std::regex_search(source.filename().string(), kVague)) << source.string();
    }
}

TEST(Files, HeadersOpenWithWhatTheyAre) {
    for (const fs::path& source : sources()) {
        if (source.extension() != ".hpp") continue;
        const std::vector<std::string> lines = lines_of(source);
        ASSERT_GE(lines.size(), 2U) << source.string();
        EXPECT_EQ(lines[0], "#pragma once") << source.string();
        EXPECT_EQ(lines[1].rfind("//", 0), 0U)
            << source.string() << ": a header opens with a comment that says what it is";
    }
}

}  // namespace
