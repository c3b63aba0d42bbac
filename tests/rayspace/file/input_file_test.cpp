#include "rayspace/file/input_file.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

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
