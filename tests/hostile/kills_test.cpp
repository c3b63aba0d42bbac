// Kills tools while they replace a file: either the old or the complete new one exists afterwards.

#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/hostile/mutation.hpp"
#include "tests/hostile/surviving.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;

// Starts the tool and kills it `after`; true if it was still running.
bool killed(const std::string& tool, std::vector<std::string> arguments, std::chrono::microseconds after, int signal) {
    const std::string program = std::string(RAYSPACE_TOOLS_DIR) + "/" + tool;
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        const int nothing = ::open("/dev/null", O_RDWR);
        for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
        ::execv(program.c_str(), argv.data());
        ::_exit(127);
    }
    std::this_thread::sleep_for(after);
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status);
}

TEST(HostileKills, WhatIsThereStaysWhole) {
    const test::TemporaryFolder folder;
    Rig rig = make_ring({.count = 8, .fl_px = 60, .width = 48, .height = 40});
    rig.object_radius = 0.9;
    test::write_drawn_set(folder / "set", rig);
    const std::string object = (folder / "object.rso").string();
    const std::string set = (folder / "extracted").string();
    const std::vector<std::string> build = {
        "build", (folder / "set").string(), "-o", object, "--planes", "3", "--cells", "16x16", "-q"};
    const std::vector<std::string> extract = {"extract", object, "-o", set, "-q"};
    ASSERT_EQ(test::run_tool(folder.path(), "rs-encode", build).exit_code, 0);
    ASSERT_EQ(test::run_tool(folder.path(), "rs-encode", extract).exit_code, 0);
    test::Random random(test::hostile_seed());
    int kills = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(test::hostile_seconds());
    while (std::chrono::steady_clock::now() < end) {
        const bool builds = test::below(random, 2) == 0;
        const int signal = test::below(random, 3) == 0 ? SIGTERM : SIGKILL;
        kills += killed("rs-encode", builds ? build : extract, std::chrono::microseconds(test::below(random, 120'000)),
                        signal);
        const auto read = read_object(fs::path(object));
        ASSERT_TRUE(read.ok()) << read.error().message;
        const auto extracted = read_rig(fs::path(set));
        ASSERT_TRUE(extracted.ok()) << extracted.error().message;
        for (const RigView& view : extracted->views) {
            ASSERT_TRUE(read_image(image_path(set, view)).ok()) << view.file_path;
        }
    }
    EXPECT_GT(kills, 0);
    // The next run removes the leftovers of the killed ones.
    ASSERT_EQ(test::run_tool(folder.path(), "rs-encode", build).exit_code, 0);
    ASSERT_EQ(test::run_tool(folder.path(), "rs-encode", extract).exit_code, 0);
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.path().filename().string().find(".partial-"), std::string::npos) << entry.path();
    }
}

}  // namespace
}  // namespace rs
