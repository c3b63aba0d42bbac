// Tools from the command line: help, usage errors, and the whole pipeline from a mesh to a rendered view.

#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace rs {
namespace {

const std::vector<std::string> kTools = {"rs-capture", "rs-encode", "rs-engine", "rs-view"};

TEST(Help, OfEveryToolHasExamples) {
    const test::TemporaryFolder folder;
    for (const std::string& tool : kTools) {
        const test::ToolRun run = test::run_tool(folder.path(), tool, {"--help"});
        EXPECT_EQ(run.exit_code, 0) << tool;
        EXPECT_NE(run.out.find("Example"), std::string::npos) << tool;
        EXPECT_EQ(run.err, "") << tool;
    }
}

TEST(Help, UsageErrorsHaveExitCodeTwoAndOneLine) {
    const test::TemporaryFolder folder;
    for (const std::string& tool : kTools) {
        const test::ToolRun run = test::run_tool(folder.path(), tool, {"--no-such-option"});
        EXPECT_EQ(run.exit_code, 2) << tool;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find("--help"), std::string::npos) << run.err;
    }
}

TEST(Pipeline, AMeshBecomesAnObjectThatReproducesItsImages) {
    const test::TemporaryFolder folder;
    const auto in = [&](const char* name) { return (folder / name).string(); };
    const auto run = [&](const std::string& tool, const std::vector<std::string>& arguments) {
        const test::ToolRun result = test::run_tool(folder.path(), tool, arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result;
    };
    {
        std::ofstream mesh(folder / "box.obj");
        mesh << "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";
    }
    run("rs-capture",
        {"synth", in("box.obj"), "-o", in("set"), "--views", "12", "--size", "64x64", "--spp", "4", "-q"});
    run("rs-encode", {"build", in("set"), "-o", in("box.rso"), "-q"});
    run("rs-encode", {"verify", in("box.rso")});
    run("rs-encode", {"extract", in("box.rso"), "-o", in("pictures"), "-q"});
    run("rs-engine", {"conformance", in("box.rso"), "--views", "8", "-q"});
    run("rs-engine", {"render", in("box.rso"), "--poses", in("set"), "-o", in("rendered"), "-q"});

    // Rendered at the captured poses: the stored images, pixel for pixel.
    const Result<Rig> rendered = read_rig(folder / "rendered");
    const Result<Rig> stored = read_rig(folder / "pictures");
    ASSERT_TRUE(rendered.ok() && stored.ok());
    ASSERT_EQ(rendered->views.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i) {
        const auto a = read_image(image_path(folder / "rendered", rendered->views[i]));
        const auto b = read_image(image_path(folder / "pictures", stored->views[i]));
        ASSERT_TRUE(a.ok() && b.ok());
        EXPECT_GT(compare_images_psnr(*a, *b).object_pixels, 300);
        EXPECT_EQ(*a, *b);
    }

    run("rs-engine", {"render", in("box.rso"), "--eye", "2,1.5,2", "--size", "80x60", "-o", in("view.png"), "-q"});
    const auto view = read_image(folder / "view.png");
    ASSERT_TRUE(view.ok());
    EXPECT_EQ(view->width(), 80);
    const auto view_with = [&](const std::string& filter) {
        run("rs-engine", {"render", in("box.rso"), "--eye", "2,1.5,2", "--size", "80x60", "--filter", filter, "-o",
                          in("filtered.png"), "-q"});
        return read_image(folder / "filtered.png").value();
    };
    EXPECT_EQ(view_with("sharp"), *view);  // auto: the view is larger than the images
    EXPECT_EQ(view_with("auto"), *view);
    EXPECT_NE(view_with("bilinear"), *view);
    EXPECT_NE(view_with("smooth"), view_with("bilinear"));
    EXPECT_EQ(test::run_tool(folder.path(), "rs-engine",
                             {"render", in("box.rso"), "--orbit", "1", "--filter", "soft", "-o", in("x.png")})
                  .exit_code,
              2);
    const test::ToolRun above =
        run("rs-engine", {"render", in("box.rso"), "--eye", "0,5,0", "--size", "32x32", "-o", in("above.png"), "-q"});
    EXPECT_NE(above.err.find("the view shows nothing of the object"), std::string::npos) << above.err;
    const test::ToolRun around =
        run("rs-engine", {"render", in("box.rso"), "--orbit", "10", "--size", "64x64", "-o", in("orbit.mp4"), "-q"});
    EXPECT_EQ(around.err, "");
    EXPECT_GT(std::filesystem::file_size(folder / "orbit.mp4"), 1000U);
    run("rs-engine", {"render", in("box.rso"), "--orbit", "6", "--sheet", "3", "-o", in("sheet.png"), "-q"});
    const auto sheet = read_image(folder / "sheet.png");
    ASSERT_TRUE(sheet.ok());
    EXPECT_EQ(sheet->width(), 192);
    EXPECT_EQ(sheet->height(), 128);
    run("rs-engine", {"render", in("box.rso"), "--orbit", "90", "--sheet", "90", "-o", in("long.png"), "-q"});
    const auto fitted = read_image(folder / "long.png");
    ASSERT_TRUE(fitted.ok());
    EXPECT_EQ(fitted->width(), 90 * 45) << "not 90 * 64: a sheet is at most 4096 wide";
    EXPECT_EQ(fitted->height(), 45);
    run("rs-engine", {"render", in("box.rso"), "--orbit", "2", "--depth", "-o", in("deep"), "-q"});
    const auto image = read_image(folder / "deep" / "0001.png");
    const auto depth = read_channel(folder / "deep" / "0001.depth.exr");
    ASSERT_TRUE(image.ok() && depth.ok());
    ASSERT_EQ(depth->width(), image->width());
    for (std::size_t i = 0; i < depth->pixels().size(); ++i) {
        ASSERT_EQ(depth->pixels()[i] > 0, image->pixels()[i].a > 0);
    }

    const test::ToolRun compare = run("rs-engine", {"compare", in("box.rso"), in("set"), "--json", "-q"});
    const auto json = nlohmann::json::parse(compare.out);
    EXPECT_EQ(json["views"].size(), 12U);
    EXPECT_GT(json["mean_psnr_db"].get<double>(), 30);
    EXPECT_LE(json["pooled_psnr_db"].get<double>(), json["mean_psnr_db"].get<double>() + 1e-9);
    const auto info = nlohmann::json::parse(run("rs-encode", {"info", in("box.rso"), "--json"}).out);
    EXPECT_EQ(info["views"], 12);
    EXPECT_EQ(info["rings"][0]["planes"], 12);
    run("rs-encode", {"info", in("box.rso"), "--map-image", in("map.png"), "--map-plane", "3"});
    const auto map = read_image_info(in("map.png"));
    ASSERT_TRUE(map.ok()) << map.error().message;
    const int x_cells = info["rings"][0]["x_cells"];
    EXPECT_EQ(map->width % x_cells, 0);
    const auto exit_code_of = [&](const std::vector<std::string>& arguments) {
        return test::run_tool(folder.path(), "rs-encode", arguments).exit_code;
    };
    EXPECT_EQ(exit_code_of({"info", in("box.rso"), "--map-image", in("map.png"), "--map-plane", "12"}), 1);
    EXPECT_EQ(exit_code_of({"info", in("box.rso"), "--map-image", in("map.png"), "--map-ring", "1"}), 1);
    EXPECT_EQ(exit_code_of({"info", in("box.rso"), "--map-ring", "0"}), 2);  // without --map-image
}

}  // namespace
}  // namespace rs
