#pragma once
// Folder of rendered photos of a drum with alpha, and the common expectations for failed imports.

#include "capture/photos/import.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/calibration/drawn_drum.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rs::test {

inline constexpr int kViews = 18;

inline capture::TurntableModel drum_model() {
    return drum_turn(kViews, -radians(20));
}

// Photos with alpha.
inline const std::vector<Image<Rgba8>>& spotted() {
    static const auto kImages = [] {
        std::vector<Image<Rgba8>> images;
        for (std::size_t i = 0; i < kViews; ++i) images.push_back(drawn_drum({}, drum_model(), i));
        return images;
    }();
    return kImages;
}

inline Image<Rgba8> plain(std::size_t view) {
    Drum drum;
    drum.is_spotted = false;
    return drawn_drum(drum, drum_model(), view);
}

inline std::string file_name(std::size_t view) {
    return (view < 10 ? "0" : "") + std::to_string(view) + ".png";
}

// photos/00.png .. 17.png with alpha.
class DrumPhotos : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder_ / "photos");
        options_.photos = folder_ / "photos";
        options_.output = folder_ / "set";
        options_.known.known.f_px = 620;  // shortens the search for a start
        options_.turning = capture::Turning::kClockwise;
    }
    void write(std::size_t view, const Image<Rgba8>& image) const {
        const Status status = write_png(folder_ / "photos" / file_name(view), image);
        ASSERT_TRUE(status.ok()) << status.error().message;
    }
    void write_spotted() const {
        for (std::size_t i = 0; i < kViews; ++i) write(i, spotted()[i]);
    }
    void write_plain() const {
        for (std::size_t i = 0; i < kViews; ++i) write(i, plain(i));
    }
    // The rig of the renderings, as another tool might provide it.
    [[nodiscard]] capture::KnownFile truth() const {
        capture::KnownFile file;
        const capture::TurntableModel model = drum_model();
        file.known.f_px = model.lens.f_px;
        file.known.principal_point = {model.lens.cx, model.lens.cy};
        file.known.distortion = {0, 0};
        file.known.pose = model.pose;
        file.known.angles_rad = model.angles_rad;
        for (std::size_t i = 0; i < kViews; ++i) file.images.push_back("images/" + file_name(i));
        return file;
    }
    void expect_error(const testing::Matcher<std::string>& words) const {
        const Result<capture::ImportReport> report = capture::import_photos(options_, nullptr);
        ASSERT_FALSE(report.ok());
        EXPECT_THAT(report.error().message, words);
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            EXPECT_EQ(entry.path().filename(), "photos") << "left over";
        }
    }

    TemporaryFolder folder_;
    capture::ImportOptions options_;
};

}  // namespace rs::test
