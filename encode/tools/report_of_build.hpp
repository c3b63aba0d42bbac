#pragma once
// Gathers what the page of a build or of an evaluation shows of a capture set (encode/report/build_report.hpp).

#include "encode/raymap/shape_map.hpp"
#include "encode/report/build_report.hpp"
#include "encode/set/capture_set.hpp"
#include "encode/tools/evaluation.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"

#include <map>
#include <utility>
#include <vector>

namespace rs::encode {

// Some of the set's images, small. Fails as read_upright_image does.
Status add_captured_images(const CaptureSet& set, BuildReport& report);

// Of some views held out: the truth, each method's answer and its error, small.
class KeptAnswers {
public:
    KeptAnswers(const HoldOut& hold_out, const std::vector<Method>& methods);

    // A LookAtAnswer: for several threads at once.
    Status keep(const AnsweredView& answered);

    // One row for each view.
    [[nodiscard]] std::vector<ImageRow> rows(const CaptureSet& set) &&;

private:
    struct Kept {
        int view = 0;
        Image<Rgba8> truth;
        CaptionedImage answer;
        CaptionedImage error;
    };
    std::map<std::pair<std::size_t, Method>, Kept> kept_;  // each has its place before answers come
};

// Scores, and what was kept of the answers.
void add_scores(const CaptureSet& set, const HoldOut& hold_out, const std::string& which,
                std::vector<MethodScores> scores, KeptAnswers answers, BuildReport& report);

// Builds objects from every other view, scores the rest and keeps some of the answers. A set with too few views is no
// error: the report states it.
Status add_held_out_views(const CaptureSet& set, int planes, BuildReport& report, Progress* progress);

// Hull and depth of a few views, as build_object() found them.
void add_depths(const CaptureSet& set, const std::vector<FoundDepth>& depths, BuildReport& report);

// Writes the page and commits it.
Status write_report(StagedFile& file, const BuildReport& report);

}  // namespace rs::encode
