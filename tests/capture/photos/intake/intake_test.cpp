#include "capture/photos/intake/intake.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace rs::capture {
namespace {

TEST(Intake, ReportsIgnoredFiles) {
    const test::TemporaryFolder folder;
    for (int i = 1; i <= 5; ++i) {
        const auto code = static_cast<std::uint8_t>(40 * i);
        const Image<Rgba8> image(64, 48, Rgba8{code, 90, 90, 255});
        ASSERT_TRUE(write_jpeg(folder / (std::to_string(i) + ".jpg"), image, 90).ok());
        if (i > 3) continue;
        ASSERT_TRUE(write_png(folder / (std::to_string(i) + ".png"), image).ok());
    }
    std::ofstream(folder / "1.cr2") << "raw";
    Result<PhotoFolder> found = open_photo_folder(folder.path());
    ASSERT_TRUE(found.ok()) << found.error().message;
    const Result<Intake> taken = run_intake(std::move(*found), nullptr);
    ASSERT_TRUE(taken.ok()) << taken.error().message;
    EXPECT_THAT(taken->notes, testing::ElementsAre("ignored, not an image: 1.cr2",
                                                   "ignored, present in another format, too: 1.png and 2 more"));
}

}  // namespace
}  // namespace rs::capture
