// Command line of `rs-encode evaluate`, and the report of `rs-encode build --report`.

#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace rs {
namespace {

using testing::HasSubstr;

class Evaluate : public testing::Test {
protected:
    void SetUp() override {
        Rig rig = make_ring({.count = 12, .fl_px = 80, .width = 64, .height = 52});
        rig.object_radius = 0.9;
        test::write_drawn_set(work_ / "set", rig);
        rig.views.resize(2);
        test::write_drawn_set(work_ / "two", rig);
    }

    std::string in(const std::string& name) const { return (work_ / name).string(); }
    test::ToolRun run(const std::vector<std::string>& arguments) const {
        return test::run_tool(scratch_.path(), "rs-encode", arguments);
    }
    void expect_failure(const std::vector<std::string>& arguments, const std::vector<std::string>& mentions) const {
        const test::ToolRun failed = run(arguments);
        EXPECT_EQ(failed.exit_code, 1) << failed.err;
        EXPECT_EQ(std::count(failed.err.begin(), failed.err.end(), '\n'), 1) << failed.err;
        for (const std::string& mention : mentions) EXPECT_THAT(failed.err, HasSubstr(mention));
    }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

TEST_F(Evaluate, ScoresEveryMethodOnHeldOutViews) {
    const test::ToolRun done =
        run({"evaluate", in("set"), "--hold-out", "every-3rd", "-o", in("answers"), "--json", "-q"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const auto json = nlohmann::json::parse(done.out);
    EXPECT_EQ(json["views_held_out"], nlohmann::json({1, 4, 7, 10}));
    EXPECT_EQ(json["views_kept"].size(), 8U);
    ASSERT_EQ(json["methods"].size(), 3U);
    for (const auto& method : json["methods"]) {
        const std::string name = method["method"];
        ASSERT_EQ(method["views"].size(), 4U) << name;
        EXPECT_EQ(method["views"][1]["picture"], "4.png");
        EXPECT_GT(method["mean_psnr_db"].get<double>(), 5) << name;
        EXPECT_LE(method["pooled_psnr_db"].get<double>(), method["mean_psnr_db"].get<double>() + 1e-9) << name;
        for (const char* image : {"0001.png", "0010.png"}) {
            EXPECT_TRUE(std::filesystem::exists(work_ / "answers" / name / image)) << name;
            EXPECT_TRUE(std::filesystem::exists(work_ / "answers" / (name + "-error") / image)) << name;
        }
        EXPECT_FALSE(std::filesystem::exists(work_ / "answers" / name / "0000.png")) << name;
    }
    const auto truth = read_image(work_ / "answers" / "truth" / "0004.png");
    const auto captured = read_image(work_ / "set" / "4.png");
    ASSERT_TRUE(truth.ok() && captured.ok());
    EXPECT_EQ(*truth, *captured);
}

TEST_F(Evaluate, PrintsATableOfTheRequestedMethods) {
    const test::ToolRun done =
        run({"evaluate", in("set"), "--methods", "plane,photo", "--planes", "6", "--views", "-q"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("every-2nd"));
    EXPECT_THAT(done.out, HasSubstr("11.png"));
    EXPECT_LT(done.out.find("\nplane "), done.out.find("\nphoto "));
    EXPECT_EQ(done.out.find("shape"), std::string::npos);
}

TEST_F(Evaluate, ReportsErrors) {
    expect_failure({"evaluate", in("set"), "--methods", "photo,foto", "-q"}, {"foto", "photo,plane,shape"});
    expect_failure({"evaluate", in("set"), "--hold-out", "half", "-q"}, {"half", "every-2nd"});
    expect_failure({"evaluate", in("set"), "--planes", "2", "-q"}, {"--planes 2", "3..64"});
    expect_failure({"evaluate", in("two"), "-q"}, {"two", "too few"});
    expect_failure({"evaluate", in("nowhere"), "-q"}, {"nowhere"});
    // A folder with other files is not replaced.
    expect_failure({"evaluate", in("set"), "-o", in("two"), "-q"}, {"two"});
    expect_failure({"build", in("set"), "-o", in("o.rso"), "--raymap", "512x512", "-q"}, {"--raymap", "--cells"});
    expect_failure({"build", in("set"), "-o", in("o.rso"), "--cells", "many", "-q"}, {"--cells", "512x512"});
    EXPECT_EQ(run({"evaluate"}).exit_code, 2);
}

TEST_F(Evaluate, WritesAReportOfItsScores) {
    const test::ToolRun done = run({"evaluate", in("set"), "--hold-out", "every-3rd", "--methods", "photo,shape",
                                    "--report", in("page.html"), "-q"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("mean PSNR"));
    std::ifstream file(work_ / "page.html");
    const std::string page(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(page, HasSubstr("Of 12 views, every 3rd was held out, 4 in total."));
    EXPECT_THAT(page, HasSubstr("error of shape"));
    EXPECT_EQ(page.find("error of plane"), std::string::npos);
    expect_failure({"evaluate", in("set"), "--report", in("nowhere/page.html"), "-q"}, {"nowhere"});
}

TEST_F(Evaluate, BuildWritesAReport) {
    const test::ToolRun built =
        run({"build", in("set"), "-o", in("o.rso"), "--name", "<balls>", "--report", in("page.html"), "-q"});
    ASSERT_EQ(built.exit_code, 0) << built.err;
    std::ifstream file(work_ / "page.html");
    const std::string page(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(page, HasSubstr("&lt;balls&gt;"));
    EXPECT_THAT(page, HasSubstr("12 of 64x52"));
    EXPECT_EQ(page.find("<balls>"), std::string::npos);
    EXPECT_EQ(page.find("http://", page.find("</style>")), page.find("http://www.w3.org/2000/svg"))
        << "the page must not load external resources";
    for (const char* method : {"photo", "plane", "shape"}) {
        EXPECT_THAT(page, HasSubstr(std::string("error of ") + method));
    }
    // The report of a set too small for held-out views states this.
    const test::ToolRun small = run({"build", in("two"), "-o", in("o.rso"), "--report", in("page.html"), "-q"});
    ASSERT_EQ(small.exit_code, 0) << small.err;
    std::ifstream again(work_ / "page.html");
    EXPECT_THAT(std::string(std::istreambuf_iterator<char>(again), {}), HasSubstr("too few"));
    expect_failure({"build", in("set"), "-o", in("p.rso"), "--report", in("nowhere/page.html"), "-q"}, {"nowhere"});
    EXPECT_FALSE(std::filesystem::exists(work_ / "p.rso"));
}

}  // namespace
}  // namespace rs
