// rs-view page: an object or a scene as a web page. tests/web opens such pages in a browser. rs-view export: scenes as
// glTF.

#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/page/html_page.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace rs {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Page : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(write_object(work_ / "a shoe.rso", test::small_object_with_shape()).ok());
        const test::ToolRun run = page({in("a shoe.rso"), "-o", in("probe.html")});
        if (run.err.find("without the web part") != std::string::npos) GTEST_SKIP() << run.err;
    }
    std::string in(const std::string& name) const { return (work_ / name).string(); }
    std::string text(const std::string& name) const {
        const auto bytes = read_file(work_ / name, 1U << 26).value();
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    test::ToolRun page(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "page");
        return test::run_tool(scratch_.path(), "rs-view", arguments);
    }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

TEST_F(Page, OneFileContainsEverything) {
    const test::ToolRun run =
        page({in("a shoe.rso"), "-o", in("shoe.html"), "--title", "Shoe <1>", "--alt", "A \"red\" shoe"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string html = text("shoe.html");
    EXPECT_THAT(html, HasSubstr("<title>Shoe &lt;1&gt;</title>"));
    EXPECT_THAT(html, HasSubstr("alt=\"A &quot;red&quot; shoe\""));
    EXPECT_THAT(html, HasSubstr(base64(read_file(work_ / "a shoe.rso", 1U << 24).value())));
    EXPECT_THAT(html, HasSubstr("core=\"data:application/gzip;base64,"));
    EXPECT_THAT(html, Not(HasSubstr("<script src")));
    EXPECT_EQ(html.find("https://"), std::string::npos);
}

TEST_F(Page, SitesHaveTheFilesOfAServer) {
    const test::ToolRun run = page({in("a shoe.rso"), "--site", in("site")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(text("site/a shoe.rso"), text("a shoe.rso"));
    EXPECT_THAT(text("site/index.html"), HasSubstr("src=\"a%20shoe.rso\""));
    EXPECT_THAT(text("site/index.html"), HasSubstr("<script src=\"ray-space.js\"></script>"));
    EXPECT_EQ(text("site/ray-space.wasm").substr(0, 4), std::string("\0asm", 4));
    EXPECT_THAT(text("site/ray-space.js"), HasSubstr("ray-space"));
    EXPECT_EQ(text("site/poster.png").substr(1, 3), "PNG");
    EXPECT_EQ(page({in("a shoe.rso"), "--site", in("site")}).exit_code, 0) << "replaces its own files";
    std::ofstream(work_ / "site" / "notes.txt") << "mine";
    EXPECT_EQ(page({in("a shoe.rso"), "--site", in("site")}).exit_code, 1);
    EXPECT_EQ(page({in("a shoe.rso"), "--site", in("site"), "--force"}).exit_code, 0);
}

constexpr const char* kHall = R"({"nodes": [{"box": [1, 1, 1]}, {"object": "a shoe.rso", "translate": [0, 0.5, 0]}]})";

TEST_F(Page, ScenesContainTheirObjects) {
    std::ofstream(work_ / "hall.json") << kHall;
    const test::ToolRun run = page({in("hall.json"), "-o", in("hall.html"), "--alt", "A <hall>"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const std::string html = text("hall.html");
    EXPECT_THAT(html, HasSubstr("<title>hall</title>"));
    EXPECT_THAT(html, HasSubstr("<ray-space-scene alt=\"A &lt;hall&gt;\""));
    EXPECT_THAT(html, HasSubstr("\"a%20shoe.rso\":\"data:application/octet-stream;base64," +
                                base64(read_file(work_ / "a shoe.rso", 1U << 24).value())));
    EXPECT_THAT(html, Not(HasSubstr("<script src")));
    ASSERT_EQ(page({in("hall.json"), "--site", in("site")}).exit_code, 0);
    EXPECT_EQ(text("site/a shoe.rso"), text("a shoe.rso"));
    EXPECT_THAT(text("site/scene.glb"), HasSubstr("\"url\":\"a%20shoe.rso\""));
    // Several objects, and one with lights, are scenes, too.
    ASSERT_EQ(page({in("a shoe.rso"), in("a shoe.rso"), "-o", in("two.html")}).exit_code, 0);
    EXPECT_THAT(text("two.html"), HasSubstr("<ray-space-scene"));
    EXPECT_THAT(text("probe.html"), Not(HasSubstr("<ray-space-scene")));
}

TEST_F(Page, MissingObjectsOfScenesAreStated) {
    std::ofstream(work_ / "hall.json") << R"({"nodes": [{"box": [1, 1, 1]}, {"object": "none.rso"}]})";
    const test::ToolRun run = page({in("hall.json"), "-o", in("hall.html")});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_THAT(run.err, HasSubstr("none.rso"));
    EXPECT_THAT(run.err, HasSubstr("omitted"));
    const test::ToolRun required = page({in("hall.json"), "--object", in("none.rso"), "-o", in("hall.html")});
    EXPECT_EQ(required.exit_code, 1);
    std::ofstream(work_ / "hall.json") << kHall;
    EXPECT_EQ(page({in("hall.json"), "-o", in("hall.json")}).exit_code, 2);
}

TEST_F(Page, ExportedScenesAreReadAgain) {
    std::ofstream(work_ / "hall.json") << kHall;
    const auto view = [&](std::vector<std::string> arguments) {
        return test::run_tool(scratch_.path(), "rs-view", arguments);
    };
    const test::ToolRun run = view({"export", in("hall.json"), "-o", in("hall.glb")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(text("hall.glb").substr(0, 4), "glTF");
    EXPECT_THAT(text("hall.glb"), HasSubstr("\"url\":\"a%20shoe.rso\""));
    const test::ToolRun again = view({"export", in("hall.glb"), "-o", in("again.glb")});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(view({"export", in("hall.json"), "-o", in("hall.obj")}).exit_code, 2);
    EXPECT_EQ(view({"export", in("hall.glb"), "-o", in("hall.glb")}).exit_code, 1) << "would overwrite its input";
}

TEST_F(Page, ScriptAndModuleAreSmall) {
    ASSERT_EQ(page({in("a shoe.rso"), "-o", in("shoe.html")}).exit_code, 0);
    // Base64 of the module compressed with gzip, the script as it is, and the poster. As servers compress them, script
    // and module are to stay below 200 KB.
    const std::uintmax_t object_bytes = std::filesystem::file_size(work_ / "a shoe.rso");
    EXPECT_LT(std::filesystem::file_size(work_ / "shoe.html"), 370'000 + 4 * object_bytes);
}

TEST_F(Page, DamagedObjectsAndWrongUseAreRefused) {
    std::string damaged = text("a shoe.rso");
    damaged[damaged.size() - 40] ^= 1;
    std::ofstream(work_ / "damaged.rso", std::ios::binary) << damaged;
    const test::ToolRun run = page({in("damaged.rso"), "-o", in("damaged.html")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr("damaged.rso: "));
    EXPECT_FALSE(std::filesystem::exists(work_ / "damaged.html"));
    EXPECT_EQ(page({in("a shoe.rso")}).exit_code, 2);
    EXPECT_EQ(page({in("a shoe.rso"), "-o", in("x.html"), "--site", in("x")}).exit_code, 2);
    EXPECT_EQ(page({in("a shoe.rso"), "-o", in("x.rso")}).exit_code, 2);
    EXPECT_EQ(page({in("a shoe.rso"), "-o", in("x.html"), "--force"}).exit_code, 2);
    EXPECT_EQ(page({in("absent.rso"), "-o", in("x.html")}).exit_code, 1);
}

}  // namespace
}  // namespace rs
