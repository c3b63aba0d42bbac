#include "rayspace/codec/stream/coded_chunks.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/codec/board/board_profile.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace rs::codec {
namespace {

constexpr std::uint16_t kEven = 2048;  // probability of contexts that are not listed
constexpr int kProbabilityUnit = 16;   // unit of listed probabilities

// Writes bits, the lowest of each byte first.
void put_bits(ByteWriter& out, const std::vector<bool>& bits) {
    for (std::size_t begin = 0; begin < bits.size(); begin += 8) {
        unsigned byte = 0;
        for (std::size_t i = begin; i < std::min(begin + 8, bits.size()); ++i)
            byte |= (bits[i] ? 1U : 0U) << (i - begin);
        out.put(static_cast<std::uint8_t>(byte));
    }
}

// Reads bits. Returns false if there are too few bytes, or padding bits that are not zero.
bool take_bits(ByteReader& in, std::vector<bool>& bits) {
    const auto bytes = in.take((bits.size() + 7) / 8);
    if (!in.ok()) return false;
    for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
        const bool bit = ((static_cast<unsigned>(bytes[i / 8]) >> (i % 8)) & 1U) != 0;
        if (i < bits.size()) {
            bits[i] = bit;
        } else if (bit) {
            return false;
        }
    }
    return true;
}

void put_size(ByteWriter& out, std::uint32_t size) {
    while (size >= 128) {
        out.put(static_cast<std::uint8_t>(128 + (size & 127U)));
        size >>= 7U;
    }
    out.put(static_cast<std::uint8_t>(size));
}

// Reads a size; a value above kMaxTile_bytes if it is invalid or not in its shortest form.
std::uint32_t take_size(ByteReader& in) {
    constexpr std::uint32_t kWrong = kMaxTile_bytes + 1;
    std::uint32_t size = 0;
    for (int i = 0; i < 3; ++i) {
        const auto byte = in.get<std::uint8_t>();
        size |= static_cast<std::uint32_t>(byte & 127U) << (7 * i);
        if (byte < 128) return i > 0 && byte == 0 ? kWrong : std::min(size, kWrong);
    }
    return kWrong;
}

Status check_references(const CodedImages& coded, std::size_t view, const ImageHead& head) {
    if (head.reference[0] == kNoReference && head.reference[1] != kNoReference) {
        return Error{"has a second reference without a first"};
    }
    if (head.references() == 2 && head.reference[0] == head.reference[1]) {
        return Error{"names the same reference twice"};
    }
    for (std::size_t r = 0; r < static_cast<std::size_t>(head.references()); ++r) {
        const std::size_t reference = head.reference[r];
        if (reference >= coded.images.size()) {
            return out_of_range("a reference", static_cast<long long>(reference), 0,
                                static_cast<long long>(coded.images.size()) - 1);
        }
        if (coded.levels[reference] >= coded.levels[view]) {
            return Error{"is predicted from image " + std::to_string(reference) + ", whose level is not lower"};
        }
    }
    return {};
}

// Features of a dense object: bits of the byte `features`.
constexpr unsigned kDeblocking = 1;
constexpr unsigned kAdaptation = 2;
constexpr unsigned kSignDataHiding = 4;
constexpr int kAllFeatures = 7;

std::uint8_t features_of(const DenseCode& dense) {
    return static_cast<std::uint8_t>((dense.deblocking ? kDeblocking : 0U) | (dense.adaptation ? kAdaptation : 0U) |
                                     (dense.sign_data_hiding ? kSignDataHiding : 0U));
}

// Reads the dense part of chunk CODE, to its end.
Status take_dense_code(ByteReader& in, DenseCode& dense) {
    if (dense.has_edge_alpha()) {
        for (std::uint8_t& off : dense.edge_alpha) off = in.get<std::uint8_t>();
        const int largest = *std::max_element(dense.edge_alpha.begin(), dense.edge_alpha.end());
        if (!in.ok()) return Error{"ends within its alpha of edges"};
        if (largest > kMaxEdgeAlpha) return out_of_range("an alpha of edges", largest, 0, kMaxEdgeAlpha);
    }
    std::vector<bool> listed(static_cast<std::size_t>(dense.contexts()));
    if (!take_bits(in, listed)) return Error{"ends within its list of contexts, or lists some that do not exist"};
    for (std::size_t c = 0; c < listed.size(); ++c) {
        const int listed_as = listed[c] ? in.get<std::uint8_t>() : kEven / kProbabilityUnit;
        if (listed_as == 0)
            return Error{"gives context " + std::to_string(c) + " a probability of zero, or is too short"};
        dense.probabilities[c] = static_cast<std::uint16_t>(kProbabilityUnit * listed_as);
    }
    if (!in.at_end()) return Error{"goes on behind its last probability"};
    return {};
}

}  // namespace

std::vector<std::byte> code_payload(const CodedImages& coded) {
    ByteWriter out;
    out.put(static_cast<std::uint8_t>(coded.profile));
    out.put(static_cast<std::uint8_t>(coded.tile_width_log2));
    out.put(static_cast<std::uint8_t>(coded.tile_height_log2));
    const bool board = coded.profile == Profile::kBoard;
    out.put(static_cast<std::uint8_t>(board ? 0 : coded.dense.alpha_bits));
    for (const int offset : coded.dense.chroma_step_offset) out.put(static_cast<std::int8_t>(board ? 0 : offset));
    out.put(static_cast<std::uint8_t>(board ? 0 : static_cast<int>(coded.dense.alpha_coding())));
    out.put(board ? std::uint8_t{0} : features_of(coded.dense));
    out.put(std::span<const std::uint8_t>(coded.levels));
    if (board) {
        put_board_code(coded.board, out);
        return out.bytes();
    }
    if (coded.dense.has_edge_alpha()) out.put(std::span<const std::uint8_t>(coded.dense.edge_alpha));
    std::vector<bool> listed(static_cast<std::size_t>(coded.dense.contexts()));
    for (std::size_t c = 0; c < listed.size(); ++c) listed[c] = coded.dense.probabilities[c] != kEven;
    put_bits(out, listed);
    for (std::size_t c = 0; c < listed.size(); ++c) {
        if (listed[c]) out.put(static_cast<std::uint8_t>(coded.dense.probabilities[c] / kProbabilityUnit));
    }
    return out.bytes();
}

Status parse_code(std::span<const std::byte> payload, std::size_t views, int width, int height, CodedImages& coded) {
    ByteReader in(payload);
    const auto profile = in.get<std::uint8_t>();
    const auto tile_width_log2 = in.get<std::uint8_t>();
    const auto tile_height_log2 = in.get<std::uint8_t>();
    const auto alpha_bits = in.get<std::uint8_t>();
    for (int& offset : coded.dense.chroma_step_offset) {
        const std::int8_t stored = in.get<std::int8_t>();
        offset = stored;
    }
    const auto alpha_coding = in.get<std::uint8_t>();
    const auto features = in.get<std::uint8_t>();
    const auto levels = in.take(views);
    if (!in.ok()) return Error{"is too short"};
    if (profile != static_cast<std::uint8_t>(Profile::kDense) &&
        profile != static_cast<std::uint8_t>(Profile::kBoard)) {
        return Error{"has profile " + std::to_string(profile) + ", which is not known here; update these tools"};
    }
    const bool board = profile == static_cast<std::uint8_t>(Profile::kBoard);
    for (const int log2 : {tile_width_log2, tile_height_log2}) {
        const int lowest = board ? kBoardTileLog2 : kMinTileLog2;
        const int highest = board ? kBoardTileLog2 : kMaxTileLog2;
        if (log2 < lowest || log2 > highest) {
            return out_of_range("the logarithm of a tile's side", log2, lowest, highest);
        }
    }
    const int most_codings = board ? 0 : static_cast<int>(AlphaCoding::kDepths);
    if (alpha_coding > most_codings) return out_of_range("the coding of alpha", alpha_coding, 0, most_codings);
    constexpr int kBits[][2] = {{1, kMaxAlphaLevelBits}, {1, 2}, {3, kMaxAlphaBits}};  // [coding]
    const int fewest_bits = board ? 0 : kBits[alpha_coding][0];
    const int most_bits = board ? 0 : kBits[alpha_coding][1];
    if (alpha_bits < fewest_bits || alpha_bits > most_bits) {
        return out_of_range("the number of alpha bits", alpha_bits, fewest_bits, most_bits);
    }
    const int largest_offset = board ? 0 : kMaxChromaOffset;
    for (const int offset : coded.dense.chroma_step_offset) {
        if (std::abs(offset) > largest_offset) {
            return out_of_range("a chroma step's offset", offset, -largest_offset, largest_offset);
        }
    }
    const int all_features = board ? 0 : kAllFeatures;
    if (features > all_features) return out_of_range("the set of features", features, 0, all_features);
    coded.profile = static_cast<Profile>(profile);
    coded.width = width;
    coded.height = height;
    coded.tile_width_log2 = tile_width_log2;
    coded.tile_height_log2 = tile_height_log2;
    coded.dense.has_masks = alpha_coding != static_cast<int>(AlphaCoding::kLevels);
    coded.dense.alpha_bits = alpha_bits;
    coded.dense.deblocking = (features & kDeblocking) != 0;
    coded.dense.adaptation = (features & kAdaptation) != 0;
    coded.dense.sign_data_hiding = (features & kSignDataHiding) != 0;
    coded.levels.resize(views);
    for (std::size_t v = 0; v < views; ++v) {
        coded.levels[v] = static_cast<std::uint8_t>(levels[v]);
        if (coded.levels[v] >= kProgressiveLevels) {
            return out_of_range("the level of image " + std::to_string(v), coded.levels[v], 0, kProgressiveLevels - 1);
        }
    }
    Status rest = board ? take_board_code(in, coded.board) : take_dense_code(in, coded.dense);
    if (!rest) return rest;
    coded.images.assign(views, {});
    return {};
}

std::vector<std::byte> coded_image_payload(const CodedImages& coded, std::size_t view) {
    const CodedImage& image = coded.images[view];
    ByteWriter out;
    out.put(kCodedImage);
    out.put(static_cast<std::uint8_t>(image.head.step));
    for (const std::uint16_t reference : image.head.reference) out.put(reference);
    for (const MotionVector motion : image.head.global_motion) {
        out.put(motion.x);
        out.put(motion.y);
    }
    out.put_zeros(2);
    std::vector<bool> present;
    for (const TileSpan& tile : image.tiles) present.push_back(tile.present);
    put_bits(out, present);
    for (const TileSpan& tile : image.tiles) {
        if (tile.present) put_size(out, tile.size);
    }
    out.put(std::span<const std::byte>(image.bytes));
    return out.bytes();
}

Status parse_coded_image(std::span<const std::byte> payload, std::size_t view, CodedImages& coded) {
    ByteReader in(payload);
    CodedImage image;
    const auto coding = in.get<std::uint8_t>();
    image.head.step = in.get<std::uint8_t>();
    for (std::uint16_t& reference : image.head.reference) reference = in.get<std::uint16_t>();
    for (MotionVector& motion : image.head.global_motion) {
        motion.x = in.get<std::int16_t>();
        motion.y = in.get<std::int16_t>();
    }
    const bool reserved_is_zero = in.take_zeros(2);
    if (!in.ok()) return Error{"is too short"};
    if (coding != kCodedImage) {
        return Error{"has image coding " + std::to_string(coding) +
                     ", which is not that of an object with a chunk CODE; encode the object anew"};
    }
    const bool board = coded.profile == Profile::kBoard;
    const int largest_step = board ? 0 : kMaxStep;
    if (image.head.step > largest_step) return out_of_range("its quantiser step", image.head.step, 0, largest_step);
    RS_TRY(check_references(coded, view, image.head));
    for (const MotionVector motion : image.head.global_motion) {
        for (const int component : {int{motion.x}, int{motion.y}}) {
            const int largest = board ? 0 : kMaxMotion_q2;
            if (std::abs(component) > largest) {
                return out_of_range("a global motion vector", component, -largest, largest);
            }
        }
    }
    if (!reserved_is_zero) return Error{"has reserved bytes that are not zero"};

    std::vector<bool> present(static_cast<std::size_t>(coded.tile_columns()) *
                              static_cast<std::size_t>(coded.tile_rows()));
    if (!take_bits(in, present)) return Error{"ends within its list of tiles, or lists some that do not exist"};
    image.tiles.resize(present.size());
    std::uint64_t begin = 0;  // may pass 2^32: 2^18 tiles are possible
    for (std::size_t t = 0; t < present.size(); ++t) {
        if (!present[t]) continue;
        const std::uint32_t size = take_size(in);
        if (!in.ok() || size > kMaxTile_bytes) {
            return Error{"gives tile " + std::to_string(t) + " no size of 0.." + std::to_string(kMaxTile_bytes) +
                         " in its shortest form"};
        }
        image.tiles[t] = {static_cast<std::uint32_t>(begin), size, true};
        begin += size;
    }
    if (in.left() != begin) {
        return Error{"has " + std::to_string(in.left()) + " bytes of tiles instead of " + std::to_string(begin)};
    }
    const auto bytes = in.take(static_cast<std::size_t>(begin));  // at most 2^30: the size of a chunk
    image.bytes.assign(bytes.begin(), bytes.end());
    coded.images[view] = std::move(image);
    return {};
}

std::uint64_t tile_table_bytes(const CodedImages& coded) {
    return sizeof(TileSpan) * static_cast<std::uint64_t>(coded.tile_columns()) *
           static_cast<std::uint64_t>(coded.tile_rows());
}

}  // namespace rs::codec
