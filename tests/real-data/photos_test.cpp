// Three real turns: what must hold of every view, whatever the photographs look like in detail.

#include "capture/photos/import.hpp"
#include "capture/photos/rig/turning.hpp"
#include "encode/evaluation/evaluation.hpp"
#include "encode/hold_out.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace rs::capture {
namespace {

struct Imported {
    ImportReport report;
    Rig rig;
    std::vector<Image<Rgba8>> cuts;
    double held_out_db = 0;    // of views between the photographs: every second one held out
    double held_out_ssim = 0;  // likewise
};

void score_held_out(const std::filesystem::path& folder, Imported& imported) {
    const Result<encode::CaptureSet> set = encode::open_capture_set(folder);
    ASSERT_TRUE(set.ok()) << set.error().message;
    const Result<encode::HoldOut> hold_out = encode::choose_hold_out(set->upright, 2, folder.string());
    ASSERT_TRUE(hold_out.ok()) << hold_out.error().message;
    const auto scores = encode::evaluate(*set, *hold_out, {.methods = {encode::Method::kShape}});
    ASSERT_TRUE(scores.ok()) << scores.error().message;
    imported.held_out_db = scores->front().mean_psnr_db;
    imported.held_out_ssim = scores->front().mean_ssim;
}

Imported import(const std::filesystem::path& photos, CalibrationChoice calibration) {
    const test::TemporaryFolder folder;
    ImportOptions options;
    options.photos = photos;
    options.output = folder / "set";
    options.calibration = calibration;
    const Result<ImportReport> report = import_photos(options, nullptr);
    EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.error().message);
    if (!report.ok()) return {};
    Imported imported{*report, *read_rig(options.output), {}, 0, 0};
    for (const RigView& view : imported.rig.views)
        imported.cuts.push_back(*read_image(image_path(options.output, view)));
    if (calibration == CalibrationChoice::kTracks) score_held_out(options.output, imported);
    return imported;
}

// Solid pixels of the largest 4-connected part, and of all parts.
struct Parts {
    int largest = 0;
    int all = 0;
};

Parts solid_parts(const Image<Rgba8>& cut) {
    Parts parts;
    Image<std::uint8_t> seen(cut.width(), cut.height());
    std::vector<std::pair<int, int>> open;
    for (int y = 0; y < cut.height(); ++y) {
        for (int x = 0; x < cut.width(); ++x) {
            if (cut(x, y).a < 128 || seen(x, y) != 0) continue;
            int size = 0;
            seen(x, y) = 1;
            open.assign(1, {x, y});
            while (!open.empty()) {
                const auto [u, v] = open.back();
                open.pop_back();
                ++size;
                for (const auto& [p, q] : {std::pair{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}}) {
                    if (p < 0 || q < 0 || p >= cut.width() || q >= cut.height()) continue;
                    if (cut(p, q).a < 128 || seen(p, q) != 0) continue;
                    seen(p, q) = 1;
                    open.emplace_back(p, q);
                }
            }
            parts.largest = std::max(parts.largest, size);
            parts.all += size;
        }
    }
    return parts;
}

// Solid pixels within 2 px of the image's border.
int solid_at_border(const Image<Rgba8>& cut) {
    int count = 0;
    for (int y = 0; y < cut.height(); ++y) {
        for (int x = 0; x < cut.width(); ++x) {
            const bool border = x < 2 || y < 2 || x >= cut.width() - 2 || y >= cut.height() - 2;
            count += border && cut(x, y).a >= 128 ? 1 : 0;
        }
    }
    return count;
}

void expect_one_object_in_every_view(const Imported& imported) {
    for (std::size_t i = 0; i < imported.cuts.size(); ++i) {
        const Parts parts = solid_parts(imported.cuts[i]);
        EXPECT_GE(parts.largest, 0.97 * parts.all) << "view " << i;
    }
}

// As a nominal rig asks for it.
std::optional<Turning> turning_by_images(const ImportReport& report) {
    const std::vector<Image<Rgba8>>& turn = report.small_foregrounds;
    const double axis_px = report.nominal.axis_x_px * turn.front().width() / report.folder.width;
    double half_width_px = 0;
    for (const Image<Rgba8>& cut : turn) {
        for (int y = 0; y < cut.height(); ++y) {
            for (int x = 0; x < cut.width(); ++x) {
                if (cut(x, y).a != 0) half_width_px = std::max(half_width_px, std::abs(x + 0.5 - axis_px));
            }
        }
    }
    return find_turning(turn, axis_px, half_width_px, 2 * kPi / static_cast<double>(turn.size()), true).turning;
}

TEST(RealPhotos, DinosaurOnABlueDisc) {
    const auto photos = RS_REAL_DATA_OR_SKIP("turntable/oxford-dino");
    const Imported imported = import(photos, CalibrationChoice::kTracks);
    ASSERT_EQ(imported.cuts.size(), 36U);
    EXPECT_EQ(imported.report.dropped_repeat, "viff.036.png");
    EXPECT_EQ(imported.report.backdrop, BackgroundKind::kColour);
    EXPECT_GT(imported.report.backdrop_colour.b, imported.report.backdrop_colour.r + 40);
    EXPECT_EQ(imported.report.turning, Turning::kClockwise);
    EXPECT_EQ(imported.report.nominal.turning_from, "") << "points tell it";
    EXPECT_EQ(turning_by_images(imported.report), Turning::kClockwise);
    EXPECT_LT(imported.report.nominal.axis_spread_px, 5);
    EXPECT_GT(imported.report.min_coverage, 0.09);
    EXPECT_LT(imported.report.max_coverage, 0.18);
    expect_one_object_in_every_view(imported);
    for (std::size_t i = 0; i < imported.cuts.size(); ++i) {
        // The dinosaur's colours are yellow to red and white; what is blue and solid would be the disc.
        int blue = 0;
        int solid = 0;
        for (const Rgba8& p : imported.cuts[i].pixels()) {
            if (p.a < 200) continue;
            ++solid;
            blue += p.b > p.r + 35 && p.b > 90 ? 1 : 0;
        }
        EXPECT_LT(blue, 0.004 * solid) << "view " << i;
        EXPECT_EQ(solid_at_border(imported.cuts[i]), 0) << "view " << i;
    }
    // 20 degrees apart; 21.97 dB and 0.797 were measured.
    EXPECT_GT(imported.held_out_db, 21.5);
    EXPECT_GT(imported.held_out_ssim, 0.78);
}

TEST(RealPhotos, ShoeOnWhiteWithASoftShadow) {
    const auto photos = RS_REAL_DATA_OR_SKIP("turntable/shoe36");
    const Imported imported = import(photos, CalibrationChoice::kNominal);
    ASSERT_EQ(imported.cuts.size(), 36U);
    EXPECT_EQ(imported.report.dropped_repeat, "");
    EXPECT_EQ(imported.report.backdrop, BackgroundKind::kWhite);
    EXPECT_EQ(imported.report.turning, Turning::kClockwise);
    EXPECT_NEAR(imported.report.nominal.axis_x_px, 400, 8);
    EXPECT_GT(imported.report.min_coverage, 0.12);
    EXPECT_LT(imported.report.max_coverage, 0.42);
    expect_one_object_in_every_view(imported);
    for (const Image<Rgba8>& cut : imported.cuts) {
        // The shoe's heel comes up to the right side in two views; elsewhere the border is free.
        EXPECT_LT(solid_at_border(cut), 60);
    }
}

TEST(RealPhotos, CarWithItsOwnAlpha) {
    const auto photos = RS_REAL_DATA_OR_SKIP("turntable/car52");
    const Imported imported = import(photos, CalibrationChoice::kNominal);
    ASSERT_EQ(imported.cuts.size(), 51U);
    EXPECT_EQ(imported.report.dropped_repeat, "52.png");
    EXPECT_EQ(imported.report.backdrop, BackgroundKind::kAlpha);
    EXPECT_EQ(imported.report.turning, Turning::kCounterClockwise);
    EXPECT_NEAR(imported.report.nominal.axis_x_px, 500, 10);
    EXPECT_EQ(imported.rig.views[9].extras["source_file"], "10.png");
    expect_one_object_in_every_view(imported);
    for (std::size_t i = 0; i < imported.cuts.size(); i += 10) {
        const Image<Rgba8> photo = *read_image(photos / (std::to_string(i + 1) + ".png"));
        for (int y = 0; y < photo.height(); ++y) {
            for (int x = 0; x < photo.width(); ++x) {
                if (photo(x, y).a > 0) {
                    ASSERT_EQ(imported.cuts[i](x, y), photo(x, y));
                } else {
                    ASSERT_EQ(imported.cuts[i](x, y).a, 0);
                }
            }
        }
    }
}

}  // namespace
}  // namespace rs::capture
