// Round trips through the dense encoder and the decoder.

#include "encode/codec/dense_encoder.hpp"
#include "encode/codec/quantise.hpp"
#include "encode/codec/search_kernels.hpp"
#include "encode/encode_images.hpp"
#include "rayspace/codec/bool_encoder.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/codec/stream/byte_account.hpp"
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/object/yuv.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <optional>
#include <random>

namespace rs::encode {
namespace {

const test::SmallObjectOptions kSmallDense{.views_per_ring = 11, .width = 150, .height = 90};

std::vector<std::byte> bytes_of(const codec::CodedImages& coded) {
    std::vector<std::byte> bytes = codec::code_payload(coded);
    for (std::size_t v = 0; v < coded.images.size(); ++v) {
        const auto payload = codec::coded_image_payload(coded, v);
        bytes.insert(bytes.end(), payload.begin(), payload.end());
    }
    return bytes;
}

double psnr_over_object(const std::vector<Image<Rgba8>>& truth, const RaySpaceObject& decoded) {
    double error = 0;
    double samples = 0;
    for (std::size_t v = 0; v < truth.size(); ++v) {
        const Image<Rgba8> shown = rgba_from_planar(decoded.images[v]);
        for (int y = 0; y < shown.height(); ++y) {
            for (int x = 0; x < shown.width(); ++x) {
                const Rgba8 a = truth[v](x, y);
                if (a.a < 128) continue;
                const Rgba8 b = shown(x, y);
                for (const int off : {a.r - b.r, a.g - b.g, a.b - b.b}) error += off * off;
                samples += 3;
            }
        }
    }
    return 10 * std::log10(255.0 * 255.0 * samples / error);
}

TEST(BoolCoder, ReadsBackWhatWasWritten) {
    std::mt19937 random(11);
    for (int round = 0; round < 300; ++round) {
        std::vector<std::pair<int, std::uint32_t>> bits;
        codec::BoolEncoder encoder;
        const int count = static_cast<int>(random() % 400);
        for (int i = 0; i < count; ++i) {
            const auto probability = static_cast<std::uint32_t>(round % 3 == 0 ? 4095 : 1 + random() % 4095);
            // Mostly likely bits, so that long carry chains occur.
            const int bit = random() % 4096 >= probability || random() % 50 == 0 ? 1 : 0;
            bits.emplace_back(bit, probability);
            encoder.bit(bit, probability);
        }
        const std::vector<std::byte> bytes = encoder.finish();
        codec::BoolDecoder decoder(bytes);
        for (std::size_t i = 0; i < bits.size(); ++i) {
            ASSERT_EQ(decoder.bit(bits[i].second), bits[i].first) << "round " << round << ", bit " << i;
        }
    }
}

TEST(BoolCoder, LikelyBitsCostLittle) {
    codec::BoolEncoder encoder;
    for (int i = 0; i < 8000; ++i) encoder.bit(0, 4080);
    EXPECT_LE(encoder.finish().size(), 8000 * 0.0057 / 8 + 2);
}

// Up to rounding, and to rows that are orthonormal to 0.1 % only.
TEST(Transform, TheInverseUndoesTheForward) {
    std::mt19937 random(5);
    for (const int size : {8, 16}) {
        for (int round = 0; round < 50; ++round) {
            std::vector<std::int16_t> residual(static_cast<std::size_t>(size * size));
            for (auto& r : residual) r = static_cast<std::int16_t>(static_cast<int>(random() % 161) - 80);
            std::vector<std::int32_t> coefficients(residual.size());
            forward_transform(residual.data(), size, coefficients.data());
            std::vector<std::int16_t> rounded(coefficients.begin(), coefficients.end());
            std::vector<std::int16_t> back(residual.size());
            codec::inverse_transform(rounded.data(), size, size, back.data());
            for (std::size_t i = 0; i < back.size(); ++i) ASSERT_NEAR(back[i], residual[i], 2);
        }
    }
}

TEST(Transform, FewerRowsAndColumnsGiveTheSame) {
    std::mt19937 random(6);
    for (const int size : {8, 16}) {
        for (int used = 1; used <= size; ++used) {
            std::vector<std::int16_t> coefficients(static_cast<std::size_t>(size * size));
            for (int v = 0; v < used; ++v) {
                for (int u = 0; u < used; ++u) {
                    coefficients[static_cast<std::size_t>(v * size + u)] =
                        static_cast<std::int16_t>(static_cast<int>(random() % 65536) - 32768);
                }
            }
            std::vector<std::int16_t> a(coefficients.size());
            std::vector<std::int16_t> b(coefficients.size());
            codec::inverse_transform(coefficients.data(), size, used, a.data());
            codec::inverse_transform(coefficients.data(), size, size, b.data());
            EXPECT_EQ(a, b) << size << ", " << used;
        }
    }
}

TEST(DenseEncoder, TheDecoderShowsWhatTheEncoderMeasured) {
    for (const auto& [step, bits] : {std::pair{3.0, 4}, std::pair{12.0, 6}, std::pair{30.0, 3}, std::pair{60.0, 5}}) {
        RaySpaceObject object = test::small_object(kSmallDense);
        const std::vector<Image<Rgba8>> images = test::drawn_images(object);
        DenseSettings settings;
        settings.step = step;
        settings.alpha_bits = bits;
        std::vector<SourceImage> sources;
        for (const auto& image : images) sources.push_back(source_image(image, bits));
        EncodedImages encoded = encode_dense(object, sources, settings);
        object.coded = std::make_shared<codec::CodedImages>(std::move(encoded.coded));
        codec::decode_images(object);
        // The encoder compares with its own Y, U, V, rounded once, where its own alpha is 128 or more.
        EXPECT_NEAR(psnr_over_object(images, object), encoded.psnr_db, 0.5) << step;
        for (std::size_t v = 0; v < images.size(); ++v) {
            for (int y = 0; y < object.height; ++y) {
                for (int x = 0; x < object.width; ++x) {
                    const int level = codec::level_of_alpha(images[v](x, y).a, bits);
                    ASSERT_EQ(object.images[v].a(x, y), codec::alpha_of_level(level, bits));
                }
            }
        }
    }
}

TEST(DenseEncoder, OneBitOfAlphaHasSoftEdges) {
    RaySpaceObject object = test::small_object(kSmallDense);
    const std::vector<Image<Rgba8>> images = test::drawn_images(object);
    DenseSettings settings;
    settings.alpha_bits = 1;
    object.coded = std::make_shared<codec::CodedImages>(test::code_images(object, images, settings));
    codec::decode_images(object);
    std::int64_t soft = 0;
    for (std::size_t v = 0; v < images.size(); ++v) {
        for (int y = 0; y < object.height; ++y) {
            for (int x = 0; x < object.width; ++x) {
                const int shown = object.images[v].a(x, y);
                ASSERT_EQ(shown >= 128, images[v](x, y).a >= 128) << v << ": " << x << ", " << y;
                soft += shown > 0 && shown < 255 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(soft, 0);
}

TEST(DenseEncoder, FinerStepsAreBetterAndLarger) {
    const RaySpaceObject object = test::small_object(kSmallDense);
    const std::vector<Image<Rgba8>> images = test::drawn_images(object);
    double last_db = 0;
    std::size_t last_bytes = 0;
    for (const double step : {64.0, 16.0, 4.0}) {
        DenseSettings settings;
        settings.step = step;
        RaySpaceObject coded = object;
        coded.coded = std::make_shared<codec::CodedImages>(test::code_images(object, images, settings));
        codec::decode_images(coded);
        const double db = psnr_over_object(images, coded);
        const std::size_t bytes = bytes_of(*coded.coded).size();
        EXPECT_GT(db, last_db + 3) << step;
        EXPECT_GT(bytes, last_bytes) << step;
        last_db = db;
        last_bytes = bytes;
    }
    EXPECT_GT(last_db, 40);
}

TEST(DenseEncoder, PredictionFromOtherImagesPays) {
    // The same image in every view: all images except references take almost no bytes.
    const RaySpaceObject object = test::small_object(kSmallDense);
    const std::vector<Image<Rgba8>> still(object.views.size(), test::drawn_images(object)[0]);
    const codec::CodedImages coded = test::code_images(object, still, {});
    ASSERT_EQ(coded.levels[0], 0);
    ASSERT_EQ(coded.levels[1], 3);
    EXPECT_LT(10 * coded.images[1].bytes.size(), coded.images[0].bytes.size());
}

TEST(DenseEncoder, AnyNumberOfThreadsGivesTheSameBytes) {
    const RaySpaceObject object = test::small_object(kSmallDense);
    const std::vector<Image<Rgba8>> images = test::drawn_images(object);
    std::vector<std::vector<std::byte>> results;
    for (const std::size_t threads : {1, 2, 4}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(bytes_of(test::code_images(object, images, {})));
    }
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
}

TEST(DenseEncoder, OddSizesOneViewAndNothingToSee) {
    for (const auto& [width, height, views] : {std::array{1, 1, 1}, {17, 33, 2}, {63, 65, 3}, {70, 16, 9}}) {
        test::SmallObjectOptions options{.views_per_ring = views, .width = width, .height = height};
        RaySpaceObject object = test::coded_object(options, {});
        codec::decode_images(object);
        EXPECT_EQ(object.images[0].y.width(), width);
    }
    RaySpaceObject empty = test::small_object({.views_per_ring = 3, .width = 40, .height = 40});
    const std::vector<Image<Rgba8>> nothing(3, Image<Rgba8>(40, 40));
    empty.coded = std::make_shared<codec::CodedImages>(test::code_images(empty, nothing, {}));
    codec::decode_images(empty);
    EXPECT_EQ(rgba_from_planar(empty.images[1]), nothing[1]);
}

TEST(ByteAccount, AddsUpToTheChunks) {
    const RaySpaceObject object = test::coded_object(kSmallDense, {});
    const auto entries = codec::account_bytes(*object.coded);
    double sum = 0;
    double rounding = 1e9;
    for (const codec::AccountEntry& entry : entries) {
        if (entry.name[0] != '(') sum += entry.bytes;
        if (entry.name == "tiles' rounding") rounding = entry.bytes;
    }
    double chunks = 0;
    double tiles = 0;
    for (std::size_t v = 0; v < object.coded->images.size(); ++v) {
        chunks += static_cast<double>(codec::coded_image_payload(*object.coded, v).size());
        for (const auto& tile : object.coded->images[v].tiles) tiles += tile.present ? 1 : 0;
    }
    EXPECT_NEAR(sum, chunks, 1e-6);
    // Information content and bytes agree to about one byte per tile.
    EXPECT_LT(std::abs(rounding), 1.5 * tiles);
}

class Goals : public testing::Test {
protected:
    void SetUp() override {
        rig_ = make_ring({.count = 9, .fl_px = 120, .width = 96, .height = 80});
        rig_.object_radius = 0.9;
        test::write_drawn_set(work_ / "set", rig_);
        Result<CaptureSet> set = open_capture_set(work_ / "set");
        ASSERT_TRUE(set.ok()) << set.error().message;
        set_ = std::move(*set);
        object_ = test::small_object({.views_per_ring = 9, .width = 96, .height = 80});
    }
    Result<EncodedImages> encode(const ImageGoal& goal, std::optional<int> alpha_bits = 2) const {
        return encode_images(set_, object_, goal, alpha_bits);
    }

    test::TemporaryFolder work_;
    Rig rig_;
    CaptureSet set_;
    RaySpaceObject object_;
};

TEST_F(Goals, FidelityIsReachedAndNotFarExceeded) {
    for (const double wanted : {28.0, 35.0}) {
        ImageGoal goal;
        goal.psnr_db = wanted;
        const auto encoded = encode(goal);
        ASSERT_TRUE(encoded.ok()) << encoded.error().message;
        EXPECT_GE(encoded->psnr_db, wanted);
        EXPECT_LE(encoded->psnr_db, wanted + 1.5);
    }
}

TEST_F(Goals, FineColoursHaveFineEdges) {
    ImageGoal goal;
    for (const double wanted : {30.9, 31.0}) {
        goal.psnr_db = wanted;
        const auto encoded = encode(goal, std::nullopt);
        ASSERT_TRUE(encoded.ok()) << encoded.error().message;
        EXPECT_EQ(encoded->coded.dense.alpha_bits, wanted < 31 ? 1 : 2) << wanted;
    }
    const auto asked = encode(goal, 1);
    ASSERT_TRUE(asked.ok()) << asked.error().message;
    EXPECT_EQ(asked->coded.dense.alpha_bits, 1);
}

// The drawn object over a background whose alpha decreases to both sides.
Image<Rgba8> drawn_over_shadow(const Camera& camera) {
    Image<Rgba8> image = test::draw_image(camera);
    for (int y = 60; y < 78; ++y) {
        for (int x = 20; x < 80; ++x) {
            Rgba8& pixel = image(x, y);
            if (pixel.a == 0) pixel = {0, 0, 0, static_cast<std::uint8_t>(150 - 4 * std::abs(x - 50))};
        }
    }
    return image;
}

TEST_F(Goals, SoftShadowsHaveManyLevels) {
    test::write_drawn_set(work_ / "soft", rig_, drawn_over_shadow);
    const Result<CaptureSet> set = open_capture_set(work_ / "soft");
    ASSERT_TRUE(set.ok()) << set.error().message;
    const auto bits = [&](ImageGoal goal, std::optional<int> asked = {}) {
        const auto encoded = encode_images(*set, object_, goal, asked);
        EXPECT_TRUE(encoded.ok()) << encoded.error().message;
        return encoded->coded.dense.alpha_bits;
    };
    ImageGoal coarse;
    coarse.quality = 30;
    EXPECT_EQ(bits({}), 6);
    EXPECT_EQ(bits(coarse), 6);
    EXPECT_EQ(bits({}, 3), 3);
}

TEST_F(Goals, SizeIsKeptAndUsed) {
    ImageGoal goal;
    goal.images_bytes = 4000;
    const auto encoded = encode(goal);
    ASSERT_TRUE(encoded.ok()) << encoded.error().message;
    EXPECT_LE(count_coded_bytes(encoded->coded), 4000U);
    EXPECT_GE(count_coded_bytes(encoded->coded), 3000U);
}

TEST_F(Goals, WhatCannotBeReachedIsSaid) {
    ImageGoal goal;
    goal.images_bytes = 100;
    const auto small = encode(goal);
    ASSERT_FALSE(small.ok());
    EXPECT_NE(small.error().message.find("--size"), std::string::npos);
    goal = {};
    goal.psnr_db = 59.9;
    const auto fine = encode(goal);
    ASSERT_FALSE(fine.ok());
    EXPECT_NE(fine.error().message.find("--psnr"), std::string::npos);
}

}  // namespace
}  // namespace rs::encode
