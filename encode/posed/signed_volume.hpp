#pragma once
// Signed distances on a voxel grid: negative inside the object, positive outside, truncated. Offline, floating point.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rs::encode {

/// Cubic voxels of side `voxel` in rig units; voxel (0, 0, 0) begins at `low`.
struct VolumeGrid {
    glm::dvec3 low{0};
    double voxel = 1;
    glm::ivec3 size{0};

    [[nodiscard]] glm::dvec3 centre(int x, int y, int z) const {
        return low + voxel * glm::dvec3(x + 0.5, y + 0.5, z + 0.5);
    }
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::size_t count() const { return index(0, 0, size.z); }
    [[nodiscard]] glm::dvec3 high() const { return low + voxel * glm::dvec3(size); }
};

/// The grid of the box low..high whose longest side has `longest` voxels.
VolumeGrid make_grid(const glm::dvec3& low, const glm::dvec3& high, int longest);

/// Distances are in voxels and at most kTruncation_voxels; 4 bytes per voxel.
class SignedVolume {
public:
    static constexpr float kTruncation_voxels = 4;

    explicit SignedVolume(const VolumeGrid& grid) : grid_(grid), distances_(grid.count(), kTruncation_voxels) {}

    /// Finds the blocks of voxels through which rays may skip; to be called after the distances are set.
    void index_empty_blocks();

    [[nodiscard]] const VolumeGrid& grid() const { return grid_; }
    [[nodiscard]] float* row(int y, int z) { return distances_.data() + grid_.index(0, y, z); }
    [[nodiscard]] const float* row(int y, int z) const { return distances_.data() + grid_.index(0, y, z); }

    /// Trilinear; kTruncation_voxels outside of the grid.
    [[nodiscard]] float sample(const glm::dvec3& p_in_world) const;
    /// The gradient's direction, which is the outward normal; (0, 0, 0) where the distances are constant.
    [[nodiscard]] glm::dvec3 normal(const glm::dvec3& p_in_world) const;

    /// Multiples of `direction` from `origin` at which a ray enters the grid's box and leaves it.
    struct Span {
        double from = 0, to = 0;
    };
    [[nodiscard]] std::optional<Span> clip(const glm::dvec3& origin, const glm::dvec3& direction) const;
    /// The first surface along a ray within `span` (after index_empty_blocks()), as a multiple of `direction`.
    [[nodiscard]] std::optional<double> intersect(const glm::dvec3& origin, const glm::dvec3& direction,
                                                  const Span& span) const;

    /// The box of all voxels inside the object; nullopt if there are none.
    struct Bounds {
        glm::dvec3 low, high;
        double radius = 0;  // about the Y axis
    };
    [[nodiscard]] std::optional<Bounds> bounds() const;

private:
    static constexpr int kBlock_voxels = 8;
    // Multiple of `direction` at which a ray leaves the empty block that contains its point at `t`; `t` where the block
    // is not empty.
    [[nodiscard]] double skip_empty(const glm::dvec3& origin, const glm::dvec3& direction, double t) const;
    [[nodiscard]] bool is_empty(const glm::ivec3& block) const;

    VolumeGrid grid_;
    std::vector<float> distances_;
    glm::ivec3 blocks_{0};
    std::vector<std::uint8_t> empty_;  // 1: every voxel of the block and next to it is at kTruncation_voxels
};

/// Axial depth of the first surface at each pixel's centre; 0: no surface. Runs in parallel over rows.
Image<float> cast_depth(const SignedVolume& volume, const Camera& camera);

}  // namespace rs::encode
