// Rules that a compiler does not check: sources include only headers of targets that theirs links, libraries neither
// print nor exit, names and comments follow the style guide.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RAYSPACE_SOURCE_DIR;

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

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

// Target of the product in the graph written by CMake (rs_write_target_graph).
struct Target {
    std::string name;
    std::string folder;
    std::vector<std::string> linked;           // own dependencies
    std::vector<std::string> linked_by_users;  // PUBLIC and INTERFACE dependencies
};

class TargetGraph {
public:
    explicit TargetGraph(std::istream& text) {
        for (std::string line; std::getline(text, line);) {
            const std::size_t linked = line.find(" :");
            const std::size_t by_users = line.find(" :", linked + 2);
            const std::vector<std::string> head = words_of(line.substr(0, linked));
            if (head.size() != 3) continue;  // a target of the project's root has no folder
            targets_[head[0]] = {head[0], head[2], words_of(line.substr(linked + 2, by_users - linked - 2)),
                                 words_of(line.substr(by_users + 2))};
        }
        for (const auto& [name, target] : targets_) {
            std::set<std::string>& folders = includable_[target.folder];
            folders.insert(target.folder);
            for (const std::string& linked : reachable(target)) folders.insert(targets_.at(linked).folder);
        }
    }

    [[nodiscard]] std::size_t size() const { return targets_.size(); }

    // Innermost folder of a target that contains the file, or an empty string.
    [[nodiscard]] std::string folder_of(const std::string& path) const {
        std::string longest;
        for (const auto& [folder, may_include] : includable_) {
            if (is_within(path, folder) && folder.size() > longest.size()) longest = folder;
        }
        return longest;
    }

    [[nodiscard]] bool may_include(const std::string& path, const std::string& header) const {
        const auto includable = includable_.find(folder_of(path));
        return includable != includable_.end() && includable->second.contains(folder_of(header));
    }

    // A target that links itself transitively, or an empty string.
    [[nodiscard]] std::string cyclic_target() const {
        for (const auto& [name, target] : targets_) {
            std::set<std::string> checked;
            std::vector<std::string> open = target.linked;
            open.insert(open.end(), target.linked_by_users.begin(), target.linked_by_users.end());
            while (!open.empty()) {
                const std::string next = open.back();
                open.pop_back();
                if (next == name) return name;
                if (!targets_.contains(next) || !checked.insert(next).second) continue;
                for (const auto* more : {&targets_.at(next).linked, &targets_.at(next).linked_by_users}) {
                    open.insert(open.end(), more->begin(), more->end());
                }
            }
        }
        return "";
    }

private:
    // Targets whose headers `target` may include: those it links, and their public dependencies.
    [[nodiscard]] std::set<std::string> reachable(const Target& target) const {
        std::set<std::string> found;
        std::vector<std::string> open = target.linked;
        open.insert(open.end(), target.linked_by_users.begin(), target.linked_by_users.end());
        while (!open.empty()) {
            const std::string next = open.back();
            open.pop_back();
            if (!targets_.contains(next) || !found.insert(next).second) continue;
            const std::vector<std::string>& more = targets_.at(next).linked_by_users;
            open.insert(open.end(), more.begin(), more.end());
        }
        return found;
    }

    std::map<std::string, Target> targets_;
    std::map<std::string, std::set<std::string>> includable_;  // folder -> folders
};

TargetGraph product_graph() {
    std::ifstream file(RAYSPACE_TARGET_GRAPH);
    return TargetGraph(file);
}

TEST(Layering, FollowsTheLinksOfTargets) {
    std::istringstream text(
        "base STATIC_LIBRARY a/base :  : \n"
        "image STATIC_LIBRARY a/image : base secret : base\n"
        "secret STATIC_LIBRARY a/secret :  : \n"
        "tool EXECUTABLE a/tools : image : \n");
    const TargetGraph graph(text);
    EXPECT_TRUE(graph.may_include("a/tools/main.cpp", "a/image/x.hpp"));
    EXPECT_TRUE(graph.may_include("a/tools/main.cpp", "a/base/x.hpp")) << "public through image";
    EXPECT_FALSE(graph.may_include("a/tools/main.cpp", "a/secret/x.hpp")) << "private to image";
    EXPECT_FALSE(graph.may_include("a/base/x.cpp", "a/image/x.hpp"));
    EXPECT_FALSE(graph.may_include("b/x.cpp", "a/base/x.hpp"));
    EXPECT_EQ(graph.cyclic_target(), "");
    std::istringstream circle("a STATIC_LIBRARY a : b : \nb STATIC_LIBRARY b : a : \n");
    EXPECT_NE(TargetGraph(circle).cyclic_target(), "");
}

TEST(Layering, TargetsHaveNoCycles) {
    const TargetGraph graph = product_graph();
    ASSERT_GT(graph.size(), 40U);
    EXPECT_EQ(graph.cyclic_target(), "");
}

// Tests may include everything.
TEST(Layering, SourcesIncludeOnlyWhatTheirTargetLinks) {
    const TargetGraph graph = product_graph();
    ASSERT_GT(sources().size(), 40U);
    for (const fs::path& source : sources()) {
        for (const Include& include : includes_of(lines_of(source))) {
            if (include.system) continue;
            const std::string place = source.string() + ":" + std::to_string(include.line);
            EXPECT_TRUE(fs::exists(kRoot / include.name))
                << place << ": write includes relative to the project's root: " << include.name;
            if (is_within(source.string(), "tests")) continue;
            // The plug-in uses inline functions of the libraries that load it, and links none of them.
            if (is_within(source.string(), "rayspace/image_io/backend")) continue;
            EXPECT_TRUE(graph.may_include(source.string(), include.name))
                << place << ": " << include.name << " belongs to no target that this one links";
        }
    }
}

TEST(Layering, OnlyTheCompositorUsesOpenGl) {
    static const std::regex kGl(R"(^(GL|EGL|GLES\d*|GLFW|epoxy)/)");
    for (const fs::path& source : sources()) {
        // These tests drive a window.
        if (is_within(source.string(), "tests/hostile")) continue;
        if (is_within(source.string(), "compositor") || is_within(source.string(), "tests/compositor")) continue;
        for (const Include& include : includes_of(lines_of(source))) {
            EXPECT_FALSE(std::regex_search(include.name, kGl)) << source.string() << ":" << include.line;
        }
    }
}

TEST(Libraries, NeitherPrintNorExit) {
    static const std::regex kPrints(R"(\bstd::c(out|err|log)\b|\b(std::)?(f?printf|puts|exit|quick_exit)\s*\()");
    const std::vector<std::string> kMay = {"rayspace/api/types/check.hpp", "rayspace/base/progress.cpp",
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
TEST(Names, AreNotReserved) {
    static const std::regex kReserved(R"(\b(_[A-Z]\w*|\w*__\w*)\b)");
    const std::set<std::string> kKnown = {"__int128",
                                          "__extension__",
                                          "__builtin_prefetch",
                                          "__builtin_bswap32",
                                          "__LINE__",
                                          "__COUNTER__",
                                          "__VA_ARGS__",
                                          "__doc__",
                                          "__FILE__",
                                          "_SC_PHYS_PAGES",
                                          "_SC_PAGESIZE",
                                          "_SC_PAGE_SIZE",
                                          "_SC_NPROCESSORS_ONLN",
                                          "__lsan_default_suppressions",
                                          "__doc__",
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

// clang-tidy checks this in a main source only, and the tidy target joins many sources.
TEST(Names, OfUsingDeclarationsAreUsed) {
    static const std::regex kUsing(R"(^\s*using (?:\w+::)+(\w+);)");
    std::size_t checked = 0;
    for (const fs::path& source : sources()) {
        if (source.extension() != ".cpp") continue;  // a header may re-export names
        const std::vector<std::string> lines = lines_of(source);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::smatch taken;
            if (!std::regex_search(lines[i], taken, kUsing)) continue;
            ++checked;
            const std::regex name("\\b" + taken[1].str() + "\\b");
            const auto uses = std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
                return &line != &lines[i] && std::regex_search(line.substr(0, line.find("//")), name);
            });
            EXPECT_GT(uses, 0) << source.string() << ":" << i + 1 << ": " << lines[i];
        }
    }
    EXPECT_GT(checked, 100U) << "the pattern matches nothing";
}

// The first word of a comment block names its subject: "Weights of ...", not "What the weights are".
TEST(Comments, StateFacts) {
    static const std::regex kComment(R"(^\s*//+\s*(\w+)?)");
    const std::set<std::string> kOpenings = {"What", "Of", "Where", "Whether", "Who", "How", "Which", "That"};
    for (const fs::path& source : sources()) {
        bool within = false;
        const std::vector<std::string> lines = lines_of(source);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::smatch comment;
            const bool is_comment = std::regex_search(lines[i], comment, kComment);
            if (is_comment && !within) {
                EXPECT_FALSE(kOpenings.contains(comment[1])) << source.string() << ":" << i + 1 << ": " << lines[i];
            }
            within = is_comment;
        }
    }
}

TEST(Files, HaveSpecificNames) {
    static const std::regex kVague(R"((^|_)(utils?|common|manager|helpers?|misc)(_|\.))");
    for (const fs::path& source : sources()) {
        EXPECT_FALSE(std::regex_search(source.filename().string(), kVague)) << source.string();
    }
}

TEST(Files, HeadersOpenWithADescription) {
    for (const fs::path& source : sources()) {
        if (source.extension() != ".hpp") continue;
        const std::vector<std::string> lines = lines_of(source);
        ASSERT_GE(lines.size(), 2U) << source.string();
        EXPECT_EQ(lines[0], "#pragma once") << source.string();
        EXPECT_EQ(lines[1].rfind("//", 0), 0U)
            << source.string() << ": a header opens with a comment that describes it";
    }
}

}  // namespace
