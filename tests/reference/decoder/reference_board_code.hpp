#pragma once
// FORMAT.md, "CODE", what follows the levels of board images: the classes of their records and the codebooks.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

// A class of records. One that is not predicted is flat.
struct BoardClass {
    bool is_predicted = false;
    bool has_alpha = false;
    int block_stages = 0;
    int quarter_stages = 0;
};

// Entry e of a codebook begins at e * (bytes of an entry): 96 of a block stage, 48 of a quarter stage, 16 of alpha.
using Codebook = std::vector<std::uint8_t>;

struct BoardCode {
    std::array<std::array<BoardClass, 8>, 2> classes;  // [0: without references, 1: with][class 1 .. 7]
    // [0: of flat records, 1: of predicted ones][stage]
    std::array<std::vector<Codebook>, 2> block_books;
    std::array<std::vector<Codebook>, 2> quarter_books;
    Codebook alpha_book;  // empty where no class has alpha
};

// `payload` from the field `record` on. Returns the rule that it breaks; "" where it breaks none.
[[nodiscard]] std::string read_board_code(std::span<const std::uint8_t> payload, BoardCode& code);

}  // namespace rs::reference
