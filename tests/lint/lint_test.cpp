// Rules of the house that a compiler does not keep: which folder may know which, who may touch OpenGL, that libraries
// neither print nor exit, that files stay readable in one sitting.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RAYSPACE_SOURCE_DIR;
constexpr int kMostLines = 400;

// Folder -> the folders whose headers it may include, besides its own. The longest matching folder counts.
const std::map<std::string, std::vector<std::string>> kDoors = {
    {"rayspace", {}},
    {"capture/tracer", {"rayspace", "capture/calibration"}},  // the model that synthetic photographs follow
    {"capture/calibration", {"rayspace"}},
    {"capture/photos", {"rayspace", "capture/calibration"}},
    {"capture/tools", {"rayspace", "capture", "datasets-synthetic"}},
    {"encode", {"rayspace"}},
    {"encode/tools", {"rayspace", "encode", "engine"}},  // held-out views are rendered by the engine
    {"engine", {"rayspace"}},
    {"compositor", {"rayspace", "engine"}},
    {"datasets-synthetic", {"rayspace", "capture/tracer"}},
};

bool is_within(const std::string& path, const std::string& folder) {
    return path.rfind(folder + "/", 0) == 0;
}

std::vector<fs::path> sources() {
    std::vector<fs::path> found;
    for (const char* folder :
         {"rayspace", "capture", "encode", "engine", "compositor", "datasets-synthetic", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            const auto extension = entry.path().extension();
            if (extension == ".cpp" || extension == ".hpp") found.push_back(fs::relative(entry.path(), kRoot));
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

std::string door_of(const std::string& path) {
    std::string best;
    for (const auto& [folder, allowed] : kDoors) {
        if (is_within(path, folder) && folder.size() > best.size()) best = folder;
    }
    return best;
}

// Empty when `path` may include `header`.
std::string broken_door(const std::string& path, const std::string& header) {
    const std::string door = door_of(path);
    if (door.empty()) return "";  // tests may know everybody
    if (is_within(header, door)) return "";
    for (const std::string& folder : kDoors.at(door)) {
        if (is_within(header, folder)) return "";
    }
    return door + " must not know " + header;
}

TEST(Doors, TheRuleItselfTellsRightFromWrong) {
    EXPECT_EQ(broken_door("engine/core/renderer.cpp", "rayspace/image.hpp"), "");
    EXPECT_NE(broken_door("engine/core/renderer.cpp", "encode/build.hpp"), "");
    EXPECT_NE(broken_door("rayspace/rig.cpp", "engine/core/renderer.hpp"), "");
    EXPECT_NE(broken_door("capture/tracer/scene.cpp", "datasets-synthetic/objects.hpp"), "");
    EXPECT_EQ(broken_door("capture/tools/synth_command.cpp", "datasets-synthetic/objects.hpp"), "");
    EXPECT_EQ(broken_door("encode/tools/evaluation.cpp", "engine/core/renderer.hpp"), "");
    EXPECT_NE(broken_door("encode/build.cpp", "engine/core/renderer.hpp"), "");
    EXPECT_EQ(broken_door("compositor/viewer/frame.cpp", "engine/core/renderer.hpp"), "");
}

TEST(Doors, FoldersKnowOnlyWhomTheyMay) {
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
    const std::vector<std::string> kMay = {"rayspace/check.hpp", "rayspace/progress.cpp", "rayspace/tool_main.cpp"};
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
