#include "capture/turns/turns_import.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

void write_photos(const fs::path& folder, const std::string& prefix, int count) {
    fs::create_directories(folder);
    for (int i = 0; i < count; ++i) {
        const std::string name = prefix + std::to_string(i) + ".png";
        ASSERT_TRUE(write_png(folder / name, Image<Rgba8>(80, 80, {200, 10, 10, 255})).ok());
    }
}

class TurnsImport : public testing::Test {
protected:
    [[nodiscard]] std::string import_error(const std::vector<fs::path>& folders) const {
        const auto turns = find_turns(folders);
        if (!turns.ok()) return turns.error().message;
        ImportOptions options;
        options.output = folder_ / "toy.set";
        const auto report = import_turns(*turns, options, nullptr);
        EXPECT_FALSE(fs::exists(options.output));
        return report.ok() ? "" : report.error().message;
    }
    rs::test::TemporaryFolder folder_;
};

TEST_F(TurnsImport, FindsTurnsInFoldersAndNames) {
    write_photos(folder_ / "all" / "low", "", 6);
    write_photos(folder_ / "all" / "high", "", 7);
    write_photos(folder_ / "rows", "r01_c0", 6);
    write_photos(folder_ / "rows", "r02_c0", 6);
    write_photos(folder_ / "single", "photo", 8);
    const auto inner = find_turns(std::vector<fs::path>{folder_ / "all"});
    ASSERT_TRUE(inner.ok());
    ASSERT_EQ(inner->size(), 2U);
    EXPECT_EQ((*inner)[0].photos.size(), 7U);  // "high"
    const auto rows = find_turns(std::vector<fs::path>{folder_ / "rows"});
    ASSERT_TRUE(rows.ok());
    ASSERT_EQ(rows->size(), 2U);
    EXPECT_THAT((*rows)[1].name, HasSubstr("row r02"));
    const auto single = find_turns(std::vector<fs::path>{folder_ / "single"});
    ASSERT_TRUE(single.ok());
    EXPECT_EQ(single->size(), 1U);
}

TEST_F(TurnsImport, NamesATurnWithOnePhotoAndOneGivenTwice) {
    write_photos(folder_ / "low", "", 6);
    write_photos(folder_ / "high", "", 1);
    EXPECT_THAT(import_error({folder_ / "low", folder_ / "high"}), HasSubstr("high: has 1 photo;"));
    EXPECT_THAT(import_error({folder_ / "low", folder_ / "low"}), HasSubstr("low: is given twice"));
    fs::create_directories(folder_ / "empty");
    EXPECT_THAT(import_error({folder_ / "low", folder_ / "empty"}), HasSubstr("empty: holds no photos"));
}

TEST_F(TurnsImport, NamesWhatIsNoTurnBesideTheTurns) {
    write_photos(folder_ / "all" / "low", "", 6);
    write_photos(folder_ / "all" / "high", "", 6);
    write_photos(folder_ / "all" / "Masks", "", 6);
    EXPECT_THAT(import_error({folder_ / "all"}), HasSubstr("Masks: is no folder of photos, by its name"));
    fs::remove_all(folder_ / "all" / "Masks");
    write_photos(folder_ / "all", "setup", 1);
    EXPECT_THAT(import_error({folder_ / "all"}), HasSubstr("setup0.png: is beside the folders of turns"));
}

}  // namespace
}  // namespace rs::capture
