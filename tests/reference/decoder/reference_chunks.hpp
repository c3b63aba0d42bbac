#pragma once
// FORMAT.md, "CODE" and "PICT, Coding 1": the fields of the two chunks and everything that must be rejected.

#include "tests/reference/decoder/reference_board_code.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

using Bytes = std::span<const std::uint8_t>;

inline constexpr std::array<int, 3> kContexts = {1447, 1649, 1649};  // [alpha_coding]
inline constexpr std::array<std::size_t, 3> kListedBytes = {181, 207, 207};
inline constexpr int kNoView = 65535;

enum class Profile { kDense = 1, kBoard = 2 };

struct Vector {
    int x = 0, y = 0;  // quarters of a sample
};

struct Code {
    Profile profile = Profile::kDense;
    int tile_width = 0;  // px
    int tile_height = 0;
    int alpha_bits = 0;
    int alpha_coding = 0;
    bool has_smooth_edges = false;      // features, bit 0
    bool is_adaptive = false;           // features, bit 1
    bool has_sign_data_hiding = false;  // features, bit 2
    std::array<int, 24> edge_alpha{};
    int u_offset = 0;
    int v_offset = 0;
    std::vector<int> level;                       // per view
    std::array<int, kContexts[1]> probability{};  // dense images: probability of a 0 in 256ths
    BoardCode board;                              // board images
};

struct Pict {
    int step = 0;
    std::array<int, 2> reference = {kNoView, kNoView};  // a, b
    std::array<Vector, 2> usual;
    std::vector<std::optional<Bytes>> tiles;  // nullopt: not present; points into the payload
};

inline int ceil_div(int a, int b) {
    return (a + b - 1) / b;
}

/// Both return the rule that the payload violates; "" if there is none.
[[nodiscard]] std::string read_code(Bytes payload, int views, Code& code);
[[nodiscard]] std::string read_pict(Bytes payload, int width, int height, int view, const Code& code, Pict& pict);

}  // namespace rs::reference
