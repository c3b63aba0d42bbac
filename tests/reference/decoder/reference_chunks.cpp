#include "tests/reference/decoder/reference_chunks.hpp"

#include "tests/reference/decoder/reference_bytes.hpp"

#include <cstdlib>

namespace rs::reference {
namespace {

int i16_at(Bytes bytes, std::size_t at) {
    const int value = u16_at(bytes, at);
    return value < 32768 ? value : value - 65536;
}

int i8_at(Bytes bytes, std::size_t at) {
    return bytes[at] < 128 ? bytes[at] : bytes[at] - 256;
}

bool bit_at(Bytes bytes, std::size_t first, int i) {
    return ((bytes[first + static_cast<std::size_t>(i / 8)] >> (i % 8)) & 1) != 0;
}

// "7 bits a byte, the lowest first, 128 added to all bytes but the last; 0 .. 65535", 1 .. 3 bytes.
std::string read_size(Bytes payload, std::size_t& at, std::size_t& size) {
    size = 0;
    for (int i = 0; i < 3; ++i) {
        if (at >= payload.size()) return "the payload ends before the sizes do";
        const std::uint8_t byte = payload[at++];
        size += static_cast<std::size_t>(byte & 127) << (7 * i);
        if (byte >= 128) continue;
        if (byte == 0 && i > 0) return "a size is not in its shortest form";
        return size > 65535 ? "a size is above 65535" : "";
    }
    return "a size has more than 3 bytes";
}

// CODE: the column "dense" or "board" of its table.
std::string read_fields(Bytes payload, Code& code) {
    if (payload[0] != 1 && payload[0] != 2) return "CODE has another profile";
    const bool is_board = payload[0] == 2;
    code.profile = is_board ? Profile::kBoard : Profile::kDense;
    for (std::size_t i = 1; i <= 2; ++i) {
        if (payload[i] < (is_board ? 5 : 4) || payload[i] > (is_board ? 5 : 6)) return "a tile's size is out of range";
    }
    code.tile_width = 1 << payload[1];
    code.tile_height = 1 << payload[2];
    code.alpha_bits = payload[3];
    code.u_offset = i8_at(payload, 4);
    code.v_offset = i8_at(payload, 5);
    const int largest_offset = is_board ? 0 : 31;
    if (std::abs(code.u_offset) > largest_offset) return "u_offset is out of range";
    if (std::abs(code.v_offset) > largest_offset) return "v_offset is out of range";
    if (payload[6] > (is_board ? 0 : 2)) return "CODE has another alpha_coding";
    code.alpha_coding = payload[6];
    constexpr std::array<std::array<int, 2>, 3> kBits = {{{1, 4}, {1, 2}, {3, 6}}};
    const std::array<int, 2> bits = is_board ? std::array{0, 0} : kBits.at(payload[6]);
    if (code.alpha_bits < bits[0] || code.alpha_bits > bits[1]) return "alpha_bits is out of range";
    if (payload[7] > (is_board ? 0 : 7)) return "CODE has other features";
    code.has_smooth_edges = (payload[7] & 1) != 0;
    code.is_adaptive = (payload[7] & 2) != 0;
    code.has_sign_data_hiding = (payload[7] & 4) != 0;
    return "";
}

// CODE: "Then, of dense images"
std::string read_probabilities(Bytes payload, Code& code) {
    if (code.alpha_coding == 1 && code.alpha_bits == 1) {
        if (payload.size() < code.edge_alpha.size()) return "CODE is shorter than its edge_alpha";
        for (std::size_t i = 0; i < code.edge_alpha.size(); ++i) {
            if (payload[i] > 127) return "an edge_alpha is above 127";
            code.edge_alpha[i] = payload[i];
        }
        payload = payload.subspan(code.edge_alpha.size());
    }
    const std::size_t listed_bytes = kListedBytes[static_cast<std::size_t>(code.alpha_coding)];
    if (payload.size() < listed_bytes) return "CODE is shorter than its fields";
    std::size_t at = listed_bytes;
    for (int context = 0; context < static_cast<int>(8 * listed_bytes); ++context) {
        const bool is_listed = bit_at(payload, 0, context);
        if (context >= kContexts[static_cast<std::size_t>(code.alpha_coding)]) {
            if (is_listed) return "a listed context does not exist";
            continue;
        }
        int& probability = code.probability[static_cast<std::size_t>(context)];
        probability = 128;
        if (!is_listed) continue;
        if (at >= payload.size()) return "CODE is shorter than its probabilities";
        probability = payload[at++];
        if (probability == 0) return "a probability is 0";
    }
    return at == payload.size() ? "" : "CODE is longer than its fields";
}

}  // namespace

// CODE
std::string read_code(Bytes payload, int views, Code& code) {
    const std::size_t v = static_cast<std::size_t>(views);
    if (payload.size() < 8 + v) return "CODE is shorter than its fields";
    if (std::string error = read_fields(payload, code); !error.empty()) return error;
    for (std::size_t i = 0; i < v; ++i) {
        if (payload[8 + i] > 3) return "a level is out of range";
        code.level.push_back(payload[8 + i]);
    }
    const Bytes rest = payload.subspan(8 + v);
    return code.profile == Profile::kBoard ? read_board_code(rest, code.board) : read_probabilities(rest, code);
}

// PICT, Coding 1
std::string read_pict(Bytes payload, int width, int height, int view, const Code& code, Pict& pict) {
    const int tiles = ceil_div(width, code.tile_width) * ceil_div(height, code.tile_height);
    const std::size_t sizes_at = 16 + static_cast<std::size_t>(ceil_div(tiles, 8));
    if (payload.size() < sizes_at) return "PICT is shorter than its fields";
    if (payload[0] != 1) return "PICT has another coding";
    pict.step = payload[1];
    const bool is_board = code.profile == Profile::kBoard;
    if (pict.step > (is_board ? 0 : 63)) return "the step is out of range";
    pict.reference = {u16_at(payload, 2), u16_at(payload, 4)};
    if (pict.reference[1] != kNoView) {
        if (pict.reference[0] == kNoView) return "reference_b without reference_a";
        if (pict.reference[0] == pict.reference[1]) return "reference_b is reference_a";
    }
    for (const int reference : pict.reference) {
        if (reference == kNoView) continue;
        if (reference >= static_cast<int>(code.level.size())) return "a reference is no view";
        if (code.level[static_cast<std::size_t>(reference)] >= code.level[static_cast<std::size_t>(view)]) {
            return "a reference's level is not lower";
        }
    }
    for (std::size_t r = 0; r < 2; ++r) {
        pict.usual[r] = {i16_at(payload, 6 + 4 * r), i16_at(payload, 8 + 4 * r)};
        const int farthest = is_board ? 0 : 1023;
        if (std::abs(pict.usual[r].x) > farthest || std::abs(pict.usual[r].y) > farthest) {
            return "a vector is out of range";
        }
    }
    if (payload[14] != 0 || payload[15] != 0) return "reserved bytes of PICT are not 0";
    for (int t = tiles; t < 8 * ceil_div(tiles, 8); ++t) {
        if (bit_at(payload, 16, t)) return "a present tile does not exist";
    }

    std::size_t at = sizes_at;
    std::vector<std::optional<std::size_t>> sizes(static_cast<std::size_t>(tiles));
    for (int t = 0; t < tiles; ++t) {
        if (!bit_at(payload, 16, t)) continue;
        std::size_t size = 0;
        std::string error = read_size(payload, at, size);
        if (!error.empty()) return error;
        sizes[static_cast<std::size_t>(t)] = size;
    }
    for (const auto& size : sizes) {
        pict.tiles.emplace_back();
        if (!size) continue;
        if (*size > payload.size() - at) return "PICT is shorter than its tiles";
        pict.tiles.back() = payload.subspan(at, *size);
        at += *size;
    }
    return at == payload.size() ? "" : "PICT is longer than its tiles";
}

}  // namespace rs::reference
