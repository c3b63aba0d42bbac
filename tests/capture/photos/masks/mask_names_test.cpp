#include "capture/photos/masks/mask_names.hpp"

#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class NamesOfMasks : public testing::Test {
protected:
    void touch(const std::vector<std::string>& names) {
        for (const std::string& name : names) ASSERT_TRUE(write_file(folder_ / name, "x").ok());
    }
    std::vector<std::string> masks_of(const std::filesystem::path& photo) {
        const Result<MaskNames> names = MaskNames::list(folder_.path());
        EXPECT_TRUE(names.ok()) << names.error().message;
        std::vector<std::string> masks;
        if (names) {
            for (const auto& mask : names->masks_of(photo)) masks.push_back(mask.filename().string());
        }
        return masks;
    }
    test::TemporaryFolder folder_;
};

TEST_F(NamesOfMasks, AreTriedInOrder) {
    touch(
        {"7.jpg", "7.tif", "7.png", "7.jpg.png", "7_mask.jpg", "7_mask.png", "7-mask.png", "7.mask.png", "mask_7.png"});
    EXPECT_THAT(masks_of("in/7.jpg"), ElementsAre("7.jpg", "7.png", "7.tif", "7.jpg.png", "7_mask.png", "7_mask.jpg",
                                                  "7-mask.png", "7.mask.png", "mask_7.png"));
}

TEST_F(NamesOfMasks, MayBeInEitherCaseButForThePhotosName) {
    touch({"A.PNG", "B.JPG.Png", "C_Mask.png", "MASK_d.png", "e.png"});
    EXPECT_THAT(masks_of("in/A.jpg"), ElementsAre("A.PNG"));
    EXPECT_THAT(masks_of("in/B.JPG"), ElementsAre("B.JPG.Png"));
    EXPECT_THAT(masks_of("in/C.jpg"), ElementsAre("C_Mask.png"));
    EXPECT_THAT(masks_of("in/d.jpg"), ElementsAre("MASK_d.png"));
    EXPECT_THAT(masks_of("in/E.jpg"), IsEmpty());
}

TEST_F(NamesOfMasks, AreNoOtherFiles) {
    touch({".a.png", "a.txt", "aa.png", "a_mask2.png"});
    std::filesystem::create_directory(folder_ / "a.png");
    EXPECT_THAT(masks_of("in/a.jpg"), IsEmpty());
}

TEST_F(NamesOfMasks, InThePhotosOwnFolderAreNotThePhotos) {
    touch({"a.png", "a_mask.png"});
    EXPECT_THAT(masks_of(folder_ / "a.png"), ElementsAre("a_mask.png"));
}

}  // namespace
}  // namespace rs::capture
