#pragma once
// Messages in the FIFOs between the blocks; kBits is the number of bits that the hardware stores. A message carries the
// number of its view; values that are constant over a view are read from the register file.

#include "engine/model/signals/sdram.hpp"

#include <cstdint>
#include <string>

namespace rs::engine::model {

struct ViewJob {
    static constexpr int kBits = 4;
    int view = 0;
};

// Raster generator output: the ray of a view column (section 2: k, n, T).
struct ColumnRay {
    static constexpr int kBits = 4 + 1 + 4 + 31 + 32;
    int view = 0;
    bool has_ray = false;
    int plane = 0;
    std::int64_t n_q28 = 0;
    std::int64_t t_q28 = 0;
};

// Ray position output: intersection of the ray with the plane, and the ray's cell of the RS map (byte address).
struct RayPoint {
    static constexpr int kBits = 4 + 1 + 4 + 23 + 29 + 30;
    static constexpr int kBitsWithDirection = kBits + 30 + 31 + 32;
    int view = 0;
    bool has_ray = false;
    int plane = 0;
    std::int64_t x_q20 = 0;
    std::int64_t lambda_q20 = 0;
    std::uint64_t cell_byte = 0;
    // On boards with shape maps: slope u and direction (section 5).
    std::int64_t u_q28 = 0, n_q28 = 0, t_q28 = 0;
};

struct MappedRay {
    static constexpr int kBits = 4 + 1 + 4 + 23 + 29 + 7;
    static constexpr int kBitsWithDirection = kBits + 30 + 31 + 32;
    int view = 0;
    bool has_ray = false;
    int plane = 0;
    std::int64_t x_q20 = 0;
    std::int64_t lambda_q20 = 0;
    int image = 0;
    std::int64_t u_q28 = 0, n_q28 = 0, t_q28 = 0;
};

// Line reader output: the image's camera and its line of the plane.
struct RayLine {
    static constexpr int kBits = 4 + 1 + 23 + 29 + 7 + 8 * 32;
    int view = 0;
    bool has_ray = false;
    std::int64_t x_q20 = 0;
    std::int64_t lambda_q20 = 0;
    int image = 0;
    std::int32_t cx_q16 = 0, cy_q16 = 0, fl_y_q16 = 0, height_q20 = 0;
    std::int32_t l0_q20 = 0, l1_q30 = 0, q0_q16 = 0, q1_q16 = 0;
};

// Vertical compensation output: column of the image, first row and row step (section 3).
struct ColumnWalk {
    static constexpr int kBits = 4 + 1 + 7 + 9 + 46 + 36;
    int view = 0;
    bool has_ray = false;
    int image = 0;
    int column = 0;
    std::int64_t row_0_q16 = 0;
    std::int64_t row_step_q16 = 0;
};

// Column address output: first words of the column's Y, (U, V) and alpha.
struct PlacedColumn {
    static constexpr int kBits = 4 + 1 + 46 + 36 + 3 * 27;
    int view = 0;
    bool has_ray = false;
    std::int64_t row_0_q16 = 0;
    std::int64_t row_step_q16 = 0;
    WordAddress luma = 0, chroma = 0, alpha = 0;
};

// Two pixels of a view column, one below the other: one word of the image buffer.
struct PixelPair {
    static constexpr int kBits = 4 + 2 * (1 + 9) + 3 * 27;
    int view = 0;
    bool shows[2] = {false, false};
    int row[2] = {0, 0};
    WordAddress luma = 0, chroma = 0, alpha = 0;
};

struct MemoryRead {
    static constexpr int kBits = 27 + 1;
    WordAddress address = 0;
    bool null = false;  // occupies a slot of the port, transfers no data, returns 0
};

struct MemoryWord {
    static constexpr int kBits = 64;
    std::uint64_t data = 0;
};

struct MemoryWrite {
    static constexpr int kBits = 27 + 64 + 1;
    WordAddress address = 0;
    std::uint64_t data = 0;
    bool last = false;  // last word of a view or of an object
};

// Purpose of a fetched word.
struct SampleTag {
    enum class Kind { alpha, chroma, luma };
    static constexpr int kBits = 4 + 2 + 1 + 2 * 6;
    int view = 0;
    Kind kind = Kind::alpha;
    int pixel = 0;                       // of the pair; used for chroma and luma
    int lane[2] = {0, 0};                // byte, byte pair or bit pair of the word, per pixel
    bool has_alpha[2] = {false, false};  // alpha: the pixels whose alpha is in the word
};

struct YuvaPixel {
    // Uncompressed images have 2 bits of alpha. Where alpha is 0, 85, 170 or 255, the 8 bits are these 2 bits repeated
    // four times.
    static constexpr int kBits = 4 + 3 * 8 + 2;
    static constexpr int kBitsOfCoded = 4 + 3 * 8 + 8;
    int view = 0;
    int y = 0, u = 0, v = 0;
    int alpha = 0;  // 0..255
};

struct RgbaPixel {
    static constexpr int kBits = 4 + 32;
    int view = 0;
    std::uint32_t rgba = 0;  // R in the low byte
};

// Completion event: last word of a view, a buffer, or a load.
struct Done {
    static constexpr int kBits = 1;
    int number = 0;
};

// To the bus: header of an image, or one of its words.
struct ImageWord {
    static constexpr int kBits = 64 + 1 + 1;
    std::uint64_t data = 0;  // head: number of words | view << 32
    bool head = false;
    bool last_view = false;  // head: no image follows in this cycle
};

struct StartCommand {
    static constexpr int kBits = 1;
    std::uint64_t program = 0;  // index of the host program; the bus has already transferred its registers
};

inline std::string text(const ViewJob& m) {
    return "view " + std::to_string(m.view);
}
inline std::string text(const ColumnRay& m) {
    return "view " + std::to_string(m.view) + (m.has_ray ? " plane " + std::to_string(m.plane) : " no ray");
}
inline std::string text(const RayPoint& m) {
    return "view " + std::to_string(m.view) + (m.has_ray ? " cell byte " + std::to_string(m.cell_byte) : " no ray");
}
inline std::string text(const MappedRay& m) {
    return "view " + std::to_string(m.view) + (m.has_ray ? " image " + std::to_string(m.image) : " no ray");
}
inline std::string text(const RayLine& m) {
    return "view " + std::to_string(m.view) + (m.has_ray ? " image " + std::to_string(m.image) : " no ray");
}
inline std::string text(const ColumnWalk& m) {
    return "view " + std::to_string(m.view) +
           (m.has_ray ? " image " + std::to_string(m.image) + " column " + std::to_string(m.column) : " no ray");
}
inline std::string text(const PlacedColumn& m) {
    return "view " + std::to_string(m.view) + (m.has_ray ? " luma at " + std::to_string(m.luma) : " no ray");
}
inline std::string text(const PixelPair& m) {
    return "view " + std::to_string(m.view) + " rows " + (m.shows[0] ? std::to_string(m.row[0]) : "-") + "," +
           (m.shows[1] ? std::to_string(m.row[1]) : "-");
}
inline std::string text(const MemoryRead& m) {
    return m.null ? "null" : "word " + std::to_string(m.address);
}
inline std::string text(const MemoryWord& m) {
    return std::to_string(m.data);
}
inline std::string text(const MemoryWrite& m) {
    return "word " + std::to_string(m.address) + (m.last ? " last" : "");
}
inline std::string text(const SampleTag& m) {
    constexpr const char* kKinds[] = {"alpha", "chroma", "luma"};
    return std::string(kKinds[static_cast<int>(m.kind)]) + " " + std::to_string(m.pixel);
}
inline std::string text(const YuvaPixel& m) {
    return "view " + std::to_string(m.view) + " y " + std::to_string(m.y);
}
inline std::string text(const RgbaPixel& m) {
    return "view " + std::to_string(m.view) + " " + std::to_string(m.rgba);
}
inline std::string text(const Done& m) {
    return std::to_string(m.number);
}
inline std::string text(const ImageWord& m) {
    return m.head ? "head" : std::to_string(m.data);
}
inline std::string text(const StartCommand& m) {
    return "program " + std::to_string(m.program);
}

// Packs two 32-bit numbers into one word of the board's memory.
inline std::uint64_t word_pair(std::int32_t low, std::int32_t high) {
    return std::uint64_t{static_cast<std::uint32_t>(low)} | std::uint64_t{static_cast<std::uint32_t>(high)} << 32U;
}

}  // namespace rs::engine::model
