// Names and folders of saved images and videos, and the interface's scale; without a window.

#include "compositor/window/view_recorder.hpp"
#include "compositor/window/window.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace rs::compositor {
namespace {

using ::testing::HasSubstr;

TEST(ViewRecorder, FilesHaveTheTypedNamesInAFolderThatIsCreated) {
    const test::TemporaryFolder work;
    const std::string folder = (work / "new/deep").string();
    ViewRecorder recorder({.folder = folder, .image = "shoe", .video = "turn"});
    const Image<Rgba8> image(64, 48, Rgba8{10, 200, 30, 255});
    EXPECT_EQ(recorder.write_png_screenshot(image), folder + "/shoe-1.png");
    EXPECT_EQ(recorder.write_jpeg_screenshot(image), folder + "/shoe-2.jpg");
    recorder.set_names({.folder = folder, .image = "boot", .video = "turn"});
    EXPECT_EQ(recorder.write_png_screenshot(image), folder + "/boot-1.png");
    EXPECT_EQ(*read_image(folder + "/boot-1.png"), image);
    ASSERT_TRUE(recorder.begin_video(64, 48, 25).ok());
    for (int n = 0; n < 3; ++n) ASSERT_TRUE(recorder.add_frame(image).ok());
    recorder.end_video();
    EXPECT_TRUE(std::filesystem::exists(folder + "/turn-1.mp4"));
}

TEST(ViewRecorder, NamesThatNoFileCanHaveAreReported) {
    const test::TemporaryFolder work;
    ASSERT_TRUE(write_file(work / "file", std::string("x")).ok());
    const Image<Rgba8> image(8, 8, Rgba8{0, 0, 0, 255});
    const auto message = [&](const std::string& folder, const std::string& name) {
        ViewRecorder recorder({.folder = folder, .image = name, .video = name});
        const Result<std::string> video = recorder.begin_video(8, 8, 25);
        EXPECT_FALSE(video.ok()) << name;
        return recorder.write_png_screenshot(image);
    };
    EXPECT_THAT(message(work.path().string(), "../out"), HasSubstr("type a name without /"));
    EXPECT_THAT(message(work.path().string(), ""), HasSubstr("type a name without /"));
    EXPECT_THAT(message((work / "file").string(), "shot"), HasSubstr("is no folder"));
    message(work.path().string(), std::string(400, 'n'));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(work.path()), {}), 1);
}

TEST(InterfaceScale, IsTheContentScaleThatWindowUnitsLack) {
    EXPECT_EQ(interface_scale(1, 1280, 1280), 1);
    EXPECT_EQ(interface_scale(1.04, 1280, 1280), 1);
    EXPECT_EQ(interface_scale(1.5, 1280, 1280), 1.5);
    EXPECT_EQ(interface_scale(2, 1280, 1280), 2);
    EXPECT_EQ(interface_scale(2, 1280, 2560), 1);  // window units are scaled already
    EXPECT_EQ(interface_scale(0, 0, 0), 1);
    EXPECT_EQ(interface_scale(100, 1280, 1280), 4);
}

}  // namespace
}  // namespace rs::compositor
