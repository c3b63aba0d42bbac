#pragma once
// Register file of the board: its objects, and two banks of 15 views, one of which is rendered while the host fills the
// other. A memory (embedded RAM in the FPGA, copied where two blocks read at once), not a block: only the render
// controller writes it, and only while the blocks that read it are empty.

#include "engine/core/definition/effective_depth.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/model/limits/board_limits.hpp"
#include "engine/model/signals/sdram.hpp"
#include "rayspace/codec/code/board_code.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::engine::model {

inline constexpr int kMaxPlanes = 12;

// Number of codebooks of an object: [flat, predicted] records.
struct BookCounts {
    std::array<int, 2> block{};
    std::array<int, 2> quarter{};
    bool alpha = false;
};

// Shape map of an object (RECONSTRUCTION.md, section 1), on boards that support shape maps.
struct ShapeRegisters {
    bool exists = false;
    int p_cells = 0;  // 13 bits
    int bands = 0;    // 9 bits
    std::int32_t p_half_q20 = 0;
    std::int32_t p_cells_per_unit_q12 = 0;
    std::int32_t h_low_q20 = 0;
    std::int32_t bands_per_unit_q12 = 0;
    std::int32_t reference_distance_q20 = 0;
    std::int32_t reference_height_q20 = 0;
    std::int32_t depth_low_q20 = 0;
    std::int32_t depth_step_q24 = 0;
    std::array<std::int16_t, EffectiveDepth::kDepths> effective_depth_q3{};  // 13 bits; in a memory of cell_march
    int foot_d_q3 = 0;                                                       // 11 bits
    int jump = 0;                                                            // 8 bits
    int thickness = 0;                                                       // 8 bits
    std::int64_t lines = 0;                                                  // sum over all gaps; 27 bits
    WordAddress cells = 0;
};

// Memory addresses of an object and its parameters of RECONSTRUCTION.md, section 1. Widths: sizes 10 bits, addresses 27
// bits, fixed point as in RECONSTRUCTION.md.
struct ObjectRegisters {
    bool valid = false;  // completely loaded
    int width = 0;       // px, of every image
    int height = 0;
    int images = 0;
    int planes = 0;
    int x_cells = 0;
    int u_cells = 0;
    std::int32_t x_half_q20 = 0;
    std::int32_t x_cells_per_unit_q12 = 0;
    std::int32_t u_half_q28 = 0;
    std::int32_t u_cells_per_unit_q12 = 0;
    int luma_pitch = 0;  // words per image column
    int chroma_pitch = 0;
    int alpha_pitch = 0;
    WordAddress luma = 0;
    WordAddress chroma = 0;
    WordAddress alpha = 0;
    WordAddress map = 0;
    WordAddress lines = 0;

    // Images of profile `board` (coded_layout.hpp); these replace the registers of luma, chroma and alpha.
    int coded_width = 0;  // px; 10 bits
    int coded_height = 0;
    int tile_columns = 0;  // 5 bits
    int table_pitch = 0;   // entries per column of tiles; 5 bits
    WordAddress tile_table = 0;
    WordAddress books = 0;
    std::uint32_t book_words = 0;  // 15 bits
    BookCounts book_counts;
    std::array<std::array<codec::RecordClass, codec::kBoardClasses>, 2> classes{};  // a byte each
    // Parallel board only (parallel_layout.hpp).
    bool coded = false;          // the images have profile `board`
    WordAddress raw_blocks = 0;  // without `coded`
    int block_columns = 0;       // of a raw image, 7 bits
    int block_rows = 0;
    ShapeRegisters shape;

    std::uint32_t serial = 0;  // number of the load, from 1: distinguishes successive objects in one slot
};

struct PlaneView {
    std::int32_t a_q20 = 0;
    std::int32_t c_q20 = 0;
    std::int64_t n0_q32 = 0, nx_q32 = 0;
    std::int64_t t0_q32 = 0, tx_q32 = 0;
};

struct BoardView {
    int object = 0;
    int width = 0;
    int height = 0;
    std::int32_t b_q20 = 0;
    std::int64_t s0_q32 = 0;  // sx is 0: the view is upright
    std::int64_t sy_q32 = 0;
    std::array<PlaneView, kMaxPlanes> planes{};

    [[nodiscard]] int words_per_column() const { return (height + 1) / 2; }  // of the image buffer
    [[nodiscard]] int words() const { return width * words_per_column(); }
};

struct ViewBank {
    std::vector<BoardView> views;
};

struct RegisterFile {
    std::vector<ObjectRegisters> objects;  // [slot]
    std::vector<ObjectRegisters> loaded;   // written by the disk controller; the render controller copies it
    std::array<ViewBank, 2> banks{};
    int active = 0;  // index of the bank that is rendered and of the image buffer that is written
    std::array<std::vector<int>, 2> buffer_words{};    // [buffer][view]: valid until the host has the images
    std::array<std::vector<int>, 2> buffer_pitches{};  // words per column, likewise
    WordAddress images = 0;                            // address of the first image buffer
    WordAddress words_per_buffer = 0;                  // offset of the second buffer
    int words_per_view = 0;                            // of the image buffer
    int views_per_cycle = 15;

    [[nodiscard]] const BoardView& view(int number) const {
        return banks[static_cast<std::size_t>(active)].views[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] const ObjectRegisters& object_of(int view_number) const {
        return objects[static_cast<std::size_t>(view(view_number).object)];
    }
    [[nodiscard]] WordAddress image(int buffer, int view_number) const {
        return images + static_cast<WordAddress>(buffer) * words_per_buffer +
               static_cast<WordAddress>(view_number * words_per_view);
    }
};

// Registers of a view of object slot `object`. Fails for a tilted view; the message names the remedy.
Result<BoardView> board_view(const engine::ViewRegisters& registers, int object);

// Number of 32-bit registers that the host writes for the view.
int register_writes(const BoardView& view, int planes);

// The board's check of a view's registers before it accepts a cycle. Returns "" if valid, otherwise the error: a size
// outside of the image buffer, a missing or empty object slot, or a number that exceeds its bit width.
std::string register_error(const BoardView& view, const RegisterFile& file, const BoardLimits& limits);

}  // namespace rs::engine::model
