#include "rayspace/file/input_file.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace rs {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(InputFile, PipesDevicesAndFoldersAreRefusedAtOnce) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const fs::path& path : {folder / "pipe", fs::path("/dev/zero"), fs::path("/dev/tty")}) {
        if (!fs::exists(path)) continue;
        EXPECT_FALSE(open_input(path).ok()) << path;
        EXPECT_FALSE(check_input(path).ok()) << path;
        EXPECT_FALSE(read_file(path, 1 << 20).ok()) << path;
    }
    EXPECT_THAT(open_input(folder / "pipe").error().message, HasSubstr("is no regular file"));
    EXPECT_THAT(check_input(folder.path()).error().message, HasSubstr("is a folder"));
    EXPECT_THAT(check_input(folder / "none").error().message, HasSubstr("does not exist"));
}

// keep_inputs() holds for the rest of a process: each case has one of its own.
int in_own_process(const std::function<bool()>& holds) {
    const pid_t child = ::fork();
    if (child == 0) {
        keep_inputs();
        ::_exit(holds() ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

TEST(InputFile, WhatIsReadIsNotReplaced) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "in", std::string("precious")).ok());
    ASSERT_EQ(::link((folder / "in").c_str(), (folder / "other").c_str()), 0);
    fs::create_symlink("in", folder / "link");
    for (const char* const output : {"in", "other", "link", "./in"}) {
        EXPECT_EQ(in_own_process([&] {
                      if (!read_file(folder / "in", 100).ok()) return false;
                      const Status written = write_file(folder / output, std::string("lost"));
                      return !written && written.error().message.find("is an input") != std::string::npos;
                  }),
                  0)
            << output;
    }
    const auto bytes = read_file(folder / "in", 100);
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ(bytes->size(), 8U);
    EXPECT_EQ(in_own_process([&] { return write_file(folder / "in", std::string("not read before")).ok(); }), 0);
}

TEST(InputFile, ANewFileThatGetsTheNumberOfOneThatIsGoneIsNoInput) {
    const TemporaryFolder folder;
    EXPECT_EQ(in_own_process([&] {
                  for (int i = 0; i < 20; ++i) {  // most file systems give the number to the next file
                      std::ofstream(folder / "in") << "read, and then removed";
                      if (!read_file(folder / "in", 100).ok()) return false;
                      fs::remove(folder / "in");
                      const fs::path output = folder / std::to_string(i);
                      std::ofstream(output) << "of today";
                      if (!write_file(output, std::string("of tomorrow")).ok()) return false;
                  }
                  return true;
              }),
              0);
}

TEST(InputFile, AFileThatIsReadAfterItWasStagedIsKeptToo) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "in", std::string("precious")).ok());
    EXPECT_EQ(in_own_process([&] {
                  Result<StagedFile> file = StagedFile::create(folder / "in");
                  return file.ok() && read_file(folder / "in", 100).ok() && !file->commit().ok();
              }),
              0);
}

TEST(InputFile, AFolderThatHoldsAnInputIsNotReplaced) {
    const TemporaryFolder folder;
    {
        Result<StagedFolder> set = StagedFolder::create(folder / "set", "pictures");
        ASSERT_TRUE(set.ok());
        ASSERT_TRUE(write_file(set->temporary_path() / "a", std::string("a")).ok());
        ASSERT_TRUE(set->commit().ok());
    }
    EXPECT_EQ(in_own_process([&] {
                  return check_input(folder / "set" / "a").ok() &&
                         !StagedFolder::create(folder / "set", "pictures").ok();
              }),
              0);
    EXPECT_EQ(in_own_process([&] {  // replaced as a whole, though it was looked at to see whether it may be
                  Result<StagedFolder> set = StagedFolder::create(folder / "set", "pictures");
                  return set.ok() && set->commit().ok();
              }),
              0);
}

TEST(Printable, ControlCharactersAreEscaped) {
    EXPECT_EQ(printable("vase é.rso"), "vase é.rso");
    EXPECT_EQ(printable("a\033[31mb\n\x7f"), "a\\x1B[31mb\\x0A\\x7F");
    EXPECT_EQ(printable("\xC2\x9B"
                        "2J \xC2\xA0 \xC2"),
              "\\xC2\\x9B"
              "2J \xC2\xA0 \xC2");
}

}  // namespace
}  // namespace rs
