#include "encode/posed/view_synthesis.hpp"

#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/image/premultiplied_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace rs::encode {
namespace {

constexpr int kTile_px = 16;               // pixels that share candidates
constexpr std::size_t kCandidates = 14;    // photos of a tile
constexpr double kVisible_voxels = 2;      // tolerance of the depth test
constexpr double kFade_px = 8;             // weights fade towards a photo's frame
constexpr double kLeastAngle_rad = 0.004;  // photos nearer than this have the same weight
constexpr int kMaxBlended = 8;
constexpr int kMaxRays = 16;          // of a pixel
constexpr double kSmooth_voxels = 3;  // range of a pixel's depths on one surface, which is coloured once

struct Contribution {
    double angle = 0;
    double weight = 0;  // of visibility and slant
    RgbaF colour;       // linear light times alpha
};

double smooth_step(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

RgbaF premultiplied(const Rgba8& p) {
    const float a = static_cast<float>(p.a) / 255.0F;
    return {linear_from_srgb8(p.r) * a, linear_from_srgb8(p.g) * a, linear_from_srgb8(p.b) * a, a};
}

Rgba8 encoded(const RgbaF& sum) {
    if (sum.a <= 0) return {};
    const auto code = [&](float value) { return srgb8_by_table(value / sum.a); };
    const auto alpha = static_cast<std::uint8_t>(std::lround(std::min(sum.a, 1.0F) * 255));
    if (alpha == 0) return {};
    return {code(sum.r), code(sum.g), code(sum.b), alpha};
}

}  // namespace

ViewSynthesizer::ViewSynthesizer(std::span<const PosedPhoto> photos, const SignedVolume& surface,
                                 const SynthesisOptions& options, Progress* progress)
    : surface_(surface), options_(options) {
    RS_CHECK(options.raster >= 1 && options.raster * options.raster <= kMaxRays);
    sources_.reserve(photos.size());
    if (progress != nullptr) progress->start("visibility", static_cast<std::int64_t>(photos.size()));
    for (const PosedPhoto& photo : photos) {
        sources_.push_back({photo.camera, photo.image.view(), cast_depth(surface, photo.camera)});
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
}

std::vector<ViewSynthesizer::Candidate> ViewSynthesizer::candidates_near(const Camera& camera, const glm::dvec3& p,
                                                                         std::size_t count) const {
    const glm::dvec3 wanted = glm::normalize(camera.centre() - p);
    std::vector<Candidate> all;
    all.reserve(sources_.size());
    for (const Source& source : sources_) {
        all.push_back({&source, glm::dot(wanted, glm::normalize(source.camera.centre() - p))});
    }
    const std::size_t kept = std::min(count, all.size());
    std::ranges::partial_sort(all, all.begin() + static_cast<std::ptrdiff_t>(kept),
                              [](const Candidate& a, const Candidate& b) { return a.cosine > b.cosine; });
    all.resize(kept);
    return all;
}

// 1 where the photo shows the point (x, y px, axial depth z), 0 where a nearer surface hides it.
float ViewSynthesizer::visibility(const Source& source, const glm::dvec3& seen) const {
    const double margin_px = std::min({seen.x, seen.y, source.camera.width - seen.x, source.camera.height - seen.y});
    if (!(seen.z > 0) || margin_px <= 1) return 0;
    const int x = std::min(static_cast<int>(seen.x - 0.5), source.camera.width - 2);
    const int y = std::min(static_cast<int>(seen.y - 0.5), source.camera.height - 2);
    float farthest = 0;
    for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        const float depth = source.depth(x + i, y + j);
        farthest = std::max(farthest, depth > 0 ? depth : 1e30F);
    }
    const double tolerance = kVisible_voxels * surface_.grid().voxel;
    const double behind = seen.z - static_cast<double>(farthest);
    return static_cast<float>((1 - smooth_step(tolerance, 2 * tolerance, behind)) *
                              smooth_step(1, kFade_px, margin_px));
}

RgbaF ViewSynthesizer::blend(const std::vector<Candidate>& candidates, const Camera& camera,
                             const glm::dvec3& p) const {
    const glm::dvec3 wanted = glm::normalize(camera.centre() - p);
    const glm::dvec3 normal = surface_.normal(p);
    const auto blended_most = static_cast<std::size_t>(std::min(options_.blended, kMaxBlended));
    std::array<std::pair<double, const Source*>, kCandidates> by_angle;
    std::size_t candidate_count = 0;
    for (const Candidate& candidate : candidates) {
        const glm::dvec3 towards = glm::normalize(candidate.source->camera.centre() - p);
        const double angle = std::acos(std::clamp(glm::dot(wanted, towards), -1.0, 1.0));
        by_angle[candidate_count++] = {angle, candidate.source};
    }
    std::sort(by_angle.begin(), by_angle.begin() + static_cast<std::ptrdiff_t>(candidate_count));
    std::array<Contribution, kMaxBlended + 1> found;
    std::size_t count = 0;
    for (std::size_t i = 0; i < candidate_count && count <= blended_most; ++i) {
        const Source& source = *by_angle[i].second;
        const glm::dvec3 seen = source.camera.project(p);
        const double visible = static_cast<double>(visibility(source, seen));
        if (visible <= 0) continue;
        const double facing = glm::dot(normal, glm::normalize(source.camera.centre() - p));
        found[count++] = {by_angle[i].first, visible * (0.02 + smooth_step(0.0, 0.35, facing)),
                          premultiplied(sample_premultiplied(source.image, seen.x, seen.y))};
    }
    if (count == 0) return {};
    const std::size_t blended = std::min(count, blended_most);
    // The first photo that is not blended sets the angle at which weights reach 0.
    const double farthest = count > blended ? found[blended].angle : found[count - 1].angle * 1.5 + kLeastAngle_rad;
    RgbaF sum;
    float weights = 0;
    for (std::size_t i = 0; i < blended; ++i) {
        const Contribution& c = found[i];
        const double nearness = std::max(1 - c.angle / farthest, 1e-4) / (c.angle + kLeastAngle_rad);
        const auto w = static_cast<float>(c.weight * nearness);
        sum.r += w * c.colour.r;
        sum.g += w * c.colour.g;
        sum.b += w * c.colour.b;
        sum.a += w * c.colour.a;
        weights += w;
    }
    if (sum.a <= 0) return {};
    // The share of a pixel that the surface covers is counted by the rays. Photos that have a contour there are half
    // transparent, too, and must not count it again; a point that they show to be beside the object is removed.
    const float alpha = std::min(2 * sum.a / weights, 1.0F);
    const float scale = alpha / sum.a;
    return {sum.r * scale, sum.g * scale, sum.b * scale, alpha};
}

ViewSynthesizer::Pixel ViewSynthesizer::render_pixel(const Camera& camera, int x, int y,
                                                     std::vector<Candidate>& candidates) const {
    const int raster = options_.raster;
    const int rays = raster * raster;
    const glm::dvec3 origin = camera.centre();
    std::array<glm::dvec3, kMaxRays> points;
    std::size_t hits = 0;
    double nearest = std::numeric_limits<double>::max();
    double farthest = 0;
    for (int i = 0; i < rays; ++i) {
        const int row = i / raster;
        const int column = i % raster;
        const glm::dvec3 direction = camera.ray(x + (column + 0.5) / raster, y + (row + 0.5) / raster);
        const auto span = surface_.clip(origin, direction);
        const auto t = span ? surface_.intersect(origin, direction, *span) : std::nullopt;
        if (!t) continue;
        points[hits++] = origin + *t * direction;
        nearest = std::min(nearest, *t);
        farthest = std::max(farthest, *t);
    }
    if (hits == 0) return {};
    if (candidates.empty()) candidates = candidates_near(camera, points[0], kCandidates);
    Pixel pixel{{}, static_cast<float>(nearest)};
    const bool smooth = farthest - nearest < kSmooth_voxels * surface_.grid().voxel;
    if (static_cast<int>(hits) == rays && smooth) {
        glm::dvec3 middle{0};
        for (std::size_t i = 0; i < hits; ++i) middle += points[i] / static_cast<double>(hits);
        pixel.colour = blend(candidates, camera, middle);
        return pixel;
    }
    const float per = 1.0F / static_cast<float>(rays);
    for (std::size_t i = 0; i < hits; ++i) {
        const RgbaF colour = blend(candidates, camera, points[i]);
        pixel.colour.r += per * colour.r;
        pixel.colour.g += per * colour.g;
        pixel.colour.b += per * colour.b;
        pixel.colour.a += per * colour.a;
    }
    return pixel;
}

SynthesizedView ViewSynthesizer::synthesize(const Camera& camera) const {
    SynthesizedView view{Image<Rgba8>(camera.width, camera.height), Image<float>(camera.width, camera.height, 0.0F)};
    const int across = (camera.width + kTile_px - 1) / kTile_px;
    const int down = (camera.height + kTile_px - 1) / kTile_px;
    for_each_index(across * down, [&](int tile) {
        const int left = tile % across * kTile_px;
        const int top = tile / across * kTile_px;
        std::vector<Candidate> candidates;
        for (int y = top; y < std::min(top + kTile_px, camera.height); ++y) {
            for (int x = left; x < std::min(left + kTile_px, camera.width); ++x) {
                const Pixel pixel = render_pixel(camera, x, y, candidates);
                view.image(x, y) = encoded(pixel.colour);
                if (view.image(x, y).a != 0) view.depth(x, y) = pixel.depth;
            }
        }
    });
    return view;
}

}  // namespace rs::encode
