#pragma once
// FORMAT.md, "Macroblocks", "Parts", "Coefficients" and "Alpha": reads the bits of a tile; "Edges of blocks": selects
// the edges to be filtered.

#include "tests/reference/decoder/reference_bits.hpp"
#include "tests/reference/decoder/reference_chunks.hpp"
#include "tests/reference/decoder/reference_decoder.hpp"
#include "tests/reference/decoder/reference_samples.hpp"

#include <array>
#include <vector>

namespace rs::reference {

class TileDecoder {
public:
    /// `references` is null for missing references. Undecoded parts of `image` contain the samples of empty blocks.
    /// `bytes` are those of tile t.
    TileDecoder(const Code& code, const Pict& pict, std::array<const DecodedImage*, 2> references, int t, Bytes bytes,
                DecodedImage& image);

    void decode();

private:
    enum class AlphaClass { kOutside = 0, kEmpty = 1, kOpaque = 2, kMixed = 3 };
    enum class Source { kNone, kIntra, kFirst, kSecond, kBoth };

    struct Block {
        AlphaClass alpha = AlphaClass::kOutside;
        bool is_in_split = false;
        Source source = Source::kNone;
        std::array<Vector, 2> vector;
        bool is_coded = false;
        bool has_small_transforms = false;
    };

    // Positions are in samples from the tile's upper left corner.
    struct Part {
        int x, y, n;
        const Block* left;  // null: not in the tile
        const Block* upper;
        Source source;
        int mode;
        std::array<Vector, 2> vector;
        bool is_coded;
        bool has_small_transforms;  // also true for coded parts of 8x8
    };

    // A non-zero level whose sign is not yet known.
    struct SignlessLevel {
        int place;
        int* level;  // points to the magnitude
    };

    static bool uses(Source source, int reference);
    template <class Predicate>
    static int count_neighbours(const Part& part, Predicate predicate);

    Block& block_at(int x, int y);
    const Block* block_in_tile(int x, int y);  // null outside
    int level_in_tile(int x, int y) const;     // alpha level; 0 outside
    int kind(int level) const;

    AlphaClass read_class(int first_context, int x, int y);
    void decode_macroblock(int x, int y);
    void decode_part(int x, int y, int n);
    void read_source(Part& part);
    Vector read_vector(const Part& part, int reference);
    int read_difference(int component);
    void read_alpha(const Part& part, int x, int y);
    int read_mixed_level(const Part& part, int block_x, int x, int y);
    void read_mask(const Part& part, int x, int y);
    int mask_from(Source source, const std::array<Vector, 2>& vector, int x, int y) const;
    int shown_alpha(Source source, const std::array<Vector, 2>& vector, int x, int y) const;
    int mask_sum(int x, int y) const;
    void make_alpha();
    void make_smooth_alpha(int x, int y);
    void read_depths(int x, int y);
    int read_difference(int x, int y, int p, int sum);
    int step_index(int plane) const;
    void read_transforms(Part& part);
    Square read_coefficients(int n, int kind);
    int read_magnitude(int kind, int e, int near);
    void read_sign_data_hiding(const std::vector<SignlessLevel>& group);
    void predict(const Part& part);
    void add(const Square& r, int plane, int x, int y);
    void smooth_edges(int plane, bool is_upright);
    static bool is_smoothed(const Block& a, const Block& b, bool is_in_macroblock);

    const Code& code_;
    const Pict& pict_;
    std::array<const DecodedImage*, 2> references_;
    DecodedImage& image_;
    Bits bits_;
    int tile_x_ = 0, tile_y_ = 0, width_ = 0, height_ = 0;
    int full_ = 0;
    std::vector<Block> blocks_;
    std::vector<int> levels_;  // alpha levels if alpha_coding is 0, else masks
    std::vector<int> depths_;
};

}  // namespace rs::reference
