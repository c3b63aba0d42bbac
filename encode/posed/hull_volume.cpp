#include "encode/posed/hull_volume.hpp"

#include "rayspace/base/parallel.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace rs::encode {
namespace {

constexpr float kFarthest_px = 24;               // distances from contours are truncated
constexpr double kMaxContradictedMattes = 0.01;  // share of the object, at which mattes agree
constexpr int kSearchVoxels = 64;                // of hulls that are only compared
constexpr double kLeastSeen = 0.4;               // share of the photos whose frames contain a point of the object
constexpr int kBlock_voxels = 8;
constexpr int kMaxTolerated = 40;  // photos

// Narrowest first.
constexpr HullTolerance kTolerances[] = {{0.25, 0}, {1, 0}, {1, 0.02}, {2, 0.02}, {2, 0.05}, {4, 0.05}, {4, 0.1}};

// Distance from the contour, px: positive inside the matte. Chamfer distances (Borgefors 1986, weights 1 and 1.41),
// which start from the coverage of the pixels at the contour.
class ContourDistance {
public:
    explicit ContourDistance(const Image<Rgba8>& image) : inside_(image.width(), image.height()) {
        Image<float> outside(image.width(), image.height());
        for (std::size_t i = 0; i < outside.pixels().size(); ++i) {
            // The contour passes through pixels with partial coverage, and others are half a pixel away at least.
            const float from_contour = static_cast<float>(image.pixels()[i].a) / 255.0F - 0.5F;
            inside_.pixels()[i] = from_contour > 0.48F ? kFarthest_px : std::max(from_contour, -0.5F);
            outside.pixels()[i] = from_contour < -0.48F ? kFarthest_px : std::max(-from_contour, -0.5F);
        }
        spread(inside_);
        spread(outside);
        for (std::size_t i = 0; i < outside.pixels().size(); ++i) {
            if (image.pixels()[i].a < 128) inside_.pixels()[i] = -outside.pixels()[i];
        }
    }

    // nullopt where the position is outside of the frame.
    [[nodiscard]] std::optional<float> at(double x, double y) const {
        if (!(x >= 0 && y >= 0 && x < inside_.width() && y < inside_.height())) return std::nullopt;
        const double px = std::clamp(x - 0.5, 0.0, inside_.width() - 1.001);
        const double py = std::clamp(y - 0.5, 0.0, inside_.height() - 1.001);
        const auto ix = static_cast<int>(px);
        const auto iy = static_cast<int>(py);
        const auto fx = static_cast<float>(px - ix);
        const auto fy = static_cast<float>(py - iy);
        const float* const a = &inside_(ix, iy);
        const float* const b = a + inside_.width();
        const float upper = a[0] + fx * (a[1] - a[0]);
        return upper + fy * (b[0] + fx * (b[1] - b[0]) - upper);
    }

private:
    static void spread(Image<float>& d) {
        const auto relax = [&](int x, int y, int nx, int ny, float step) {
            if (nx < 0 || ny < 0 || nx >= d.width() || ny >= d.height()) return;
            d(x, y) = std::min(d(x, y), d(nx, ny) + step);
        };
        const auto visit = [&](int x, int y, int sense) {
            relax(x, y, x - sense, y, 1);
            relax(x, y, x, y - sense, 1);
            relax(x, y, x - sense, y - sense, 1.41F);
            relax(x, y, x + sense, y - sense, 1.41F);
        };
        for (int y = 0; y < d.height(); ++y) {
            for (int x = 0; x < d.width(); ++x) visit(x, y, 1);
        }
        for (int y = d.height() - 1; y >= 0; --y) {
            for (int x = d.width() - 1; x >= 0; --x) visit(x, y, -1);
        }
    }

    Image<float> inside_;
};

struct Silhouettes {
    std::span<const PosedPhoto> photos;
    std::vector<ContourDistance> distances;
};

// Photos to project a point into. The others, `seen_by_others`, contain the point and do not rule it out.
struct PhotoSelection {
    std::vector<std::size_t> photos;
    int seen_by_others = 0;
};

PhotoSelection all_photos(const Silhouettes& silhouettes) {
    PhotoSelection all;
    all.photos.resize(silhouettes.photos.size());
    std::iota(all.photos.begin(), all.photos.end(), 0);
    return all;
}

// Without the photos in which the block around `middle` is too far inside the matte to lower a truncated distance.
PhotoSelection photos_of_block(const Silhouettes& silhouettes, const glm::dvec3& middle, double voxel) {
    // More than half of a block's diagonal, for what projection and chamfer distances add.
    constexpr double kReach_voxels = 1.3 * kBlock_voxels;
    PhotoSelection selection;
    for (std::size_t n = 0; n < silhouettes.photos.size(); ++n) {
        const Camera& camera = silhouettes.photos[n].camera;
        const glm::dvec3 seen = camera.project(middle);
        const double px_per_voxel = camera.fl_x * voxel / seen.z;
        const double frame_px = std::min({seen.x, seen.y, camera.width - seen.x, camera.height - seen.y});
        const bool is_within = seen.z > kReach_voxels * voxel && frame_px > kReach_voxels * px_per_voxel;
        const auto px = is_within ? silhouettes.distances[n].at(seen.x, seen.y) : std::nullopt;
        const double least_px = (static_cast<double>(SignedVolume::kTruncation_voxels) + kReach_voxels) * px_per_voxel;
        if (px && static_cast<double>(*px) > least_px) {
            ++selection.seen_by_others;
        } else {
            selection.photos.push_back(n);
        }
    }
    return selection;
}

// Distance of a voxel from the hull's surface in voxels, negative inside and at most `most`: the photo that rules out
// the point most decides, after the tolerated ones.
float hull_distance(const Silhouettes& silhouettes, const PhotoSelection& selection, const glm::dvec3& p, double voxel,
                    const HullTolerance& tolerance, float most = SignedVolume::kTruncation_voxels) {
    const auto tolerated =
        std::min(static_cast<int>(tolerance.tolerated * static_cast<double>(silhouettes.photos.size())), kMaxTolerated);
    std::array<float, kMaxTolerated + 1> least{};
    std::fill_n(least.begin(), tolerated + 1, most);
    int seen_by = selection.seen_by_others;
    for (const std::size_t n : selection.photos) {
        const Camera& camera = silhouettes.photos[n].camera;
        const glm::dvec3 seen = camera.project(p);
        if (seen.z <= 0) continue;
        const auto px = silhouettes.distances[n].at(seen.x, seen.y);
        if (!px) continue;
        ++seen_by;
        auto distance =
            static_cast<float>((static_cast<double>(*px) + tolerance.margin_px) * seen.z / camera.fl_x / voxel);
        for (int i = 0; i <= tolerated; ++i) {
            auto& known = least[static_cast<std::size_t>(i)];
            if (distance < known) std::swap(distance, known);
        }
        if (least[static_cast<std::size_t>(tolerated)] <= -most) return most;
    }
    // Nothing rules out what only a few frames contain, such as the space around a camera.
    if (seen_by < kLeastSeen * static_cast<double>(silhouettes.photos.size())) return most;
    return -least[static_cast<std::size_t>(tolerated)];
}

// Carves a block of voxels from `first`. Distances change by at most a voxel per voxel, so that the middle decides for
// blocks far from the surface.
void carve_block(const Silhouettes& silhouettes, const PhotoSelection& all, const HullTolerance& tolerance,
                 const glm::ivec3& first, SignedVolume& hull) {
    const VolumeGrid& grid = hull.grid();
    constexpr float kFar = SignedVolume::kTruncation_voxels + 0.9F * kBlock_voxels;  // half of a block's diagonal
    const glm::dvec3 middle = grid.low + grid.voxel * (glm::dvec3(first) + 0.5 * kBlock_voxels);
    const float distance = hull_distance(silhouettes, all, middle, grid.voxel, tolerance, kFar);
    const bool is_far = std::abs(distance) >= kFar;
    const PhotoSelection selection = is_far ? PhotoSelection{} : photos_of_block(silhouettes, middle, grid.voxel);
    const glm::ivec3 end = glm::min(first + kBlock_voxels, grid.size);
    for (int z = first.z; z < end.z; ++z) {
        for (int y = first.y; y < end.y; ++y) {
            float* const row = hull.row(y, z);
            for (int x = first.x; x < end.x; ++x) {
                row[x] = is_far ? std::copysign(SignedVolume::kTruncation_voxels, distance)
                                : hull_distance(silhouettes, selection, grid.centre(x, y, z), grid.voxel, tolerance);
            }
        }
    }
}

SignedVolume carve(const Silhouettes& silhouettes, const VolumeGrid& grid, const HullTolerance& tolerance,
                   Progress* progress) {
    SignedVolume hull(grid);
    const glm::ivec3 blocks = (grid.size + (kBlock_voxels - 1)) / kBlock_voxels;
    if (progress != nullptr) progress->start("visual hull", blocks.z);
    const PhotoSelection all = all_photos(silhouettes);
    for_each_index(blocks.z, [&](int z) {
        for (int y = 0; y < blocks.y; ++y) {
            for (int x = 0; x < blocks.x; ++x) {
                carve_block(silhouettes, all, tolerance, kBlock_voxels * glm::ivec3(x, y, z), hull);
            }
        }
        if (progress != nullptr) progress->advance();
    });
    if (progress != nullptr) progress->finish();
    hull.index_empty_blocks();
    return hull;
}

// Share of the object's pixels, sampled, whose rays miss the hull.
double contradicted_share(const Silhouettes& silhouettes, const SignedVolume& hull) {
    constexpr int kEvery_px = 7;
    std::vector<glm::ivec2> counts(silhouettes.photos.size());  // missed, all
    for_each_index(silhouettes.photos.size(), [&](std::size_t n) {
        const PosedPhoto& photo = silhouettes.photos[n];
        for (int y = kEvery_px / 2; y < photo.image.height(); y += kEvery_px) {
            for (int x = kEvery_px / 2; x < photo.image.width(); x += kEvery_px) {
                const auto inside = silhouettes.distances[n].at(x + 0.5, y + 0.5);
                if (!inside || *inside < 3) continue;
                const glm::dvec3 direction = photo.camera.ray(x + 0.5, y + 0.5);
                const auto span = hull.clip(photo.camera.centre(), direction);
                const bool met = span && hull.intersect(photo.camera.centre(), direction, *span);
                counts[n] += glm::ivec2(met ? 0 : 1, 1);
            }
        }
    });
    glm::dvec2 sum{0};
    for (const glm::ivec2& count : counts) sum += glm::dvec2(count);
    return sum.y > 0 ? sum.x / sum.y : 1;
}

// The box in which the object is searched: as far from the origin as the nearest camera.
double nearest_camera(std::span<const PosedPhoto> photos) {
    double nearest = std::numeric_limits<double>::max();
    for (const PosedPhoto& photo : photos) nearest = std::min(nearest, glm::length(photo.camera.centre()));
    return nearest;
}

Status check_cameras(std::span<const PosedPhoto> photos, const SignedVolume& hull) {
    for (const PosedPhoto& photo : photos) {
        if (hull.sample(photo.camera.centre()) > 0) continue;
        return Error{photo.name + ": its camera is inside the object; check the poses and their axes"};
    }
    return {};
}

Error no_common_volume() {
    return Error{"the photos' mattes have no common volume; check the poses, their axes and the masks"};
}

}  // namespace

Result<CarvedHull> carve_hull(std::span<const PosedPhoto> photos, const HullOptions& options, Progress* progress) {
    if (photos.size() < kLeastPhotos) {
        return Error{std::to_string(photos.size()) + " posed photos are too few; at least " +
                     std::to_string(kLeastPhotos) + " are needed, and 40 or more around the object are better"};
    }
    Silhouettes silhouettes{photos, {}};
    silhouettes.distances.reserve(photos.size());
    for (const PosedPhoto& photo : photos) silhouettes.distances.emplace_back(photo.image);

    const double half = nearest_camera(photos);
    const VolumeGrid everywhere = make_grid(glm::dvec3(-half), glm::dvec3(half), kSearchVoxels);
    std::optional<CarvedHull> best;
    SignedVolume::Bounds box{};
    for (const HullTolerance& tolerance : kTolerances) {
        const SignedVolume rough = carve(silhouettes, everywhere, tolerance, nullptr);
        const auto rough_box = rough.bounds();
        if (!rough_box) continue;
        const glm::dvec3 rim(2 * everywhere.voxel);
        SignedVolume finer =
            carve(silhouettes, make_grid(rough_box->low - rim, rough_box->high + rim, 3 * kSearchVoxels / 2), tolerance,
                  nullptr);
        const auto finer_box = finer.bounds();
        if (!finer_box) continue;
        const double contradicted = contradicted_share(silhouettes, finer);
        if (!best || contradicted < best->contradicted) {
            box = *finer_box;
            best = CarvedHull{std::move(finer), tolerance, contradicted};
        }
        if (contradicted <= kMaxContradictedMattes) break;
    }
    if (!best) return no_common_volume();
    RS_TRY(check_cameras(photos, best->volume));
    const glm::dvec3 rim = glm::dvec3(0.03 * glm::length(box.high - box.low));
    best->volume =
        carve(silhouettes, make_grid(box.low - rim, box.high + rim, options.longest_voxels), best->tolerance, progress);
    return std::move(*best);
}

}  // namespace rs::encode
