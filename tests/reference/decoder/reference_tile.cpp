#include "tests/reference/decoder/reference_tile.hpp"

#include "tests/reference/decoder/reference_contexts.hpp"
#include "tests/reference/decoder/reference_edges.hpp"

#include <algorithm>

namespace rs::reference {
namespace {

int median(int a, int b, int c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

}  // namespace

// Samples, tiles, blocks
TileDecoder::TileDecoder(const Code& code, const Pict& pict, std::array<const DecodedImage*, 2> references, int t,
                         Bytes bytes, DecodedImage& image)
    : code_(code),
      pict_(pict),
      references_(references),
      image_(image),
      bits_(bytes, code.probability, code.is_adaptive) {
    const int columns = ceil_div(image.width, code.tile_width);
    tile_x_ = code.tile_width * (t % columns);
    tile_y_ = code.tile_height * (t / columns);
    width_ = std::min(code.tile_width, image.width - tile_x_);
    height_ = std::min(code.tile_height, image.height - tile_y_);
    full_ = (1 << code.alpha_bits) - 1;
    blocks_.resize(static_cast<std::size_t>(width_ / 8 * (height_ / 8)));
    levels_.resize(static_cast<std::size_t>(width_ * height_));
    depths_.resize(levels_.size());
}

void TileDecoder::decode() {
    for (int y = 0; y < height_; y += 16) {
        for (int x = 0; x < width_; x += 16) decode_macroblock(x, y);
    }
    if (code_.alpha_coding != 0) make_alpha();
    if (!code_.has_smooth_edges) return;
    for (int plane = 0; plane < 3; ++plane) {
        smooth_edges(plane, true);
        smooth_edges(plane, false);
    }
}

TileDecoder::Block& TileDecoder::block_at(int x, int y) {
    return blocks_.at(static_cast<std::size_t>(y / 8 * (width_ / 8) + x / 8));
}

const TileDecoder::Block* TileDecoder::block_in_tile(int x, int y) {
    return x < 0 || y < 0 ? nullptr : &block_at(x, y);
}

// Macroblocks
TileDecoder::AlphaClass TileDecoder::read_class(int first_context, int x, int y) {
    const Block* left = block_in_tile(x - 8, y);
    const Block* upper = block_in_tile(x, y - 8);
    const int l = left != nullptr ? static_cast<int>(left->alpha) : 0;
    const int a = upper != nullptr ? static_cast<int>(upper->alpha) : 0;
    const int context = first_context + (l * 4 + a) * 2;
    if (bits_.bit(context) == 0) return AlphaClass::kEmpty;
    return bits_.bit(context + 1) == 1 ? AlphaClass::kMixed : AlphaClass::kOpaque;
}

void TileDecoder::decode_macroblock(int x, int y) {
    const AlphaClass whole = read_class(kMacroblockAlpha, x, y);
    for (int b = 0; b < 4; ++b) {
        const int bx = x + 8 * (b % 2);
        const int by = y + 8 * (b / 2);
        block_at(bx, by).alpha = whole == AlphaClass::kMixed ? read_class(kBlockAlpha, bx, by) : whole;
    }
    if (whole == AlphaClass::kEmpty) return;

    int n = 0;
    for (const Block* block : {block_in_tile(x - 8, y), block_in_tile(x, y - 8)}) {
        n += block != nullptr && block->is_in_split ? 1 : 0;
    }
    if (bits_.bit(kSplit + n) == 0) return decode_part(x, y, 16);
    for (int b = 0; b < 4; ++b) block_at(x + 8 * (b % 2), y + 8 * (b / 2)).is_in_split = true;
    for (int b = 0; b < 4; ++b) {
        const int bx = x + 8 * (b % 2);
        const int by = y + 8 * (b / 2);
        if (block_at(bx, by).alpha != AlphaClass::kEmpty) decode_part(bx, by, 8);
    }
}

// Parts
bool TileDecoder::uses(Source source, int reference) {
    return source == Source::kBoth || source == (reference == 0 ? Source::kFirst : Source::kSecond);
}

template <class Predicate>
int TileDecoder::count_neighbours(const Part& part, Predicate predicate) {
    return (part.left != nullptr && predicate(*part.left) ? 1 : 0) +
           (part.upper != nullptr && predicate(*part.upper) ? 1 : 0);
}

void TileDecoder::decode_part(int x, int y, int n) {
    Part part = {x, y, n, block_in_tile(x - 8, y), block_in_tile(x, y - 8), Source::kIntra, 0, {}, false, false};
    const int size = n == 16 ? 1 : 0;
    read_source(part);
    if (part.source == Source::kIntra) part.mode = bits_.tree(kIntraMode + 7 * size, 3);
    for (int r = 0; r < 2; ++r) {
        if (uses(part.source, r)) part.vector[static_cast<std::size_t>(r)] = read_vector(part, r);
    }
    for (int by = y; by < y + n; by += 8) {
        for (int bx = x; bx < x + n; bx += 8) {
            if (code_.alpha_coding != 0) {
                read_mask(part, bx, by);
            } else {
                read_alpha(part, bx, by);
            }
        }
    }
    const int i = part.source == Source::kIntra ? 0 : 1;
    const int coded = count_neighbours(part, [](const Block& block) { return block.is_coded; });
    part.is_coded = bits_.bit(kCoded + (size * 2 + i) * 3 + coded) == 1;

    predict(part);
    if (part.is_coded) read_transforms(part);
    for (int by = y; by < y + n; by += 8) {
        for (int bx = x; bx < x + n; bx += 8) {
            Block& block = block_at(bx, by);
            block.source = part.source;
            block.vector = part.vector;
            block.is_coded = part.is_coded;
            block.has_small_transforms = part.has_small_transforms;
        }
    }
}

void TileDecoder::read_source(Part& part) {
    if (references_[0] == nullptr) return;
    const int first = 3 * (part.n == 16 ? 1 : 0);
    const int inter =
        count_neighbours(part, [](const Block& b) { return b.source != Source::kNone && b.source != Source::kIntra; });
    if (bits_.bit(kInter + first + inter) == 0) return;
    part.source = Source::kFirst;
    if (references_[1] == nullptr) return;
    const int both = count_neighbours(part, [](const Block& b) { return b.source == Source::kBoth; });
    if (bits_.bit(kBoth + first + both) == 1) {
        part.source = Source::kBoth;
        return;
    }
    const int second = count_neighbours(part, [](const Block& b) { return b.source == Source::kSecond; });
    if (bits_.bit(kSecond + first + second) == 1) part.source = Source::kSecond;
}

Vector TileDecoder::read_vector(const Part& part, int reference) {
    const std::size_t r = static_cast<std::size_t>(reference);
    const Vector usual = pict_.usual[r];
    const bool left = part.left != nullptr && uses(part.left->source, reference);
    const bool upper = part.upper != nullptr && uses(part.upper->source, reference);
    Vector vector = usual;
    if (left && upper) {
        const Vector l = part.left->vector[r];
        const Vector u = part.upper->vector[r];
        vector = {median(l.x, u.x, usual.x), median(l.y, u.y, usual.y)};
    } else if (left || upper) {
        vector = left ? part.left->vector[r] : part.upper->vector[r];
    }
    if (bits_.bit(kMotionZero + (part.n == 16 ? 1 : 0)) == 0) return vector;

    const int dx = bits_.bit(kComponentZero) == 1 ? read_difference(0) : 0;
    const int dy = dx == 0 || bits_.bit(kComponentZero + 1) == 1 ? read_difference(1) : 0;
    return {std::clamp(vector.x + dx, -1023, 1023), std::clamp(vector.y + dy, -1023, 1023)};
}

int TileDecoder::read_difference(int component) {
    const bool is_negative = bits_.bit(kComponentSign + component) == 1;
    const int magnitude = 1 + bits_.number(kComponentClass + 10 * component, 10, kComponentTop + 10 * component - 1);
    return is_negative ? -magnitude : magnitude;
}

// Reconstruction: "The step index of Y is the image's; of U and V that plus the offset in CODE, clamped to 0 .. 63."
int TileDecoder::step_index(int plane) const {
    const int offset = plane == 0 ? 0 : plane == 1 ? code_.u_offset : code_.v_offset;
    return std::clamp(pict_.step + offset, 0, 63);
}

void TileDecoder::read_transforms(Part& part) {
    const int i = part.source == Source::kIntra ? 0 : 1;
    part.has_small_transforms = part.n == 8 || bits_.bit(kSmallTransforms + i) == 1;
    const int n = part.has_small_transforms ? 8 : 16;
    const int s = n == 16 ? 1 : 0;
    int before = 0;  // b
    for (int plane = 0; plane < 3; ++plane) {
        for (int y = part.y; y < part.y + part.n; y += n) {
            for (int x = part.x; x < part.x + part.n; x += n) {
                if (bits_.bit(kPlaneCoded + ((plane * 2 + s) * 2 + i) * 2 + before) == 0) continue;
                before = 1;
                const Square levels = read_coefficients(n, 4 * (plane > 0 ? 1 : 0) + 2 * s + i);
                add(residual(levels, step_index(plane)), plane, x, y);
            }
        }
    }
}

// Prediction
void TileDecoder::predict(const Part& part) {
    const int x = tile_x_ + part.x;
    const int y = tile_y_ + part.y;
    const auto has_source = [](const Block* block) { return block != nullptr && block->source != Source::kNone; };
    for (int plane = 0; plane < 3; ++plane) {
        Square predicted(part.n);
        if (part.source == Source::kIntra) {
            predicted = predict_from_neighbours(image_, plane, x, y, part.n, part.mode, has_source(part.left),
                                                has_source(part.upper));
        } else if (part.source == Source::kBoth) {
            const Square a = predict_from_reference(*references_[0], plane, x, y, part.n, part.vector[0]);
            const Square b = predict_from_reference(*references_[1], plane, x, y, part.n, part.vector[1]);
            for (std::size_t i = 0; i < a.values.size(); ++i) {
                predicted.values[i] = (a.values[i] + b.values[i] + 1) >> 1;
            }
        } else {
            const std::size_t r = part.source == Source::kFirst ? 0 : 1;
            predicted = predict_from_reference(*references_[r], plane, x, y, part.n, part.vector[r]);
        }
        for (int py = 0; py < part.n; ++py) {
            for (int px = 0; px < part.n; ++px) {
                sample(image_, plane, x + px, y + py) = static_cast<std::uint8_t>(predicted.at(px, py));
            }
        }
    }
}

// Reconstruction: "R is added to the prediction and clamped to 0 .. 255."
void TileDecoder::add(const Square& r, int plane, int x, int y) {
    for (int py = 0; py < r.n; ++py) {
        for (int px = 0; px < r.n; ++px) {
            std::uint8_t& s = sample(image_, plane, tile_x_ + x + px, tile_y_ + y + py);
            s = static_cast<std::uint8_t>(std::clamp(s + r.at(px, py), 0, 255));
        }
    }
}

// Edges of blocks: "at x = 8, 16, .. of the tile", or "at y".
void TileDecoder::smooth_edges(int plane, bool is_upright) {
    const int q = quantiser_step(step_index(plane));
    for (int y = is_upright ? 0 : 8; y < height_; y += 8) {
        for (int x = is_upright ? 8 : 0; x < width_; x += 8) {
            const Block& a = is_upright ? block_at(x - 8, y) : block_at(x, y - 8);
            const bool is_in_macroblock = (is_upright ? x : y) % 16 == 8;
            if (!is_smoothed(a, block_at(x, y), is_in_macroblock)) continue;
            smooth_edge(image_, {plane, tile_x_ + x, tile_y_ + y, is_upright, q});
        }
    }
}

bool TileDecoder::is_smoothed(const Block& a, const Block& b, bool is_in_macroblock) {
    // "inside of a part of 16x16: if the part is coded in transforms of 8x8"
    if (is_in_macroblock && !a.is_in_split) return a.has_small_transforms;
    // "between two parts: if both blocks have a source ..., and at least one of them is coded, or ..."
    if (a.source == Source::kNone || b.source == Source::kNone) return false;
    if (a.is_coded || b.is_coded || a.source != b.source || a.source == Source::kIntra) return true;
    for (std::size_t r = 0; r < 2; ++r) {
        const bool differs = a.vector[r].x != b.vector[r].x || a.vector[r].y != b.vector[r].y;
        if (uses(a.source, static_cast<int>(r)) && differs) return true;
    }
    return false;
}

}  // namespace rs::reference
