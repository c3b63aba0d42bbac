#pragma once
// Messages in the FIFOs of a pipe of the parallel board, from a column's ray to the pixels of a patch. On this board
// the number of an image is the place of its view in the ring (parallel_layout.hpp).
//
// A *patch* is 16 columns and 8 rows of a view: pixel `id` is slot * 128 + row * 16 + column, where `slot` is one of
// the four patches in flight. A *stripe* is 16 columns over the whole height; `stripe` counts a pipe's stripes,
// modulo 4.

#include "engine/core/definition/shape_cells.hpp"
#include "engine/model/limits/board_limits.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/stripes.hpp"

#include <array>

namespace rs::engine::model {

inline constexpr int kPatchRows = 8;
inline constexpr int kPatchPixels = kPatchRows * kStripeColumns;
inline constexpr int kPatchSlots = 4;
inline constexpr int kPatchIds = kPatchSlots * kPatchPixels;
inline constexpr int kStripeNumbers = 4;  // numbers modulo 4; kStripeSlots stripes are in flight
inline constexpr int kStripeSlots = 2;

// Kind of a column's ray; it determines how its pixels are computed.
enum class RayKind {
    none,   // no ray
    plane,  // object without a shape map: one image column is scanned (section 3)
    foot,   // object with a shape map but no bands for this ray: its surface is at the foot (section 5)
    shape,  // object with a shape map and bands for this ray
};

// Bracket finder output: the two captured images that enclose the ray (section 5).
struct BracketedRay {
    static constexpr int kBits = 4 + 2 + 4 + 23 + 29 + 31 + 32 + 7 + 7 + 31 + 31 + 11 + 27 + 2;
    int view = 0;
    RayKind kind = RayKind::none;
    int plane = 0;
    std::int64_t x_q20 = 0, lambda_q20 = 0, n_q28 = 0, t_q28 = 0;
    int first = 0;  // image; the image of the RS map if the ray has no gap
    int second = 0;
    std::int64_t from_first_q20 = 0;  // f
    std::int64_t width_q20 = 0;       // w
    int lines = 0;                    // S
    std::int64_t first_line = 0;
    bool lines_before = false;  // the previous gap has lines
    bool lines_behind = false;
};

// Camera of an image, and its line of the plane with the terms along the normal.
struct ImageLine {
    static constexpr int kBits = 10 * 32;
    std::int32_t cx_q16 = 0, cy_q16 = 0, fl_y_q16 = 0, height_q20 = 0;
    std::int32_t l0_q20 = 0, l1_q30 = 0, q0_q16 = 0, q1_q16 = 0;
    std::int32_t l2_q30 = 0, q2_q16 = 0;
};

// Image reader output: the ray with the lines of its images.
struct RayWithLines {
    static constexpr int kBits = BracketedRay::kBits + 2 * ImageLine::kBits;
    BracketedRay ray;
    std::array<ImageLine, 2> image{};
};

// A captured image along the ray: all values that are linear in the depth (section 5).
struct ImageSetup {
    static constexpr int kBits = 7 + 30 + 20 + 31 + 22 + 3 * 31 + 29;
    int image = 0;
    std::int64_t l0_q20 = 0, l1_q24 = 0, q0_q12 = 0, q1_q12 = 0;
    std::int32_t cx_q16 = 0, cy_q16 = 0, fl_y_q16 = 0, height_q20 = 0;
};

// Column set-up output: all values shared by the pixels of a column. Sent to three blocks, each of which stores a part.
struct ColumnSetup {
    static constexpr int kHeadBits = 4 + 2 + 2 + 4;
    static constexpr int kBits =
        kHeadBits + 7 + 9 + 46 + 36 + 2 * ImageSetup::kBits + 9 + 3 * 30 + 25 + 22 + 2 * 27 + 2 * 13 + 2 * 3;
    static constexpr int kRiseBits = kHeadBits + 30 + 25 + 22;
    static constexpr int kMarchBits = kHeadBits + 9 + 3 + 3 + 1;
    static constexpr int kPlaceBits = kHeadBits + 46 + 36 + 9 + 2 * ImageSetup::kBits + 9 + 31 + 22;
    int view = 0;
    RayKind kind = RayKind::none;
    int stripe = 0;           // set by the band reader
    int column = 0;           // in the stripe; set by the band reader
    bool same_cells = false;  // the same cells as the previous column; set by the band reader
    // plane
    int image = 0, image_column = 0;
    std::int64_t row_0_q16 = 0, row_step_q16 = 0;
    // foot, shape
    std::array<ImageSetup, 2> images{};
    int weight = 0;
    std::int64_t lambda_foot_q20 = 0, lambda0_q20 = 0, lambda1_q21 = 0;
    std::int64_t inverse_r_q20 = 0, inverse_rho_q20 = 0;
    std::array<std::int64_t, 2> map_line{};  // the two lines beside the ray
    std::array<int, 2> map_place{};          // the two cells along p
    int line_part = 0;                       // weight of the second line, in eighths
    int p_part = 0;
};

// Pixel scan output: start of a patch.
struct PatchJob {
    static constexpr int kBits = 4 + 2 + 5 + 6 + 5 + 4 + 1 + 1;
    int view = 0;
    int slot = 0;
    int first_column = 0;  // of the view
    int first_row = 0;
    int columns = 0;
    int rows = 0;  // 1 .. 8
    bool ends_stripe = false;
    bool ends_view = false;
};

struct ScannedPixel {
    static constexpr int kBits = 9 + 4 + 2 + 9 + 28;
    int id = 0;
    int view = 0;
    int stripe = 0;
    int row = 0;  // of the view
    std::int32_t rise_q24 = 0;
    [[nodiscard]] int column() const { return id % kStripeColumns; }
};

// Ray rise output: the bands that the pixel's ray crosses (section 6).
struct PixelBandRay {
    static constexpr int kBits = ScannedPixel::kBits + 30 + 24;
    ScannedPixel pixel;
    std::int32_t foot_q12 = 0;   // band at the foot
    std::int32_t per_d_q20 = 0;  // up to 2^22 on either side
};

// Position at which the march along a ray continues.
struct MarchState {
    static constexpr int kBits = 9;
    static constexpr int kFoot = 256;      // at the foot: the last surface
    static constexpr int kBehind = 257;    // at the foot: the surface behind the last one
    static constexpr int kFarthest = 258;  // at the foot: the farthest of the cells
    int begin = 0;                         // depth, or one of the constants above
};

// Cell march output: a surface that the pixel's ray hits.
struct SurfaceHit {
    static constexpr int kBits = ScannedPixel::kBits + 11 + 1 + MarchState::kBits + 5;
    ScannedPixel pixel;
    int depth_q3 = 0;
    bool final = false;  // no other surface is tried if this one is transparent
    MarchState next;
    int lean = kBothShow;
};

// A finished pixel: empty (rgba 0) or with its colour.
struct FinishedPixel {
    static constexpr int kBitsOfEmpty = 9;
    static constexpr int kBits = 9 + 32;
    int id = 0;
    std::uint32_t rgba = 0;
};

struct ReturnedPixel {
    static constexpr int kBits = 9 + MarchState::kBits;
    int id = 0;
    MarchState state;
};

// Part of a sample that passes the texel blocks unchanged: its image, and the continuation after its surface is
// complete.
struct SampleHead {
    static constexpr int kBits = 9 + 1 + 1 + 9 + 1 + 1 + MarchState::kBits;
    int id = 0;
    bool is_there = false;  // false: a token that only ends its surface
    bool second = false;    // sample of the second image
    int weight = 0;         // blend weight of the second image
    bool last = false;      // last sample of its surface
    bool final = false;
    MarchState next;
};

// Sample place output: the four texels of a sample (section 7).
struct PlacedSample {
    static constexpr int kBits = SampleHead::kBits + 4 + 1 + 7 + 2 * 9 + 2 * 3 + 2;
    SampleHead head;
    int view = 0;
    bool inside = false;
    int image = 0;
    int left = 0, top = 0;
    int fx = 0, fy = 0;                                 // eighths
    bool right_is_left = false, bottom_is_top = false;  // at the image border
};

// Samples that can be between texel_tags and texel_cache: the depth of the FIFO `waiting`. They are numbered modulo
// twice as many.
inline constexpr int kWaitingSamples = 512;
inline constexpr std::uint32_t kSampleNumbers = 2 * kWaitingSamples;

// Request for a block of 8x8 texels, to be written into a line of the cache.
struct TexelFill {
    static constexpr int kBits = 4 + 7 + 6 + 6 + 7 + 10;
    int view = 0;
    int image = 0;
    int block_column = 0;
    int block_row = 0;
    int line = 0;
    std::uint32_t guard = 0;  // number of the last sample that must be read before the line is written
};

struct FillTarget {
    static constexpr int kBits = 7 + 10;
    int line = 0;
    std::uint32_t guard = 0;
};

struct FillKind {
    static constexpr int kBits = 1;
    bool coded = false;
};

// A sample with the cache lines of its texels; texel n: (left, top), (left, bottom), (right, top), (right, bottom).
struct WaitingSample {
    static constexpr int kBits = SampleHead::kBits + 1 + 2 * 3 + 4 * (7 + 6) + 3;
    SampleHead head;
    bool inside = false;
    int fx = 0, fy = 0;
    std::array<int, 4> line{};
    std::array<int, 4> texel{};  // 8 * column + row in the block
    int fills = 0;               // blocks that were requested for this sample
};

struct TexelQuad {
    static constexpr int kBits = SampleHead::kBits + 1 + 2 * 3 + 4 * 32;
    SampleHead head;
    bool inside = false;
    int fx = 0, fy = 0;
    std::array<std::uint32_t, 4> rgba{};  // 0 without a weight
};

struct FilteredSample {
    static constexpr int kBits = SampleHead::kBits + 1 + 14 + 3 * 22;
    SampleHead head;
    bool inside = false;
    std::int32_t a = 0, r = 0, g = 0, b = 0;
};

inline std::string id_text(int id) {
    return "pixel " + std::to_string(id);
}
inline std::string text(const BracketedRay& m) {
    return "view " + std::to_string(m.view) + " kind " + std::to_string(static_cast<int>(m.kind)) + " images " +
           std::to_string(m.first) + "," + std::to_string(m.second);
}
inline std::string text(const RayWithLines& m) {
    return text(m.ray);
}
inline std::string text(const ColumnSetup& m) {
    return "view " + std::to_string(m.view) + " stripe " + std::to_string(m.stripe) + " column " +
           std::to_string(m.column);
}
inline std::string text(const PatchJob& m) {
    return "view " + std::to_string(m.view) + " slot " + std::to_string(m.slot) + " at " +
           std::to_string(m.first_column) + "," + std::to_string(m.first_row);
}
inline std::string text(const ScannedPixel& m) {
    return id_text(m.id);
}
inline std::string text(const PixelBandRay& m) {
    return id_text(m.pixel.id);
}
inline std::string text(const SurfaceHit& m) {
    return id_text(m.pixel.id) + (m.final ? " final" : "");
}
inline std::string text(const FinishedPixel& m) {
    return id_text(m.id);
}
inline std::string text(const ReturnedPixel& m) {
    return id_text(m.id) + " from " + std::to_string(m.state.begin);
}
inline std::string text(const PlacedSample& m) {
    return id_text(m.head.id) + (m.inside ? " image " + std::to_string(m.image) : " outside");
}
inline std::string text(const TexelFill& m) {
    return "image " + std::to_string(m.image) + " block " + std::to_string(m.block_column) + "," +
           std::to_string(m.block_row) + " line " + std::to_string(m.line);
}
inline std::string text(const FillTarget& m) {
    return "line " + std::to_string(m.line) + " behind sample " + std::to_string(m.guard);
}
inline std::string text(const FillKind& m) {
    return m.coded ? "coded" : "raw";
}
inline std::string text(const WaitingSample& m) {
    return id_text(m.head.id) + " fills " + std::to_string(m.fills);
}
inline std::string text(const TexelQuad& m) {
    return id_text(m.head.id);
}
inline std::string text(const FilteredSample& m) {
    return id_text(m.head.id) + " a " + std::to_string(m.a);
}

}  // namespace rs::engine::model
