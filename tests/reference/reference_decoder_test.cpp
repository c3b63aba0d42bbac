// Two decoders of coded pictures, the library's and the one written from encode/FORMAT.md, give the same samples: of
// what the encoder writes, and of random bytes.

#include "tests/reference/reference_decoder.hpp"

#include "encode/codec/dense_encoder.hpp"
#include "rayspace/codec/coded_chunks.hpp"
#include "rayspace/codec/decode_picture.hpp"
#include "tests/reference/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numeric>

namespace rs::reference {
namespace {

using Planes = std::array<Image<std::uint8_t>, 4>;

// Every tile by decode_tile(), into planes that hold something else before.
std::vector<Planes> decode_by_tiles(const codec::CodedPictures& coded) {
    std::vector<Planes> decoded(coded.pictures.size());
    for (auto& planes : decoded) {
        for (auto& plane : planes) plane = Image<std::uint8_t>(coded.coded_width(), coded.coded_height(), 77);
    }
    const auto views_of = [](auto& planes) {
        return codec::PlaneViews{planes[0].view(), planes[1].view(), planes[2].view(), planes[3].view()};
    };
    for (int level = 0; level < kProgressiveLevels; ++level) {
        for (std::size_t v = 0; v < decoded.size(); ++v) {
            if (coded.levels[v] != level) continue;
            const codec::CodedPicture& picture = coded.pictures[v];
            std::array<codec::ConstPlaneViews, 2> references;
            for (std::size_t r = 0; r < static_cast<std::size_t>(picture.head.references()); ++r) {
                std::ranges::copy(views_of(decoded[picture.head.reference[r]]), references[r].begin());
            }
            for (std::size_t t = 0; t < picture.tiles.size(); ++t) {
                codec::decode_tile(coded, v, t, references, nullptr, views_of(decoded[v]));
            }
        }
    }
    return decoded;
}

// The first sample of width x height in which the planes differ; "" for none.
std::string difference(const Picture& expected, std::size_t plane, const Image<std::uint8_t>& found, int width,
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

void expect_same(const Pictures& expected, const codec::CodedPictures& coded) {
    const std::vector<Planes> found = decode_by_tiles(coded);
    ASSERT_EQ(expected.views.size(), found.size());
    for (std::size_t v = 0; v < found.size(); ++v) {
        const Picture& picture = expected.views[v];
        ASSERT_EQ(picture.width, coded.coded_width());
        ASSERT_EQ(picture.height, coded.coded_height());
        for (std::size_t p = 0; p < 4; ++p) {
            ASSERT_EQ(difference(picture, p, found[v][p], picture.width, picture.height), "") << "view " << v;
        }
    }
}

std::vector<std::uint8_t> as_numbers(const std::vector<std::byte>& payload) {
    std::vector<std::uint8_t> numbers;
    for (const std::byte byte : payload) numbers.push_back(std::to_integer<std::uint8_t>(byte));
    return numbers;
}

Stream stream_of(const codec::CodedPictures& coded) {
    Stream stream = {coded.width, coded.height, as_numbers(codec::code_payload(coded)), {}};
    for (std::size_t v = 0; v < coded.pictures.size(); ++v) {
        stream.picts.push_back(as_numbers(codec::coded_picture_payload(coded, v)));
    }
    return stream;
}

// Coloured blobs with a soft rim before nothing, and a texture on them, that move with the view.
Image<Rgba8> blobs(int width, int height, int view) {
    Image<Rgba8> picture(width, height);
    const auto byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double across = x - 1.7 * view;
            const double first = std::hypot(across - 0.45 * width, y - 0.4 * height) / (0.3 * width);
            const double second = std::hypot(x + 0.9 * view - 0.7 * width, y - 0.7 * height) / (0.22 * height);
            const double inside = std::max(1 - first, 1 - second);
            picture(x, y) = {byte(120 + 80 * std::sin(across * 0.3) + 30 * std::cos(y * 0.9)),
                             byte(90 + 90 * std::cos(y * 0.2 + 0.1 * view)),
                             byte(first < second ? 200 - 60 * first : 60 + 50 * std::sin(across * y * 0.02)),
                             byte(128 + 900 * inside)};
        }
    }
    return picture;
}

struct EncodedCase {
    int width, height, views, alpha_bits, tile_width_log2, tile_height_log2;
    double step;
};

class EncodedObject : public testing::TestWithParam<EncodedCase> {};

TEST_P(EncodedObject, IsTheSameByBothDecoders) {
    const EncodedCase& c = GetParam();
    RaySpaceObject object;
    object.width = c.width;
    object.height = c.height;
    object.views.resize(static_cast<std::size_t>(c.views));
    object.pictures.resize(object.views.size());
    object.rings.resize(1);
    object.rings[0].views.resize(object.views.size());
    std::iota(object.rings[0].views.begin(), object.rings[0].views.end(), std::uint16_t{0});
    encode::DenseSettings settings;
    settings.step = c.step;
    settings.alpha_bits = c.alpha_bits;
    settings.tile_width_log2 = c.tile_width_log2;
    settings.tile_height_log2 = c.tile_height_log2;
    const codec::CodedPictures written = encode::encode_dense(
        object, [&](int view) { return blobs(c.width, c.height, view); }, settings);

    const Stream stream = stream_of(written);
    const Pictures expected = decode_reference(stream.width, stream.height, stream.code, stream.picts);
    ASSERT_EQ(expected.error, "");
    codec::CodedPictures coded;
    ASSERT_EQ(parse_stream(stream, coded), "");
    expect_same(expected, coded);

    object.coded = std::make_shared<const codec::CodedPictures>(coded);
    codec::decode_pictures(object);
    for (std::size_t v = 0; v < object.pictures.size(); ++v) {
        const PlanarPicture& picture = object.pictures[v];
        const Image<std::uint8_t>* const planes[4] = {&picture.y, &picture.u, &picture.v, &picture.a};
        for (std::size_t p = 0; p < 4; ++p) {
            ASSERT_EQ(difference(expected.views[v], p, *planes[p], c.width, c.height), "") << "view " << v;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Blobs, EncodedObject,
                         testing::Values(EncodedCase{70, 50, 9, 1, 4, 5, 2}, EncodedCase{128, 96, 12, 2, 6, 6, 12},
                                         EncodedCase{97, 33, 10, 4, 5, 4, 60}, EncodedCase{64, 64, 9, 3, 6, 4, 20}));

TEST(RandomStreams, AreTheSameByBothDecoders) {
    constexpr std::uint64_t kStreams = 1500;
    std::size_t samples = 0;
    std::size_t telling = 0;  // neither an empty tile's nor at the end of the range
    for (std::uint64_t seed = 1; seed <= kStreams; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Stream stream = random_stream(seed);
        const Pictures expected = decode_reference(stream.width, stream.height, stream.code, stream.picts);
        ASSERT_EQ(expected.error, "");
        codec::CodedPictures coded;
        ASSERT_EQ(parse_stream(stream, coded), "");
        expect_same(expected, coded);
        if (HasFatalFailure()) return;
        for (const Picture& picture : expected.views) {
            samples += picture.planes[0].size();
            telling += static_cast<std::size_t>(std::ranges::count_if(
                picture.planes[0], [](std::uint8_t s) { return s != 0 && s != 128 && s != 255; }));
        }
    }
    std::cout << kStreams << " random streams, " << samples << " samples of each plane, " << telling
              << " of Y neither 0, 128 nor 255\n";
    EXPECT_GT(telling, samples / 4);
}

}  // namespace
}  // namespace rs::reference
