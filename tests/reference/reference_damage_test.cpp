// What must be rejected of CODE and PICT: the library's parsers and those written from encode/FORMAT.md refuse the same
// payloads, and read the same from what they accept.

#include "rayspace/codec/coded_chunks.hpp"
#include "tests/reference/random_stream.hpp"
#include "tests/reference/reference_chunks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

namespace rs::reference {
namespace {

using Payload = std::vector<std::uint8_t>;

struct Tally {
    int accepted = 0;
    int refused = 0;
};

class DamagedPayload : public testing::Test {
protected:
    void SetUp() override {
        // A view with two references, in a stream whose last byte of `present` has bits of no tile.
        for (seed_ = 1; seed_ < 10000; ++seed_) {
            stream_ = random_stream(seed_);
            ASSERT_EQ(parse_stream(stream_, coded_), "");
            const std::size_t tiles = coded_.pictures[0].tiles.size();
            for (view_ = 0; view_ < stream_.picts.size(); ++view_) {
                const codec::CodedPicture& picture = coded_.pictures[view_];
                if (picture.head.references() == 2 && tiles % 8 != 0 && tiles > 3 && picture.bytes.size() < 600) {
                    ASSERT_EQ(read_code(stream_.code, views(), code_), "");
                    return;
                }
            }
        }
        FAIL() << "no stream fits";
    }

    [[nodiscard]] int views() const { return static_cast<int>(stream_.picts.size()); }

    void expect_same_code(const Payload& payload, const std::string& what) {
        Code expected;
        const std::string error = read_code(payload, views(), expected);
        codec::CodedPictures found;
        const Status status =
            codec::parse_code(as_payload(payload), stream_.picts.size(), stream_.width, stream_.height, found);
        ASSERT_EQ(error.empty(), status.ok()) << "seed " << seed_ << ", CODE, " << what << ": reference says '" << error
                                              << "', library '" << (status.ok() ? "" : status.error().message) << "'";
        ++(error.empty() ? tally_.accepted : tally_.refused);
        if (!error.empty()) return;
        ASSERT_EQ(expected.tile_width, found.tile_width()) << what;
        ASSERT_EQ(expected.tile_height, found.tile_height()) << what;
        ASSERT_EQ(expected.alpha_bits, found.dense.alpha_bits) << what;
        ASSERT_EQ(expected.u_offset, found.dense.chroma_step_offset[0]) << what;
        ASSERT_EQ(expected.v_offset, found.dense.chroma_step_offset[1]) << what;
        ASSERT_TRUE(std::ranges::equal(expected.level, found.levels)) << what;
        ASSERT_TRUE(std::ranges::equal(expected.probability, found.dense.probabilities, [](int p, int P) {
            return 16 * p == P;
        })) << what;
    }

    void expect_same_pict(const Payload& payload, const std::string& what) {
        Pict expected;
        const std::string error =
            read_pict(payload, stream_.width, stream_.height, static_cast<int>(view_), code_, expected);
        coded_.pictures[view_] = {};
        const Status status = codec::parse_coded_picture(as_payload(payload), view_, coded_);
        ASSERT_EQ(error.empty(), status.ok())
            << "seed " << seed_ << ", PICT " << view_ << ", " << what << ": reference says '" << error << "', library '"
            << (status.ok() ? "" : status.error().message) << "'";
        ++(error.empty() ? tally_.accepted : tally_.refused);
        if (!error.empty()) return;
        const codec::CodedPicture& found = coded_.pictures[view_];
        ASSERT_EQ(expected.step, found.head.step) << what;
        for (std::size_t r = 0; r < 2; ++r) {
            ASSERT_EQ(expected.reference[r], found.head.reference[r]) << what;
            ASSERT_EQ(expected.usual[r].x, found.head.usual_motion[r].x) << what;
            ASSERT_EQ(expected.usual[r].y, found.head.usual_motion[r].y) << what;
        }
        ASSERT_EQ(expected.tiles.size(), found.tiles.size()) << what;
        for (std::size_t t = 0; t < found.tiles.size(); ++t) {
            ASSERT_EQ(expected.tiles[t].has_value(), found.tiles[t].present) << what;
            if (!found.tiles[t].present) continue;
            ASSERT_TRUE(std::ranges::equal(std::as_bytes(*expected.tiles[t]), found.tile_bytes(t))) << what;
        }
    }

    // Every value of the byte, or of the two bytes from there on.
    template <class Check>
    void try_values(const Payload& payload, std::size_t at, std::size_t bytes, Check check) {
        for (int value = 0; value < (bytes == 1 ? 256 : 65536); ++value) {
            Payload damaged = payload;
            damaged[at] = static_cast<std::uint8_t>(value & 255);
            if (bytes == 2) damaged[at + 1] = static_cast<std::uint8_t>(value >> 8);
            check(damaged, "bytes from " + std::to_string(at) + " on are " + std::to_string(value));
            if (HasFatalFailure()) return;
        }
    }

    template <class Check>
    void try_lengths(const Payload& payload, Check check) {
        for (std::size_t size = 0; size < payload.size() + 4; ++size) {
            Payload damaged = payload;
            damaged.resize(size);
            check(damaged, "cut or filled up to " + std::to_string(size) + " bytes");
            if (HasFatalFailure()) return;
        }
    }

    std::uint64_t seed_ = 0;
    Stream stream_;
    std::size_t view_ = 0;
    codec::CodedPictures coded_;
    Code code_;
    Tally tally_;
};

TEST_F(DamagedPayload, OfCodeIsJudgedTheSame) {
    const auto check = [&](const Payload& payload, const std::string& what) { expect_same_code(payload, what); };
    const std::size_t probabilities_at = 189 + stream_.picts.size();
    for (std::size_t at = 0; at < probabilities_at + 4 && !HasFatalFailure(); ++at) {
        try_values(stream_.code, at, 1, check);
    }
    try_values(stream_.code, stream_.code.size() - 1, 1, check);
    try_lengths(stream_.code, check);
    std::cout << tally_.accepted << " accepted, " << tally_.refused << " refused\n";
    EXPECT_GT(tally_.accepted, 1000);
    EXPECT_GT(tally_.refused, 1000);
}

TEST_F(DamagedPayload, OfPictIsJudgedTheSame) {
    const Payload& payload = stream_.picts[view_];
    const auto check = [&](const Payload& damaged, const std::string& what) { expect_same_pict(damaged, what); };
    const std::size_t tiles_at = payload.size() - coded_.pictures[view_].bytes.size();
    for (std::size_t at = 0; at < tiles_at && !HasFatalFailure(); ++at) try_values(payload, at, 1, check);
    for (std::size_t at = 2; at < 14 && !HasFatalFailure(); at += 2) try_values(payload, at, 2, check);
    try_lengths(payload, check);
    std::cout << tally_.accepted << " accepted, " << tally_.refused << " refused\n";
    EXPECT_GT(tally_.accepted, 1000);
    EXPECT_GT(tally_.refused, 1000);
}

// The shortest, longer and too large forms of sizes, in a picture of one tile.
TEST_F(DamagedPayload, SizesAreJudgedTheSame) {
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

// Sizes that add up to 2^32, of a picture with enough tiles, and no bytes for them.
TEST_F(DamagedPayload, OfSizesThatAddUpTo2To32IsRefusedByBoth) {
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
    EXPECT_FALSE(codec::parse_coded_picture(as_payload(payload), view_, coded_).ok());
}

}  // namespace
}  // namespace rs::reference
