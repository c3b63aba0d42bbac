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

float SignedVolume::sample(const glm::dvec3& p_in_world) const {
    const glm::dvec3 g = (p_in_world - grid_.low) / grid_.voxel - 0.5;
    const auto x = static_cast<int>(std::floor(g.x));
    const auto y = static_cast<int>(std::floor(g.y));
    const auto z = static_cast<int>(std::floor(g.z));
    if (x < 0 || y < 0 || z < 0 || x + 1 >= grid_.size.x || y + 1 >= grid_.size.y || z + 1 >= grid_.size.z) {
        return kTruncation_voxels;
    }
    const auto fx = static_cast<float>(g.x - x);
    const auto fy = static_cast<float>(g.y - y);
    const auto fz = static_cast<float>(g.z - z);
    const float* const a = distances_.data() + grid_.index(x, y, z);
    const float* const b = a + grid_.size.x;
    const float* const c = distances_.data() + grid_.index(x, y, z + 1);
    const float* const d = c + grid_.size.x;
    const auto along_x = [&](const float* v) { return v[0] + fx * (v[1] - v[0]); };
    const float near = along_x(a) + fy * (along_x(b) - along_x(a));
    const float far = along_x(c) + fy * (along_x(d) - along_x(c));
    return near + fz * (far - near);
}

glm::dvec3 SignedVolume::normal(const glm::dvec3& p_in_world) const {
    glm::dvec3 gradient{0};
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step{0};
        step[axis] = grid_.voxel;
        gradient[axis] = static_cast<double>(sample(p_in_world + step) - sample(p_in_world - step));
    }
    const double length = glm::length(gradient);
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
    if (span.from >= span.to) return std::nullopt;
    return span;
}

void SignedVolume::index_empty_blocks() {
    blocks_ = (grid_.size + (kBlock_voxels - 1)) / kBlock_voxels;
    empty_.assign(
        static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y) * static_cast<std::size_t>(blocks_.z),
        0);
    for_each_index(blocks_.z, [&](int z) {
        for (int y = 0; y < blocks_.y; ++y) {
            for (int x = 0; x < blocks_.x; ++x) {
                const auto n = static_cast<std::size_t>((z * blocks_.y + y) * blocks_.x + x);
                empty_[n] = is_empty({x, y, z}) ? 1 : 0;
            }
        }
    });
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

double SignedVolume::skip_empty(const glm::dvec3& origin, const glm::dvec3& direction, double t) const {
    const double side = grid_.voxel * kBlock_voxels;
    const glm::ivec3 block(glm::floor((origin + t * direction - grid_.low) / side));
    if (block.x < 0 || block.y < 0 || block.z < 0 || block.x >= blocks_.x || block.y >= blocks_.y ||
        block.z >= blocks_.z) {
        return t;
    }
    if (empty_[static_cast<std::size_t>((block.z * blocks_.y + block.y) * blocks_.x + block.x)] == 0) return t;
    double left = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(direction[axis]) < 1e-12) continue;
        const double wall = grid_.low[axis] + side * (block[axis] + (direction[axis] > 0 ? 1 : 0));
        left = std::min(left, (wall - origin[axis]) / direction[axis]);
    }
    return left + 1e-3 * grid_.voxel / glm::length(direction);
}

std::optional<double> SignedVolume::intersect(const glm::dvec3& origin, const glm::dvec3& direction,
                                              const Span& span) const {
    // Distances along depth maps' rays exceed those to the surface, so that steps are shorter.
    constexpr double kPartOfDistance = 0.7;
    constexpr double kLeastStep_voxels = 0.4;
    const double per_voxel = grid_.voxel / glm::length(direction);
    double before = span.from;
    double before_distance = 1;
    for (double t = span.from; t < span.to;) {
        const auto distance = static_cast<double>(sample(origin + t * direction));
        if (distance <= 0) {
            if (t == span.from) return t;
            return before + (t - before) * before_distance / (before_distance - distance);
        }
        before = t;
        before_distance = distance;
        if (distance >= static_cast<double>(kTruncation_voxels)) {
            const double left = skip_empty(origin, direction, t);
            if (left > t) {
                t = left;
                continue;
            }
        }
        t += per_voxel * std::max(kLeastStep_voxels, kPartOfDistance * distance);
    }
    return std::nullopt;
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
    Image<float> depth(camera.width, camera.height, 0.0F);
    const glm::dvec3 origin = camera.centre();
    for_each_index(camera.height, [&](int y) {
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 direction = camera.ray(x + 0.5, y + 0.5);
            const auto span = volume.clip(origin, direction);
            if (!span) continue;
            if (const auto t = volume.intersect(origin, direction, *span)) depth(x, y) = static_cast<float>(*t);
        }
    });
    return depth;
}

}  // namespace rs::encode
