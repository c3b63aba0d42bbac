#pragma once
// FORMAT.md, "CODE" of board images, after the levels: record classes and codebooks.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

/// A record class; flat if it is not predicted.
struct BoardClass {
    bool is_predicted = false;
    bool has_alpha = false;
    int block_stages = 0;
    int quarter_stages = 0;
};

/// Entry e of a codebook begins at e * (bytes of an entry): 96 of a block stage, 48 of a quarter stage, 16 of alpha.
using Codebook = std::vector<std::uint8_t>;

struct BoardCode {
    std::array<std::array<BoardClass, 8>, 2> classes;  // [0: without references, 1: with][class 1 .. 7]
    // [0: flat records, 1: predicted records][stage]
    std::array<std::vector<Codebook>, 2> block_books;
    std::array<std::vector<Codebook>, 2> quarter_books;
    Codebook alpha_book;  // empty if no class has alpha
};

/// Reads `payload` from the field `record` on. Returns the violated rule; "" if there is none.
[[nodiscard]] std::string read_board_code(std::span<const std::uint8_t> payload, BoardCode& code);

}  // namespace rs::reference
