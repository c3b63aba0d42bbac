#include "encode/report/build_report.hpp"

#include "rayspace/page/html_page.hpp"
#include "rayspace/page/plots.hpp"
#include "rayspace/page/svg_parts.hpp"

#include <numeric>

namespace rs::encode {
namespace {

constexpr int kThumbnail_px = 150;
constexpr int kCompared_px = 260;

void add_build_facts(HtmlPage& page, const BuildReport& report) {
    std::vector<std::vector<std::string>> rows;
    for (const ReportFact& fact : report.facts) rows.push_back({fact.name, fact.value});
    if (!rows.empty()) page.table({"", ""}, rows);
    if (!report.warnings.empty()) {
        page.heading("Warnings");
        page.list(report.warnings);
    }
}

Status add_captured(HtmlPage& page, const BuildReport& report) {
    if (report.captured.empty()) return {};
    page.heading("Captured images");
    return page.images(report.captured, kThumbnail_px);
}

void add_rings(HtmlPage& page, const BuildReport& report) {
    if (report.rig.views.empty()) return;
    page.heading("The cameras from above");
    page.drawing(draw_ring_plan(report.rig));
    std::vector<std::string> missing = describe_missing_sectors(report.rig);
    if (missing.empty()) {
        page.paragraph("No sector is missing.");
    } else {
        page.paragraph("Sectors without views, measured from +Z towards +X; renderings from these are extrapolated:");
        page.list(missing);
    }
}

LinePlot plot_of_scores(const std::vector<MethodScores>& scores) {
    LinePlot plot;
    plot.title = "PSNR of the held-out views";
    plot.x_label = "view";
    plot.y_label = "dB";
    for (const MethodScores& method : scores) {
        PlotSeries series{method.method, {}, {}};
        series.x.reserve(method.views.size());
        series.y.reserve(method.views.size());
        for (const HeldOutScore& score : method.views) {
            series.x.push_back(score.view);
            series.y.push_back(score.psnr_db);
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

void add_score_tables(HtmlPage& page, const std::vector<MethodScores>& scores) {
    std::vector<std::vector<std::string>> summary;
    summary.reserve(scores.size());
    for (const MethodScores& method : scores) {
        summary.push_back({method.method, two_decimals(method.mean_psnr_db), two_decimals(method.pooled_psnr_db),
                           two_decimals(method.mean_ssim * 100), two_decimals(method.build_seconds)});
    }
    page.table({"method", "mean PSNR, dB", "PSNR of all pixels, dB", "mean SSIM, %", "build, s"}, summary);
    page.drawing(draw_svg(plot_of_scores(scores)));

    std::vector<std::string> header{"view", "image"};
    for (const MethodScores& method : scores) header.push_back(method.method + ", dB");
    std::vector<std::vector<std::string>> rows;
    for (std::size_t n = 0; n < scores.front().views.size(); ++n) {
        const HeldOutScore& first = scores.front().views[n];
        std::vector<std::string> row{std::to_string(first.view), first.image};
        for (const MethodScores& method : scores) row.push_back(two_decimals(method.views[n].psnr_db));
        rows.push_back(std::move(row));
    }
    page.begin_details("All held-out views");
    page.table(header, rows);
    page.end_details();
}

Status add_scores(HtmlPage& page, const BuildReport& report) {
    if (report.scores.empty() && report.why_no_scores.empty()) return {};
    page.heading("Held-out views");
    if (report.scores.empty()) {
        page.paragraph(report.why_no_scores);
        return {};
    }
    page.paragraph(
        "For these figures, objects were built without the views that they are scored on. " + report.hold_out +
        " \"photo\" shows the nearest kept image, \"plane\" assumes the object to lie on the reference "
        "planes, "
        "\"shape\" uses the depth estimated from the images. The kept views are farther apart than the views of "
        "the "
        "object in the file, which is therefore better. PSNR and SSIM over the object's pixels, colours "
        "premultiplied by alpha.");
    add_score_tables(page, report.scores);
    if (!report.held_out.empty()) {
        page.paragraph("Error map beside each rendering: black is no error, white an error of " +
                       std::to_string(kErrorFullScale) + " of 255 or more in the worst of R, G and B.");
    }
    for (const ImageRow& row : report.held_out) {
        page.paragraph(row.caption);
        RS_TRY(page.images(row.images, kCompared_px, ImageLayout::kLine));
    }
    return {};
}

Status add_found(HtmlPage& page, const char* heading, const std::vector<CaptionedImage>& images) {
    if (images.empty()) return {};
    page.heading(heading);
    return page.images(images, kCompared_px);
}

void add_accounts(HtmlPage& page, const BuildReport& report) {
    if (!report.stages.empty()) {
        page.heading("Time");
        std::vector<std::vector<std::string>> rows;
        for (const StageTime& stage : report.stages) rows.push_back({stage.name, two_decimals(stage.seconds)});
        page.table({"stage", "s"}, rows);
    }
    if (!report.chunks.empty()) {
        page.heading("Bytes of the file");
        const auto all =
            std::accumulate(report.chunks.begin(), report.chunks.end(), std::uint64_t{0},
                            [](std::uint64_t sum, const ChunkSummary& chunk) { return sum + chunk.size_bytes; });
        std::vector<std::vector<std::string>> rows;
        for (const ChunkSummary& chunk : report.chunks) {
            const double share =
                all == 0 ? 0 : 100.0 * static_cast<double>(chunk.size_bytes) / static_cast<double>(all);
            rows.push_back(
                {chunk.name, std::to_string(chunk.count), std::to_string(chunk.size_bytes), two_decimals(share)});
        }
        page.table({"chunk", "count", "bytes", "%"}, rows);
    }
}

}  // namespace

Result<std::string> build_report_page(const BuildReport& report) {
    HtmlPage page(report.name);
    add_build_facts(page, report);
    RS_TRY(add_captured(page, report));
    add_rings(page, report);
    RS_TRY(add_scores(page, report));
    RS_TRY(add_found(page, "Visual hull", report.hull_images));
    RS_TRY(add_found(page, "Estimated depth", report.depth_images));
    add_accounts(page, report);
    return page.text();
}

}  // namespace rs::encode
