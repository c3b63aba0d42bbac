// Compares the library's decoder with the reference decoder written from encode/FORMAT.md, on encoder output and on
// random bytes.

#include "tests/reference/decoder/reference_decoder.hpp"

#include "encode/codec/board/board_encoder.hpp"
#include "encode/codec/dense_encoder.hpp"
#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "tests/reference/library_tiles.hpp"
#include "tests/reference/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <numeric>

namespace rs::reference {
namespace {

// The first of width x height samples that differs; "" if none does.
std::string difference(const DecodedImage& expected, std::size_t plane, const Image<std::uint8_t>& found, int width,
                       int height) {
    if (found.width() < width || found.height() < height) return "a plane is too small";
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int e = expected.planes[plane][static_cast<std::size_t>(y * expected.width + x)];
            if (found(x, y) == e) continue;
            return "plane " + std::to_string(plane) + ", sample (" + std::to_string(x) + ", " + std::to_string(y) +
                   "): reference " + std::to_string(e) + ", library " + std::to_string(found(x, y));
        }
    }
    return "";
}

void expect_same(const Images& expected, const codec::CodedImages& coded) {
    const std::vector<LibraryPlanes> found = decode_by_tiles(coded);
    ASSERT_EQ(expected.views.size(), found.size());
    for (std::size_t v = 0; v < found.size(); ++v) {
        const DecodedImage& image = expected.views[v];
        ASSERT_EQ(image.width, coded.coded_width());
        ASSERT_EQ(image.height, coded.coded_height());
        for (std::size_t p = 0; p < 4; ++p) {
            ASSERT_EQ(difference(image, p, found[v][p], image.width, image.height), "") << "view " << v;
        }
    }
}

std::vector<std::uint8_t> as_numbers(const std::vector<std::byte>& payload) {
    std::vector<std::uint8_t> numbers;
    for (const std::byte byte : payload) numbers.push_back(std::to_integer<std::uint8_t>(byte));
    return numbers;
}

Stream stream_of(const codec::CodedImages& coded) {
    Stream stream = {coded.width, coded.height, as_numbers(codec::code_payload(coded)), {}};
    for (std::size_t v = 0; v < coded.images.size(); ++v) {
        stream.picts.push_back(as_numbers(codec::coded_image_payload(coded, v)));
    }
    return stream;
}

// Textured, coloured blobs with soft edges on a transparent background, which move with the view.
Image<Rgba8> blobs(int width, int height, int view) {
    Image<Rgba8> image(width, height);
    const auto byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double across = x - 1.7 * view;
            const double first = std::hypot(across - 0.45 * width, y - 0.4 * height) / (0.3 * width);
            const double second = std::hypot(x + 0.9 * view - 0.7 * width, y - 0.7 * height) / (0.22 * height);
            const double inside = std::max(1 - first, 1 - second);
            image(x, y) = {byte(120 + 80 * std::sin(across * 0.3) + 30 * std::cos(y * 0.9)),
                           byte(90 + 90 * std::cos(y * 0.2 + 0.1 * view)),
                           byte(first < second ? 200 - 60 * first : 60 + 50 * std::sin(across * y * 0.02)),
                           byte(128 + 900 * inside)};
        }
    }
    return image;
}

struct EncodedCase {
    int width, height, views, alpha_bits, tile_width_log2, tile_height_log2;
    double step;
    Profile profile = Profile::kDense;
};

codec::CodedImages encoded(const RaySpaceObject& object, const EncodedCase& c) {
    if (c.profile == Profile::kBoard) {
        encode::BoardSettings settings;
        settings.step = c.step;
        settings.alpha_bits = c.alpha_bits;
        std::vector<encode::SourceImage> sources;
        for (int v = 0; v < c.views; ++v) {
            sources.push_back(encode::source_image(blobs(c.width, c.height, v).view(), c.alpha_bits));
        }
        return encode::encode_board(object, sources, settings).coded;
    }
    encode::DenseSettings settings;
    settings.step = c.step;
    settings.alpha_bits = c.alpha_bits;
    settings.tile_width_log2 = c.tile_width_log2;
    settings.tile_height_log2 = c.tile_height_log2;
    return encode::encode_dense(
        object, [&](int view) { return blobs(c.width, c.height, view); }, settings);
}

class EncodedObject : public testing::TestWithParam<EncodedCase> {};

TEST_P(EncodedObject, IsTheSameByBothDecoders) {
    const EncodedCase& c = GetParam();
    RaySpaceObject object;
    object.width = c.width;
    object.height = c.height;
    object.views.resize(static_cast<std::size_t>(c.views));
    object.images.resize(object.views.size());
    object.rings.resize(1);
    object.rings[0].views.resize(object.views.size());
    std::iota(object.rings[0].views.begin(), object.rings[0].views.end(), std::uint16_t{0});
    const codec::CodedImages written = encoded(object, c);

    const Stream stream = stream_of(written);
    const Images expected = decode_reference(stream.width, stream.height, stream.code, stream.picts);
    ASSERT_EQ(expected.error, "");
    codec::CodedImages coded;
    ASSERT_EQ(parse_stream(stream, coded), "");
    expect_same(expected, coded);

    object.coded = std::make_shared<const codec::CodedImages>(coded);
    codec::decode_images(object);
    for (std::size_t v = 0; v < object.images.size(); ++v) {
        const PlanarImage& image = object.images[v];
        const Image<std::uint8_t>* const planes[4] = {&image.y, &image.u, &image.v, &image.a};
        for (std::size_t p = 0; p < 4; ++p) {
            ASSERT_EQ(difference(expected.views[v], p, *planes[p], c.width, c.height), "") << "view " << v;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Blobs, EncodedObject,
                         testing::Values(EncodedCase{70, 50, 9, 1, 4, 5, 2}, EncodedCase{128, 96, 12, 2, 6, 6, 12},
                                         EncodedCase{97, 33, 10, 4, 5, 4, 60}, EncodedCase{64, 64, 9, 3, 6, 4, 20},
                                         EncodedCase{97, 70, 12, 2, 5, 5, 12, Profile::kBoard},
                                         EncodedCase{33, 49, 5, 4, 5, 5, 40, Profile::kBoard}));

// Length of the longest chain of references.
int longest_chain(const Stream& stream, const codec::CodedImages& coded) {
    std::vector<int> chain(stream.picts.size(), 0);
    for (int level = 0; level < kProgressiveLevels; ++level) {
        for (std::size_t v = 0; v < chain.size(); ++v) {
            if (coded.levels[v] != level) continue;
            const codec::ImageHead& head = coded.images[v].head;
            for (std::size_t r = 0; r < static_cast<std::size_t>(head.references()); ++r) {
                chain[v] = std::max(chain[v], chain[head.reference[r]] + 1);
            }
        }
    }
    return *std::ranges::max_element(chain);
}

class RandomStreams : public testing::TestWithParam<Profile> {};

// For a longer run: RAYSPACE_RANDOM_STREAMS=20000.
TEST_P(RandomStreams, AreTheSameByBothDecoders) {
    const char* const wanted = std::getenv("RAYSPACE_RANDOM_STREAMS");
    const std::uint64_t streams = wanted != nullptr ? std::stoull(wanted) : 1500;
    ASSERT_GE(streams, 100U);
    std::size_t samples = 0;
    std::size_t telling = 0;                           // samples outside of empty tiles, not saturated
    std::array<std::size_t, 3> images = {0, 0, 0};     // [references]
    std::array<std::size_t, 4> chains = {0, 0, 0, 0};  // [longest chain of a stream]
    for (std::uint64_t seed = 1; seed <= streams; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Stream stream = random_stream(seed, GetParam());
        const Images expected = decode_reference(stream.width, stream.height, stream.code, stream.picts);
        ASSERT_EQ(expected.error, "");
        codec::CodedImages coded;
        ASSERT_EQ(parse_stream(stream, coded), "");
        ASSERT_NO_FATAL_FAILURE(expect_same(expected, coded));
        for (const DecodedImage& image : expected.views) {
            samples += image.planes[0].size();
            telling += static_cast<std::size_t>(
                std::ranges::count_if(image.planes[0], [](std::uint8_t s) { return s != 0 && s != 128 && s != 255; }));
        }
        for (const codec::CodedImage& image : coded.images) {
            ++images[static_cast<std::size_t>(image.head.references())];
        }
        ++chains[static_cast<std::size_t>(longest_chain(stream, coded))];
    }
    std::cout << streams << " random streams, " << samples << " samples of each plane, " << telling
              << " of Y neither 0, 128 nor 255; images with 0, 1, 2 references: " << images[0] << ", " << images[1]
              << ", " << images[2] << "; streams with chains of 0, 1, 2, 3: " << chains[0] << ", " << chains[1] << ", "
              << chains[2] << ", " << chains[3] << "\n";
    EXPECT_GT(telling, samples / 4);
    for (const std::size_t count : images) EXPECT_GT(count, streams / 8);
    EXPECT_GT(chains[3], streams / 50);
}

INSTANTIATE_TEST_SUITE_P(Profiles, RandomStreams, testing::Values(Profile::kDense, Profile::kBoard),
                         [](const testing::TestParamInfo<Profile>& tested) {
                             return tested.param == Profile::kBoard ? "Board" : "Dense";
                         });

}  // namespace
}  // namespace rs::reference
