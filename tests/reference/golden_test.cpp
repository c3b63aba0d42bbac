// Golden files: both decoders give the recorded samples of valid files, and reject invalid ones with the recorded
// messages.

#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/reference/golden_planes.hpp"
#include "tests/reference/library_tiles.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace rs::golden {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(RAYSPACE_SOURCE_DIR) / "tests" / "reference" / "golden";

// The lines of a text file without comments and empty lines.
std::vector<std::string> lines_of(const fs::path& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file.good()) << path;
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty() && line[0] != '#') lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> parts_of(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = text.find(separator, begin)) != std::string::npos;
         begin = end + separator.size()) {
        parts.push_back(text.substr(begin, end - begin));
    }
    parts.push_back(text.substr(begin));
    return parts;
}

std::set<std::string> files_in(const fs::path& folder) {
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.insert(entry.path().filename().string());
    return files;
}

template <class Value>
std::set<std::string> names_of(const std::map<std::string, Value>& map) {
    std::set<std::string> names;
    for (const auto& [name, value] : map) names.insert(name);
    return names;
}

std::map<std::string, std::vector<PlaneSums>> expected_planes() {
    std::map<std::string, std::vector<PlaneSums>> expected;
    for (const std::string& line : lines_of(kFolder / "planes.txt")) {
        std::istringstream in(line);
        std::string name;
        std::size_t view = 0;
        PlaneSums sums{};
        in >> name >> view >> std::hex;
        for (std::uint64_t& sum : sums) in >> sum;
        EXPECT_TRUE(in && view == expected[name].size()) << line;
        expected[name].push_back(sums);
    }
    return expected;
}

std::vector<PlaneSums> tile_sums(const RaySpaceObject& object) {
    std::vector<PlaneSums> sums;
    for (const reference::LibraryPlanes& planes : reference::decode_by_tiles(*object.coded)) {
        sums.emplace_back();
        for (std::size_t p = 0; p < 4; ++p) {
            sums.back()[p] = plane_sum(planes[p].view(), object.width, object.height);
        }
    }
    return sums;
}

TEST(GoldenFiles, ValidOnesDecodeToTheirSums) {
    const auto expected = expected_planes();
    EXPECT_EQ(names_of(expected), files_in(kFolder / "valid"));
    std::map<std::string, int> kinds;
    for (const auto& [name, sums] : expected) {
        SCOPED_TRACE(name);
        const auto file = ContainerReader::open(kFolder / "valid" / name);
        ASSERT_TRUE(file.ok()) << file.error().message;
        const FileSums by_reference = reference_sums(*file);
        EXPECT_EQ(by_reference.error, "");
        EXPECT_EQ(by_reference.views, sums);
        const auto object = read_object(*file);
        ASSERT_TRUE(object.ok()) << object.error().message;
        EXPECT_EQ(object_sums(*object), sums);
        if (object->coded) {
            EXPECT_EQ(tile_sums(*object), sums);
        }
        ++kinds[!object->coded ? "raw" : name_of(object->coded->profile)];
        for (const Ring& ring : object->rings) kinds["with a shape"] += ring.shape.empty() ? 0 : 1;
        EXPECT_LT(file->size_bytes(), 60000U);
    }
    EXPECT_GE(kinds["raw"], 3);
    EXPECT_GE(kinds["dense"], 6);
    EXPECT_GE(kinds["board"], 4);
    EXPECT_GE(kinds["with a shape"], 3);
}

// Detects a hash that is equal for all files, which no other test would.
TEST(GoldenFiles, SumsTellImagesApart) {
    std::set<std::uint64_t> luma;
    std::size_t images = 0;
    for (const auto& [name, views] : expected_planes()) {
        for (const PlaneSums& sums : views) luma.insert(sums[0]);
        images += views.size();
    }
    EXPECT_GT(images, 60U);
    EXPECT_GT(luma.size(), images * 3 / 4);
}

struct Refusal {
    bool is_of_codec = false;
    std::string made_of;
    std::vector<std::string> words;
};

std::map<std::string, Refusal> expected_refusals() {
    std::map<std::string, Refusal> expected;
    for (const std::string& line : lines_of(kFolder / "refusals.txt")) {
        const std::vector<std::string> parts = parts_of(line, "; ");
        EXPECT_EQ(parts.size(), 4U) << line;
        if (parts.size() != 4) continue;
        EXPECT_TRUE(parts[1] == "codec" || parts[1] == "file") << line;
        EXPECT_TRUE(fs::exists(kFolder / "valid" / parts[2])) << line;
        const bool is_new =
            expected.try_emplace(parts[0], Refusal{parts[1] == "codec", parts[2], parts_of(parts[3], " | ")}).second;
        EXPECT_TRUE(is_new) << line;
    }
    return expected;
}

std::string refusal_of(const fs::path& path) {
    const auto object = read_object(path);
    return object.ok() ? "" : object.error().message;
}

TEST(GoldenFiles, InvalidOnesAreRefusedForTheirReason) {
    const auto expected = expected_refusals();
    EXPECT_EQ(names_of(expected), files_in(kFolder / "invalid"));
    int of_codec = 0;
    for (const auto& [name, refusal] : expected) {
        SCOPED_TRACE(name);
        const fs::path path = kFolder / "invalid" / name;
        const std::string message = refusal_of(path);
        for (const std::string& word : refusal.words) {
            EXPECT_NE(message.find(word, path.string().size()), std::string::npos)
                << "wanted: " << word << "\nfound:  " << message;
        }
        EXPECT_EQ(message.rfind(path.string(), 0), 0U) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_LT(fs::file_size(path), 20000U);
        if (!refusal.is_of_codec) continue;
        ++of_codec;
        const auto file = ContainerReader::open(path);
        ASSERT_TRUE(file.ok()) << file.error().message;
        EXPECT_NE(reference_sums(*file).error, "");
    }
    std::cout << expected.size() << " invalid files, " << of_codec << " of them by CODE or a coded PICT\n";
    EXPECT_GE(expected.size(), 40U);
    EXPECT_GE(of_codec, 20);
}

}  // namespace
}  // namespace rs::golden
