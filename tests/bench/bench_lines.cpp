// Compares edges of an object's rendered views with ground truth: their positions, and steps that the truth lacks.
//
//     rs-engine render OBJECT --poses TRUTH -o DRAWN && bench_lines DRAWN TRUTH
//
// Both sets have the same cameras. Prints means over all views:
//   steps   isolated steps per 1000 px, for the rendered views and the truth: adjacent pixels that differ by more than
//   6
//           grey levels between flat neighbours (less than 2), at least 6 px inside the object
//   found   recall: share of true edges (Canny, thresholds 100 and 250, grey over white) with a rendered edge within
//           1 px. Rendered edges of half that strength count, since positions are compared, not sharpness
//   real    precision: likewise, the share of rendered edges near a true one
// Canny thresholds refer to the gradient, which is 4 times a step of grey.

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

namespace rs::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kStrong = 250;
constexpr double kWeak = kStrong / 2;

struct View {
    cv::Mat1b grey;    // over white
    cv::Mat1b inside;  // 255 at least 6 px inside the object
};

View view_of(ConstImageView<Rgba8> image) {
    View view{cv::Mat1b(image.height(), image.width()), cv::Mat1b(image.height(), image.width())};
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const Rgba8& p = image(x, y);
            const double grey = 0.299 * p.r + 0.587 * p.g + 0.114 * p.b, alpha = p.a / 255.0;
            view.grey(y, x) = static_cast<std::uint8_t>(std::lround(alpha * grey + (1 - alpha) * 255));
            view.inside(y, x) = p.a > 250 ? 255 : 0;
        }
    }
    cv::erode(view.inside, view.inside, cv::getStructuringElement(cv::MORPH_RECT, {13, 13}));
    return view;
}

double steps_per_1000(const View& view) {
    constexpr int kStep = 6, kFlat = 2;
    double steps = 0, all = 0;
    for (int y = 1; y + 2 < view.grey.rows; ++y) {
        for (int x = 1; x + 2 < view.grey.cols; ++x) {
            if (view.inside(y, x) == 0) continue;
            all += 1;
            const auto isolated = [&](int dx, int dy) {
                const auto difference = [&](int i) {
                    return std::abs(view.grey(y + (i + 1) * dy, x + (i + 1) * dx) - view.grey(y + i * dy, x + i * dx));
                };
                return difference(0) > kStep && difference(-1) < kFlat && difference(1) < kFlat;
            };
            steps += static_cast<int>(isolated(1, 0)) + static_cast<int>(isolated(0, 1));
        }
    }
    return 1000 * steps / std::max(1.0, all);
}

cv::Mat1b edges_of(const View& view, double strength) {
    cv::Mat1b edges;
    cv::Canny(view.grey, edges, 0.4 * strength, strength);
    return edges;
}

struct Share {
    double found = 0, all = 0;
    // Counts the pixels of `edges` with one of `others` within 1 px.
    void add(const cv::Mat1b& edges, const cv::Mat1b& others) {
        cv::Mat1f distance;
        cv::distanceTransform(255 - others, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
        for (int y = 0; y < edges.rows; ++y) {
            for (int x = 0; x < edges.cols; ++x) {
                if (edges(y, x) == 0) continue;
                all += 1;
                found += distance(y, x) <= 1.001F ? 1 : 0;
            }
        }
    }
    [[nodiscard]] double percent() const { return 100 * found / std::max(1.0, all); }
};

Status run(const fs::path& drawn_folder, const fs::path& truth_folder) {
    const Result<Rig> drawn_rig = read_rig(drawn_folder);
    if (!drawn_rig) return drawn_rig.error();
    const Result<Rig> truth_rig = read_rig(truth_folder);
    if (!truth_rig) return truth_rig.error();
    if (drawn_rig->views.size() != truth_rig->views.size()) {
        return Error{drawn_folder.string() + ": has not as many views as " + truth_folder.string() +
                     "; render it with --poses " + truth_folder.string()};
    }
    double drawn_steps = 0, truth_steps = 0;
    Share found, real;
    const std::size_t count = truth_rig->views.size();
    for (std::size_t i = 0; i < count; ++i) {
        const auto draw_image = read_image(drawn_folder / drawn_rig->views[i].file_path);
        if (!draw_image) return draw_image.error();
        const auto truth_image = read_image(truth_folder / truth_rig->views[i].file_path);
        if (!truth_image) return truth_image.error();
        if (draw_image->width() != truth_image->width() || draw_image->height() != truth_image->height()) {
            return Error{drawn_folder.string() +
                         ": its images differ in size from the true ones; render it with the same cameras"};
        }
        const View drawn = view_of(*draw_image), truth = view_of(*truth_image);
        drawn_steps += steps_per_1000(drawn);
        truth_steps += steps_per_1000(truth);
        found.add(edges_of(truth, kStrong), edges_of(drawn, kWeak));
        real.add(edges_of(drawn, kStrong), edges_of(truth, kWeak));
    }
    std::printf(
        "steps per 1000 px: %.2f, truth %.2f\nedges of truth found: %.2f %% of %.0f px, real: %.2f %% of %.0f px\n",
        drawn_steps / static_cast<double>(count), truth_steps / static_cast<double>(count), found.percent(), found.all,
        real.percent(), real.all);
    return {};
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    std::string drawn, truth;
    CLI::App app("Edges and isolated steps of an object's views against ground truth.", "bench_lines");
    app.add_option("DRAWN", drawn, "output of rs-engine render OBJECT --poses TRUTH -o DRAWN")->required();
    app.add_option("TRUTH", truth, "capture set of the true images")->required();
    app.footer("Example:\n  bench_lines blocks-drawn blocks-truth");
    std::function<rs::Status()> run = [&] { return rs::bench::run(drawn, truth); };
    return rs::tool_main(app, argc, argv, run);
}
