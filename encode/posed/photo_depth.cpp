#include "encode/posed/photo_depth.hpp"

#include "encode/raymap/semi_global.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace rs::encode {
namespace {

constexpr std::uint8_t kUnseen = 255;  // no cost: outside of the neighbour's frame
constexpr int kMatchTile_px = 32;      // side of the squares of pixels that are matched at the same levels

// A photo at the working size.
struct WorkPhoto {
    Camera camera;
    Image<Rgba8> reduced;           // empty if the photo has the working size
    ConstImageView<Rgba8> image{};  // `reduced`, or the photo's own
    Image<float> luma;              // codes; 0 where the image is transparent
    Image<std::uint8_t> inside;     // 1 inside of the matte
};

WorkPhoto make_work_photo(const PosedPhoto& photo, int reduction) {
    WorkPhoto work;
    work.camera = photo.camera;
    work.camera.width /= reduction;
    work.camera.height /= reduction;
    work.camera.fl_x /= reduction;
    work.camera.fl_y /= reduction;
    work.camera.cx /= reduction;
    work.camera.cy /= reduction;
    if (reduction > 1) work.reduced = Image<Rgba8>(work.camera.width, work.camera.height);
    work.image = reduction > 1 ? work.reduced.view() : photo.image.view();
    work.luma = Image<float>(work.camera.width, work.camera.height);
    work.inside = Image<std::uint8_t>(work.camera.width, work.camera.height);
    for (int y = 0; y < work.camera.height; ++y) {
        for (int x = 0; x < work.camera.width; ++x) {
            glm::dvec4 sum{0};
            for (int j = 0; j < reduction; ++j) {
                for (int i = 0; i < reduction; ++i) {
                    const Rgba8& p = photo.image(x * reduction + i, y * reduction + j);
                    sum += glm::dvec4(p.r * p.a, p.g * p.a, p.b * p.a, p.a);
                }
            }
            if (sum.w == 0) continue;
            const glm::dvec3 mean = glm::dvec3(sum) / sum.w;
            const auto code = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
            if (reduction > 1) {
                work.reduced(x, y) = {code(mean.r), code(mean.g), code(mean.b), code(sum.w / (reduction * reduction))};
            }
            work.inside(x, y) = work.image(x, y).a >= kInside ? 1 : 0;
            work.luma(x, y) = static_cast<float>(0.3 * mean.r + 0.6 * mean.g + 0.1 * mean.b);
        }
    }
    return work;
}

// Box of the pixels inside of the matte.
ObjectBox box_of(ConstImageView<Rgba8> image) {
    ObjectBox box{image.width(), image.height(), 0, 0};
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if (image(x, y).a < kInside) continue;
            box.left = std::min(box.left, x);
            box.right = std::max(box.right, x + 1);
            box.top = std::min(box.top, y);
            box.bottom = std::max(box.bottom, y + 1);
        }
    }
    return box;
}

double angle_between(const Camera& a, const Camera& b) {
    return std::acos(std::clamp(glm::dot(glm::normalize(a.centre()), glm::normalize(b.centre())), -1.0, 1.0));
}

// Cameras within the allowed angles, in directions as different as possible: each next one is the camera with the least
// sum of its angle and of its nearness to those chosen.
std::vector<int> choose_neighbours(std::span<const Camera> cameras, int n, const PhotoDepthOptions& options) {
    const auto camera = [&](int i) -> const Camera& { return cameras[static_cast<std::size_t>(i)]; };
    std::vector<int> near;
    for (int i = 0; i < static_cast<int>(cameras.size()); ++i) {
        const double angle_deg = degrees(angle_between(camera(n), camera(i)));
        if (i != n && angle_deg >= options.least_angle_deg && angle_deg <= options.most_angle_deg) near.push_back(i);
    }
    std::vector<int> chosen;
    while (chosen.size() < static_cast<std::size_t>(options.neighbours) && !near.empty()) {
        const auto badness = [&](int i) {
            double sum = angle_between(camera(n), camera(i));
            for (const int other : chosen) sum += 0.02 / (0.05 + angle_between(camera(i), camera(other)));
            return sum;
        };
        const auto best = std::ranges::min_element(near, {}, badness);
        chosen.push_back(*best);
        near.erase(best);
    }
    return chosen;
}

// At most `most` cameras, ascending: each next one is the farthest in angle from those chosen.
std::vector<int> spread_evenly(std::span<const Camera> cameras, int most) {
    std::vector<double> nearest(cameras.size(), std::numeric_limits<double>::max());
    std::vector<int> chosen;
    while (chosen.size() < std::min(cameras.size(), static_cast<std::size_t>(most))) {
        const auto next = std::ranges::max_element(nearest) - nearest.begin();
        chosen.push_back(static_cast<int>(next));
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            nearest[i] = std::min(nearest[i], angle_between(cameras[i], cameras[static_cast<std::size_t>(next)]));
        }
        nearest[static_cast<std::size_t>(next)] = -1;
    }
    std::ranges::sort(chosen);
    return chosen;
}

// First and last level inside of the hull along a pixel's ray; count 0 where the ray misses it.
struct Levels {
    double low = 0, step = 1;  // axial depth of level 0, and per level
    int count = 0;
};

// Sparse volume of the levels between the hull's entry and exit.
CostVolume make_volume(const WorkPhoto& photo, const SignedVolume& hull, const ObjectBox& box, const Levels& levels) {
    CostVolume volume;
    volume.box = box;
    volume.levels = levels.count;
    volume.pixels.resize(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
    const glm::dvec3 origin = photo.camera.centre();
    const double margin = 1.5 * hull.grid().voxel;
    std::size_t end = 0;
    for (int x = box.left; x < box.right; ++x) {
        for (int y = box.top; y < box.bottom; ++y) {
            if (photo.image(x, y).a < kInside) continue;
            const glm::dvec3 direction = photo.camera.ray(x + 0.5, y + 0.5);
            const auto span = hull.clip(origin, direction);
            const auto entry = span ? hull.intersect(origin, direction, *span) : std::nullopt;
            if (!entry) continue;
            const glm::dvec3 beyond = origin + span->to * direction;
            const auto back = hull.intersect(beyond, -direction, {0, span->to - *entry});
            const double exit = back ? span->to - *back : *entry;
            const int first =
                std::clamp(static_cast<int>((*entry - margin - levels.low) / levels.step), 0, levels.count - 1);
            const int last =
                std::clamp(static_cast<int>((exit + margin - levels.low) / levels.step) + 1, first, levels.count - 1);
            PixelLevels& pixel = volume.pixels[static_cast<std::size_t>((x - box.left) * box.height() + y - box.top)];
            pixel.begin = static_cast<std::uint32_t>(end);
            pixel.first = static_cast<std::uint16_t>(first);
            pixel.count = static_cast<std::uint16_t>(last - first + 1);
            end += pixel.count;
        }
    }
    volume.costs.assign(end, kMaxCost / 2);
    return volume;
}

// Matching costs of one neighbour at one level, from sums over a square window. Sums are arrays over the pixels of a
// row, which the compiler vectorizes.
class PlaneMatcher {
public:
    PlaneMatcher(const WorkPhoto& photo, int window)
        : photo_(photo), radius_(window / 2), rows_(static_cast<std::size_t>(window)) {
        RS_CHECK(window % 2 == 1 && window <= kMostWindow_px);
    }

    // Writes kUnseen, or kMaxCost where the neighbour is transparent, or the cost of the correlation, for the pixels of
    // `active`, at most kMatchTile_px wide. The first of them is written to costs(0, 0).
    void match(const WorkPhoto& neighbour, double depth, const ObjectBox& active, Image<std::uint8_t>& costs) {
        const int width = active.width();
        const int left = active.left - radius_;
        const Plane plane = plane_at(neighbour.camera, depth, left);
        for (int y = active.top - radius_; y < active.bottom + radius_; ++y) {
            Row& row = row_of(y, active);
            warp_row(neighbour, plane, left, y, width + 2 * radius_, row);
            const int done = y - radius_;
            if (done < active.top) continue;
            const Row& middle = row_of(done, active);
            sum_window(width);
            write_costs(middle, width, &costs(0, done - active.top));
        }
    }

private:
    static constexpr int kMostWindow_px = 17;
    static constexpr int kMost_px = kMatchTile_px + kMostWindow_px - 1;
    static constexpr float kMiddle = 128;                     // subtracted from codes, for the precision of sums
    enum State : std::uint8_t { kOutside, kHidden, kValid };  // kHidden: outside of the neighbour's frame

    // Number of the pixels that both photos show, their values, squares and products.
    struct Moments {
        alignas(32) std::array<std::array<float, kMost_px>, 6> sums;  // n, a, b, aa, bb, ab
    };
    struct Row {
        Moments moments;
        std::array<State, kMost_px> states;
    };

    [[nodiscard]] Row& row_of(int y, const ObjectBox& active) {
        return rows_[static_cast<std::size_t>(y - active.top + radius_) % rows_.size()];
    }

    // Homogeneous pixel positions in the neighbour: of the first column of row 0, and per column and row.
    struct Plane {
        glm::dvec3 first, per_column, per_row;
    };
    [[nodiscard]] Plane plane_at(const Camera& to, double depth, int left) const {
        const auto in_camera = [&](const glm::dvec3& v) {
            const double z = glm::dot(v, to.forward());
            return glm::dvec3(to.cx * z + to.fl_x * glm::dot(v, to.right()), to.cy * z - to.fl_y * glm::dot(v, to.up()),
                              z);
        };
        const Camera& from = photo_.camera;
        return {in_camera(from.centre() + depth * from.ray(left + 0.5, 0.5) - to.centre()),
                in_camera(from.right() * (depth / from.fl_x)), in_camera(from.up() * (-depth / from.fl_y))};
    }

    // Samples the neighbour where its camera sees the points of the plane.
    void warp_row(const WorkPhoto& neighbour, const Plane& plane, int left, int y, int width, Row& row) const {
        for (auto& sums : row.moments.sums) std::fill_n(sums.begin(), width, 0.0F);
        std::fill_n(row.states.begin(), width, kOutside);
        if (y < 0 || y >= photo_.image.height()) return;
        const Camera& to = neighbour.camera;
        const glm::vec3 first(plane.first + static_cast<double>(y) * plane.per_row);
        const glm::vec3 step(plane.per_column);
        const auto right_most = static_cast<float>(to.width - 1);
        const auto lowest = static_cast<float>(to.height - 1);
        const int end = std::min(width, photo_.image.width() - left);
        for (int i = std::max(-left, 0); i < end; ++i) {
            if (photo_.inside(left + i, y) == 0) continue;
            const auto n = static_cast<std::size_t>(i);
            const glm::vec3 p = first + static_cast<float>(i) * step;
            const float per_depth = 1 / p.z;
            const float px = p.x * per_depth - 0.5F;
            const float py = p.y * per_depth - 0.5F;
            if (p.z <= 0 || !(px >= 0 && py >= 0) || px >= right_most || py >= lowest) {
                row.states[n] = kHidden;
                continue;
            }
            const auto ix = static_cast<int>(px);
            const auto iy = static_cast<int>(py);
            const float fx = px - static_cast<float>(ix);
            const float fy = py - static_cast<float>(iy);
            if (neighbour.inside(ix + (fx >= 0.5F ? 1 : 0), iy + (fy >= 0.5F ? 1 : 0)) == 0) continue;
            const float* const upper = &neighbour.luma(ix, iy);
            const float* const lower = upper + to.width;
            const float above = upper[0] + fx * (upper[1] - upper[0]);
            const float b = above + fy * (lower[0] + fx * (lower[1] - lower[0]) - above) - kMiddle;
            const float a = photo_.luma(left + i, y) - kMiddle;
            const float values[] = {1, a, b, a * a, b * b, a * b};
            for (std::size_t moment = 0; moment < 6; ++moment) row.moments.sums[moment][n] = values[moment];
            row.states[n] = kValid;
        }
    }

    // Sets window_ to the sums over the window around each pixel.
    void sum_window(int width) {
        for (std::size_t moment = 0; moment < 6; ++moment) {
            std::array<float, kMost_px> column;
            const int with_rim = width + 2 * radius_;
            std::copy_n(rows_[0].moments.sums[moment].begin(), with_rim, column.begin());
            for (std::size_t row = 1; row < rows_.size(); ++row)
                add(with_rim, rows_[row].moments.sums[moment].data(), column.data());
            float* const out = window_.sums[moment].data();
            std::copy_n(column.begin(), width, out);
            for (int shift = 1; shift <= 2 * radius_; ++shift) add(width, column.data() + shift, out);
        }
    }
    static void add(int count, const float* values, float* sums) {
        for (int i = 0; i < count; ++i) sums[i] += values[i];
    }

    void write_costs(const Row& middle, int width, std::uint8_t* costs) const {
        constexpr float kNoise = 9;    // variance, codes squared
        constexpr float kOffset = 40;  // codes: photos of one exposure differ less
        constexpr float kOffsetPart = 0.2F;
        const auto& [count, sum_a, sum_b, sum_aa, sum_bb, sum_ab] = window_.sums;
        std::array<float, kMost_px> found;
        for (std::size_t i = 0; i < static_cast<std::size_t>(width); ++i) {
            const float per = 1 / std::max(count[i], 1.0F);
            const float a = sum_a[i] * per;
            const float b = sum_b[i] * per;
            const float var_a = std::max(sum_aa[i] * per - a * a, 0.0F) + kNoise;
            const float var_b = std::max(sum_bb[i] * per - b * b, 0.0F) + kNoise;
            const float correlation = (sum_ab[i] * per - a * b) / std::sqrt(var_a * var_b);
            const float offset = std::min(std::abs(a - b) / kOffset, 1.0F);
            const float cost = ((1 - kOffsetPart) * (1 - correlation) / 2 + kOffsetPart * offset) * kMaxCost;
            found[i] = std::min(std::max(cost + 0.5F, 0.0F), static_cast<float>(kMaxCost));
        }
        for (std::size_t i = 0; i < static_cast<std::size_t>(width); ++i) {
            const State state = middle.states[i + static_cast<std::size_t>(radius_)];
            costs[i] = state == kValid    ? static_cast<std::uint8_t>(found[i])
                       : state == kHidden ? kUnseen
                                          : static_cast<std::uint8_t>(kMaxCost);
        }
    }

    const WorkPhoto& photo_;
    int radius_;
    std::vector<Row> rows_;  // the last `window` rows
    Moments window_{};
};

// Mean of the lower half of the neighbours' costs, in ascending order: a surface is occluded in some of them.
std::uint8_t best_half(std::span<const std::uint8_t> costs) {
    const auto seen = static_cast<std::size_t>(std::ranges::find(costs, kUnseen) - costs.begin());
    if (seen == 0) return kMaxCost / 2;
    const std::size_t used = (seen + 1) / 2;
    int sum = 0;
    for (std::size_t i = 0; i < used; ++i) sum += costs[i];
    return static_cast<std::uint8_t>(sum / static_cast<int>(used));
}

class DepthSearch {
public:
    DepthSearch(std::span<const WorkPhoto> photos, const SignedVolume& hull, const PhotoDepthOptions& options)
        : photos_(photos), hull_(hull), options_(options) {}

    [[nodiscard]] Image<float> depth_of(int n, const std::vector<int>& neighbours) const {
        const WorkPhoto& photo = photos_[static_cast<std::size_t>(n)];
        Image<float> depth(photo.camera.width, photo.camera.height, 0.0F);
        const ObjectBox box = box_of(photo.image);
        if (neighbours.empty() || box.empty()) return depth;
        const Levels levels = levels_of(photo, neighbours);
        CostVolume volume = make_volume(photo, hull_, box, levels);
        if (volume.costs.empty()) return depth;
        fill(volume, photo, neighbours, levels);
        const Image<float> found = regularize(photo, volume);
        for (int y = 0; y < depth.height(); ++y) {
            for (int x = 0; x < depth.width(); ++x) {
                const float level = found(y, x);
                if (!std::isnan(level))
                    depth(x, y) = static_cast<float>(levels.low + static_cast<double>(level) * levels.step);
            }
        }
        return depth;
    }

private:
    // Levels over the hull's box, spaced by the depth resolution of the neighbour at the widest angle.
    [[nodiscard]] Levels levels_of(const WorkPhoto& photo, const std::vector<int>& neighbours) const {
        double low = 1e30, high = -1e30;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 a = hull_.grid().low;
            const glm::dvec3 b = hull_.grid().high();
            const glm::dvec3 p((corner & 1) != 0 ? a.x : b.x, (corner & 2) != 0 ? a.y : b.y,
                               (corner & 4) != 0 ? a.z : b.z);
            const double depth = photo.camera.project(p).z;
            low = std::min(low, depth);
            high = std::max(high, depth);
        }
        low = std::max(low, 1e-3 * high);
        double px_per_unit = 0;
        for (const int i : neighbours) {
            const Camera& other = photos_[static_cast<std::size_t>(i)].camera;
            px_per_unit = std::max(
                px_per_unit, std::sin(angle_between(photo.camera, other)) * other.fl_x / glm::length(other.centre()));
        }
        Levels levels;
        levels.count =
            std::clamp(static_cast<int>((high - low) * px_per_unit / options_.level_px), 16, options_.max_levels);
        levels.low = low;
        levels.step = (high - low) / (levels.count - 1);
        return levels;
    }

    // The box of the pixels of `tile` that have a level; empty if there are none.
    static ObjectBox active_box(const CostVolume& volume, const ObjectBox& tile, int level) {
        ObjectBox active{tile.right, tile.bottom, tile.left, tile.top};
        for (int x = tile.left; x < tile.right; ++x) {
            for (int y = tile.top; y < tile.bottom; ++y) {
                const PixelLevels& pixel = volume.of(x, y);
                if (level < pixel.first || level >= pixel.first + pixel.count) continue;
                active.left = std::min(active.left, x);
                active.right = std::max(active.right, x + 1);
                active.top = std::min(active.top, y);
                active.bottom = std::max(active.bottom, y + 1);
            }
        }
        return active;
    }

    // Pixels of a tile have similar levels, so that few others are matched with them.
    void fill(CostVolume& volume, const WorkPhoto& photo, const std::vector<int>& neighbours,
              const Levels& levels) const {
        const ObjectBox& box = volume.box;
        PlaneMatcher matcher(photo, options_.window_px);
        std::vector<Image<std::uint8_t>> costs(neighbours.size(), Image<std::uint8_t>(kMatchTile_px, kMatchTile_px));
        for (int top = box.top; top < box.bottom; top += kMatchTile_px) {
            for (int left = box.left; left < box.right; left += kMatchTile_px) {
                const ObjectBox tile{left, top, std::min(left + kMatchTile_px, box.right),
                                     std::min(top + kMatchTile_px, box.bottom)};
                for (int level = 0; level < levels.count; ++level) {
                    const ObjectBox active = active_box(volume, tile, level);
                    if (active.empty()) continue;
                    for (std::size_t i = 0; i < neighbours.size(); ++i) {
                        const WorkPhoto& neighbour = photos_[static_cast<std::size_t>(neighbours[i])];
                        matcher.match(neighbour, levels.low + level * levels.step, active, costs[i]);
                    }
                    store(costs, active, level, volume);
                }
            }
        }
    }

    // Sorts the neighbours' costs of each pixel, by exchanges of whole rows, which the compiler vectorizes.
    static void sort_costs(std::vector<Image<std::uint8_t>>& costs, int y, int width) {
        for (std::size_t last = costs.size() - 1; last > 0; --last) {
            for (std::size_t i = 0; i < last; ++i) {
                std::uint8_t* const a = &costs[i](0, y);
                std::uint8_t* const b = &costs[i + 1](0, y);
                for (int x = 0; x < width; ++x) {
                    const std::uint8_t lower = std::min(a[x], b[x]);
                    b[x] = std::max(a[x], b[x]);
                    a[x] = lower;
                }
            }
        }
    }

    // Sets the costs of a level from those of the neighbours, whose pixel (0, 0) is the first of `active`.
    static void store(std::vector<Image<std::uint8_t>>& costs, const ObjectBox& active, int level, CostVolume& volume) {
        std::vector<std::uint8_t> one(costs.size());
        for (int y = active.top; y < active.bottom; ++y) {
            sort_costs(costs, y - active.top, active.width());
            for (int x = active.left; x < active.right; ++x) {
                const PixelLevels& pixel = volume.of(x, y);
                if (level < pixel.first || level >= pixel.first + pixel.count) continue;
                for (std::size_t i = 0; i < costs.size(); ++i) one[i] = costs[i](x - active.left, y - active.top);
                volume.costs[pixel.begin + static_cast<std::size_t>(level - pixel.first)] = best_half(one);
            }
        }
    }

    // Transposed, as semi_global_levels() returns it.
    [[nodiscard]] static Image<float> regularize(const WorkPhoto& photo, const CostVolume& volume) {
        WorkView view;
        view.width = photo.image.width();
        view.height = photo.image.height();
        view.columns = Image<Rgba8>(view.height, view.width);
        for (int y = 0; y < view.height; ++y) {
            for (int x = 0; x < view.width; ++x) {
                const Rgba8& p = photo.image(x, y);
                view.columns(y, x) = p.a != 0 ? p : Rgba8{};
            }
        }
        return semi_global_levels(view, volume, SmoothnessOptions{.small_step = 2, .large_step = 60});
    }

    std::span<const WorkPhoto> photos_;
    const SignedVolume& hull_;
    const PhotoDepthOptions& options_;
};

// [pixel]: true if fewer than `confirming` neighbours have its depth within `tolerance`.
std::vector<bool> find_unconfirmed(const std::vector<PhotoDepth>& all, std::size_t n,
                                   const std::vector<int>& neighbours, double tolerance, int confirming) {
    const PhotoDepth& own = all[n];
    std::vector<bool> unconfirmed(own.depth.pixels().size());
    for (int y = 0; y < own.depth.height(); ++y) {
        for (int x = 0; x < own.depth.width(); ++x) {
            const float depth = own.depth(x, y);
            if (depth <= 0) continue;
            const glm::dvec3 p = own.camera.centre() + static_cast<double>(depth) * own.camera.ray(x + 0.5, y + 0.5);
            int votes = 0;
            for (const int i : neighbours) {
                const PhotoDepth& other = all[static_cast<std::size_t>(i)];
                const glm::dvec3 seen = other.camera.project(p);
                if (!(seen.z > 0 && seen.x >= 0 && seen.y >= 0 && seen.x < other.depth.width() &&
                      seen.y < other.depth.height()))
                    continue;
                const auto there = static_cast<double>(other.depth(static_cast<int>(seen.x), static_cast<int>(seen.y)));
                if (there > 0 && std::abs(there - seen.z) <= tolerance) ++votes;
            }
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(own.depth.width()) + static_cast<std::size_t>(x);
            unconfirmed[pixel] = votes < std::min(confirming, static_cast<int>(neighbours.size()));
        }
    }
    return unconfirmed;
}

// Removes depths that too few neighbours confirm.
void remove_unconfirmed(std::vector<PhotoDepth>& depths, double voxel, const PhotoDepthOptions& options) {
    std::vector<Camera> cameras;
    for (const PhotoDepth& map : depths) cameras.push_back(map.camera);
    std::vector<std::vector<bool>> unconfirmed(depths.size());
    for_each_index(depths.size(), [&](std::size_t n) {
        const std::vector<int> neighbours = choose_neighbours(cameras, static_cast<int>(n), options);
        unconfirmed[n] = find_unconfirmed(depths, n, neighbours, options.agreement * voxel, options.confirming);
    });
    for (std::size_t n = 0; n < depths.size(); ++n) {
        for (std::size_t i = 0; i < unconfirmed[n].size(); ++i) {
            if (unconfirmed[n][i]) depths[n].depth.pixels()[i] = 0;
        }
    }
}

}  // namespace

Result<std::vector<PhotoDepth>> estimate_photo_depths(std::span<const PosedPhoto> photos, const SignedVolume& hull,
                                                      const PhotoDepthOptions& options, Progress* progress) {
    std::vector<WorkPhoto> work(photos.size());
    for_each_index(photos.size(), [&](std::size_t n) {
        const int longest = std::max(photos[n].image.width(), photos[n].image.height());
        work[n] = make_work_photo(photos[n], (longest + options.working_size_px - 1) / options.working_size_px);
    });
    std::vector<Camera> cameras;
    for (const WorkPhoto& photo : work) cameras.push_back(photo.camera);
    const std::vector<int> references = spread_evenly(cameras, options.most_maps);
    const int count = static_cast<int>(references.size());
    std::vector<PhotoDepth> depths(references.size());
    const DepthSearch search(work, hull, options);
    RS_TRY(for_each_in_parallel(count, "depth of photos", progress, [&](int i) -> Status {
        const auto n = static_cast<std::size_t>(i);
        const Camera& camera = cameras[static_cast<std::size_t>(references[n])];
        depths[n] = {camera, search.depth_of(references[n], choose_neighbours(cameras, references[n], options))};
        return {};
    }));
    work.clear();
    remove_unconfirmed(depths, hull.grid().voxel, options);
    return depths;
}

}  // namespace rs::encode
