// The codebooks' frame in CODE of board images: both readers accept and reject the same ones.

#include "tests/reference/damaged_payload.hpp"

#include <zstd.h>

namespace rs::reference {
namespace {

class DamagedCodebooks : public DamagedPayload {
protected:
    // CODE with one class and its whole codebook from the payload, and these bytes as the frame.
    void judge(int record, const Payload& frame, bool is_valid, const std::string& what) {
        Payload payload(stream_.code.begin(), stream_.code.begin() + 8 + views());
        payload.resize(payload.size() + 14);
        payload[payload.size() - 1] = static_cast<std::uint8_t>(record);
        payload.insert(payload.end(), frame.begin(), frame.end());
        Code code;
        EXPECT_EQ(read_code(payload, views(), code).empty(), is_valid) << what;
        expect_same_code(payload, what);
    }

    static Payload frame_of(std::size_t bytes, bool has_checksum, bool states_size) {
        ZSTD_CCtx* const context = ZSTD_createCCtx();
        ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, has_checksum ? 1 : 0);
        ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, states_size ? 1 : 0);
        Payload content(bytes);
        for (std::size_t i = 0; i < bytes; ++i) content[i] = static_cast<std::uint8_t>(i % 251);
        Payload frame(ZSTD_compressBound(bytes));
        frame.resize(ZSTD_compress2(context, frame.data(), frame.size(), content.data(), bytes));
        ZSTD_freeCCtx(context);
        return frame;
    }
};

// "A frame that is not one whole frame of the size that the classes ask for"
TEST_P(DamagedCodebooks, AreJudgedTheSame) {
    constexpr int kAlpha = 2, kBlock = 4, kQuarter = 16, kPredicted = 1;
    constexpr std::size_t kAlphaBytes = 4096, kBlockBytes = 24576, kQuarterBytes = 12288;
    const Payload right = frame_of(kAlphaBytes, false, true);
    judge(kAlpha, right, true, "right");
    judge(kAlpha, frame_of(kAlphaBytes, true, true), true, "with a checksum");
    judge(kPredicted + kBlock + kQuarter + kAlpha, frame_of(kAlphaBytes + kBlockBytes + kQuarterBytes, false, true),
          true, "of three codebooks");
    judge(2 * kBlock + 4 * kQuarter, frame_of(2 * kBlockBytes + 4 * kQuarterBytes, false, true), true, "of all stages");
    judge(0, {}, true, "of no codebook");

    judge(0, frame_of(0, false, true), false, "a frame of nothing");
    judge(0, right, false, "a frame, but no codebook is used");
    judge(kAlpha, {}, false, "no frame");
    judge(kAlpha, frame_of(kAlphaBytes, false, false), false, "no size stated");
    judge(kAlpha, frame_of(kAlphaBytes - 1, false, true), false, "one byte too few");
    judge(kAlpha, frame_of(kAlphaBytes + 1, false, true), false, "one byte too many");
    judge(kBlock, frame_of(kQuarterBytes, false, true), false, "another codebook's size");
    judge(3 * kBlock, frame_of(3 * kBlockBytes, false, true), false, "three block stages");
    judge(5 * kQuarter, frame_of(5 * kQuarterBytes, false, true), false, "five quarter stages");

    const Payload skippable = {0x50, 0x2A, 0x4D, 0x18, 1, 0, 0, 0, 7};
    const auto joined = [](Payload first, const Payload& second) {
        first.insert(first.end(), second.begin(), second.end());
        return first;
    };
    judge(kAlpha, joined(right, right), false, "two frames");
    judge(kAlpha, joined(right, {0}), false, "a byte behind the frame");
    judge(kAlpha, joined(skippable, right), false, "a skippable frame before it");
    judge(kAlpha, joined(right, skippable), false, "a skippable frame behind it");
    judge(kAlpha, joined(frame_of(kAlphaBytes / 2, false, true), frame_of(kAlphaBytes / 2, false, true)), false,
          "two frames of half the size");
    judge(kAlpha, Payload(right.begin(), right.end() - 1), false, "cut off");
    Payload wrong_sum = frame_of(kAlphaBytes, true, true);
    wrong_sum.back() = static_cast<std::uint8_t>(wrong_sum.back() ^ 1);
    judge(kAlpha, wrong_sum, false, "a wrong checksum of its content");
    Payload dictionary = right;
    dictionary[4] = static_cast<std::uint8_t>(dictionary[4] | 1);  // a dictionary ID of one byte follows
    const std::ptrdiff_t number_at = (right[4] & 0x20) != 0 ? 5 : 6;
    dictionary.insert(dictionary.begin() + number_at, 9);
    judge(kAlpha, dictionary, false, "a dictionary");
}

INSTANTIATE_TEST_SUITE_P(Profiles, DamagedCodebooks, testing::Values(Profile::kBoard), profile_name);

}  // namespace
}  // namespace rs::reference
