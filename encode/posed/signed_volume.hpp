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

    /// Part of a ray, in multiples of its direction.
    struct Span {
        double from = 0, to = 0;
        [[nodiscard]] bool empty() const { return from >= to; }
    };
    /// Between the points at which a ray enters the grid's box and leaves it.
    [[nodiscard]] std::optional<Span> clip(const glm::dvec3& origin, const glm::dvec3& direction) const;
    /// The first surface along a ray within `span` (after index_empty_blocks()), as a multiple of `direction`.
    [[nodiscard]] std::optional<double> intersect(const glm::dvec3& origin, const glm::dvec3& direction,
                                                  const Span& span) const;
    /// The axial depths between which the rays of each square tile of a view, including its border, may meet a surface
    /// (after index_empty_blocks()); an empty span where they meet none. Row by row.
    [[nodiscard]] std::vector<Span> depths_of_tiles(const Camera& camera, int tile_px) const;

    /// The box of all voxels inside the object; nullopt if there are none.
    struct Bounds {
        glm::dvec3 low, high;
        double radius = 0;  // about the Y axis
    };
    [[nodiscard]] std::optional<Bounds> bounds() const;

private:
    static constexpr int kBlock_voxels = 8;
    // In grid coordinates, in which voxel centres are whole numbers.
    [[nodiscard]] float sample_in_grid(const glm::vec3& p) const;
    [[nodiscard]] std::size_t block_index(const glm::ivec3& block) const {
        return static_cast<std::size_t>((block.z * blocks_.y + block.y) * blocks_.x + block.x);
    }
    // Step of a ray first + step * forward (in grid coordinates) at which it leaves the empty blocks around its point
    // at step `at`; `at` where the block is not empty.
    [[nodiscard]] float end_of_empty(const glm::vec3& first, const glm::vec3& forward, float at) const;
    [[nodiscard]] bool is_empty(const glm::ivec3& block) const;
    // Sets the clearance of the empty blocks whose neighbours all have the clearance `least` to one more.
    void widen_clearance(int least);

    VolumeGrid grid_;
    std::vector<float> distances_;
    glm::ivec3 blocks_{0};
    // [block], in blocks. 0: a voxel of the block or next to it is below kTruncation_voxels; n: blocks less than n away
    // have a clearance above 0.
    std::vector<std::uint8_t> clearance_;
};

/// Axial depth of the first surface at each pixel's centre; 0: no surface. Runs in parallel over tiles.
Image<float> cast_depth(const SignedVolume& volume, const Camera& camera);

}  // namespace rs::encode
