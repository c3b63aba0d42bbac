#include "rayspace/codec/stream/byte_account.hpp"

#include "rayspace/codec/board/board_profile.hpp"
#include "rayspace/codec/bool_decoder.hpp"
#include "rayspace/codec/context_states.hpp"
#include "rayspace/codec/dense_tile_decoder.hpp"
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/codec/stream/decode_image.hpp"

#include <array>
#include <cmath>
#include <mutex>

namespace rs::codec {
namespace {

enum Purpose : std::size_t { kAlpha, kPrediction, kMotion, kFlags, kLuma, kChroma, kRawBits, kPurposes };
constexpr const char* kNames[kPurposes] = {"alpha",
                                           "choice of prediction",
                                           "motion",
                                           "what is coded",
                                           "coefficients of Y",
                                           "coefficients of U and V",
                                           "signs and low bits"};

Purpose purpose_of(int context) {
    namespace c = context;
    if (context < c::kSplit || context >= c::kAlphaZero) return kAlpha;
    if (context < c::kMotionZero) return kPrediction;
    if (context < c::kSmallTransforms) return kMotion;
    if (context < c::kLastClass) return kFlags;
    // The four kinds of luma come first in each group.
    const auto kind = [&](int begin, int per_kind) { return (context - begin) / per_kind; };
    int of = 0;
    if (context < c::kLastTop) {
        of = kind(c::kLastClass, 8);
    } else if (context < c::kNonZero) {
        of = kind(c::kLastTop, 9);
    } else if (context < c::kAboveOne) {
        of = kind(c::kNonZero, c::kBands * c::kNearSums);
    } else if (context < c::kAboveTwo) {
        of = kind(c::kAboveOne, 2 * c::kNearSums);
    } else if (context < c::kRestClass) {
        of = kind(c::kAboveTwo, 2 * c::kNearSums);
    } else {
        of = kind(c::kRestClass, 14);
    }
    return of < c::kBlockKinds / 2 ? kLuma : kChroma;
}

using Bits = std::array<double, kPurposes>;

class CountingReader {
public:
    CountingReader(std::span<const std::byte> bytes, const DenseCode& code, Bits& bits)
        : decoder_(bytes), states_(code), bits_(bits) {}
    int bit(int context, int /*value*/) {
        const std::uint32_t zero = states_.probability(context);
        const int read = decoder_.bit(zero);
        states_.adapt(context, read);
        bits_[purpose_of(context)] -= std::log2((read == 0 ? zero : 4096 - zero) / 4096.0);
        return read;
    }
    int raw(int /*value*/) {
        bits_[kRawBits] += 1;
        return decoder_.bit(1U << (kProbabilityBits - 1));
    }

private:
    BoolDecoder decoder_;
    ContextStates states_;
    Bits& bits_;
};

std::vector<AccountEntry> account_of_tiles(const CodedImages& coded) {
    Bits sum{};
    std::mutex mutex;
    decode_planes(coded, [&](std::size_t view, std::size_t tile, const auto& references, const PlaneViews& out) {
        const CodedImage& image = coded.images[view];
        if (!image.tiles[tile].present) return decode_tile(coded, view, tile, references, nullptr, out);
        Bits bits{};
        const CodedTile coded_tile{.head = image.head,
                                   .bytes = image.tile_bytes(tile),
                                   .place = tile_rect(coded, tile),
                                   .references = references};
        CountingReader reader(coded_tile.bytes, coded.dense, bits);
        DenseTileDecoder(reader, coded.dense, coded_tile, out).decode();
        const std::lock_guard lock(mutex);
        for (std::size_t p = 0; p < kPurposes; ++p) sum[p] += bits[p];
    });
    std::vector<AccountEntry> entries;
    for (std::size_t p = 0; p < kPurposes; ++p) {
        entries.push_back({kNames[p], sum[p] / 8});
    }
    return entries;
}

std::vector<AccountEntry> account_of_records(const CodedImages& coded) {
    double motion = 0;
    double colours = 0;
    double blocks = 0;
    double quarters = 0;
    double alpha = 0;
    double heads = 0;
    for (const CodedImage& image : coded.images) {
        const auto& classes = coded.board.classes[image.head.references() > 0 ? 1 : 0];
        for (std::size_t t = 0; t < image.tiles.size(); ++t) {
            if (!image.tiles[t].present) continue;
            heads += kBoardTileHeadBytes;
            const std::uint64_t tile_classes = board_tile_classes(image.tile_bytes(t));
            for (int b = 0; b < kBoardTileBlocks; ++b) {
                const auto number = static_cast<std::size_t>((tile_classes >> (3 * b)) & 7U);
                if (number == 0) continue;
                (classes[number].predicted ? motion : colours) += classes[number].predicted ? 2 : 3;
                blocks += classes[number].block_stages;
                quarters += 4.0 * classes[number].quarter_stages;
                alpha += classes[number].alpha ? 4 : 0;
            }
        }
    }
    return {{"motion", motion},
            {"flat colours", colours},
            {"indices of whole blocks", blocks},
            {"indices of quarters", quarters},
            {"alpha", alpha},
            {"classes of records", heads}};
}

}  // namespace

std::vector<AccountEntry> account_bytes(const CodedImages& coded) {
    std::vector<AccountEntry> entries =
        coded.profile == Profile::kBoard ? account_of_records(coded) : account_of_tiles(coded);
    double tiles = 0;
    double whole = 0;
    double of_references = 0;
    for (std::size_t v = 0; v < coded.images.size(); ++v) {
        const auto size = static_cast<double>(coded_image_payload(coded, v).size());
        whole += size;
        tiles += static_cast<double>(coded.images[v].bytes.size());
        if (coded.levels[v] == 0) of_references += size;
    }
    double accounted = 0;
    for (const AccountEntry& entry : entries) accounted += entry.bytes;
    entries.push_back({coded.profile == Profile::kBoard ? "padding of records" : "tiles' rounding", tiles - accounted});
    entries.push_back({"offsets and heads", whole - tiles});
    entries.push_back({"(of all these, images of level 0)", of_references});
    return entries;
}

}  // namespace rs::codec
