#include "rayspace/file/file_output.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

namespace {

namespace fs = std::filesystem;
using namespace rs;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void put_text(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

TEST(StagedFile, AppearsOnCommitOnly) {
    const TemporaryFolder folder;
    auto file = StagedFile::create(folder / "a.bin");
    ASSERT_TRUE(file.ok()) << file.error().message;
    ASSERT_TRUE(file->write(bytes_of("hello world")).ok());
    ASSERT_TRUE(file->write_at(6, bytes_of("there")).ok());
    EXPECT_EQ(file->size_bytes(), 11U);
    EXPECT_FALSE(fs::exists(folder / "a.bin"));
    EXPECT_EQ(file->temporary_path().extension(), ".bin");
    ASSERT_TRUE(file->commit().ok());
    EXPECT_EQ(contents(folder / "a.bin"), "hello there");
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.bin"});
}

TEST(StagedFile, DroppedItLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    put_text(folder / "a.bin", "old");
    {
        auto file = StagedFile::create(folder / "a.bin");
        ASSERT_TRUE(file.ok());
        ASSERT_TRUE(file->write(bytes_of("new")).ok());
    }
    EXPECT_EQ(contents(folder / "a.bin"), "old");
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.bin"});
}

TEST(StagedFile, ReplacesAndMoves) {
    const TemporaryFolder folder;
    put_text(folder / "a.bin", "old and longer");
    auto made = StagedFile::create(folder / "a.bin");
    auto other = StagedFile::create(folder / "b.bin");
    ASSERT_TRUE(made.ok() && other.ok());
    StagedFile file = std::move(made).value();
    ASSERT_TRUE(file.write(bytes_of("new")).ok());
    ASSERT_TRUE(file.commit().ok());
    file = std::move(other).value();
    ASSERT_TRUE(file.write(bytes_of("b")).ok());
    ASSERT_TRUE(file.commit().ok());
    EXPECT_EQ(contents(folder / "a.bin"), "new");
    EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"a.bin", "b.bin"}));
}

TEST(StagedFile, WritersOfOneTargetDoNotMeet) {
    const TemporaryFolder folder;
    auto first = StagedFile::create(folder / "a");
    auto second = StagedFile::create(folder / "a");
    ASSERT_TRUE(first.ok() && second.ok());
    ASSERT_TRUE(first->write(bytes_of("first")).ok());
    ASSERT_TRUE(second->write(bytes_of("second")).ok());
    ASSERT_TRUE(second->commit().ok());
    ASSERT_TRUE(first->commit().ok());
    EXPECT_EQ(contents(folder / "a"), "first");
}

TEST(StagedFile, TakesWhatALibraryPutUnderTheTemporaryName) {
    const TemporaryFolder folder;
    auto file = StagedFile::create(folder / "a.mp4");
    ASSERT_TRUE(file.ok());
    fs::remove(file->temporary_path());
    put_text(file->temporary_path(), "by a library");
    ASSERT_TRUE(file->commit().ok());
    EXPECT_EQ(contents(folder / "a.mp4"), "by a library");
}

TEST(StagedFile, NamesTheMissingFolder) {
    const TemporaryFolder folder;
    const auto file = StagedFile::create(folder.path() / "none" / "a.bin");
    ASSERT_FALSE(file.ok());
    EXPECT_THAT(file.error().message, HasSubstr((folder / "none").string() + " does not exist; create it first"));
}

TEST(StagedFile, RefusesFoldersAndEmptyNames) {
    const TemporaryFolder folder;
    EXPECT_THAT(StagedFile::create(folder.path()).error().message, HasSubstr("is a folder"));
    EXPECT_THAT(StagedFile::create("").error().message, HasSubstr("names no file"));
    EXPECT_THAT(StagedFile::create("/dev/null").error().message, HasSubstr("no regular file"));
    put_text(folder / "plain", "x");
    EXPECT_THAT(StagedFile::create(folder.path() / "plain" / "a").error().message, HasSubstr("is not a folder"));
}

TEST(StagedFile, AFullDiskIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    const test::SmallDisk disk(folder.path());
    if (!disk.mounted()) GTEST_SKIP() << "a small file system cannot be mounted here (it takes root)";
    {
        auto file = StagedFile::create(folder / "a.bin");
        ASSERT_TRUE(file.ok());
        const Status status = file->write(std::vector<std::byte>(1 << 20));
        ASSERT_FALSE(status.ok());
        EXPECT_THAT(status.error().message, HasSubstr((folder / "a.bin").string()));
        EXPECT_THAT(status.error().message, HasSubstr("no space left on device; free some space"));
    }
    EXPECT_TRUE(names_in(folder.path()).empty());
}

StagedFolder open_folder(const fs::path& path) {
    auto folder = StagedFolder::create(path, "images");
    EXPECT_TRUE(folder.ok()) << folder.error().message;
    return std::move(folder).value();
}

TEST(StagedFolder, AppearsOnCommitOnly) {
    const TemporaryFolder root;
    {
        StagedFolder folder = open_folder(root.path() / "set" / "");  // a trailing slash
        put_text(folder.temporary_path() / "marker.json", "1");
        EXPECT_FALSE(fs::exists(root / "set"));
        ASSERT_TRUE(folder.commit().ok());
    }
    EXPECT_EQ(contents(root.path() / "set" / "marker.json"), "1");
    EXPECT_EQ(names_in(root.path()), std::vector<std::string>{"set"});
}

TEST(StagedFolder, DroppedItIsRemovedWithAllItHolds) {
    const TemporaryFolder root;
    {
        const StagedFolder folder = open_folder(root / "set");
        fs::create_directory(folder.temporary_path() / "images");
        put_text(folder.temporary_path() / "images" / "a", "1");
    }
    EXPECT_TRUE(names_in(root.path()).empty());
}

TEST(StagedFolder, ReplacesAFolderOfOursAsAWhole) {
    const TemporaryFolder root;
    {
        StagedFolder folder = open_folder(root / "set");
        fs::create_directory(folder.temporary_path() / "images");
        put_text(folder.temporary_path() / "images" / "old-picture", "old");
        ASSERT_TRUE(folder.commit().ok());
    }
    StagedFolder folder = open_folder(root / "set");
    put_text(folder.temporary_path() / "new-picture", "new");
    ASSERT_TRUE(folder.commit().ok());
    EXPECT_EQ(names_in(root / "set"), (std::vector<std::string>{".rayspace-folder", "new-picture"}));
    EXPECT_EQ(names_in(root.path()), std::vector<std::string>{"set"});
}

TEST(StagedFolder, RefusesFilesThatItDidNotWrite) {
    const TemporaryFolder root;
    {
        StagedFolder folder = open_folder(root / "set");
        put_text(folder.temporary_path() / "picture", "ours");
        ASSERT_TRUE(folder.commit().ok());
    }
    EXPECT_TRUE(StagedFolder::create(root / "set", "images").ok());
    fs::remove(root / "set" / "picture");
    EXPECT_TRUE(StagedFolder::create(root / "set", "images").ok()) << "without a file it is still ours";
    put_text(root.path() / "set" / "notes.txt", "mine");
    const auto refused = StagedFolder::create(root / "set", "images");
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, AllOf(HasSubstr("notes.txt"), HasSubstr("--force")));
    EXPECT_EQ(contents(root.path() / "set" / "notes.txt"), "mine");
}

TEST(StagedFolder, ReplacesOnlyItsOwnKind) {
    const TemporaryFolder root;
    {
        StagedFolder folder = open_folder(root / "set");
        put_text(folder.temporary_path() / "picture", "ours");
        ASSERT_TRUE(folder.commit().ok());
    }
    const auto other = StagedFolder::create(root / "set", "rendered views");
    ASSERT_FALSE(other.ok());
    EXPECT_THAT(other.error().message, AllOf(HasSubstr("holds images, not rendered views"), HasSubstr("--force")));
}

TEST(StagedFolder, ForceReplacesWhateverAFolderHolds) {
    const TemporaryFolder root;
    fs::create_directory(root / "home");
    put_text(root.path() / "home" / "thesis.tex", "years of work");
    EXPECT_FALSE(StagedFolder::create(root / "home", "images").ok());
    auto folder = StagedFolder::create(root / "home", "images", true);
    ASSERT_TRUE(folder.ok()) << folder.error().message;
    put_text(folder->temporary_path() / "a", "new");
    EXPECT_TRUE(fs::exists(root / "home" / "thesis.tex")) << "until commit()";
    ASSERT_TRUE(folder->commit().ok());
    EXPECT_EQ(names_in(root / "home"), (std::vector<std::string>{".rayspace-folder", "a"}));
    EXPECT_EQ(names_in(root.path()), std::vector<std::string>{"home"});
    put_text(root / "file", "x");
    EXPECT_FALSE(StagedFolder::create(root / "file", "images", true).ok());
    fs::create_directory_symlink("home", root / "link");
    EXPECT_FALSE(StagedFolder::create(root / "link", "images", true).ok());
}

TEST(StagedFolder, TheCurrentFolderIsNotReplaced) {
    const TemporaryFolder root;
    fs::create_directories(root / "work" / "inner");
    const fs::path before = fs::current_path();
    fs::current_path(root / "work" / "inner");
    const auto folder = StagedFolder::create(root / "work", "images", true);
    const auto beside = StagedFolder::create("set", "images", true);
    fs::current_path(before);
    ASSERT_FALSE(folder.ok());
    EXPECT_THAT(folder.error().message, HasSubstr("contains the current folder"));
    EXPECT_TRUE(beside.ok());
}

TEST(StagedFolder, NamesItsFilesInTheMarker) {
    const TemporaryFolder root;
    StagedFolder folder = open_folder(root / "set");
    fs::create_directory(folder.temporary_path() / "images");
    put_text(folder.temporary_path() / "images" / "an image", "1");
    put_text(folder.temporary_path() / "rig", "2");
    ASSERT_TRUE(folder.commit().ok());
    EXPECT_EQ(contents(root.path() / "set" / ".rayspace-folder"), "images\nimages/an image\nrig\n");
}

TEST(Temporary, WhatKilledProcessesLeftIsRemovedByTheNextWriterOfTheSameTarget) {
    const TemporaryFolder root;
    put_text(root / ".a.bin.partial-0123456789abcdef.bin", "left");
    put_text(root / ".other.bin.partial-0123456789abcdef.bin", "of another target");
    fs::create_directories(root / ".set.partial-0123456789abcdef" / "images");
    put_text(root.path() / ".set.partial-0123456789abcdef" / "images" / "a", "left");
    {
        const auto live = StagedFile::create(root / "b.bin");
        const auto live_folder = StagedFolder::create(root / "set", "images");
        ASSERT_TRUE(live.ok() && live_folder.ok());
        EXPECT_TRUE(StagedFile::create(root / "a.bin").ok());
        EXPECT_TRUE(StagedFile::create(root / "b.bin").ok());
        EXPECT_TRUE(StagedFolder::create(root / "set", "images").ok());
        EXPECT_TRUE(fs::exists(live->temporary_path())) << "still written";
        EXPECT_TRUE(fs::exists(live_folder->temporary_path())) << "still written";
    }
    EXPECT_EQ(names_in(root.path()), std::vector<std::string>{".other.bin.partial-0123456789abcdef.bin"});
}

TEST(RefuseOverwritingInputs, ComparesFilesWhateverTheirNames) {
    const TemporaryFolder root;
    put_text(root / "in", "precious");
    fs::create_hard_link(root / "in", root / "hard");
    fs::create_symlink("in", root / "link");
    fs::create_directory(root / "set");
    put_text(root.path() / "set" / "a", "1");
    fs::create_symlink("../in", root / "set" / "inner");
    const auto is_refused = [&](const fs::path& output, const fs::path& input) {
        const Status status = refuse_overwriting_inputs(output, {"", input});
        if (status) return false;
        EXPECT_THAT(status.error().message, HasSubstr("would overwrite " + input.string()));
        return true;
    };
    for (const char* const output : {"in", "hard", "link", "./in", "set/../in"}) {
        EXPECT_TRUE(is_refused(root.path() / output, root / "in")) << output;
    }
    EXPECT_TRUE(is_refused(root / "set", root.path() / "set" / "a"));
    EXPECT_TRUE(is_refused(root.path() / "set" / "", root.path() / "set" / "a"));
    EXPECT_TRUE(is_refused(root / "set", root / "set"));
    EXPECT_TRUE(is_refused(root / "set", root.path() / "set" / "inner")) << "a link in the folder is lost with it";
    EXPECT_TRUE(is_refused(root / "new", root / "new")) << "another output";
    fs::create_symlink("new", root / "link-to-new");
    EXPECT_TRUE(is_refused(root / "link-to-new", root / "new"));
    EXPECT_TRUE(is_refused(root / "new", root / "link-to-new"));
    EXPECT_FALSE(is_refused(root.path() / "set" / "b", root / "set"));
    EXPECT_FALSE(is_refused(root / "set", root / "set2"));
    EXPECT_FALSE(is_refused(root / "other", root / "in"));
    EXPECT_FALSE(is_refused(root / "set", root.path() / "set" / ".."));
    EXPECT_FALSE(is_refused("", root / "in"));
}

TEST(StagedFolder, ReplacesAnEmptyFolder) {
    const TemporaryFolder root;
    fs::create_directory(root / "set");
    StagedFolder folder = open_folder(root / "set");
    put_text(folder.temporary_path() / "a", "new");
    ASSERT_TRUE(folder.commit().ok());
    EXPECT_EQ(names_in(root / "set"), (std::vector<std::string>{".rayspace-folder", "a"}));
}

TEST(StagedFolder, LeavesOtherPeoplesFoldersAlone) {
    const TemporaryFolder root;
    fs::create_directory(root / "home");
    put_text(root.path() / "home" / "thesis.tex", "years of work");
    const auto folder = StagedFolder::create(root / "home", "images");
    ASSERT_FALSE(folder.ok());
    EXPECT_THAT(folder.error().message, AllOf(HasSubstr("thesis.tex"), HasSubstr("--force")));
    put_text(root / "file", "x");
    EXPECT_THAT(StagedFolder::create(root / "file", "images").error().message, HasSubstr("is not a folder"));
    EXPECT_THAT(StagedFolder::create(root.path() / "none" / "set", "images").error().message,
                HasSubstr("create it first"));
    EXPECT_EQ(names_in(root.path()), (std::vector<std::string>{"file", "home"}));
}

TEST(StagedFolder, LooksAgainBeforeItReplaces) {
    const TemporaryFolder root;
    StagedFolder folder = open_folder(root / "set");
    fs::create_directory(root / "set");
    put_text(root.path() / "set" / "thesis.tex", "put there meanwhile");
    EXPECT_FALSE(folder.commit().ok());
    EXPECT_EQ(contents(root.path() / "set" / "thesis.tex"), "put there meanwhile");
}

TEST(StagedFolder, IsThereWholeWheneverItsWriterIsKilled) {
    const TemporaryFolder root;
    const auto replace = [&](const std::string& text) {
        Result<StagedFolder> folder = StagedFolder::create(root / "set", "images");
        if (!folder) return false;
        for (const char* const name : {"a", "b", "c"}) put_text(folder->temporary_path() / name, text);
        return folder->commit().ok();
    };
    ASSERT_TRUE(replace("first"));
    std::mt19937 random(7);
    int killed_late = 0;
    // On a busy machine more, with more patience, until a writer has come to replace something.
    for (int trial = 0; trial < 40 || (killed_late == 0 && trial < 200); ++trial) {
        const pid_t child = ::fork();
        if (child == 0) {
            for (int i = 0;; ++i) {
                if (!replace(std::to_string(i))) ::_exit(1);
            }
        }
        std::this_thread::sleep_for(std::chrono::microseconds(random() % (trial < 40 ? 20000U : 400000U)));
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself";
        ASSERT_EQ(contents(root / "set" / "a"), contents(root / "set" / "b"));
        ASSERT_EQ(contents(root / "set" / "a"), contents(root / "set" / "c"));
        ASSERT_FALSE(contents(root / "set" / "a").empty());
        if (contents(root / "set" / "a") != "first") ++killed_late;
    }
    EXPECT_GT(killed_late, 0) << "no writer came to replace anything";
    ASSERT_TRUE(replace("last"));
    EXPECT_THAT(names_in(root.path()), testing::ElementsAre("set"))
        << "what the killed ones left is removed by the next";
}

TEST(StagedFile, NamesMayBeAsLongAsTheFileSystemTakes) {
    const TemporaryFolder root;
    for (const std::size_t length : {225U, 251U, 255U}) {
        std::string name;
        while (name.size() + 2 <= length - 4) name += "\u00e9";  // two bytes each
        name.resize(length - 4, 'x');
        name += ".png";
        Result<StagedFile> file = StagedFile::create(root / name);
        ASSERT_TRUE(file.ok()) << length << ": " << file.error().message;
        EXPECT_EQ(file->temporary_path().extension(), ".png");
        EXPECT_TRUE(file->commit().ok());
        EXPECT_TRUE(fs::exists(root / name));
    }
}

TEST(ReadFile, ReadsUpToItsCap) {
    const TemporaryFolder folder;
    put_text(folder / "a", std::string(1000, 'x'));
    const auto whole = read_file(folder / "a", 1000);
    ASSERT_TRUE(whole.ok());
    EXPECT_EQ(whole->size(), 1000U);
    EXPECT_THAT(read_file(folder / "a", 999).error().message, HasSubstr("larger than 999 bytes"));
    EXPECT_THAT(read_file(folder / "b", 10).error().message, HasSubstr("cannot be opened"));
    EXPECT_THAT(read_file(folder.path(), 10).error().message, HasSubstr("is a folder"));
}

TEST(ReadFile, ReadsWhatHasNoSizeBeforehand) {
    const auto status = read_file("/proc/self/status", 1 << 20);
    ASSERT_TRUE(status.ok());
    EXPECT_GT(status->size(), 100U);
    EXPECT_FALSE(read_file("/proc/self/status", 10).ok());
    EXPECT_FALSE(read_file("/dev/zero", 1 << 16).ok());
}

}  // namespace
