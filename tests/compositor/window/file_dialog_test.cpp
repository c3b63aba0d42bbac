// File list: filter, order, navigation and choices, without a window.

#include "compositor/window/file_dialog.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FileDialogTest : public ::testing::Test {
protected:
    FileDialogTest() {
        fs::create_directories(work_ / "z-folder");
        fs::create_directories(work_ / ".hidden");
        for (const char* name : {"b.rso", "A.GLB", "notes.txt", "hall.wrl.gz", "archive.gz", ".c.rso", "lights.json"}) {
            std::ofstream(work_ / name) << "x";
        }
        std::ofstream(work_ / "z-folder" / "inner.json") << "x";
    }
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const ListedFile& file : dialog_.files()) names.push_back(file.name + (file.is_folder ? "/" : ""));
        return names;
    }
    test::TemporaryFolder work_;
    FileDialog dialog_;
};

TEST_F(FileDialogTest, ListsFoldersAndKnownEndings) {
    dialog_.open(FileUse::kOpen, work_.path());
    EXPECT_THAT(names(), ElementsAre("z-folder/", "A.GLB", "b.rso", "hall.wrl.gz", "lights.json"));
    dialog_.open(FileUse::kLightList, work_ / "new.json");
    EXPECT_THAT(names(), ElementsAre("z-folder/", "lights.json"));
    dialog_.open(FileUse::kFolder, work_.path());
    EXPECT_THAT(names(), ElementsAre("z-folder/"));
}

TEST_F(FileDialogTest, EntersFoldersAndChoosesFiles) {
    dialog_.open(FileUse::kOpen, work_.path());
    dialog_.enter("z-folder");
    EXPECT_THAT(names(), ElementsAre("inner.json"));
    dialog_.enter("..");
    EXPECT_EQ(fs::canonical(dialog_.folder()), fs::canonical(work_.path()));
    EXPECT_TRUE(dialog_.is_open());
    dialog_.enter("b.rso");
    EXPECT_FALSE(dialog_.is_open());
    const auto choice = dialog_.take_choice();
    ASSERT_TRUE(choice.has_value());
    EXPECT_EQ(choice->use, FileUse::kOpen);
    EXPECT_TRUE(fs::equivalent(choice->path, work_ / "b.rso"));
    EXPECT_FALSE(dialog_.take_choice().has_value());
}

TEST_F(FileDialogTest, RefusesMissingFilesExceptToSave) {
    dialog_.open(FileUse::kOpen, work_.path());
    dialog_.enter("gone.rso");
    EXPECT_TRUE(dialog_.is_open());
    EXPECT_THAT(dialog_.error(), HasSubstr("gone.rso"));
    EXPECT_THAT(names(), ElementsAre("z-folder/", "A.GLB", "b.rso", "hall.wrl.gz", "lights.json"));
    dialog_.open(FileUse::kLightList, work_.path());
    dialog_.enter("new.json");
    ASSERT_FALSE(dialog_.is_open());
    EXPECT_EQ(fs::path(dialog_.take_choice()->path).filename(), "new.json");
    dialog_.open(FileUse::kFolder, work_.path());
    dialog_.choose_folder();
    EXPECT_TRUE(fs::equivalent(dialog_.take_choice()->path, work_.path()));
    EXPECT_FALSE(list_files(work_ / "gone", {}).ok());
}

}  // namespace
}  // namespace rs::compositor
