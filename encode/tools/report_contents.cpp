#include "encode/tools/report_contents.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <span>
#include <utility>

namespace rs::encode {
namespace {

constexpr int kCapturedShown = 8;
constexpr int kHeldOutShown = 5;
constexpr int kThumbnailSide_px = 400;  // longer side of a thumbnail

std::string caption_of(const CaptureSet& set, int view) {
    return "view " + std::to_string(view) + ", " + set.upright.views[static_cast<std::size_t>(view)].file_path;
}

std::string with_db(const std::string& text, double psnr_db) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%.2f dB", psnr_db);
    return text + ", " + number.data();
}

// Transposes a map stored by columns.
Image<float> transpose(const Image<float>& columns) {
    Image<float> image(columns.height(), columns.width());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) image(x, y) = columns(y, x);
    }
    return image;
}

}  // namespace

EvaluationThumbnails::EvaluationThumbnails(const HoldOut& hold_out, const std::vector<Method>& methods) {
    for (const int n : select_evenly(static_cast<int>(hold_out.held.size()), kHeldOutShown)) {
        for (const Method method : methods) thumbnails_[{static_cast<std::size_t>(n), method}] = {};
    }
}

Status EvaluationThumbnails::keep(const EvaluatedView& evaluated) {
    const auto entry = thumbnails_.find({evaluated.number, evaluated.method});
    if (entry == thumbnails_.end()) return {};
    const std::string name = to_string(evaluated.method);
    entry->second.view = evaluated.view;
    entry->second.truth = downscale(evaluated.truth, kThumbnailSide_px);
    entry->second.rendering = {downscale(evaluated.rendering, kThumbnailSide_px), with_db(name, evaluated.psnr_db)};
    entry->second.error = {
        downscale(error_image(evaluated.truth, evaluated.rendering, kErrorFullScale), kThumbnailSide_px),
        "error of " + name};
    return {};
}

std::vector<ImageRow> EvaluationThumbnails::rows(const CaptureSet& set) && {
    std::vector<ImageRow> rows;
    std::size_t row_of = 0;
    for (auto& [key, kept] : thumbnails_) {
        if (rows.empty() || key.first != row_of) {
            row_of = key.first;
            rows.push_back({caption_of(set, kept.view), {}});
            rows.back().images.push_back({std::move(kept.truth), "truth"});
        }
        rows.back().images.push_back(std::move(kept.rendering));
        rows.back().images.push_back(std::move(kept.error));
    }
    return rows;
}

void add_scores(const CaptureSet& set, const HoldOut& hold_out, const std::string& which,
                std::vector<MethodScores> scores, EvaluationThumbnails thumbnails, BuildReport& report) {
    report.scores = std::move(scores);
    report.hold_out = "Of " + std::to_string(set.upright.views.size()) + " views, " + which + " was held out, " +
                      std::to_string(hold_out.held.size()) + " in total.";
    report.held_out = std::move(thumbnails).rows(set);
}

Status add_captured_images(const CaptureSet& set, BuildReport& report) {
    for (const int view : select_evenly(static_cast<int>(set.upright.views.size()), kCapturedShown)) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, read_upright_image(set, view));
        report.captured.push_back({downscale(image, kThumbnailSide_px), caption_of(set, view)});
    }
    return {};
}

Status add_evaluation(const CaptureSet& set, int planes, BuildReport& report, Progress* progress) {
    const Result<HoldOut> hold_out = choose_hold_out(set.upright, 2, set.folder.string());
    if (!hold_out) {
        report.why_no_scores = hold_out.error().message;
        return {};
    }
    EvaluationOptions options;
    options.planes = planes;
    EvaluationThumbnails thumbnails(*hold_out, options.methods);
    RS_ASSIGN_OR_RETURN(std::vector<MethodScores> scores,
                        evaluate(
                            set, *hold_out, options,
                            [&](const EvaluatedView& evaluated) { return thumbnails.keep(evaluated); }, progress));
    add_scores(set, *hold_out, "every 2nd", std::move(scores), std::move(thumbnails), report);
    return {};
}

void add_depth_images(const CaptureSet& set, const std::vector<DepthPreview>& depths, BuildReport& report) {
    constexpr float kShown = 1;  // object radii to either side of the foot
    for (const DepthPreview& found : depths) {
        const std::string caption = caption_of(set, found.view);
        report.hull_images.push_back(
            {downscale(depth_image(transpose(found.hull), -kShown, kShown), kThumbnailSide_px), caption});
        report.depth_images.push_back(
            {downscale(depth_image(transpose(found.depth), -kShown, kShown), kThumbnailSide_px), caption});
    }
}

Status write_report(StagedFile& file, const BuildReport& report) {
    RS_ASSIGN_OR_RETURN(const std::string page, build_report_page(report));
    RS_TRY(file.write(std::as_bytes(std::span(page))));
    return file.commit();
}

}  // namespace rs::encode
