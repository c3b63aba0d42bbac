// Invalid payloads of CODE and PICT: the library's parsers and those written from encode/FORMAT.md reject the same
// payloads and read the same values from accepted ones.

#include "tests/reference/damaged_payload.hpp"

#include <iostream>

namespace rs::reference {
namespace {

TEST_P(DamagedPayload, OfCodeIsJudgedTheSame) {
    const auto check = [&](const Payload& payload, const std::string& what) { expect_same_code(payload, what); };
    // Up to the first probabilities, or past the head of the codebooks' frame (at most 18 bytes).
    const std::size_t begin = 8 + stream_.picts.size();
    const std::size_t end = begin + (GetParam() == Profile::kBoard ? 14 + 22 : 181 + 4);
    for (std::size_t at = 0; at < end && !HasFatalFailure(); ++at) {
        try_values(stream_.code, at, 1, check);
    }
    try_values(stream_.code, stream_.code.size() - 1, 1, check);
    try_lengths(stream_.code, check);
    std::cout << tally_.accepted << " accepted, " << tally_.refused << " refused\n";
    EXPECT_GT(tally_.accepted, 500);
    EXPECT_GT(tally_.refused, 1000);
}

TEST_P(DamagedPayload, OfPictIsJudgedTheSame) {
    const Payload& payload = stream_.picts[view_];
    const auto check = [&](const Payload& damaged, const std::string& what) { expect_same_pict(damaged, what); };
    const std::size_t tiles_at = payload.size() - coded_.images[view_].bytes.size();
    for (std::size_t at = 0; at < tiles_at && !HasFatalFailure(); ++at) try_values(payload, at, 1, check);
    for (std::size_t at = 2; at < 14 && !HasFatalFailure(); at += 2) try_values(payload, at, 2, check);
    try_lengths(payload, check);
    std::cout << tally_.accepted << " accepted, " << tally_.refused << " refused\n";
    EXPECT_GT(tally_.accepted, GetParam() == Profile::kBoard ? 20 : 1000);  // most numbers of board images are 0
    EXPECT_GT(tally_.refused, 1000);
}

// Shortest, longer and too large forms of sizes, in an image of one tile.
TEST_P(DamagedPayload, SizesAreJudgedTheSame) {
    stream_.width = 16;
    stream_.height = 16;
    coded_.width = 16;
    coded_.height = 16;
    const std::vector<std::pair<Payload, std::size_t>> sizes = {{{0x00}, 0},
                                                                {{0x7F}, 127},
                                                                {{0x80, 0x01}, 128},
                                                                {{0xFF, 0x7F}, 16383},
                                                                {{0x80, 0x00}, 0},
                                                                {{0x80, 0x80, 0x00}, 0},
                                                                {{0x80, 0x80, 0x01}, 16384},
                                                                {{0xFF, 0xFF, 0x03}, 65535},
                                                                {{0xFF, 0x00}, 127},
                                                                {{0xFF, 0x80, 0x00}, 127},
                                                                {{0x80, 0x80, 0x04}, 65536},
                                                                {{0x80, 0x80, 0x7F}, 127U << 14U},
                                                                {{0x81, 0x80, 0x80, 0x00}, 1},
                                                                {{0x81, 0x80, 0x80}, 0},
                                                                {{0x81}, 0}};
    for (const auto& [form, bytes] : sizes) {
        Payload payload(stream_.picts[view_].begin(), stream_.picts[view_].begin() + 16);
        payload.push_back(1);
        payload.insert(payload.end(), form.begin(), form.end());
        for (const std::size_t more : {0U, 1U, 2U}) {
            Payload whole = payload;
            whole.resize(payload.size() + bytes + more);
            expect_same_pict(whole, "size of " + std::to_string(form.size()) + " bytes, " + std::to_string(bytes));
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_GE(tally_.accepted, 6);
    EXPECT_GT(tally_.refused, 20);
}

// Sizes that add up to 2^32 in an image with enough tiles, without bytes for them.
class DamagedDensePayload : public DamagedPayload {};  // board images have too few tiles

TEST_P(DamagedDensePayload, OfSizesThatAddUpTo2To32IsRefusedByBoth) {
    stream_.width = stream_.height = coded_.width = coded_.height = 8192;
    code_.tile_width = code_.tile_height = 16;
    coded_.tile_width_log2 = coded_.tile_height_log2 = 4;
    Payload payload(stream_.picts[view_].begin(), stream_.picts[view_].begin() + 16);
    payload.resize(16 + 512 * 512 / 8);
    const int tiles = 65538;
    for (std::size_t t = 0; t < tiles; ++t)
        payload[16 + t / 8] = static_cast<std::uint8_t>(payload[16 + t / 8] | (1U << t % 8));
    for (int t = 0; t + 1 < tiles; ++t) payload.insert(payload.end(), {0xFF, 0xFF, 0x03});  // 65537 * 65535 = 2^32 - 1
    payload.push_back(1);
    Pict pict;
    EXPECT_NE(read_pict(payload, 8192, 8192, static_cast<int>(view_), code_, pict), "");
    EXPECT_FALSE(codec::parse_coded_image(as_payload(payload), view_, coded_).ok());
}

INSTANTIATE_TEST_SUITE_P(Profiles, DamagedPayload, testing::Values(Profile::kDense, Profile::kBoard), profile_name);
INSTANTIATE_TEST_SUITE_P(Profiles, DamagedDensePayload, testing::Values(Profile::kDense), profile_name);

}  // namespace
}  // namespace rs::reference
