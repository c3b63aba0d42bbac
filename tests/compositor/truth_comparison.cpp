#include "tests/compositor/truth_comparison.hpp"

#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace rs::test {
namespace {

constexpr int kFarthest_px = 8;
constexpr float kWhole = 0.99F;      // coverage from which a pixel counts as inside of an object
constexpr float kAnything = 0.008F;  // two codes of 8 bits

compositor::Scene plain(compositor::Scene scene, const glm::vec3& colour) {
    for (compositor::GeometryNode& node : scene.geometry) {
        node.material = {};
        node.material.lit = false;
        node.material.diffuse = colour;
    }
    scene.background = {};
    scene.background.sky = {colour};
    return scene;
}

struct SquaredError {
    double sum = 0;
    std::int64_t pixels = 0;

    void add(Rgba8 a, Rgba8 b) {
        const auto square = [](int d) { return static_cast<double>(d * d); };
        sum += square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b);
        ++pixels;
    }
    [[nodiscard]] double psnr_db() const {
        if (pixels == 0 || sum == 0) return 99;
        return 10 * std::log10(255.0 * 255.0 * 3 * static_cast<double>(pixels) / sum);
    }
};

// Position between two pixel centres at which coverage crosses one half.
struct Crossing {
    glm::dvec2 place;
    bool inside;  // both pixels are inside of an object, so that only geometry can end it here
};

std::vector<Crossing> crossings(const Image<float>& shown, const Image<float>& unhidden_a,
                                const Image<float>& unhidden_b) {
    std::vector<Crossing> found;
    const auto look = [&](int x, int y, int dx, int dy) {
        if (x + dx >= shown.width() || y + dy >= shown.height()) return;
        const double a = static_cast<double>(shown(x, y));
        const double b = static_cast<double>(shown(x + dx, y + dy));
        if ((a >= 0.5) == (b >= 0.5)) return;
        const double way = (a - 0.5) / (a - b);
        const bool inside = std::min({unhidden_a(x, y), unhidden_a(x + dx, y + dy), unhidden_b(x, y),
                                      unhidden_b(x + dx, y + dy)}) >= kWhole;
        found.push_back({{x + way * dx, y + way * dy}, inside});
    };
    for (int y = 0; y < shown.height(); ++y) {
        for (int x = 0; x < shown.width(); ++x) {
            look(x, y, 1, 0);
            look(x, y, 0, 1);
        }
    }
    return found;
}

void add_distances(const std::vector<Crossing>& from, const std::vector<Crossing>& to, std::vector<double>& distances) {
    for (const Crossing& a : from) {
        if (!a.inside) continue;
        double nearest = kFarthest_px;
        for (const Crossing& b : to) {
            if (std::abs(b.place.y - a.place.y) < nearest) nearest = std::min(nearest, glm::distance(a.place, b.place));
        }
        distances.push_back(nearest);
    }
}

EdgeDistances edge_distances(const std::vector<Crossing>& a, const std::vector<Crossing>& b) {
    std::vector<double> distances;
    add_distances(a, b, distances);
    add_distances(b, a, distances);
    EdgeDistances result;
    if (distances.empty()) return result;
    std::sort(distances.begin(), distances.end());
    result.places = static_cast<int>(distances.size());
    for (const double distance : distances) result.mean_px += distance / result.places;
    result.within_px = distances[(distances.size() - 1) * 99 / 100];
    result.largest_px = distances.back();
    return result;
}

}  // namespace

Result<Image<float>> TruthComparison::Backdrops::covered(const Camera& camera) {
    const Result<Image<Rgba8>> on_white = white.compose(camera);
    if (!on_white) return on_white.error();
    const Result<Image<Rgba8>> on_black = black.compose(camera);
    if (!on_black) return on_black.error();
    Image<float> share(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            share(x, y) = 1 - (linear_from_srgb8((*on_white)(x, y).g) - linear_from_srgb8((*on_black)(x, y).g));
        }
    }
    return share;
}

Result<TruthComparison> TruthComparison::create(const compositor::Scene& scene,
                                                const std::vector<compositor::PlacedObject>& objects,
                                                const std::vector<TracedNode>& traced,
                                                const compositor::FrameOptions& options) {
    compositor::Scene empty = plain(scene, glm::vec3(0));
    empty.geometry.clear();
    const auto backdrops = [&](const compositor::Scene& of) -> Result<Backdrops> {
        auto white = compositor::FrameCompositor::create(plain(of, glm::vec3(1)), objects, options);
        if (!white) return white.error();
        auto black = compositor::FrameCompositor::create(plain(of, glm::vec3(0)), objects, options);
        if (!black) return black.error();
        return Backdrops{std::move(*white), std::move(*black)};
    };
    auto frames = compositor::FrameCompositor::create(scene, objects, options);
    if (!frames) return frames.error();
    auto with_geometry = backdrops(scene);
    if (!with_geometry) return with_geometry.error();
    auto without = backdrops(empty);
    if (!without) return without.error();
    auto truth = TruthScene::create(scene, traced);
    if (!truth) return truth.error();
    auto objects_alone = TruthScene::create(empty, traced);
    if (!objects_alone) return objects_alone.error();
    return TruthComparison(std::move(*frames), std::move(*with_geometry), std::move(*without), std::move(*truth),
                           std::move(*objects_alone));
}

Result<TruthDifference> TruthComparison::compare(const Camera& camera, const TruthOptions& options) {
    Result<Image<Rgba8>> frame = frames_.compose(camera);
    if (!frame) return frame.error();
    const Result<Image<float>> shown = with_geometry_.covered(camera);
    if (!shown) return shown.error();
    const Result<Image<float>> unhidden = without_.covered(camera);
    if (!unhidden) return unhidden.error();
    const Result<Image<Rgba8>> alone = without_.black.compose(camera);
    if (!alone) return alone.error();
    TruthDifference difference;
    difference.truth = truth_.render(camera, options);
    const TruthImage& truth = difference.truth;
    const Image<Rgba8> alone_truth = objects_alone_.render(camera, options).image;

    SquaredError objects;
    SquaredError elsewhere;
    SquaredError objects_alone;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const bool object = truth.objects(x, y) > 0 || (*shown)(x, y) > kAnything;
            (object ? objects : elsewhere).add((*frame)(x, y), truth.image(x, y));
            if (truth.unhidden(x, y) > 0 || (*unhidden)(x, y) > kAnything) {
                objects_alone.add((*alone)(x, y), alone_truth(x, y));
            }
        }
    }
    difference.objects_db = objects.psnr_db();
    difference.elsewhere_db = elsewhere.psnr_db();
    difference.alone_db = objects_alone.psnr_db();
    difference.object_share = static_cast<double>(objects.pixels) / (1.0 * camera.width * camera.height);
    difference.cuts = edge_distances(crossings(truth.objects, truth.unhidden, *unhidden),
                                     crossings(*shown, truth.unhidden, *unhidden));
    difference.frame = std::move(*frame);
    return difference;
}

}  // namespace rs::test
