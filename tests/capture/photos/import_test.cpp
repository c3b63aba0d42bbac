#include "capture/photos/import.hpp"

#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/photos/turn_of_images.hpp"
#include "tests/support/camera_jpeg.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// photos/1.png .. N.png, composited over white; no calibration: a disc that always looks the same does not allow one.
class ImportTest : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder_ / "photos");
        for (int i = 0; i < turn_.views; ++i) write(i + 1, test::draw_view(turn_, i).photo);
        options_.photos = folder_ / "photos";
        options_.output = folder_ / "set";
        options_.turning = Turning::kClockwise;
        options_.calibration = CalibrationChoice::kNominal;
    }
    void write(int number, const Image<Rgba8>& image) const {
        const Status status = write_png(photo(number), image);
        ASSERT_TRUE(status.ok()) << status.error().message;
    }
    [[nodiscard]] std::filesystem::path photo(int number) const {
        return folder_ / "photos" / (std::to_string(number) + ".png");
    }
    // All files in the test's folder except the photos.
    [[nodiscard]] bool output_is_clean() const {
        const std::filesystem::directory_iterator entries(folder_.path());
        return std::all_of(begin(entries), end(entries),
                           [](const auto& entry) { return entry.path().filename() == "photos"; });
    }

    test::TemporaryFolder folder_;
    test::DrawnTurn turn_;
    ImportOptions options_;
};

TEST_F(ImportTest, MakesACaptureSet) {
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->views, 12);
    EXPECT_EQ(report->method, CalibrationMethod::kNominal);
    EXPECT_EQ(report->backdrop, BackgroundKind::kWhite);
    EXPECT_EQ(report->nominal.axis_from, "silhouettes");
    EXPECT_NEAR(report->nominal.axis_x_px, turn_.axis_x_px, 0.6);
    EXPECT_EQ(report->step_deg, 30);

    const Result<Rig> rig = read_rig(options_.output);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    ASSERT_EQ(rig->views.size(), 12U);
    EXPECT_EQ(rig->object_radius, 1);
    EXPECT_EQ(rig->extras["photo_import"]["backdrop"], "white");
    EXPECT_EQ(rig->views[10].extras["source_file"], "11.png") << "natural order";
    for (int i = 0; i < 12; ++i) {
        const RigView& view = rig->views[static_cast<std::size_t>(i)];
        EXPECT_NEAR(view.camera.cx, report->nominal.axis_x_px, 1e-9);
        const Result<Image<Rgba8>> cut = read_image(image_path(options_.output, view));
        ASSERT_TRUE(cut.ok()) << cut.error().message;
        const test::DrawnView truth = test::draw_view(turn_, i);
        double wrong = 0;
        for (int y = 0; y < turn_.height; ++y) {
            for (int x = 0; x < turn_.width; ++x) wrong += std::abs((*cut)(x, y).a / 255.0 - truth.alpha(x, y));
        }
        EXPECT_LT(wrong, 0.02 * 3.14 * turn_.radius_px * turn_.radius_px) << "view " << i;
    }
}

// The same, stored on its side with EXIF data, as a phone does.
TEST_F(ImportTest, TurnsWhatAPhoneTookOnItsSide) {
    for (int i = 0; i < turn_.views; ++i) {
        const Image<Rgba8> shown = test::draw_view(turn_, i).photo;
        Image<Rgba8> stored(shown.height(), shown.width());
        for (int y = 0; y < shown.height(); ++y) {
            for (int x = 0; x < shown.width(); ++x) stored(y, shown.width() - 1 - x) = shown(x, y);
        }
        const std::filesystem::path jpeg = folder_ / "photos" / (std::to_string(i + 1) + ".jpg");
        ASSERT_TRUE(write_jpeg(jpeg, stored, 98).ok());
        test::add_exif(jpeg, 6, 50);
        std::filesystem::remove(photo(i + 1));
    }
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->folder.width, turn_.width);
    EXPECT_EQ(report->folder.height, turn_.height);
    EXPECT_NEAR(report->nominal.axis_x_px, turn_.axis_x_px, 0.6);
    // 43.27 mm of film across the diagonal, 50 mm behind the lens.
    const double half_mm = 0.5 * 43.27 * turn_.width / std::hypot(turn_.width, turn_.height);
    EXPECT_EQ(report->nominal.fov_from, "camera");
    EXPECT_NEAR(report->nominal.fov_deg, 2 * std::atan(half_mm / 50) * 180 / 3.14159265, 1e-3);
    const Result<Rig> rig = read_rig(options_.output);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    const Result<Image<Rgba8>> cut = read_image(image_path(options_.output, rig->views[3]));
    ASSERT_TRUE(cut.ok()) << cut.error().message;
    const test::DrawnView truth = test::draw_view(turn_, 3);
    double wrong = 0;
    for (int y = 0; y < turn_.height; ++y) {
        for (int x = 0; x < turn_.width; ++x) wrong += std::abs((*cut)(x, y).a / 255.0 - truth.alpha(x, y));
    }
    EXPECT_LT(wrong, 0.03 * 3.14 * turn_.radius_px * turn_.radius_px);
}

TEST_F(ImportTest, RefusesMasksThatMayBeOfOtherPixels) {
    for (int i = 0; i < turn_.views; ++i) {
        const std::filesystem::path jpeg = folder_ / "photos" / (std::to_string(i + 1) + ".jpg");
        ASSERT_TRUE(write_jpeg(jpeg, test::draw_view(turn_, i).photo, 98).ok());
        test::add_exif(jpeg, 3);
        std::filesystem::remove(photo(i + 1));
    }
    options_.segmentation.masks = folder_ / "photos";
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_FALSE(report.ok());
    EXPECT_THAT(report.error().message, HasSubstr("EXIF orientation is 3"));
    EXPECT_TRUE(output_is_clean());
    // One photo with another orientation, which a mask tool may have applied.
    for (int i = 0; i < turn_.views; ++i) {
        const std::filesystem::path jpeg = folder_ / "photos" / (std::to_string(i + 1) + ".jpg");
        ASSERT_TRUE(write_jpeg(jpeg, test::draw_view(turn_, i).photo, 98).ok());
        if (i == 4) test::add_exif(jpeg, 3);
    }
    const Result<ImportReport> mixed = import_photos(options_, nullptr);
    ASSERT_FALSE(mixed.ok());
    EXPECT_THAT(mixed.error().message, HasSubstr("several EXIF orientations"));
    options_.segmentation.masks.clear();
    const Result<ImportReport> without = import_photos(options_, nullptr);
    ASSERT_TRUE(without.ok()) << without.error().message;
    EXPECT_EQ(without->nominal.fov_from, "assumed");
}

TEST_F(ImportTest, LargePhotographsAreWorkedOnSmaller) {
    options_.max_side_px = std::max(turn_.width, turn_.height) / 2;
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->folder.width, turn_.width / 2);
    EXPECT_NEAR(report->nominal.axis_x_px, turn_.axis_x_px / 2, 0.4);
    ASSERT_FALSE(report->notes.empty());
    EXPECT_THAT(report->notes.front(), HasSubstr("--max-side"));
    const Result<Rig> rig = read_rig(options_.output);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->views[0].camera.width, turn_.width / 2);
    EXPECT_EQ(rig->extras["photo_import"]["reduced_from"][0], turn_.width);
    options_.max_side_px = kMinSide_px - 1;
    const Result<ImportReport> refused = import_photos(options_, nullptr);
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, HasSubstr("--max-side"));
}

// A piece of furniture that is included in the masks, and a flag at the border that changes.
TEST_F(ImportTest, RefusesStaticBackgroundAtTheBorderUnlessForced) {
    std::filesystem::create_directory(folder_ / "masks");
    options_.segmentation.masks = folder_ / "masks";
    for (const bool changes : {true, false}) {
        for (int i = 0; i < turn_.views; ++i) {
            test::DrawnView view = test::draw_view(turn_, i);
            Image<Rgba8> mask(turn_.width, turn_.height, Rgba8{0, 0, 0, 255});
            for (int y = 0; y < turn_.height; ++y) {
                for (int x = 0; x < turn_.width; ++x) {
                    const bool thing = x < turn_.width / 8 && y > turn_.height / 2;
                    const auto code = static_cast<std::uint8_t>(changes ? 20 * i : 90);
                    if (thing) view.photo(x, y) = {code, 120, 40, 255};
                    if (thing || view.alpha(x, y) > 0.5) mask(x, y) = {255, 255, 255, 255};
                }
            }
            write(i + 1, view.photo);
            ASSERT_TRUE(write_png(options_.segmentation.masks / (std::to_string(i + 1) + ".png"), mask).ok());
        }
        const auto never_changes = testing::Contains(HasSubstr("never changes"));
        const auto at_border = testing::Contains(HasSubstr("reaches the image border in 12 of 12"));
        Result<ImportReport> report = import_photos(options_, nullptr);
        if (changes) {
            ASSERT_TRUE(report.ok()) << report.error().message;
            EXPECT_THAT(report->notes, AllOf(at_border, testing::Not(never_changes)));
            std::filesystem::remove_all(options_.output);
            continue;
        }
        ASSERT_FALSE(report.ok());
        EXPECT_THAT(report.error().message, AllOf(HasSubstr("never changes"), HasSubstr("--force")));
        EXPECT_FALSE(std::filesystem::exists(options_.output));
        options_.force = true;
        report = import_photos(options_, nullptr);
        ASSERT_TRUE(report.ok()) << report.error().message;
        EXPECT_THAT(report->notes, AllOf(at_border, never_changes));
    }
}

TEST_F(ImportTest, DropsTheRepeatedLastView) {
    write(13, test::draw_view(turn_, 0).photo);
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->views, 12);
    EXPECT_EQ(report->dropped_repeat, "13.png");
    EXPECT_THAT(report->notes, testing::Contains(HasSubstr("13.png repeats 1.png")));
}

TEST_F(ImportTest, TakesWhatIsGiven) {
    options_.axis_x_px = 77.25;
    options_.degrees_per_view = 5;
    options_.turning = Turning::kCounterClockwise;
    options_.segmentation.background = *parse_background("255,255,255");
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->backdrop, BackgroundKind::kColour);
    const Rig rig = *read_rig(options_.output);
    EXPECT_EQ(rig.views[0].camera.cx, 77.25);
    const glm::dvec3 second = rig.views[1].camera.centre();
    EXPECT_NEAR(std::atan2(second.x, second.z), -radians(5), 1e-9);
}

TEST_F(ImportTest, SaysSoWhereThereIsNoFullTurn) {
    options_.degrees_per_view = 5;
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->nominal.axis_from, "image middle");
    EXPECT_THAT(report->notes, testing::Contains(HasSubstr("--axis-x")));
}

TEST_F(ImportTest, ACorruptImageLeavesNothing) {
    const auto size = std::filesystem::file_size(photo(7));
    std::filesystem::resize_file(photo(7), size / 2);
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_FALSE(report.ok());
    EXPECT_THAT(report.error().message, HasSubstr("7.png"));
    EXPECT_TRUE(output_is_clean());
}

TEST_F(ImportTest, AViewWithoutTheObjectLeavesNothing) {
    write(5, Image<Rgba8>(turn_.width, turn_.height, turn_.backdrop));
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_FALSE(report.ok());
    EXPECT_THAT(report.error().message, HasSubstr("5.png"));
    EXPECT_TRUE(output_is_clean());
}

TEST_F(ImportTest, AViewThatIsAllObjectLeavesNothing) {
    write(5, Image<Rgba8>(turn_.width, turn_.height, Rgba8{190, 60, 40, 255}));
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_FALSE(report.ok());
    EXPECT_THAT(report.error().message, HasSubstr("5.png: the object covers the whole image"));
    EXPECT_TRUE(output_is_clean());
}

TEST_F(ImportTest, AViewWithItsOwnAlphaMayBeAllObject) {
    for (int i = 1; i <= turn_.views; ++i) {
        Image<Rgba8> image(turn_.width, turn_.height, Rgba8{190, 60, static_cast<std::uint8_t>(20 * i), 255});
        for (int y = 0; y < turn_.height && i != 5; ++y) image(0, y).a = image(1, y).a = 0;
        write(i, image);
    }
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->max_coverage, 1);
}

// Counts the photos processed under each label.
class Counts final : public Progress {
public:
    void start(const std::string& label, std::int64_t total) override {
        done = 0;
        last_label = label;
        last_total = total;
    }
    void advance(std::int64_t steps) override { done += steps; }
    void finish() override {}

    std::string last_label;
    std::int64_t last_total = 0;
    std::atomic<std::int64_t> done = 0;
};

TEST_F(ImportTest, StopsAtTheFirstFailureOfEitherPass) {
    tbb::task_arena one_thread(1);  // photos are then processed in order
    write(1, Image<Rgba8>(turn_.width, turn_.height, turn_.backdrop));
    Counts cutting;
    ASSERT_FALSE(one_thread.execute([&] { return import_photos(options_, &cutting); }).ok());
    EXPECT_EQ(cutting.last_label, "segmenting");
    EXPECT_EQ(cutting.last_total, turn_.views);
    EXPECT_EQ(cutting.done, 0);

    std::filesystem::resize_file(photo(1), std::filesystem::file_size(photo(1)) / 2);
    Counts looking;
    ASSERT_FALSE(one_thread.execute([&] { return import_photos(options_, &looking); }).ok());
    EXPECT_EQ(looking.last_label, "surveying photos");
    EXPECT_EQ(looking.done, 0);
}

// All files below `folder`.
std::vector<std::string> names_below(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) names.push_back(entry.path());
    std::sort(names.begin(), names.end());
    return names;
}

TEST_F(ImportTest, RefusesToReplaceItsOwnPhotographs) {
    ASSERT_TRUE(import_photos(options_, nullptr).ok());
    // A set's images are photos with alpha: without the check they would be replaced by themselves.
    const std::filesystem::path set = options_.output;
    const auto before = names_below(folder_.path());
    std::filesystem::create_directory_symlink(set, folder_ / "link");
    for (const auto& [photos, output] : {std::pair{set / "images", set},
                                         {set / "images", set / "images" / ".." / ""},
                                         {set / "images", folder_ / "link"},
                                         {folder_ / "link" / "images", set},
                                         {folder_ / "photos", folder_ / "photos"},
                                         {folder_ / "photos" / "", folder_.path()}}) {
        options_.photos = photos;
        options_.output = output;
        const Result<ImportReport> report = import_photos(options_, nullptr);
        ASSERT_FALSE(report.ok()) << photos << " " << output;
        EXPECT_THAT(report.error().message, HasSubstr(photos.string()));
        EXPECT_THAT(report.error().message, HasSubstr(output.string() + ": "));
        EXPECT_THAT(report.error().message, HasSubstr("would overwrite"));
    }
    std::filesystem::remove(folder_ / "link");
    EXPECT_EQ(names_below(folder_.path()), before);
}

TEST_F(ImportTest, MayWriteBesideOrBelowThePhotographs) {
    options_.output = folder_ / "photos-set";  // a longer name is not a folder inside
    EXPECT_TRUE(import_photos(options_, nullptr).ok());
    options_.output = options_.photos / "set";
    EXPECT_TRUE(import_photos(options_, nullptr).ok());
}

TEST_F(ImportTest, RefusesAFolderThatIsNotASet) {
    std::filesystem::create_directory(options_.output);
    std::ofstream(options_.output / "letter.txt") << "keep me";
    const Result<ImportReport> report = import_photos(options_, nullptr);
    ASSERT_FALSE(report.ok());
    EXPECT_TRUE(std::filesystem::exists(options_.output / "letter.txt"));
}

TEST_F(ImportTest, ReplacesASetOfItsOwn) {
    ASSERT_TRUE(import_photos(options_, nullptr).ok());
    std::filesystem::remove(photo(12));
    ASSERT_TRUE(import_photos(options_, nullptr).ok());
    EXPECT_EQ(read_rig(options_.output)->views.size(), 11U);
    EXPECT_FALSE(std::filesystem::exists(options_.output / "images" / "0011.png"));
}

TEST_F(ImportTest, RefusesOptionsOutOfRange) {
    options_.fov_deg = 0.5;
    EXPECT_FALSE(import_photos(options_, nullptr).ok());
    options_.fov_deg = 25;
    options_.degrees_per_view = 0;
    EXPECT_FALSE(import_photos(options_, nullptr).ok());
    options_.degrees_per_view.reset();
    options_.axis_x_px = std::nan("");
    EXPECT_FALSE(import_photos(options_, nullptr).ok());
    EXPECT_TRUE(output_is_clean());
}

}  // namespace
}  // namespace rs::capture
