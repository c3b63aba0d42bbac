// Board profile: the decoder returns the encoder's reconstruction for any number of threads; codebooks are trained;
// records use only their class's fields.

#include "encode/codec/board/board_encoder.hpp"
#include "encode/codec/board/board_block.hpp"
#include "encode/codec/board/vector_quantiser.hpp"
#include "rayspace/codec/board/board_profile.hpp"
#include "rayspace/codec/stream/byte_account.hpp"
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <random>

namespace rs::encode {
namespace {

const test::SmallObjectOptions kSmallBoard{.views_per_ring = 18, .width = 72, .height = 60};

RaySpaceObject board_object(const BoardSettings& settings, double* psnr_db = nullptr) {
    RaySpaceObject object = test::small_object(kSmallBoard);
    for (PlanarImage& image : object.images) image = {};
    std::vector<SourceImage> sources;
    for (const Image<Rgba8>& image : test::drawn_images(object)) {
        sources.push_back(source_image(image, settings.alpha_bits));
    }
    EncodedImages encoded = encode_board(object, sources, settings);
    if (psnr_db != nullptr) *psnr_db = encoded.psnr_db;
    object.coded = std::make_shared<codec::CodedImages>(std::move(encoded.coded));
    return object;
}

std::vector<std::vector<std::byte>> payloads_of(const codec::CodedImages& coded) {
    std::vector<std::vector<std::byte>> payloads = {codec::code_payload(coded)};
    for (std::size_t v = 0; v < coded.images.size(); ++v) payloads.push_back(codec::coded_image_payload(coded, v));
    return payloads;
}

std::size_t record_bytes(const codec::CodedImages& coded) {
    std::size_t bytes = 0;
    for (const codec::CodedImage& image : coded.images) bytes += image.bytes.size();
    return bytes;
}

// PSNR of the decoded file against the drawn images.
double file_psnr(const std::filesystem::path& file) {
    const auto object = read_object(file);
    EXPECT_TRUE(object.ok()) << object.error().message;
    const std::vector<Image<Rgba8>> drawn = test::drawn_images(*object);
    double error = 0;
    double samples = 0;
    for (std::size_t v = 0; v < drawn.size(); ++v) {
        const PlanarImage& shown = object->images[v];
        for (int y = 0; y < object->height; ++y) {
            for (int x = 0; x < object->width; ++x) {
                const Rgba8 expected = drawn[v](x, y);
                if (expected.a < 128) continue;
                error += std::pow(0.299 * expected.r + 0.587 * expected.g + 0.114 * expected.b - shown.y(x, y), 2);
                samples += 1;
            }
        }
    }
    return 10 * std::log10(65025 * samples / error);
}

TEST(BoardEncoder, WhatTheFileShowsIsNearTheSource) {
    const test::TemporaryFolder work;
    double fine_db = 0;
    const RaySpaceObject fine = board_object({.step = 4}, &fine_db);
    ASSERT_TRUE(write_object(work / "fine.rso", fine).ok());
    const double found_db = file_psnr(work / "fine.rso");
    EXPECT_GT(found_db, 30);
    EXPECT_GT(found_db, fine_db - 0.5);  // Y is more accurate than R, G and B together
    double coarse_db = 0;
    const RaySpaceObject coarse = board_object({.step = 80}, &coarse_db);
    EXPECT_LT(coarse_db, fine_db - 1);
    ASSERT_TRUE(write_object(work / "coarse.rso", coarse).ok());
    EXPECT_LT(record_bytes(*coarse.coded), record_bytes(*fine.coded));
    EXPECT_LT(file_psnr(work / "coarse.rso"), found_db);
}

TEST(BoardEncoder, IsTheSameOnAnyNumberOfThreads) {
    std::vector<std::vector<std::byte>> expected;
    for (const int threads : {1, 2, 4}) {
        tbb::task_arena arena(threads);
        const auto payloads = arena.execute([] { return payloads_of(*board_object({.step = 10}).coded); });
        if (expected.empty()) expected = payloads;
        EXPECT_EQ(payloads, expected) << threads;
    }
}

TEST(BoardEncoder, OneImageInNineIsAReferenceAndTheOthersNeedNoMore) {
    const RaySpaceObject object = board_object({.step = 10});
    int references = 0;
    for (std::size_t v = 0; v < object.views.size(); ++v) {
        const codec::ImageHead& head = object.coded->images[v].head;
        if (head.references() == 0) {
            ++references;
            EXPECT_EQ(object.coded->levels[v], 0);
        }
        for (int r = 0; r < head.references(); ++r) {
            EXPECT_EQ(object.coded->images[head.reference[static_cast<std::size_t>(r)]].head.references(), 0);
        }
    }
    EXPECT_EQ(references, 2);
}

TEST(BoardEncoder, AccountsForEveryByte) {
    const RaySpaceObject object = board_object({.step = 10});
    double bytes = 0;
    for (const codec::AccountEntry& entry : codec::account_bytes(*object.coded)) {
        if (entry.name.front() != '(') bytes += entry.bytes;
    }
    double expected = 0;
    for (std::size_t v = 0; v < object.views.size(); ++v) {
        expected += static_cast<double>(codec::coded_image_payload(*object.coded, v).size());
    }
    EXPECT_DOUBLE_EQ(bytes, expected);
}

TEST(BoardMotion, WordsAndVectorsAreEachOthersInverse) {
    for (unsigned word = 0; word < 65536; ++word) {
        const codec::BoardMotion motion = codec::board_motion(static_cast<std::uint16_t>(word));
        EXPECT_GE(motion.x, -128);
        EXPECT_LE(motion.x, 127);
        EXPECT_GE(motion.y, -64);
        EXPECT_LE(motion.y, 63);
        ASSERT_EQ(codec::board_motion_word(motion), word);
    }
}

TEST(RecordClasses, HaveEvenSizes) {
    EXPECT_EQ((codec::RecordClass{true, false, 0, 0}).bytes(), 2);
    EXPECT_EQ((codec::RecordClass{false, false, 0, 0}).bytes(), 4);
    EXPECT_EQ((codec::RecordClass{false, true, 1, 1}).bytes(), 12);
    EXPECT_EQ((codec::RecordClass{false, true, 2, 4}).bytes(), 26);
    EXPECT_EQ((codec::RecordClass{true, false, 1, 2}).bytes(), 12);
}

// Vectors about a few centres, some components without weight.
TEST(VectorQuantiser, FindsCentresAndIgnoresWhatDoesNotMatter) {
    std::mt19937 random(5);
    WeightedVectors vectors;
    vectors.dimensions = 16;
    std::vector<std::array<int, 16>> centres(8);
    for (auto& centre : centres) {
        for (int& c : centre) c = static_cast<int>(random() % 200) - 100;
    }
    for (int i = 0; i < 4000; ++i) {
        const auto& centre = centres[static_cast<std::size_t>(i) % centres.size()];
        const WeightedVectors::Place place = vectors.add();
        for (std::size_t d = 0; d < 16; ++d) {
            const bool valid = random() % 4 != 0;
            place.weights[d] = valid ? 6 : 0;
            place.values[d] = static_cast<std::int16_t>(valid ? centre[d] + static_cast<int>(random() % 5) - 2
                                                              : static_cast<int>(random() % 400) - 200);
        }
    }
    const Codebook book = train_codebook(vectors, 32);
    ASSERT_EQ(book.count(), 32U);
    for (std::size_t d = 0; d < 16; ++d) EXPECT_EQ(book.entries[d], 0);
    for (const auto& centre : centres) {
        std::int16_t values[16];
        const std::int16_t weights[16] = {6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6};
        for (std::size_t d = 0; d < 16; ++d) values[d] = static_cast<std::int16_t>(centre[d]);
        EXPECT_LE(find_nearest_entry(book, values, weights).distance, 6 * 16 * 2);
    }
}

TEST(VectorQuantiser, NearestIsTheFirstOfTheNearest) {
    std::mt19937 random(6);
    Codebook book;
    book.dimensions = 96;
    for (int i = 0; i < 96 * 64; ++i)
        book.entries.push_back(static_cast<std::int16_t>(static_cast<int>(random() % 7) - 3));
    book.entries.insert(book.entries.end(), book.entries.begin(), book.entries.end());  // every entry twice
    for (int round = 0; round < 200; ++round) {
        std::int16_t values[96];
        std::int16_t weights[96];
        for (int d = 0; d < 96; ++d) {
            values[d] = static_cast<std::int16_t>(static_cast<int>(random() % 2048) - 1024);
            weights[d] = static_cast<std::int16_t>(random() % 29);
        }
        std::size_t best = 0;
        std::int64_t best_distance = -1;
        for (std::size_t e = 0; e < 128; ++e) {
            std::int64_t distance = 0;
            for (std::size_t d = 0; d < 96; ++d) {
                const std::int64_t off = values[d] - book.entries[e * 96 + d];
                distance += weights[d] * off * off;
            }
            if (best_distance < 0 || distance < best_distance) {
                best = e;
                best_distance = distance;
            }
        }
        const Nearest found = find_nearest_entry(book, values, weights);
        EXPECT_EQ(found.index, best);
        EXPECT_EQ(found.distance, best_distance);
    }
}

}  // namespace
}  // namespace rs::encode
