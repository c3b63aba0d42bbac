// Bad input: one line that names the file, exit code 1, no partial output, no crash. Also run under the sanitizers.

#include "rayspace/file/file_output.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace rs {
namespace {

std::set<std::string> names_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

class BadInput : public testing::Test {
protected:
    // Expects exit code 1, one error line with all `mentions`, and no change in `work_`.
    void expect_failure(const std::string& tool, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& mentions) {
        SCOPED_TRACE(tool + " " + arguments.front());
        const auto before = names_in(work_.path());
        const test::ToolRun run = test::run_tool(scratch_.path(), tool, arguments);
        EXPECT_EQ(run.exit_code, 1) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find("error: "), std::string::npos) << run.err;
        for (const std::string& mention : mentions) EXPECT_NE(run.err.find(mention), std::string::npos) << run.err;
        EXPECT_EQ(names_in(work_.path()), before);
    }

    std::string in(const std::string& name) const { return (work_ / name).string(); }

    void write_text(const std::string& name, const std::string& text) const { std::ofstream(work_ / name) << text; }

    void write_set(const std::string& name) const {
        Rig rig = make_ring({.count = 6, .fl_px = 60, .width = 48, .height = 40});
        rig.object_radius = 0.9;
        test::write_drawn_set(work_ / name, rig);
    }

    void write_photos(const std::string& name) const {
        std::filesystem::create_directories(work_ / name);
        const Rig rig = make_ring({.count = 6, .fl_px = 60, .width = 48, .height = 40});
        for (std::size_t i = 0; i < 6; ++i) {
            const auto path = work_ / name / ("p" + std::to_string(i) + ".png");
            ASSERT_TRUE(write_png(path, test::draw_image(rig.views[i].camera)).ok());
        }
    }

    std::string write_object() const {
        write_set("object-set");
        const test::ToolRun run = test::run_tool(
            scratch_.path(), "rs-encode",
            {"build", in("object-set"), "-o", in("object.rso"), "--planes", "3", "--cells", "16x16", "-q"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return in("object.rso");
    }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

TEST_F(BadInput, Folders) {
    std::filesystem::create_directories(work_ / "empty");
    expect_failure("rs-capture", {"import", in("empty"), "-o", in("set"), "-q"}, {"empty"});
    expect_failure("rs-capture", {"import", in("nowhere"), "-o", in("set"), "-q"}, {"nowhere"});
    expect_failure("rs-encode", {"build", in("empty"), "-o", in("o.rso"), "-q"}, {"transforms.json"});
    expect_failure("rs-encode", {"build", in("nowhere"), "-o", in("o.rso"), "-q"}, {"nowhere"});
}

TEST_F(BadInput, ImagesOfDifferentSizes) {
    write_photos("photos");
    ASSERT_TRUE(write_png(work_ / "photos" / "p3.png", Image<Rgba8>(50, 40)).ok());
    expect_failure("rs-capture", {"import", in("photos"), "-o", in("set"), "-q"}, {"p3.png", "50x40"});
}

TEST_F(BadInput, CorruptImages) {
    write_photos("photos");
    const auto photo = work_ / "photos" / "p4.png";
    const auto size = std::filesystem::file_size(photo);
    std::filesystem::resize_file(photo, size / 2);
    expect_failure("rs-capture", {"import", in("photos"), "-o", in("set"), "-q"}, {"p4.png"});
    write_set("set");
    {
        std::fstream file(work_ / "set" / "2.png", std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(work_ / "set" / "2.png") / 2));
        file.put('\x55');
        file.put('\xAA');
    }
    expect_failure("rs-encode", {"build", in("set"), "-o", in("o.rso"), "-q"}, {"2.png"});
    write_text("text.png", "this is no image");
    std::filesystem::rename(work_ / "text.png", work_ / "set" / "2.png");
    expect_failure("rs-encode", {"build", in("set"), "-o", in("o.rso"), "-q"}, {"2.png"});
}

TEST_F(BadInput, DamagedRig) {
    write_set("set");
    write_text("set/transforms.json", "{\"frames\": [");
    expect_failure("rs-encode", {"build", in("set"), "-o", in("o.rso"), "-q"}, {"transforms.json"});
    write_text("set/transforms.json", "{\"frames\": [{\"file_path\": \"0.png\", \"transform_matrix\": [[1,2],[3]]}]}");
    expect_failure("rs-encode", {"build", in("set"), "-o", in("o.rso"), "-q"}, {"transforms.json", "transform_matrix"});
}

TEST_F(BadInput, DamagedObjects) {
    const std::string object = write_object();
    const Result<std::vector<std::byte>> bytes = read_file(object, 1 << 24);
    ASSERT_TRUE(bytes.ok());
    const auto write_damaged = [&](const std::vector<std::byte>& damaged) {
        std::ofstream file(work_ / "damaged.rso", std::ios::binary);
        file.write(reinterpret_cast<const char*>(damaged.data()), static_cast<std::streamsize>(damaged.size()));
    };
    write_damaged({});
    expect_failure("rs-encode", {"verify", in("damaged.rso")}, {"damaged.rso"});
    // Positions spread over the file; the unit tests of the container flip every byte.
    for (std::size_t n = 0; n < 40; ++n) {
        SCOPED_TRACE(n);
        std::vector<std::byte> damaged = *bytes;
        damaged[n * (damaged.size() - 1) / 39] ^= std::byte{static_cast<unsigned char>(1U << (n % 8))};
        write_damaged(damaged);
        expect_failure("rs-encode", {"verify", in("damaged.rso")}, {"damaged.rso"});
        if (n % 8 == 0) {
            expect_failure("rs-encode", {"extract", in("damaged.rso"), "-o", in("pictures"), "-q"}, {"damaged.rso"});
            expect_failure("rs-engine", {"render", in("damaged.rso"), "--orbit", "2", "-o", in("views"), "-q"},
                           {"damaged.rso"});
        }
        damaged = *bytes;
        damaged.resize(n * damaged.size() / 40);
        write_damaged(damaged);
        expect_failure("rs-encode", {"verify", in("damaged.rso")}, {"damaged.rso"});
    }
}

TEST_F(BadInput, Meshes) {
    write_text("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    expect_failure("rs-capture", {"synth", in("points.obj"), "-o", in("set"), "-q"}, {"points.obj"});
    write_text("textured.mtl", "newmtl painted\nmap_Kd missing-texture.png\n");
    write_text(
        "textured.obj",
        "mtllib textured.mtl\nusemtl painted\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    expect_failure("rs-capture", {"synth", in("textured.obj"), "-o", in("set"), "-q"}, {"missing-texture.png"});
    write_text("garbage.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\nend_header\n");
    expect_failure("rs-capture", {"synth", in("garbage.ply"), "-o", in("set"), "-q"}, {"garbage.ply"});
    write_text("recipe.json", "{\"name\": \"x\", \"object\": {\"generator\": \"no-such-thing\"}}");
    expect_failure("rs-capture", {"synth", in("recipe.json"), "-o", in("set"), "-q"}, {"no-such-thing"});
    write_text("recipe.json", "{\"name\": \"x\", \"objekt\": {}}");
    expect_failure("rs-capture", {"synth", in("recipe.json"), "-o", in("set"), "-q"}, {"recipe.json", "objekt"});
}

TEST_F(BadInput, InvalidOutputs) {
    const std::string object = write_object();
    expect_failure("rs-encode", {"build", in("object-set"), "-o", in("no/such/folder/o.rso"), "-q"},
                   {"no/such/folder"});
    expect_failure("rs-engine", {"render", object, "--orbit", "2", "-o", in("no/such/folder/v.mp4"), "-q"},
                   {"no/such/folder"});
    expect_failure("rs-engine", {"render", object, "--orbit", "2", "-o", in("two.png"), "-q"}, {"two.png", "--sheet"});
    expect_failure("rs-engine", {"render", object, "--orbit", "2", "--depth", "-o", in("two.mp4"), "-q"},
                   {"two.mp4", "--depth"});
    expect_failure("rs-engine",
                   {"render", object, "--orbit", "2", "--depth", "--sheet", "2", "-o", in("two.png"), "-q"},
                   {"two.png", "--depth"});
    // A folder with other files is not replaced.
    std::filesystem::create_directories(work_ / "mine");
    write_text("mine/letter.txt", "dear");
    expect_failure("rs-encode", {"extract", object, "-o", in("mine"), "-q"}, {"mine", "letter.txt", "--force"});
    EXPECT_TRUE(std::filesystem::exists(work_ / "mine" / "letter.txt"));
    // Every command that writes a folder has --force. A new file in the folder requires it again.
    write_text("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_photos("photos");
    const std::vector<std::pair<std::string, std::vector<std::string>>> commands = {
        {"rs-encode", {"extract", object, "-q"}},
        {"rs-encode", {"evaluate", in("object-set"), "--methods", "photo", "-q"}},
        {"rs-engine", {"render", object, "--orbit", "2", "-q"}},
        {"rs-capture", {"synth", in("room.obj"), "--views", "2", "--size", "8x8", "--spp", "1", "-q"}},
        {"rs-capture", {"import", in("photos"), "--calibration", "nominal", "-q"}},
        {"rs-street", {"--seconds", "0.1", "--small"}},
        {"rs-showroom", {"--small"}},
        {"rs-view", {"render", in("room.obj"), "--orbit", "2", "--size", "32x24", "-q"}},
    };
    for (const auto& [tool, arguments] : commands) {
        SCOPED_TRACE(tool + " " + arguments.front());
        auto command = arguments;
        command.insert(command.end(), {"-o", in("mine")});
        const test::ToolRun refused = test::run_tool(scratch_.path(), tool, command);
        if (refused.err.find("OpenGL: ") != std::string::npos) continue;
        EXPECT_EQ(refused.exit_code, 1);
        EXPECT_NE(refused.err.find("letter.txt"), std::string::npos) << refused.err;
        EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
        command.emplace_back("--force");
        const test::ToolRun forced = test::run_tool(scratch_.path(), tool, command);
        EXPECT_EQ(forced.exit_code, 0) << forced.err;
        EXPECT_FALSE(std::filesystem::exists(work_ / "mine" / "letter.txt"));
        command.pop_back();
        EXPECT_EQ(test::run_tool(scratch_.path(), tool, command).exit_code, 0)
            << "a folder written by the tool is replaced";
        write_text("mine/letter.txt", "dear");
    }
}

TEST_F(BadInput, OutputThatWouldReplaceAnInputOrAnotherOutput) {
    write_set("set");
    write_photos("photos");
    ASSERT_EQ(write_object(), in("object.rso"));
    std::filesystem::copy_file(work_ / "object.rso", work_ / "object.png");
    ASSERT_EQ(
        test::run_tool(scratch_.path(), "rs-capture", {"import", in("photos"), "-o", in("imported"), "-q"}).exit_code,
        0);
    ASSERT_TRUE(write_png(work_ / "texture.png", Image<Rgba8>(4, 4, Rgba8{200, 100, 50, 255})).ok());
    write_text(
        "scene.wrl",
        "#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url \"texture.png\" } } geometry "
        "Box {} }\n");
    const auto bytes_of = [&](const std::string& name) {
        std::ifstream file(work_ / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    struct Case {
        std::string kept;
        std::string tool;
        std::vector<std::string> arguments;
        std::string mention = "would overwrite";
        int exit_code = 1;
    };
    const std::vector<Case> cases = {
        {"set/transforms.json",
         "rs-encode",
         {"build", in("set"), "-o", in("set/transforms.json"), "-q"},
         "must end in .rso",
         2},
        {"texture.png",
         "rs-encode",
         {"build", in("set"), "-o", in("o.rso"), "--report", in("texture.png")},
         "must end in .html",
         2},
        {"set/transforms.json",
         "rs-engine",
         {"render", in("object.rso"), "--poses", in("set/transforms.json"), "-o", in("set/transforms.json"), "-q"},
         ""},
        {"set/transforms.json",
         "rs-engine",
         {"render", in("object.rso"), "--poses", in("set/transforms.json"), "-o", in("set"), "--force", "-q"}},
        {"set/0.png", "rs-encode", {"evaluate", in("set"), "-o", in("set"), "--force", "-q"}},
        {"object.rso", "rs-encode", {"extract", in("object.rso"), "-o", work_.path().string(), "--force", "-q"}},
        {"photos/p0.png", "rs-capture", {"import", in("photos"), "-o", in("photos"), "--force", "-q"}},
        {"scene.wrl", "rs-capture", {"synth", in("scene.wrl"), "-o", work_.path().string(), "--force", "-q"}},
        {"object.png", "rs-engine", {"render", in("object.png"), "--eye", "3,0,0", "-o", in("object.png"), "-q"}},
        {"texture.png", "rs-view", {"render", in("scene.wrl"), "-o", in("texture.png")}},
        {"imported/transforms.json",
         "rs-capture",
         {"import", in("photos"), "--known", in("imported/transforms.json"), "-o", in("again"), "--report",
          in("imported/transforms.json"), "-q"},
         "must end in .html",
         2},
    };
    for (const Case& wrong : cases) {
        SCOPED_TRACE(wrong.tool + " " + wrong.arguments.front());
        const std::string before = bytes_of(wrong.kept);
        ASSERT_FALSE(before.empty());
        const test::ToolRun run = test::run_tool(scratch_.path(), wrong.tool, wrong.arguments);
        EXPECT_EQ(run.exit_code, wrong.exit_code) << run.err;
        EXPECT_NE(run.err.find(wrong.mention), std::string::npos) << run.err;
        EXPECT_TRUE(bytes_of(wrong.kept) == before) << run.err;
    }
    // Two outputs of one command are the same file.
    std::filesystem::create_symlink(in("new.png"), in("times.json"));
    const test::ToolRun run = test::run_tool(
        scratch_.path(), "rs-view",
        {"render", in("scene.wrl"), "--size", "64x48", "-o", in("new.png"), "--stats", in("times.json")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("would overwrite"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(in("new.png")));
}

TEST_F(BadInput, ProcessLimitsAreReportedInOneLine) {
    write_set("set");
    ASSERT_EQ(write_object(), in("object.rso"));
    const std::string tools = RAYSPACE_TOOLS_DIR;
    const auto limited = [&](const std::string& limit, const std::string& command) {
        const std::string err = (scratch_ / "limited.txt").string();
        const int status = std::system(
            ("bash -c " + test::quoted("ulimit " + limit + "; exec " + tools + "/" + command + " >/dev/null 2>" + err))
                .c_str());
        std::ifstream file(err);
        const std::string text(std::istreambuf_iterator<char>(file), {});
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status << ": " << text;
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
        return text;
    };
    EXPECT_NE(limited("-f 4", "rs-encode build " + in("set") + " -q -o " + in("x.rso")).find("file-size limit"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(work_ / "x.rso"));
#if !defined(RAYSPACE_ADDRESS_SANITIZER)
    const std::string little = limited("-v 300000", "rs-encode build " + in("set") + " -q -o " + in("x.rso"));
    EXPECT_NE(little.find("memory"), std::string::npos) << little;
    EXPECT_EQ(little.find("beside the program"), std::string::npos) << little;
#endif
}

TEST_F(BadInput, PipesInReferencesAreRefusedAtOnce) {
    ASSERT_EQ(::mkfifo((work_ / "pipe").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo((work_ / "pipe.mtl").c_str(), 0600), 0);
    std::filesystem::create_directories(work_ / "set");
    ASSERT_EQ(::mkfifo((work_ / "set" / "transforms.json").c_str(), 0600), 0);
    write_text(
        "texture.wrl",
        "#VRML V2.0 utf8\nShape { appearance Appearance { texture ImageTexture { url \"pipe\" } } geometry Box {} "
        "}\n");
    write_text("inline.wrl", "#VRML V2.0 utf8\nInline { url \"pipe\" }\nShape { geometry Box {} }\n");
    write_text("object.wrl",
               "#VRML V2.0 utf8\nEXTERNPROTO RaySpace [field MFString url] \"urn:x\"\nRaySpace { url \"pipe\" }\n");
    write_text("model.obj", "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_text(
        "model.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[{"uri":"pipe","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
                  "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
                  "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]})");
    expect_failure("rs-encode", {"build", in("set"), "-o", in("x.rso"), "-q"}, {"no regular file"});
    expect_failure("rs-engine", {"render", in("pipe"), "--orbit", "2", "-o", in("x"), "-q"}, {"no regular file"});
    for (const char* const scene : {"texture.wrl", "inline.wrl", "object.wrl", "model.obj", "model.gltf"}) {
        // An error or a warning: the tool must terminate and name the file.
        const test::ToolRun run =
            test::run_tool(scratch_.path(), "rs-view", {"render", in(scene), "--size", "32x24", "-o", in("frame.png")});
        EXPECT_LE(run.exit_code, 1) << scene << ": " << run.err;
        EXPECT_NE(run.err.find("pipe"), std::string::npos) << scene << ": " << run.err;
    }
    for (const char* const mesh : {"model.obj", "model.gltf"}) {
        const test::ToolRun run = test::run_tool(
            scratch_.path(), "rs-capture",
            {"synth", in(mesh), "--views", "2", "--size", "8x8", "--spp", "1", "-o", in("traced"), "-q"});
        EXPECT_EQ(run.exit_code, 1) << mesh << ": " << run.err;
        EXPECT_NE(run.err.find("pipe"), std::string::npos) << run.err;
    }
}

TEST_F(BadInput, ModelsThatAssimpDoesNotSurvive) {
    write_text("early.mtl", "map_Kd texture.png\nnewmtl red\nKd 1 0 0\n");
    write_text("early.obj", "mtllib early.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_text("none.mtl", "map_Kd texture.png\n");
    write_text("none.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_text("indented.mtl", " newmtlred\nKd 1 0 0\n");
    write_text("indented.obj", "mtllib indented.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const char* const model : {"early.obj", "none.obj", "indented.obj"}) {
        EXPECT_EQ(
            test::run_tool(scratch_.path(), "rs-view", {"render", in(model), "--size", "32x24", "-o", in("frame.png")})
                .exit_code,
            0)
            << model;
        EXPECT_EQ(test::run_tool(
                      scratch_.path(), "rs-capture",
                      {"synth", in(model), "--views", "2", "--size", "8x8", "--spp", "1", "-o", in("traced"), "-q"})
                      .exit_code,
                  0)
            << model;
    }
    write_text("inf.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const std::string tool : {"rs-view", "rs-capture"}) {
        std::vector<std::string> arguments = {"render", in("inf.obj"), "--size", "32x24", "-o", in("out.png")};
        if (tool == "rs-capture") arguments = {"synth", in("inf.obj"), "--views", "2", "-o", in("out"), "-q"};
        expect_failure(tool, arguments, {"inf.obj", "is not finite"});
    }
    write_text("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n");
    expect_failure("rs-capture", {"synth", in("lines.obj"), "--views", "2", "-o", in("out"), "-q"}, {"lines.obj"});
}

class FullDisk : public BadInput {
protected:
    void SetUp() override {
        std::filesystem::create_directories(work_ / "small");
        disk_.emplace(work_ / "small");
        if (!disk_->mounted()) GTEST_SKIP() << "a small file system cannot be mounted here (root is required)";
    }
    void expect_disk_full(const std::string& tool, const std::vector<std::string>& arguments) {
        expect_failure(tool, arguments, {"no space left"});
        EXPECT_TRUE(names_in(work_ / "small").empty());
    }
    std::optional<test::SmallDisk> disk_;  // destroyed before the folder that contains it
};

TEST_F(FullDisk, IsReportedAndLeavesNoFiles) {
    Rig rig = make_ring({.count = 4, .fl_px = 500, .width = 400, .height = 400});
    rig.object_radius = 0.9;
    test::write_drawn_set(work_ / "set", rig);
    ASSERT_EQ(test::run_tool(scratch_.path(), "rs-encode", {"build", in("set"), "-o", in("large.rso"), "-q"}).exit_code,
              0);
    std::filesystem::create_directories(work_ / "photos");
    for (int i = 0; i < 4; ++i) {
        std::filesystem::copy_file(work_ / "set" / (std::to_string(i) + ".png"),
                                   work_ / "photos" / (std::to_string(i) + ".png"));
    }
    write_text("ball.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    expect_disk_full("rs-encode", {"build", in("set"), "-o", in("small/o.rso"), "--profile", "raw", "-q"});
    expect_disk_full("rs-encode", {"extract", in("large.rso"), "-o", in("small/pictures"), "-q"});
    expect_disk_full("rs-engine", {"render", in("large.rso"), "--orbit", "40", "-o", in("small/views"), "-q"});
    expect_disk_full("rs-engine", {"render", in("large.rso"), "--orbit", "120", "--size", "1200x1200", "-o",
                                   in("small/orbit.mp4"), "-q"});
    {
        std::ofstream filler(work_ / "small" / "filler", std::ios::binary);
        filler << std::string(1 << 20, 'x');
    }
    expect_failure("rs-engine", {"render", in("large.rso"), "--orbit", "3", "-o", in("small/orbit.mp4"), "-q"},
                   {"no space left"});
    std::filesystem::remove(work_ / "small" / "filler");
    expect_disk_full("rs-engine", {"render", in("large.rso"), "--eye", "0,0,3", "--size", "4000x4000", "-o",
                                   in("small/v.png"), "-q"});
    expect_disk_full("rs-capture", {"import", in("photos"), "--backdrop", "alpha", "-o", in("small/imported"), "-q"});
    expect_disk_full("rs-capture", {"synth", in("ball.obj"), "-o", in("small/traced"), "--views", "40", "--size",
                                    "300x300", "--spp", "1", "-q"});
}

}  // namespace
}  // namespace rs
