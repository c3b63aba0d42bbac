#pragma once
// Collects the contents of build and evaluation reports (encode/report/build_report.hpp).

#include "encode/evaluation/evaluation.hpp"
#include "encode/raymap/shape_map.hpp"
#include "encode/report/build_report.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"

#include <map>
#include <utility>
#include <vector>

namespace rs::encode {

/// Adds thumbnails of some of the set's images. Fails as read_upright_image does.
Status add_captured_images(const CaptureSet& set, BuildReport& report);

/// Thumbnails of ground truth, renderings and error maps of some held-out views.
class EvaluationThumbnails {
public:
    EvaluationThumbnails(const HoldOut& hold_out, const std::vector<Method>& methods);

    /// A EvaluationSink. Thread-safe.
    Status keep(const EvaluatedView& evaluated);

    /// One row per view.
    [[nodiscard]] std::vector<ImageRow> rows(const CaptureSet& set) &&;

private:
    struct ViewThumbnails {
        int view = 0;
        Image<Rgba8> truth;
        CaptionedImage rendering;
        CaptionedImage error;
    };
    std::map<std::pair<std::size_t, Method>, ViewThumbnails> thumbnails_;  // keys are inserted by the constructor
};

/// Adds scores and thumbnails.
void add_scores(const CaptureSet& set, const HoldOut& hold_out, const std::string& which,
                std::vector<MethodScores> scores, EvaluationThumbnails thumbnails, BuildReport& report);

/// Builds objects from every second view, scores the other views and adds thumbnails. A set with too few views is not
/// an error: the report states the reason.
Status add_evaluation(const CaptureSet& set, int planes, BuildReport& report, Progress* progress);

/// Adds hull and depth images of a few views from build_object().
void add_depth_images(const CaptureSet& set, const std::vector<DepthPreview>& depths, BuildReport& report);

/// Writes the page and commits the file.
Status write_report(StagedFile& file, const BuildReport& report);

}  // namespace rs::encode
