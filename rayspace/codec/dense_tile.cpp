#include "rayspace/codec/dense_tile.hpp"

#include "rayspace/codec/bool_decoder.hpp"
#include "rayspace/codec/context_states.hpp"
#include "rayspace/codec/dense_tile_decoder.hpp"

#include <cstring>

namespace rs::codec {
namespace {

class Reader {
public:
    Reader(std::span<const std::byte> bytes, const DenseCode& code) : bits_(bytes), states_(code) {}
    int bit(int context, int /*value*/) {
        const int read = bits_.bit(states_.probability(context));
        states_.adapt(context, read);
        return read;
    }
    int raw(int /*value*/) { return bits_.bit(1U << (kProbabilityBits - 1)); }

private:
    BoolDecoder bits_;
    ContextStates states_;
};

}  // namespace

void decode_dense_tile(const DenseCode& code, const CodedTile& tile, const PlaneViews& out) {
    Reader reader(tile.bytes, code);
    DenseTileDecoder(reader, code, tile, out).decode();
}

void clear_tile(const TileRect& place, const PlaneViews& out) {
    for (std::size_t plane = 0; plane < out.size(); ++plane) {
        for (int y = place.top; y < place.top + place.height; ++y) {
            std::memset(out[plane].row(y) + place.left, plane == 3 ? 0 : kEmptySample,
                        static_cast<std::size_t>(place.width));
        }
    }
}

}  // namespace rs::codec
