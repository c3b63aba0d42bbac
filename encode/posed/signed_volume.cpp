#include "encode/posed/signed_volume.hpp"

#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::encode {

VolumeGrid make_grid(const glm::dvec3& low, const glm::dvec3& high, int longest) {
    const glm::dvec3 extent = high - low;
    VolumeGrid grid;
    grid.low = low;
    grid.voxel = std::max({extent.x, extent.y, extent.z}) / longest;
    for (int axis = 0; axis < 3; ++axis) {
        grid.size[axis] = std::clamp(static_cast<int>(std::ceil(extent[axis] / grid.voxel - 1e-6)), 1, longest);
    }
    return grid;
}

float SignedVolume::sample_in_grid(const glm::vec3& p) const {
    if (!(p.x >= 0 && p.y >= 0 && p.z >= 0)) return kTruncation_voxels;
    const auto x = static_cast<int>(p.x);
    const auto y = static_cast<int>(p.y);
    const auto z = static_cast<int>(p.z);
    if (x + 1 >= grid_.size.x || y + 1 >= grid_.size.y || z + 1 >= grid_.size.z) return kTruncation_voxels;
    const float fx = p.x - static_cast<float>(x);
    const float fy = p.y - static_cast<float>(y);
    const float fz = p.z - static_cast<float>(z);
    const float* const a = distances_.data() + grid_.index(x, y, z);
    const float* const b = a + grid_.size.x;
    const float* const c = a + grid_.index(0, 0, 1);
    const float* const d = c + grid_.size.x;
    const auto along_x = [&](const float* v) { return v[0] + fx * (v[1] - v[0]); };
    const float near = along_x(a) + fy * (along_x(b) - along_x(a));
    const float far = along_x(c) + fy * (along_x(d) - along_x(c));
    return near + fz * (far - near);
}

float SignedVolume::sample(const glm::dvec3& p_in_world) const {
    return sample_in_grid(glm::vec3((p_in_world - grid_.low) / grid_.voxel - 0.5));
}

glm::dvec3 SignedVolume::normal(const glm::dvec3& p_in_world) const {
    const glm::vec3 p((p_in_world - grid_.low) / grid_.voxel - 0.5);
    glm::vec3 gradient{0};
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 step{0};
        step[axis] = 1;
        gradient[axis] = sample_in_grid(p + step) - sample_in_grid(p - step);
    }
    const float length = glm::length(gradient);
    return length > 0 ? gradient / length : gradient;
}

std::optional<SignedVolume::Span> SignedVolume::clip(const glm::dvec3& origin, const glm::dvec3& direction) const {
    Span span{0, std::numeric_limits<double>::max()};
    const glm::dvec3 high = grid_.high();
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(direction[axis]) < 1e-12) {
            if (origin[axis] < grid_.low[axis] || origin[axis] > high[axis]) return std::nullopt;
            continue;
        }
        const double a = (grid_.low[axis] - origin[axis]) / direction[axis];
        const double b = (high[axis] - origin[axis]) / direction[axis];
        span.from = std::max(span.from, std::min(a, b));
        span.to = std::min(span.to, std::max(a, b));
    }
    if (span.empty()) return std::nullopt;
    return span;
}

void SignedVolume::index_empty_blocks() {
    constexpr int kMaxClearance_blocks = 8;
    blocks_ = (grid_.size + (kBlock_voxels - 1)) / kBlock_voxels;
    clearance_.assign(block_index({0, 0, blocks_.z}), 0);
    for_each_index(blocks_.z, [&](int z) {
        for (int y = 0; y < blocks_.y; ++y) {
            for (int x = 0; x < blocks_.x; ++x) clearance_[block_index({x, y, z})] = is_empty({x, y, z}) ? 1 : 0;
        }
    });
    for (int n = 1; n < kMaxClearance_blocks; ++n) widen_clearance(n);
}

void SignedVolume::widen_clearance(int least) {
    const auto all_clear = [&](const glm::ivec3& low, const glm::ivec3& high) {
        for (int z = low.z; z <= high.z; ++z) {
            for (int y = low.y; y <= high.y; ++y) {
                for (int x = low.x; x <= high.x; ++x) {
                    if (clearance_[block_index({x, y, z})] < least) return false;
                }
            }
        }
        return true;
    };
    for (int z = 0; z < blocks_.z; ++z) {
        for (int y = 0; y < blocks_.y; ++y) {
            for (int x = 0; x < blocks_.x; ++x) {
                std::uint8_t& clearance = clearance_[block_index({x, y, z})];
                const glm::ivec3 block(x, y, z);
                if (clearance == least &&
                    all_clear(glm::max(block - 1, glm::ivec3(0)), glm::min(block + 1, blocks_ - 1)))
                    ++clearance;
            }
        }
    }
}

bool SignedVolume::is_empty(const glm::ivec3& block) const {
    const glm::ivec3 first = glm::max(kBlock_voxels * block - 1, glm::ivec3(0));
    const glm::ivec3 end = glm::min(kBlock_voxels * (block + 1) + 1, grid_.size);
    for (int z = first.z; z < end.z; ++z) {
        for (int y = first.y; y < end.y; ++y) {
            const float* const values = row(y, z);
            if (std::any_of(values + first.x, values + end.x, [](float v) { return v < kTruncation_voxels; }))
                return false;
        }
    }
    return true;
}

float SignedVolume::end_of_empty(const glm::vec3& first, const glm::vec3& forward, float at) const {
    constexpr float kBeyondWall_voxels = 1e-3F;
    const glm::vec3 in_blocks = (first + at * forward + 0.5F) / static_cast<float>(kBlock_voxels);
    if (!(in_blocks.x >= 0 && in_blocks.y >= 0 && in_blocks.z >= 0)) return at;
    const glm::ivec3 block(in_blocks);
    if (block.x >= blocks_.x || block.y >= blocks_.y || block.z >= blocks_.z) return at;
    const int clear = clearance_[block_index(block)];
    if (clear == 0) return at;
    float left = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(forward[axis]) < 1e-9F) continue;
        const int wall = kBlock_voxels * (block[axis] + (forward[axis] > 0 ? clear : 1 - clear));
        left = std::min(left, (static_cast<float>(wall) - 0.5F - first[axis]) / forward[axis]);
    }
    return left + kBeyondWall_voxels;
}

std::optional<double> SignedVolume::intersect(const glm::dvec3& origin, const glm::dvec3& direction,
                                              const Span& span) const {
    // Distances along depth maps' rays exceed those to the surface, so that steps are shorter.
    constexpr float kPartOfDistance = 0.7F;
    constexpr float kLeastStep_voxels = 0.4F;
    const double voxels_per_t = glm::length(direction) / grid_.voxel;
    // Steps are in voxels from the span's first point.
    const glm::vec3 first((origin + span.from * direction - grid_.low) / grid_.voxel - 0.5);
    const glm::vec3 forward(direction / (grid_.voxel * voxels_per_t));
    const auto end = static_cast<float>((span.to - span.from) * voxels_per_t);
    const auto as_t = [&](float step) { return span.from + static_cast<double>(step) / voxels_per_t; };
    float before = 0;
    float before_distance = 1;
    for (float at = 0; at < end;) {
        const glm::vec3 p = first + at * forward;
        const float distance = sample_in_grid(p);
        if (distance <= 0) {
            return as_t(at == 0 ? 0 : before + (at - before) * before_distance / (before_distance - distance));
        }
        before = at;
        before_distance = distance;
        const float step = std::max(kLeastStep_voxels, kPartOfDistance * distance);
        at = std::max(at + step, distance < kTruncation_voxels ? 0 : end_of_empty(first, forward, at));
    }
    return std::nullopt;
}

std::vector<SignedVolume::Span> SignedVolume::depths_of_tiles(const Camera& camera, int tile_px) const {
    constexpr double kMargin_px = 1;  // beyond the tiles' borders, for rounding
    const int across = (camera.width + tile_px - 1) / tile_px;
    const int down = (camera.height + tile_px - 1) / tile_px;
    constexpr double kFar = std::numeric_limits<double>::max();
    std::vector<Span> tiles(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), Span{kFar, 0});
    const auto widen = [&](const glm::ivec2& first, const glm::ivec2& last, double near, double far) {
        for (int y = std::max(first.y, 0); y <= std::min(last.y, down - 1); ++y) {
            for (int x = std::max(first.x, 0); x <= std::min(last.x, across - 1); ++x) {
                Span& span = tiles[static_cast<std::size_t>(y * across + x)];
                span = {std::min(span.from, near), std::max(span.to, far)};
            }
        }
    };
    // A block's half extent along the camera's axes.
    const double half = grid_.voxel * kBlock_voxels / 2;
    const auto extent = [&](const glm::dvec3& axis) {
        return half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    };
    const glm::dvec3 reach(extent(camera.right()), extent(camera.up()), extent(camera.forward()));
    for (int z = 0; z < blocks_.z; ++z) {
        for (int y = 0; y < blocks_.y; ++y) {
            for (int x = 0; x < blocks_.x; ++x) {
                if (clearance_[block_index({x, y, z})] != 0) continue;
                const glm::dvec3 v = grid_.low + 2 * half * glm::dvec3(x + 0.5, y + 0.5, z + 0.5) - camera.centre();
                const double depth = glm::dot(v, camera.forward());
                const double near = depth - reach.z - grid_.voxel, far = depth + reach.z + grid_.voxel;
                if (far <= 0) continue;
                if (near <= 0.01 * far) {
                    widen({0, 0}, {across - 1, down - 1}, 0, far);
                    continue;
                }
                const glm::dvec2 middle(glm::dot(v, camera.right()), -glm::dot(v, camera.up()));
                const glm::dvec2 focal(camera.fl_x, camera.fl_y), principal(camera.cx, camera.cy);
                const glm::dvec2 low = focal * (middle - glm::dvec2(reach)),
                                 high = focal * (middle + glm::dvec2(reach));
                const glm::dvec2 first = principal + glm::min(low / near, low / far) - kMargin_px;
                const glm::dvec2 last = principal + glm::max(high / near, high / far) + kMargin_px;
                widen(glm::ivec2(glm::floor(first / static_cast<double>(tile_px))),
                      glm::ivec2(glm::floor(last / static_cast<double>(tile_px))), near, far);
            }
        }
    }
    return tiles;
}

std::optional<SignedVolume::Bounds> SignedVolume::bounds() const {
    Bounds found{glm::dvec3(1e30), glm::dvec3(-1e30)};
    for (int z = 0; z < grid_.size.z; ++z) {
        for (int y = 0; y < grid_.size.y; ++y) {
            const float* const values = row(y, z);
            for (int x = 0; x < grid_.size.x; ++x) {
                if (values[x] > 0) continue;
                const glm::dvec3 p = grid_.centre(x, y, z);
                found.low = glm::min(found.low, p - 0.5 * grid_.voxel);
                found.high = glm::max(found.high, p + 0.5 * grid_.voxel);
                found.radius = std::max(found.radius, std::hypot(p.x, p.z) + grid_.voxel);
            }
        }
    }
    if (found.radius == 0) return std::nullopt;
    return found;
}

Image<float> cast_depth(const SignedVolume& volume, const Camera& camera) {
    constexpr int kTile_px = 16;
    Image<float> depth(camera.width, camera.height, 0.0F);
    const glm::dvec3 origin = camera.centre();
    const std::vector<SignedVolume::Span> spans = volume.depths_of_tiles(camera, kTile_px);
    const int across = (camera.width + kTile_px - 1) / kTile_px;
    for_each_index(spans.size(), [&](std::size_t tile) {
        if (spans[tile].empty()) return;
        const int left = static_cast<int>(tile) % across * kTile_px;
        const int top = static_cast<int>(tile) / across * kTile_px;
        for (int y = top; y < std::min(top + kTile_px, camera.height); ++y) {
            for (int x = left; x < std::min(left + kTile_px, camera.width); ++x) {
                const auto t = volume.intersect(origin, camera.ray(x + 0.5, y + 0.5), spans[tile]);
                if (t) depth(x, y) = static_cast<float>(*t);
            }
        }
    });
    return depth;
}

}  // namespace rs::encode
