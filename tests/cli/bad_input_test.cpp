// Bad input: one line that names the file, exit code 1, nothing half-written, no crash (run under the sanitizers too).

#include "rayspace/file_output.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>

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
    // The tool must fail as it should, and leave `work_` as it was.
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

    void write_photographs(const std::string& name) const {
        std::filesystem::create_directories(work_ / name);
        const Rig rig = make_ring({.count = 6, .fl_px = 60, .width = 48, .height = 40});
        for (std::size_t i = 0; i < 6; ++i) {
            const auto path = work_ / name / ("p" + std::to_string(i) + ".png");
            ASSERT_TRUE(write_png(path, test::drawn_picture(rig.views[i].camera)).ok());
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

TEST_F(BadInput, PicturesOfDifferentSizes) {
    write_photographs("photos");
    ASSERT_TRUE(write_png(work_ / "photos" / "p3.png", Image<Rgba8>(50, 40)).ok());
    expect_failure("rs-capture", {"import", in("photos"), "-o", in("set"), "-q"}, {"p3.png", "50x40"});
}

TEST_F(BadInput, CorruptPictures) {
    write_photographs("photos");
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
    write_text("text.png", "this is no picture");
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
    // Spread over the file; every single byte is flipped in the unit tests of the container.
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

TEST_F(BadInput, OutputThatCannotBe) {
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
    // A folder that is not ours is not replaced.
    std::filesystem::create_directories(work_ / "mine");
    write_text("mine/letter.txt", "dear");
    expect_failure("rs-encode", {"extract", object, "-o", in("mine"), "-q"}, {"mine"});
    EXPECT_TRUE(std::filesystem::exists(work_ / "mine" / "letter.txt"));
}

class FullDisk : public BadInput {
protected:
    void SetUp() override {
        std::filesystem::create_directories(work_ / "small");
        disk_.emplace(work_ / "small");
        if (!disk_->mounted()) GTEST_SKIP() << "a small file system cannot be mounted here (it takes root)";
    }
    void expect_disk_full(const std::string& tool, const std::vector<std::string>& arguments) {
        expect_failure(tool, arguments, {"no space left"});
        EXPECT_TRUE(names_in(work_ / "small").empty());
    }
    std::optional<test::SmallDisk> disk_;  // gone before the folder it stands in
};

TEST_F(FullDisk, IsSaidAndLeavesNothingBehind) {
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
    expect_disk_full("rs-engine", {"render", in("large.rso"), "--eye", "0,0,3", "--size", "4000x4000", "-o",
                                   in("small/v.png"), "-q"});
    expect_disk_full("rs-capture", {"import", in("photos"), "--backdrop", "alpha", "-o", in("small/imported"), "-q"});
    expect_disk_full("rs-capture", {"synth", in("ball.obj"), "-o", in("small/traced"), "--views", "40", "--size",
                                    "300x300", "--spp", "1", "-q"});
}

}  // namespace
}  // namespace rs
