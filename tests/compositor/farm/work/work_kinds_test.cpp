#include "compositor/farm/work/work_kinds.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace rs::farm {
namespace {

const WorkKind& import_kind() {
    return kWorkKinds[1];
}

class ItemsOfPhotographs : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder_ / "shoe");
        // 2600 and 2500 times one pixel: beside the limit of 1.25 times 2048.
        write("large", 2600);
        write("small", 2500);
    }
    void write(const std::string& name, int width) const {
        std::filesystem::create_directory(folder_ / name);
        for (const char* file : {"1.png", "2.png"}) {
            ASSERT_TRUE(write_png(folder_ / name / file, Image<Rgba8>(width, 1)).ok());
        }
    }
    [[nodiscard]] Item item(const std::string& name, std::vector<std::string> options = {}) const {
        const Result<std::vector<Item>> items =
            items_of(import_kind(), {{(folder_ / name).string()}, folder_ / "out", std::move(options), {}});
        EXPECT_TRUE(items.ok());
        return items->front();
    }
    rs::test::TemporaryFolder folder_;
};

TEST_F(ItemsOfPhotographs, CountThePixelsThatAreWorkedWith) {
    ASSERT_STREQ(import_kind().name, "import");
    const double reduction = 2600 / 2048.0;
    EXPECT_NEAR(item("large").size, 2 * 2600 / (reduction * reduction), 1e-6);
    EXPECT_EQ(item("small").size, 2 * 2500);
    EXPECT_EQ(item("large", {"--max-side", "2400"}).size, 2 * 2600);
    EXPECT_EQ(item("large", {"--fov", "20", "--max-side=2400"}).size, 2 * 2600);
    EXPECT_EQ(item("large").memory_bytes,
              static_cast<std::int64_t>(200e6 + (8 * 2 + 312) * 2600 / (reduction * reduction)));
}

TEST_F(ItemsOfPhotographs, CountWhatReadingTakes) {
    // Worked with as 100 x 0.04: what it takes to read 2600 pixels is more.
    EXPECT_NEAR(item("large", {"--max-side", "100"}).size, 2 * 2600 * 24.0 / 312, 1e-6);
}

}  // namespace
}  // namespace rs::farm
