#pragma once
// Fixture of the damage tests: a stream, and the check that the library's parsers and the reference parsers written
// from encode/FORMAT.md accept the same payloads and read the same values.

#include "rayspace/codec/stream/coded_chunks.hpp"
#include "tests/reference/decoder/reference_chunks.hpp"
#include "tests/reference/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

using Payload = std::vector<std::uint8_t>;

struct Tally {
    int accepted = 0;
    int refused = 0;
};

class DamagedPayload : public testing::TestWithParam<Profile> {
protected:
    void SetUp() override {
        // A view with two references, in a stream whose last byte of `present` has unused bits.
        for (seed_ = 1; seed_ < 10000; ++seed_) {
            stream_ = random_stream(seed_, GetParam());
            ASSERT_EQ(parse_stream(stream_, coded_), "");
            const std::size_t tiles = coded_.images[0].tiles.size();
            for (view_ = 0; view_ < stream_.picts.size(); ++view_) {
                const codec::CodedImage& image = coded_.images[view_];
                const bool has_books = GetParam() == Profile::kDense || !coded_.board.books[0].block[0].empty();
                if (image.head.references() == 2 && tiles % 8 != 0 && tiles > 3 && image.bytes.size() < 600 &&
                    has_books) {
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
        codec::CodedImages found;
        const Status status =
            codec::parse_code(as_payload(payload), stream_.picts.size(), stream_.width, stream_.height, found);
        ASSERT_EQ(error.empty(), status.ok()) << "seed " << seed_ << ", CODE, " << what << ": reference says '" << error
                                              << "', library '" << (status.ok() ? "" : status.error().message) << "'";
        ++(error.empty() ? tally_.accepted : tally_.refused);
        if (!error.empty()) return;
        ASSERT_EQ(expected.profile == Profile::kBoard, found.profile == codec::Profile::kBoard) << what;
        ASSERT_EQ(expected.tile_width, found.tile_width()) << what;
        ASSERT_EQ(expected.tile_height, found.tile_height()) << what;
        ASSERT_TRUE(std::ranges::equal(expected.level, found.levels)) << what;
        if (expected.profile == Profile::kBoard) {
            expect_same_board(expected.board, found.board, what);
        } else {
            expect_same_dense(expected, found.dense, what);
        }
    }

    static void expect_same_dense(const Code& expected, const codec::DenseCode& found, const std::string& what) {
        ASSERT_EQ(expected.alpha_bits, found.alpha_bits) << what;
        ASSERT_TRUE(std::ranges::equal(expected.edge_alpha, found.edge_alpha)) << what;
        ASSERT_EQ(expected.alpha_coding, static_cast<int>(found.alpha_coding())) << what;
        ASSERT_EQ(expected.u_offset, found.chroma_step_offset[0]) << what;
        ASSERT_EQ(expected.v_offset, found.chroma_step_offset[1]) << what;
        const auto contexts = static_cast<std::size_t>(found.contexts());
        ASSERT_EQ(static_cast<std::size_t>(kContexts[static_cast<std::size_t>(expected.alpha_coding)]), contexts)
            << what;
        ASSERT_TRUE(std::ranges::equal(std::span(expected.probability).first(contexts),
                                       std::span(found.probabilities).first(contexts),
                                       [](int p, int P) { return 16 * p == P; }))
            << what;
    }

    static void expect_same_board(const BoardCode& expected, const codec::BoardCode& found, const std::string& what) {
        for (std::size_t table = 0; table < 2; ++table) {
            for (std::size_t c = 1; c < 8; ++c) {
                const BoardClass& e = expected.classes[table][c];
                const codec::RecordClass f = {e.is_predicted, e.has_alpha, e.block_stages, e.quarter_stages};
                ASSERT_EQ(f, found.classes[table][c]) << what << ", class " << c;
            }
        }
        for (std::size_t kind = 0; kind < 2; ++kind) {
            expect_same_books(expected.block_books[kind], found.books[kind].block, what);
            expect_same_books(expected.quarter_books[kind], found.books[kind].quarter, what);
        }
        ASSERT_EQ(expected.alpha_book, found.alpha) << what;
    }

    static void expect_same_books(const std::vector<Codebook>& expected, std::span<const codec::Book> found,
                                  const std::string& what) {
        for (std::size_t stage = 0; stage < found.size(); ++stage) {
            ASSERT_EQ(stage < expected.size(), !found[stage].empty()) << what << ", stage " << stage;
            if (found[stage].empty()) continue;
            ASSERT_TRUE(
                std::ranges::equal(std::as_bytes(std::span(expected[stage])), std::as_bytes(std::span(found[stage]))))
                << what << ", stage " << stage;
        }
    }

    void expect_same_pict(const Payload& payload, const std::string& what) {
        Pict expected;
        const std::string error =
            read_pict(payload, stream_.width, stream_.height, static_cast<int>(view_), code_, expected);
        coded_.images[view_] = {};
        const Status status = codec::parse_coded_image(as_payload(payload), view_, coded_);
        ASSERT_EQ(error.empty(), status.ok())
            << "seed " << seed_ << ", PICT " << view_ << ", " << what << ": reference says '" << error << "', library '"
            << (status.ok() ? "" : status.error().message) << "'";
        ++(error.empty() ? tally_.accepted : tally_.refused);
        if (!error.empty()) return;
        const codec::CodedImage& found = coded_.images[view_];
        ASSERT_EQ(expected.step, found.head.step) << what;
        for (std::size_t r = 0; r < 2; ++r) {
            ASSERT_EQ(expected.reference[r], found.head.reference[r]) << what;
            ASSERT_EQ(expected.usual[r].x, found.head.global_motion[r].x) << what;
            ASSERT_EQ(expected.usual[r].y, found.head.global_motion[r].y) << what;
        }
        ASSERT_EQ(expected.tiles.size(), found.tiles.size()) << what;
        for (std::size_t t = 0; t < found.tiles.size(); ++t) {
            ASSERT_EQ(expected.tiles[t].has_value(), found.tiles[t].present) << what;
            if (!found.tiles[t].present) continue;
            ASSERT_TRUE(std::ranges::equal(std::as_bytes(*expected.tiles[t]), found.tile_bytes(t))) << what;
        }
    }

    // Tries every value of the byte, or of the two bytes from there on.
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
        const std::size_t head = 300;  // not every length is tried in the codebooks, which follow
        for (std::size_t size = 0; size < payload.size() + 4; ++size) {
            if (size > head && size + 20 < payload.size() && payload.size() > 4000 && size % 97 != 0) continue;
            Payload damaged = payload;
            damaged.resize(size);
            check(damaged, "cut or filled up to " + std::to_string(size) + " bytes");
            if (HasFatalFailure()) return;
        }
    }

    std::uint64_t seed_ = 0;
    Stream stream_;
    std::size_t view_ = 0;
    codec::CodedImages coded_;
    Code code_;
    Tally tally_;
};

inline std::string profile_name(const testing::TestParamInfo<Profile>& tested) {
    return tested.param == Profile::kBoard ? "Board" : "Dense";
}

}  // namespace rs::reference
