// The visual hull of silhouettes, and the lines of a shape map inside it.

#include "encode/raymap/silhouettes/visual_hull.hpp"

#include "encode/raymap/semi_global.hpp"
#include "encode/raymap/shape_lines.hpp"
#include "tests/encode/raymap/drawn_views.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace rs::encode {
namespace {

TEST(VisualHull, EqualsAskingEverySilhouette) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(12, 3));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> across(-1.1, 1.1);
    for (const int margin : {0, 1, 4}) {
        const VisualHull hull(pointers(views), margin);
        std::vector<Interval> heights;
        int inside = 0;
        for (int n = 0; n < 4000; ++n) {
            const glm::dvec2 place(across(random), across(random));
            hull.heights_above(place, heights);
            const double y = across(random);
            const bool allowed = std::any_of(heights.begin(), heights.end(),
                                             [&](const Interval& i) { return y >= i.low && y < i.high; });
            inside += allowed ? 1 : 0;
            ASSERT_EQ(allowed, is_allowed(views, place, y, margin)) << "margin " << margin << ", point " << n;
        }
        EXPECT_GT(inside, 100);
        EXPECT_LT(inside, 3000);
    }
}

TEST(VisualHull, RulesOutWhatMoreSilhouettesForbidThanAreTolerated) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(12, 3));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> across(-1.1, 1.1);
    for (const int tolerated : {1, 3, 12}) {
        const VisualHull hull(pointers(views), 1, tolerated);
        std::vector<Interval> heights;
        int forbidden_by_some = 0;
        for (int n = 0; n < 2000; ++n) {
            const glm::dvec2 place(across(random), across(random));
            hull.heights_above(place, heights);
            for (std::size_t i = 1; i < heights.size(); ++i) ASSERT_LE(heights[i - 1].high, heights[i].low);
            const double y = across(random);
            const bool allowed = std::any_of(heights.begin(), heights.end(),
                                             [&](const Interval& i) { return y >= i.low && y < i.high; });
            const auto forbid = std::count_if(views.begin(), views.end(),
                                              [&](const WorkView& view) { return !is_allowed({view}, place, y, 1); });
            forbidden_by_some += allowed && forbid > 0 ? 1 : 0;
            ASSERT_EQ(allowed, forbid <= tolerated) << tolerated << " tolerated, point " << n;
        }
        EXPECT_GT(forbidden_by_some, 10);
    }
}

TEST(VisualHull, TheHeightsWithinBoundsAreThoseOfAllCutToThem) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(12, 3));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> across(-1.1, 1.1);
    for (const int tolerated : {0, 2}) {
        const VisualHull hull(pointers(views), 1, tolerated);
        std::vector<Interval> all, some;
        int cut = 0;
        for (int n = 0; n < 2000; ++n) {
            const glm::dvec2 place(across(random), across(random));
            Interval within{across(random), across(random)};
            if (within.low > within.high) std::swap(within.low, within.high);
            hull.heights_above(place, all);
            hull.heights_above(place, some, within);
            std::vector<Interval> wanted;
            for (const Interval& each : all) {
                const Interval both{std::max(each.low, within.low), std::min(each.high, within.high)};
                if (both.low < both.high) wanted.push_back(both);
            }
            ASSERT_EQ(some.size(), wanted.size()) << tolerated << " tolerated, point " << n;
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                ASSERT_EQ(some[i].low, wanted[i].low);
                ASSERT_EQ(some[i].high, wanted[i].high);
            }
            cut += wanted.empty() ? 0 : 1;
        }
        EXPECT_GT(cut, 100);
    }
}

TEST(VisualHull, APartThatOneCutOutLacksIsKeptWhereThatIsTolerated) {
    std::vector<WorkView> views = drawn_views(drawn_ring(12));
    const DepthRange range;
    WorkView& torn = views[3];
    for (int column = 0; column < torn.width; ++column) {
        for (int row = 0; row < torn.height / 2; ++row) torn.columns(row, column) = {};
    }
    EXPECT_GT(inconsistent_share(pointers(views), VisualHull(pointers(views), 16), range), 0.05);
    EXPECT_LT(inconsistent_share(pointers(views), VisualHull(pointers(views), 1, 1), range), 0.01);
}

TEST(VisualHull, SilhouettesOfTheRightRigAgreeAndOfAWrongOneDoNot) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(12));
    const DepthRange range;
    EXPECT_LT(inconsistent_share(pointers(views), VisualHull(pointers(views), 1), range), 0.01);
    std::vector<WorkView> wrong = views;
    for (WorkView& view : wrong) view.cx += 9;
    EXPECT_GT(inconsistent_share(pointers(wrong), VisualHull(pointers(wrong), 1), range), 0.1);
}

TEST(VisualHull, AViewWithoutAnObjectSaysNothing) {
    std::vector<WorkView> views = drawn_views(drawn_ring(6));
    const VisualHull before(pointers(views), 1);
    WorkView empty = views[2];
    for (Rgba8& pixel : empty.columns.pixels()) pixel = {};
    views.push_back(empty);
    const VisualHull after(pointers(views), 1);
    std::vector<Interval> a, b;
    before.heights_above({0.1, 0.2}, a);
    after.heights_above({0.1, 0.2}, b);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_FALSE(a.empty());
    EXPECT_EQ(a[0].low, b[0].low);
}

TEST(SampledHull, HasTheHeightsOfTheNextPointOfItsGrid) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(9));
    constexpr double kSpacing = 0.013;
    for (const int tolerated : {0, 2}) {
        const VisualHull hull(pointers(views), 1, tolerated);
        const SampledHull sampled(hull, kSpacing);
        std::mt19937 random(4);
        std::uniform_real_distribution<double> along(-kMaxDepth, kMaxDepth);
        std::vector<Interval> wanted;
        int with_some = 0;
        for (int n = 0; n < 3000; ++n) {
            const glm::dvec2 place(along(random), along(random));
            hull.heights_above(kSpacing * glm::round(place / kSpacing), wanted);
            const auto found = sampled.heights_above(place);
            ASSERT_EQ(found.size(), wanted.size());
            with_some += wanted.empty() ? 0 : 1;
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                ASSERT_NEAR(found[i].low, wanted[i].low, 1e-9);
                ASSERT_NEAR(found[i].high, wanted[i].high, 1e-9);
            }
        }
        EXPECT_GT(with_some, 100);
    }
}

// Positions of the cells of the line of `viewpoint`, for cameras at one height.
class CellPlaces {
public:
    CellPlaces(const ShapeMap& map, const glm::dvec2& viewpoint) : map_(map), viewpoint_(viewpoint) {}

    struct Point {
        glm::dvec2 place;
        double y = 0;
    };
    [[nodiscard]] Point at(int p_cell, int band, double depth) const {
        const double p = -kMaxDepth + (p_cell + 0.5) * 2 * kMaxDepth / map_.p_cells;
        const double sine = p / glm::length(viewpoint_);
        const glm::dvec2 inwards = -glm::normalize(viewpoint_);
        const glm::dvec2 along = inwards * std::sqrt(1 - sine * sine) + glm::dvec2(-inwards.y, inwards.x) * sine;
        const double distance = std::ldexp(map_.reference_distance_q20, -20);
        const double camera_height = std::ldexp(map_.reference_height_q20, -20);
        const double rho = std::sqrt(distance * distance - p * p);
        const double h = std::ldexp(map_.h_low_q20, -20) + (band + 0.5) / std::ldexp(map_.bands_per_unit_q12, -12);
        return {p * glm::dvec2(-along.y, along.x) + depth * along,
                camera_height + (h - camera_height) * (rho + depth) / rho};
    }
    [[nodiscard]] const ShapeCell& cell(std::uint32_t line, int p_cell, int band) const {
        return map_.cells[(line * static_cast<std::size_t>(map_.p_cells) + static_cast<std::size_t>(p_cell)) *
                              static_cast<std::size_t>(map_.bands) +
                          static_cast<std::size_t>(band)];
    }

private:
    const ShapeMap& map_;
    glm::dvec2 viewpoint_;
};

// Every depth is wrong by the maximum: the far end of the search range. Seen from between two images, such points lie
// beside the object.
TEST(ShapeLines, NothingFloatsBesideTheObjectWhereSilhouettesAgree) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(12));
    const SampledHull hull(VisualHull(pointers(views), 1), 0.01);
    std::vector<DepthView> found;
    for (const WorkView& view : views) {
        DepthView& one = found.emplace_back(DepthView{view, Image<float>(view.height, view.width, kNoDepth)});
        for (int column = 0; column < view.width; ++column) {
            for (int row = 0; row < view.height; ++row) {
                if (view.at(column, row).a >= 128) one.depth(row, column) = 1.0F;
            }
        }
    }
    ShapeLinesOptions options;
    options.line_deg = 30;
    const ShapeMap clean = make_shape_lines({{.ring = found, .hull = &hull}}, options);
    const ShapeMap all = make_shape_lines({{.ring = found, .hull = &hull, .silhouettes_agree = false}}, options);
    ASSERT_EQ(clean.cells.size(), all.cells.size());

    const CellPlaces places(all, 0.5 * (views[0].centre + views[1].centre));
    const CellPlaces clean_places(clean, 0.5 * (views[0].centre + views[1].centre));
    ASSERT_EQ(all.gaps[0].lines, 1) << "which looks from halfway";
    const std::uint32_t line = all.gaps[0].first_line;
    const auto allowed = [&](int pi, int hi) {
        for (double depth = -kMaxDepth; depth <= kMaxDepth; depth += 0.01) {
            const CellPlaces::Point point = places.at(pi, hi, depth);
            if (is_allowed(views, point.place, point.y, 2)) return true;
        }
        return false;
    };
    int dropped = 0;
    for (int pi = 1; pi + 1 < all.p_cells; ++pi) {
        for (int hi = 1; hi + 1 < all.bands; ++hi) {
            if (!places.cell(line, pi, hi).has_surface()) continue;
            const bool stays = clean_places.cell(line, pi, hi).has_surface();
            bool near_object = false;
            for (int n = 0; n < 9; ++n) near_object |= allowed(pi + n % 3 - 1, hi + n / 3 - 1);
            dropped += stays ? 0 : 1;
            EXPECT_TRUE(near_object || !stays) << "cell " << pi << ", " << hi;
        }
    }
    EXPECT_GT(dropped, 20);
}

// A translucent wall behind the object: halfway between two images it is visible where one of them shows the object.
TEST(ShapeLines, NoImageHidesWhatStandsBehind) {
    std::vector<DepthView> gauze;
    for (const WorkView& view : drawn_views(drawn_ring(12))) {
        DepthView& one = gauze.emplace_back(DepthView{view, Image<float>(view.height, view.width, kNoDepth)});
        for (std::size_t n = 0; n < one.depth.pixels().size(); ++n) {
            Rgba8& pixel = one.view.columns.pixels()[n];
            if (pixel.a != 0) continue;
            pixel = {90, 90, 90, 255};
            one.depth.pixels()[n] = 0.8F;
        }
    }
    const SampledHull everywhere(VisualHull({}, 1), 0.05);
    ShapeLinesOptions options;
    options.line_deg = 30;
    const glm::dvec2 viewpoint = 0.5 * (gauze[0].view.centre + gauze[1].view.centre);
    const auto hidden_and_shown = [&](bool in_front) {
        const ShapeMap map = make_shape_lines({{.ring = gauze, .hull = &everywhere, .in_front = in_front}}, options);
        const CellPlaces places(map, viewpoint);
        std::array<int, 2> hidden_shown{};
        for (int pi = 0; pi < map.p_cells; ++pi) {
            for (int hi = 0; hi < map.bands; ++hi) {
                const ShapeCell& cell = places.cell(map.gaps[0].first_line, pi, hi);
                if (!cell.has_surface()) continue;
                const double depth =
                    std::ldexp(map.depth_low_q20, -20) + cell.depth * std::ldexp(map.depth_step_q24, -24);
                const CellPlaces::Point point = places.at(pi, hi, depth);
                const bool hides = std::any_of(gauze.begin(), gauze.begin() + 2, [&](const DepthView& image) {
                    const ProjectedColumn seen = image.view.see(point.place);
                    const double row = image.view.row_of(point.y, seen.axial);
                    return seen.column >= 0 && seen.column < image.view.width && row >= 0 && row < image.view.height &&
                           std::isnan(image.depth(static_cast<int>(row), static_cast<int>(seen.column)));
                });
                ++hidden_shown[hides ? 0 : 1];
            }
        }
        return hidden_shown;
    };
    const auto [hidden, shown] = hidden_and_shown(false);
    const auto [hidden_before, shown_before] = hidden_and_shown(true);
    EXPECT_EQ(hidden, 0);
    EXPECT_GT(hidden_before, 50);
    EXPECT_GT(shown, shown_before + hidden_before / 4) << "many have moved, not gone";
}

}  // namespace
}  // namespace rs::encode
