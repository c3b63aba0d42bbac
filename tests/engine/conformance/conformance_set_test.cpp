// Tests of the conformance set of the project, and of implementations that do not conform.

#include "engine/conformance/run_vectors.hpp"
#include "rayspace/api/types/executor_table.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace rs::engine {
namespace {

std::unique_ptr<Executor> executor_named(const std::string& name) {
    return std::move(ExecutorTable().create(name)).value();
}

namespace fs = std::filesystem;

VectorSet the_set() {
    const auto set = read_vectors(fs::path(RAYSPACE_SOURCE_DIR) / "engine" / "conformance" / "vectors");
    EXPECT_TRUE(set.ok()) << set.error().message;
    return set.ok() ? *set : VectorSet{};
}

// The first case only, with few views.
VectorSet small_set() {
    VectorSet set = the_set();
    set.cases.resize(1);
    set.cases[0].views.resize(2);
    return set;
}

TEST(ConformanceSet, DefinitionAndCoreMatchTheHashes) {
    const VectorSet set = the_set();
    ASSERT_GE(set.cases.size(), 20U);
    const auto matrix =
        run_vectors(set, {implementation_of(executor_named("scalar")), implementation_of(executor_named("core"))});
    ASSERT_TRUE(matrix.ok()) << matrix.error().message;
    EXPECT_TRUE(matrix->passed());
    for (std::size_t c = 0; c < set.cases.size(); ++c) {
        for (const CaseResult& result : matrix->results[c]) {
            EXPECT_EQ(result.same, static_cast<int>(set.cases[c].views.size()))
                << set.cases[c].name << ": " << result.first << result.declined;
        }
    }
}

// Cases with only empty or only equal images would test nothing.
TEST(ConformanceSet, CasesShowTheirObjects) {
    for (const ConformanceCase& c : the_set().cases) {
        std::set<std::uint64_t> images;
        int shown = 0;
        for (const ConformanceView& view : c.views) {
            images.insert(view.rgba_hash);
            shown += view.object_pixels;
        }
        EXPECT_GT(shown, 500) << c.name;
        EXPECT_GT(images.size(), c.views.size() / 2) << c.name;
    }
}

TEST(ConformanceSet, OneWrongBitIsFound) {
    const VectorSet set = small_set();
    for (const bool in_depth : {false, true}) {
        Implementation wrong = implementation_of(executor_named("scalar"));
        wrong.open = [in_depth](const ConformanceCase& test_case, RaySpaceObject object) -> Result<ExecuteView> {
            auto right = implementation_of(executor_named("scalar")).open(test_case, std::move(object));
            return ExecuteView([right = *right, in_depth](std::size_t v) {
                auto view = right(v);
                if (v == 1 && in_depth) view->depth_q20(3, 3) ^= 1;
                if (v == 1 && !in_depth) view->image(3, 3).g ^= 1;
                return view;
            });
        };
        const auto matrix = run_vectors(set, {wrong});
        ASSERT_TRUE(matrix.ok());
        EXPECT_FALSE(matrix->passed());
        EXPECT_EQ(matrix->results[0][0].same, 1);
        EXPECT_EQ(matrix->results[0][0].different, 1);
        EXPECT_NE(matrix->results[0][0].first.find(in_depth ? "view 1: depths" : "view 1: colours"), std::string::npos)
            << matrix->results[0][0].first;
    }
}

TEST(ConformanceSet, AnImplementationThatDeclinesEverythingFails) {
    const Implementation none{"none", [](const ConformanceCase&, const RaySpaceObject&) -> Result<ExecuteView> {
                                  return Error{"does nothing"};
                              }};
    const auto matrix = run_vectors(small_set(), {implementation_of(executor_named("scalar")), none});
    ASSERT_TRUE(matrix.ok());
    EXPECT_FALSE(matrix->passed());
    EXPECT_EQ(matrix->results[0][1].declined, "does nothing");
}

TEST(ConformanceFiles, RoundTrip) {
    const test::TemporaryFolder work;
    const VectorSet set = small_set();
    ASSERT_TRUE(run_vectors(set, {implementation_of(executor_named("core"))}, work / "out")->passed());
    const auto matrix = run_vectors(set, {implementation_in_files(work / "out")});
    ASSERT_TRUE(matrix.ok()) << matrix.error().message;
    EXPECT_TRUE(matrix->passed()) << matrix->results[0][0].first << matrix->results[0][0].declined;

    const fs::path colours = work / "out" / set.cases[0].name / "1.rgba";
    fs::remove(work / "out" / set.cases[0].name / "1.depth");
    EXPECT_TRUE(run_vectors(set, {implementation_in_files(work / "out")})->passed());  // depth is optional
    fs::resize_file(colours, fs::file_size(colours) - 1);
    const auto cut = run_vectors(set, {implementation_in_files(work / "out")});
    EXPECT_FALSE(cut->passed());
    EXPECT_NE(cut->results[0][0].declined.find("1.rgba"), std::string::npos) << cut->results[0][0].declined;
    fs::remove(colours);
    EXPECT_FALSE(run_vectors(set, {implementation_in_files(work / "out")})->passed());
}

class VectorsFile : public testing::Test {
protected:
    Result<VectorSet> read(const std::string& text) {
        std::ofstream(work_ / kVectorsFile) << text;
        return read_vectors(work_.path());
    }
    test::TemporaryFolder work_;
};

TEST_F(VectorsFile, RoundTrip) {
    VectorSet set = the_set();
    set.folder = work_.path();
    ASSERT_TRUE(write_vectors(set).ok());
    const auto read = read_vectors(work_.path());
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read->cases.size(), set.cases.size());
    EXPECT_EQ(read->edition, set.edition);
    const ConformanceView& expected = set.cases.back().views.back();
    const ConformanceView& found = read->cases.back().views.back();
    EXPECT_EQ(found.rgba_hash, expected.rgba_hash);
    EXPECT_EQ(found.registers.planes.size(), expected.registers.planes.size());
    EXPECT_EQ(found.registers.planes.back().along_tangent.per_row,
              expected.registers.planes.back().along_tangent.per_row);
}

TEST_F(VectorsFile, InvalidFilesAreRejectedByName) {
    const std::string sound_case =
        R"({"name":"a","covers":"b","object":"a.rso","views":[{"registers":{"width":1,"height":1,"ring":0,"b":0,"s":[0,0,0],"planes":[]},"rgba":"0","depth":"0","object_pixels":0}]})";
    EXPECT_TRUE(read(R"({"version":1,"edition":"1","cases":[)" + sound_case + "]}").ok());
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string text = R"({"version":1,"edition":"1","cases":[)" + sound_case + "]}";
        return text.replace(text.find(from), from.size(), to);
    };
    for (const std::string& text :
         {std::string(), std::string("[]"), std::string("{\"version\":1}"), replaced("\"version\":1", "\"version\":2"),
          replaced("\"name\":\"a\"", "\"name\":\"../a\""), replaced("a.rso", "../a.rso"), replaced("a.rso", ".."),
          replaced("\"width\":1", "\"width\":\"1\""), replaced("[0,0,0]", "[0,0]"),
          replaced("\"rgba\":\"0\"", "\"rgba\":\"xyz\""), std::string(R"({"version":1,"edition":"1","cases":[]})")}) {
        const auto set = read(text);
        ASSERT_FALSE(set.ok()) << text;
        EXPECT_NE(set.error().message.find(kVectorsFile), std::string::npos) << set.error().message;
    }
}

TEST_F(VectorsFile, RegistersOutOfRangeAreRejected) {
    const VectorSet sound = small_set();
    const auto refused = [&](const char* what, const std::function<void(ViewRegisters&)>& damage) {
        VectorSet set = sound;
        damage(set.cases[0].views[1].registers);
        const auto matrix = run_vectors(set, {implementation_of(executor_named("scalar"))});
        ASSERT_FALSE(matrix.ok()) << what;
        EXPECT_NE(matrix.error().message.find("view 1"), std::string::npos) << matrix.error().message;
    };
    refused("width", [](ViewRegisters& r) { r.width = 8193; });
    refused("height", [](ViewRegisters& r) { r.height = 0; });
    refused("ring", [](ViewRegisters& r) { r.ring = 1; });
    refused("ring", [](ViewRegisters& r) { r.ring = -1; });
    refused("planes", [](ViewRegisters& r) { r.planes.pop_back(); });
    refused("b", [](ViewRegisters& r) { r.b_q20 = 1 << 28; });
    refused("a", [](ViewRegisters& r) { r.planes[1].a_q20 = -(1 << 28); });
    refused("c", [](ViewRegisters& r) { r.planes[1].c_q20 = 1 << 28; });
    refused("n", [](ViewRegisters& r) { r.planes[1].along_normal.at_origin = std::int64_t{1} << 36; });
    refused("t", [](ViewRegisters& r) { r.planes[1].along_tangent.per_column = std::int64_t{1} << 62; });
    refused("s", [](ViewRegisters& r) { r.rise.per_row = std::int64_t{1} << 33; });
}

}  // namespace
}  // namespace rs::engine
