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

std::vector<const ViewSynthesizer::Source*> ViewSynthesizer::nearest_sources(
    const Camera& camera, const glm::dvec3& p, const std::function<bool(const Source&)>& is_suitable) const {
    const glm::dvec3 wanted = glm::normalize(camera.centre() - p);
    std::vector<std::pair<double, const Source*>> all;  // by decreasing cosine of the angle to the view's ray
    all.reserve(sources_.size());
    for (const Source& source : sources_) {
        if (!is_suitable(source)) continue;
        all.emplace_back(-glm::dot(wanted, glm::normalize(source.camera.centre() - p)), &source);
    }
    const std::size_t count = std::min(kCandidates, all.size());
    std::ranges::partial_sort(all, all.begin() + static_cast<std::ptrdiff_t>(count));
    std::vector<const Source*> nearest(count);
    std::transform(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), nearest.begin(),
                   [](const auto& candidate) { return candidate.second; });
    return nearest;
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

std::optional<RgbaF> ViewSynthesizer::blend(std::span<const Source* const> candidates, const Camera& camera,
                                            const glm::dvec3& p) const {
    struct Direction {
        double cosine = 0;  // of the angle to the view's ray
        glm::dvec3 towards{0};
        const Source* source = nullptr;
    };
    const glm::dvec3 wanted = glm::normalize(camera.centre() - p);
    const auto blended_most = static_cast<std::size_t>(std::min(options_.blended, kMaxBlended));
    std::array<Direction, kCandidates> nearest;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const glm::dvec3 towards = glm::normalize(candidates[i]->camera.centre() - p);
        nearest[i] = {glm::dot(wanted, towards), towards, candidates[i]};
    }
    const auto end = nearest.begin() + static_cast<std::ptrdiff_t>(candidates.size());
    std::sort(nearest.begin(), end, [](const Direction& a, const Direction& b) {
        return a.cosine != b.cosine ? a.cosine > b.cosine : a.source < b.source;
    });
    const glm::dvec3 normal = surface_.normal(p);
    std::array<Contribution, kMaxBlended + 1> found;
    std::size_t count = 0;
    for (auto n = nearest.begin(); n != end && count <= blended_most; ++n) {
        const glm::dvec3 seen = n->source->camera.project(p);
        const double visible = static_cast<double>(visibility(*n->source, seen));
        if (visible <= 0) continue;
        const double facing = glm::dot(normal, n->towards);
        found[count++] = {std::acos(std::clamp(n->cosine, -1.0, 1.0)),
                          visible * (0.02 + smooth_step(0.0, 0.35, facing)),
                          sample_linear(n->source->image, seen.x, seen.y)};
    }
    if (count == 0) return std::nullopt;
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
    if (sum.a <= 0) return RgbaF{};
    // The share of a pixel that the surface covers is counted by the rays. Photos that have a contour there are half
    // transparent, too, and must not count it again; a point that they show to be beside the object is removed.
    const float alpha = std::min(2 * sum.a / weights, 1.0F);
    const float scale = alpha / sum.a;
    return RgbaF{sum.r * scale, sum.g * scale, sum.b * scale, alpha};
}

RgbaF ViewSynthesizer::colour_at(const Camera& camera, const glm::dvec3& p, Tile& tile) const {
    if (tile.candidates.empty()) {
        tile.candidates = nearest_sources(camera, p, [](const Source&) { return true; });
    }
    if (const auto colour = blend(tile.candidates, camera, p)) return *colour;
    // From straight above, the nearest photos of a turn may all be on one side, from which the point is hidden.
    const glm::dvec3 normal = surface_.normal(p);
    const auto shows = [&](const Source& source) {
        return glm::dot(normal, source.camera.centre() - p) > 0 && visibility(source, source.camera.project(p)) > 0;
    };
    return blend(nearest_sources(camera, p, shows), camera, p).value_or(RgbaF{});
}

ViewSynthesizer::Pixel ViewSynthesizer::render_edge(const Camera& camera, int x, int y, Tile& tile) const {
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
        const auto t = surface_.intersect(origin, direction, tile.depths);
        if (!t) continue;
        points[hits++] = origin + *t * direction;
        nearest = std::min(nearest, *t);
        farthest = std::max(farthest, *t);
    }
    if (hits == 0) return {};
    Pixel pixel{{}, static_cast<float>(nearest)};
    const bool smooth = farthest - nearest < kSmooth_voxels * surface_.grid().voxel;
    if (static_cast<int>(hits) == rays && smooth) {
        glm::dvec3 middle{0};
        for (std::size_t i = 0; i < hits; ++i) middle += points[i] / static_cast<double>(hits);
        pixel.colour = colour_at(camera, middle, tile);
        return pixel;
    }
    const float per = 1.0F / static_cast<float>(rays);
    for (std::size_t i = 0; i < hits; ++i) {
        const RgbaF colour = colour_at(camera, points[i], tile);
        pixel.colour.r += per * colour.r;
        pixel.colour.g += per * colour.g;
        pixel.colour.b += per * colour.b;
        pixel.colour.a += per * colour.a;
    }
    return pixel;
}

void ViewSynthesizer::cast_corners(const Camera& camera, const Tile& tile, Image<float>& corners) const {
    if (tile.depths.empty()) return;
    // The last tiles include the frame's border.
    const int right = tile.left + kTile_px < camera.width ? tile.left + kTile_px : corners.width();
    const int bottom = tile.top + kTile_px < camera.height ? tile.top + kTile_px : corners.height();
    for (int y = tile.top; y < bottom; ++y) {
        for (int x = tile.left; x < right; ++x) {
            const auto t = surface_.intersect(camera.centre(), camera.ray(x, y), tile.depths);
            corners(x, y) = t ? static_cast<float>(*t) : 0.0F;
        }
    }
}

void ViewSynthesizer::render_tile(const Camera& camera, const Image<float>& corners, Tile& tile,
                                  SynthesizedView& view) const {
    const auto any_hit_around = [&](int x, int y) {
        for (int j = std::max(y - 1, 0); j <= std::min(y + 2, camera.height); ++j) {
            for (int i = std::max(x - 1, 0); i <= std::min(x + 2, camera.width); ++i) {
                if (corners(i, j) > 0) return true;
            }
        }
        return false;
    };
    for (int y = tile.top; y < std::min(tile.top + kTile_px, camera.height); ++y) {
        for (int x = tile.left; x < std::min(tile.left + kTile_px, camera.width); ++x) {
            const std::array<float, 4> depths = {corners(x, y), corners(x + 1, y), corners(x, y + 1),
                                                 corners(x + 1, y + 1)};
            const auto [least, most] = std::ranges::minmax(depths);
            Pixel pixel;
            if (least > 0 && static_cast<double>(most - least) < kSmooth_voxels * surface_.grid().voxel) {
                pixel.depth = (depths[0] + depths[1] + depths[2] + depths[3]) / 4;
                const glm::dvec3 direction = camera.ray(x + 0.5, y + 0.5);
                pixel.colour = colour_at(camera, camera.centre() + static_cast<double>(pixel.depth) * direction, tile);
            } else if (most > 0 || any_hit_around(x, y)) {
                pixel = render_edge(camera, x, y, tile);
            }
            view.image(x, y) = encoded(pixel.colour);
            if (view.image(x, y).a != 0) view.depth(x, y) = pixel.depth;
        }
    }
}

SynthesizedView ViewSynthesizer::synthesize(const Camera& camera) const {
    SynthesizedView view{Image<Rgba8>(camera.width, camera.height), Image<float>(camera.width, camera.height, 0.0F)};
    const int across = (camera.width + kTile_px - 1) / kTile_px;
    const std::vector<SignedVolume::Span> depths = surface_.depths_of_tiles(camera, kTile_px);
    const auto tile_at = [&](std::size_t n) {
        return Tile{static_cast<int>(n) % across * kTile_px, static_cast<int>(n) / across * kTile_px, depths[n], {}};
    };
    Image<float> corners(camera.width + 1, camera.height + 1, 0.0F);
    for_each_index(depths.size(), [&](std::size_t n) { cast_corners(camera, tile_at(n), corners); });
    for_each_index(depths.size(), [&](std::size_t n) {
        Tile tile = tile_at(n);
        if (!tile.depths.empty()) render_tile(camera, corners, tile, view);
    });
    return view;
}

}  // namespace rs::encode
