// Build report: well-formed for any text, plots with points at the positions of their values, embedded images equal to
// the input.

#include "encode/report/build_report.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/page/html_page.hpp"
#include "rayspace/page/plots.hpp"
#include "rayspace/page/svg_parts.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <regex>

namespace rs::encode {
namespace {

using testing::HasSubstr;
using testing::Not;

// Checks that tags are balanced; returns the name of the first one that is not, else "".
std::string find_unbalanced_tag(const std::string& markup) {
    static const std::regex kTag(R"(<(/?)([a-zA-Z0-9]+)((?:[^<>"]|"[^"<>]*")*?)(/?)>)");
    std::vector<std::string> open;
    for (std::sregex_iterator tag(markup.begin(), markup.end(), kTag), end; tag != end; ++tag) {
        const std::string name = (*tag)[2];
        if ((*tag)[4] == "/") continue;
        if ((*tag)[1] != "/") {
            open.push_back(name);
        } else if (open.empty() || open.back() != name) {
            return name;
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : open.back();
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(Escaped, NothingOfATextBecomesMarkup) {
    EXPECT_EQ(escaped("<b a=\"1\" c='2'>&amp;</b>"), "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;amp;&lt;/b&gt;");
    EXPECT_EQ(escaped("Käse \xE2\x82\xAC \xF0\x9F\x8D\x8E"), "Käse \xE2\x82\xAC \xF0\x9F\x8D\x8E");
    // Control characters, a lone continuation, an overlong '/', a surrogate, a cut sequence.
    EXPECT_EQ(escaped(std::string_view("a\0b", 3)),
              "a\xEF\xBF\xBD"
              "b");
    for (const char* bad : {"\x01", "\x80", "\xFF"}) EXPECT_EQ(escaped(bad), "\xEF\xBF\xBD");
    for (const char* bad : {"\xC0\xAF", "\xED\xA0\x80", "\xE2\x82"}) {
        const std::string safe = escaped(bad);
        EXPECT_EQ(safe.find(bad), std::string::npos);
        EXPECT_EQ(occurrences(safe, "\xEF\xBF\xBD"), std::string(bad).size());
    }
}

TEST(Base64, IsThatOfRfc4648) {
    const auto of = [](const std::string& text) { return base64(std::as_bytes(std::span(text))); };
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("f"), "Zg==");
    EXPECT_EQ(of("fo"), "Zm8=");
    EXPECT_EQ(of("foo"), "Zm9v");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(of("\xFB\xFF\xFE"), "+//+");
}

TEST(HtmlPage, IsWellFormedAndHoldsWhatWasAdded) {
    HtmlPage page("a < b & \"c\"");
    page.heading("</h2><script>");
    page.paragraph("1 < 2");
    page.list({"<li>", "two"});
    page.table({"name", "dB"}, {{"<td>", "12.5"}, {"b", "-3"}});
    page.begin_details("more & more");
    page.drawing(draw_svg(LinePlot{"<t>", "x&", "y\"", {{"</svg>", {0, 1}, {2, 3}}}}));
    page.end_details();
    const std::string text = page.text();
    EXPECT_EQ(find_unbalanced_tag(text), "") << text;
    EXPECT_THAT(text, HasSubstr("<title>a &lt; b &amp; &quot;c&quot;</title>"));
    EXPECT_THAT(text, HasSubstr("&lt;/h2&gt;&lt;script&gt;"));
    EXPECT_THAT(text, Not(HasSubstr("<script")));
    EXPECT_THAT(text, HasSubstr("<td>&lt;td&gt;</td><td class=\"number\">12.5</td>"));
    EXPECT_THAT(text, HasSubstr("<summary>more &amp; more</summary>"));
    EXPECT_EQ(occurrences(text, "</svg>"), 1U);
    EXPECT_EQ(find_unbalanced_tag("<p><b></p></b>"), "p") << "the check itself must be able to fail";
}

TEST(HtmlPage, AImageInsideIsTheImageScaledDown) {
    Image<Rgba8> image(600, 300, {200, 100, 50, 255});
    const std::vector<CaptionedImage> row{{image, "wide \"one\""}, {Image<Rgba8>(20, 40, {1, 2, 3, 255}), "small"}};
    HtmlPage page("images");
    ASSERT_TRUE(page.images(row, 150).ok());
    const std::string text = page.text();
    EXPECT_EQ(find_unbalanced_tag(text), "");
    EXPECT_THAT(text, HasSubstr("alt=\"wide &quot;one&quot;\" width=\"150\" height=\"75\""));
    EXPECT_THAT(text, HasSubstr("width=\"20\" height=\"40\""));
    const auto bytes = encode_png(downscale(image, 150), "wide");
    ASSERT_TRUE(bytes.ok());
    EXPECT_THAT(text, HasSubstr("src=\"data:image/png;base64," + base64(*bytes) + "\""));
    // The bytes are a readable file.
    const test::TemporaryFolder folder;
    std::ofstream(folder / "p.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
    const auto read = read_image(folder / "p.png");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(*read, Image<Rgba8>(150, 75, {200, 100, 50, 255}));
    EXPECT_FALSE(HtmlPage("none").images(std::vector<CaptionedImage>{{{}, "empty"}}).ok());
}

TEST(ScaledDown, AveragesInLinearLightAndByAlpha) {
    Image<Rgba8> image(4, 2, {0, 0, 0, 255});
    for (int y = 0; y < 2; ++y) {
        image(0, y) = {255, 255, 255, 255};
        image(2, y) = {90, 60, 30, 255};
        image(3, y) = {255, 0, 255, 0};
    }
    const Image<Rgba8> small = downscale(image, 2);
    ASSERT_EQ(small.width(), 2);
    ASSERT_EQ(small.height(), 1);
    EXPECT_EQ(small(0, 0), (Rgba8{188, 188, 188, 255}));  // half of the light of white
    EXPECT_EQ(small(1, 0), (Rgba8{90, 60, 30, 128}));     // the transparent half does not contribute
    EXPECT_EQ(downscale(image, 4), image);
    // Sizes without a common factor: a constant image stays constant up to the last pixel.
    const Image<Rgba8> odd(101, 67, {77, 88, 99, 255});
    EXPECT_EQ(downscale(odd, 40), Image<Rgba8>(40, 27, {77, 88, 99, 255}));
}

TEST(Colours, DepthAndErrorRunFromEndToEnd) {
    const Rgba8 near = depth_colour(0.1F), far = depth_colour(0.9F);
    EXPECT_GT(near.b, near.r);
    EXPECT_GT(far.r, far.b);
    EXPECT_EQ(depth_colour(std::numeric_limits<float>::quiet_NaN()), depth_colour(0));
    EXPECT_EQ(depth_colour(7), depth_colour(1));
    EXPECT_EQ(heat_colour(0), (Rgba8{0, 0, 0, 255}));
    EXPECT_EQ(heat_colour(1), (Rgba8{255, 255, 255, 255}));

    Image<float> depth(2, 1, 1.0F);
    depth(1, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(depth_image(depth, 0, 2)(0, 0), depth_colour(0.5F));
    EXPECT_EQ(depth_image(depth, 0, 2)(1, 0).a, 0);

    Image<Rgba8> a(3, 1), b(3, 1);
    a(0, 0) = {100, 50, 20, 255};
    b(0, 0) = {100, 82, 20, 255};
    a(1, 0) = {10, 10, 10, 255};  // b is transparent there: the whole colour is wrong
    const Image<Rgba8> error = error_image(a, b, 64);
    EXPECT_EQ(error(0, 0), heat_colour(0.5F));
    EXPECT_EQ(error(1, 0), heat_colour(10.0F / 64));
    EXPECT_EQ(error(2, 0).a, 0);
}

TEST(LinePlot, TicksAreRoundAndHoldTheData) {
    for (const auto& [least, most] : {std::pair{0.0, 1.0},
                                      {14.3, 31.1},
                                      {-5.0, 5.0},
                                      {0.0, 89.0},
                                      {1e-4, 3e-4},
                                      {999.0, 1001.0},
                                      {20.0, 20.0},
                                      {0.0, 0.0}}) {
        const AxisTicks ticks = axis_ticks(least, most);
        EXPECT_LE(ticks.low, least + 1e-9 * ticks.step);
        EXPECT_GE(ticks.high, most - 1e-9 * ticks.step);
        EXPECT_GE(ticks.count(), 3) << least << ".." << most;
        EXPECT_LE(ticks.count(), 11) << least << ".." << most;
        const double leading = ticks.step / std::pow(10, std::floor(std::log10(ticks.step) + 1e-9));
        EXPECT_TRUE(std::abs(leading - 1) < 1e-6 || std::abs(leading - 2) < 1e-6 || std::abs(leading - 5) < 1e-6)
            << ticks.step;
    }
    EXPECT_EQ(axis_ticks(0, 89).step, 20);
    EXPECT_EQ(axis_ticks(0, 89).high, 100);
}

TEST(LinePlot, PointsStandWhereTheirNumbersSay) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    LinePlot plot{"title", "view", "dB", {{"a", {0, 50, 100}, {10, kNone, 20}}, {"b & c", {0, 100}, {12, 14}}}};
    const PlotFrame frame = plot_frame(plot);
    EXPECT_EQ(frame.x_px(frame.x.low), frame.left);
    EXPECT_EQ(frame.x_px(frame.x.high), frame.right);
    EXPECT_EQ(frame.y_px(frame.y.low), frame.bottom) << "y grows upwards";
    EXPECT_EQ(frame.y_px(frame.y.high), frame.top);
    EXPECT_NEAR(frame.x_px(50), (frame.left + frame.right) / 2, 1e-9);

    const std::string svg = draw_svg(plot);
    EXPECT_EQ(find_unbalanced_tag(svg), "") << svg;
    const auto circle = [&](double x, double y) {
        return "<circle cx=\"" + two_decimals(frame.x_px(x)) + "\" cy=\"" + two_decimals(frame.y_px(y)) + "\"";
    };
    EXPECT_THAT(svg, HasSubstr(circle(0, 10)));
    EXPECT_THAT(svg, HasSubstr(circle(100, 20)));
    EXPECT_THAT(svg, HasSubstr(circle(100, 14)));
    EXPECT_EQ(occurrences(svg, "<circle"), 4U) << "the point that is no number is left out";
    EXPECT_THAT(svg, HasSubstr("b &amp; c"));
    // The gap interrupts the line: two moves, no line between.
    const std::size_t path = svg.find("<path d=\"");
    const std::string first = svg.substr(path, svg.find('>', path) - path);
    EXPECT_EQ(occurrences(first, "M"), 2U) << first;
    EXPECT_EQ(occurrences(first, "L"), 0U) << first;
    EXPECT_EQ(find_unbalanced_tag(draw_svg({})), "") << "a plot of nothing is still a plot";
}

TEST(LinePlot, LongNamesGetRoom) {
    LinePlot plot{"t", "x", "y", {{"residual, px RMS", {0, 1}, {2, 3}}}};
    const PlotFrame usual = plot_frame(plot);
    EXPECT_GE(plot.width_px - usual.right, 42 + 100) << "16 letters of 13 px are at most 100 px wide";
    plot.series[0].name.append(16, 'm');
    EXPECT_GT(usual.right, plot_frame(plot).right + 100);
}

TEST(RingPlan, AMissingImageOfAnEvenTurnIsSeen) {
    std::vector<double> azimuths;
    for (int n = 0; n < 36; ++n) azimuths.push_back(radians(10.0 * n));
    EXPECT_TRUE(find_missing_sectors(azimuths).empty());
    azimuths.erase(azimuths.begin() + 5);
    const auto one = find_missing_sectors(azimuths);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NEAR(degrees(one[0].from_rad), 40, 1e-9);
    EXPECT_NEAR(degrees(one[0].to_rad), 60, 1e-9);
    azimuths.resize(20);  // up to 200 degrees: the rest of the turn is missing, across +Z
    const auto two = find_missing_sectors(azimuths);
    ASSERT_EQ(two.size(), 2U);
    EXPECT_NEAR(degrees(two[1].from_rad), 200, 1e-9);
    EXPECT_NEAR(degrees(two[1].to_rad), 360, 1e-9);
    EXPECT_TRUE(find_missing_sectors({0, 1}).empty());
}

TEST(RingPlan, ShowsEveryCameraWhereItStands) {
    Rig rig = make_ring({.count = 12, .distance = 3.5, .fl_px = 60, .width = 48, .height = 40});
    rig.object_radius = 1;
    std::string svg = draw_ring_plan(rig);
    EXPECT_EQ(find_unbalanced_tag(svg), "") << svg;
    EXPECT_EQ(occurrences(svg, "<path"), 12U);
    // 340 px with a margin of 26: the first camera, on +Z, is at the bottom, the fourth, on +X, to the right.
    EXPECT_THAT(svg, HasSubstr("<path d=\"M170.00 314.00L"));
    EXPECT_THAT(svg, HasSubstr("<path d=\"M314.00 170.00L"));
    EXPECT_TRUE(describe_missing_sectors(rig).empty());
    rig.views.erase(rig.views.begin() + 3);
    EXPECT_EQ(occurrences(draw_ring_plan(rig), "var(--bad)"), 2U);
    ASSERT_EQ(describe_missing_sectors(rig).size(), 1U);
    EXPECT_EQ(describe_missing_sectors(rig)[0], "from 60.00 to 120.00 degrees (ring 1)");
}

BuildReport small_report() {
    BuildReport report;
    report.name = "vase <1>";
    report.facts = {{"images", "12 of 48x40"}};
    report.stages = {{"RS map", 0.25}};
    report.chunks = {{"PICT", 12, 3000}, {"RMAP", 1, 1000}};
    report.rig = make_ring({.count = 12, .fl_px = 60, .width = 48, .height = 40});
    report.rig.object_radius = 1;
    return report;
}

TEST(BuildReport, WhatIsEmptyIsNotShown) {
    const auto page = build_report_page(small_report());
    ASSERT_TRUE(page.ok());
    EXPECT_EQ(find_unbalanced_tag(*page), "");
    EXPECT_THAT(*page, HasSubstr("vase &lt;1&gt;"));
    EXPECT_THAT(*page, HasSubstr("75.00"));  // per cent of the bytes in images
    for (const char* heading : {"Warnings", "Captured", "Visual hull", "Estimated depth", "Held-out views"}) {
        EXPECT_THAT(*page, Not(HasSubstr(std::string("<h2>") + heading))) << heading;
    }
}

TEST(BuildReport, ShowsScoresAndImages) {
    BuildReport report = small_report();
    const CaptionedImage image{Image<Rgba8>(8, 8, {9, 9, 9, 255}), "some image"};
    report.warnings = {"a gap & a hole"};
    report.captured = {image};
    report.hull_images = {image, image};
    report.depth_images = {image};
    report.hold_out = "Every 2nd.";
    report.scores = {{"photo", {{1, "1.png", 17.5, 0.8}, {3, "3.png", 18.5, 0.9}}, 18.0, 17.97, 0.85, 0},
                     {"shape", {{1, "1.png", 28.5, 0.95}, {3, "3.png", 27.25, 0.94}}, 27.875, 27.8, 0.945, 3}};
    report.held_out = {{"view 1", {image, image, image}}};
    const auto page = build_report_page(report);
    ASSERT_TRUE(page.ok());
    EXPECT_EQ(find_unbalanced_tag(*page), "");
    EXPECT_EQ(occurrences(*page, "<img "), 7U);
    for (const char* text :
         {"a gap &amp; a hole", "<h2>Visual hull", "<h2>Estimated depth", "27.25", "94.50", "<svg"}) {
        EXPECT_THAT(*page, HasSubstr(text)) << text;
    }
    report.scores.clear();
    report.held_out.clear();
    report.why_no_scores = "2 views are too few";
    const auto without = build_report_page(report);
    ASSERT_TRUE(without.ok());
    EXPECT_THAT(*without, HasSubstr("2 views are too few"));
}

TEST(StageClock, AddsUpTheTimesOfEachStage) {
    class SilentProgress final : public Progress {
    public:
        void start(const std::string&, std::int64_t) override { ++started; }
        void advance(std::int64_t steps) override { advanced += steps; }
        void finish() override { ++finished; }
        int started = 0, finished = 0;
        std::int64_t advanced = 0;
    } shown;
    StageClock clock(shown);
    clock.start("one", 2);
    clock.advance(2);
    clock.start("two", 1);  // ends the first
    clock.finish();
    clock.finish();
    clock.start("one", 1);
    clock.finish();
    ASSERT_EQ(clock.stages().size(), 2U);
    EXPECT_EQ(clock.stages()[0].name, "one");
    EXPECT_GE(clock.stages()[0].seconds, 0);
    EXPECT_EQ(shown.started, 3);
    EXPECT_EQ(shown.finished, 3);
    EXPECT_EQ(shown.advanced, 2);
}

}  // namespace
}  // namespace rs::encode
