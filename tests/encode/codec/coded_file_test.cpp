// Files with coded images: chunks, rejected payloads, and damage.

#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace rs::codec {
namespace {

const test::SmallObjectOptions kSmallFile{.views_per_ring = 9, .width = 40, .height = 36};

class CodedFile : public testing::Test {
protected:
    void SetUp() override {
        object_ = test::coded_object(kSmallFile, {});
        const Status written = write_object(file_, object_);
        ASSERT_TRUE(written.ok()) << written.error().message;
    }

    test::TemporaryFolder work_;
    std::filesystem::path file_ = work_ / "coded.rso";
    RaySpaceObject object_;
};

TEST_F(CodedFile, RoundTrip) {
    const auto read = read_object(file_);
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_NE(read->coded, nullptr);
    EXPECT_EQ(code_payload(*read->coded), code_payload(*object_.coded));
    for (std::size_t v = 0; v < object_.views.size(); ++v) {
        EXPECT_EQ(coded_image_payload(*read->coded, v), coded_image_payload(*object_.coded, v));
    }
    decode_images(object_);
    EXPECT_EQ(read->images, object_.images);
}

TEST_F(CodedFile, MayStayCoded) {
    const auto read = read_object(file_, {.decode = false});
    ASSERT_TRUE(read.ok()) << read.error().message;
    for (const PlanarImage& image : read->images) EXPECT_TRUE(image.empty());
    for (const CodedImage& image : read->coded->images) EXPECT_TRUE(image.loaded());
}

TEST_F(CodedFile, LevelsAreLoadedOneByOne) {
    for (int level = 0; level < kProgressiveLevels; ++level) {
        const auto read = read_object(file_, {.max_level = level});
        ASSERT_TRUE(read.ok()) << read.error().message;
        for (std::size_t v = 0; v < read->views.size(); ++v) {
            EXPECT_EQ(!read->images[v].empty(), read->coded->levels[v] <= level);
        }
    }
}

TEST_F(CodedFile, MemoryIsCapped) {
    const auto read = read_object(file_, {.memory_cap_bytes = 40000});
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().message.find("memory"), std::string::npos) << read.error().message;
}

// Invalid payloads of CODE. Offsets as in encode/FORMAT.md.
TEST_F(CodedFile, EveryFieldOfTheSharedPartIsChecked) {
    const std::vector<std::byte> sound = code_payload(*object_.coded);
    const auto parse = [&](const std::vector<std::byte>& payload) {
        CodedImages coded;
        return parse_code(payload, object_.views.size(), object_.width, object_.height, coded).ok();
    };
    ASSERT_TRUE(parse(sound));
    const std::pair<std::size_t, int> wrong[] = {
        {0, 0},  {0, 3},        {1, 3},  {1, 7}, {2, 3}, {2, 7}, {3, 0},    {3, 5},
        {4, 32}, {4, 256 - 32}, {5, 32}, {6, 2}, {7, 8}, {8, 4}, {16, 200}, {8 + 9 + 180, 255}};
    for (const auto& [offset, value] : wrong) {
        std::vector<std::byte> damaged = sound;
        damaged[offset] = static_cast<std::byte>(value);
        EXPECT_FALSE(parse(damaged)) << offset << " = " << value;
    }
    ASSERT_GT(sound.size(), 8U + 9 + 181);
    std::vector<std::byte> zero = sound;
    zero.back() = std::byte{0};
    EXPECT_FALSE(parse(zero));
    for (std::size_t size = 0; size < sound.size(); ++size) {
        EXPECT_FALSE(parse({sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    }
    std::vector<std::byte> longer = sound;
    longer.push_back(std::byte{1});
    EXPECT_FALSE(parse(longer));
}

TEST_F(CodedFile, EveryFieldOfAImageIsChecked) {
    constexpr std::size_t kView = 1;  // a view of level 3, with two references
    ASSERT_EQ(object_.coded->images[kView].head.references(), 2);
    const std::vector<std::byte> sound = coded_image_payload(*object_.coded, kView);
    const auto parse = [&](const std::vector<std::byte>& payload) {
        CodedImages coded = *object_.coded;
        return parse_coded_image(payload, kView, coded).ok();
    };
    ASSERT_TRUE(parse(sound));
    const auto refused = [&](const char* what, const std::function<void(std::vector<std::byte>&)>& damage) {
        std::vector<std::byte> damaged = sound;
        damage(damaged);
        EXPECT_FALSE(parse(damaged)) << what;
    };
    const auto set = [](std::vector<std::byte>& payload, std::size_t offset, unsigned number) {
        payload[offset] = static_cast<std::byte>(number & 255U);
        payload[offset + 1] = static_cast<std::byte>(number >> 8U);
    };
    refused("coding 0", [](auto& p) { p[0] = std::byte{0}; });
    refused("coding 2", [](auto& p) { p[0] = std::byte{2}; });
    refused("step 64", [](auto& p) { p[1] = std::byte{64}; });
    refused("a reference that is no view", [&](auto& p) { set(p, 2, 9); });
    refused("a reference to itself", [&](auto& p) { set(p, 2, 1); });
    refused("a reference of the same level", [&](auto& p) { set(p, 2, 3); });
    refused("a second reference only", [&](auto& p) { set(p, 2, 65535); });
    refused("the same reference twice", [&](auto& p) { set(p, 4, object_.coded->images[kView].head.reference[0]); });
    for (const std::size_t offset : {6, 8, 10, 12}) {
        refused("a vector too far right", [&](auto& p) { set(p, offset, 1024); });
        refused("a vector too far left", [&](auto& p) { set(p, offset, 65536 - 1024); });
    }
    refused("reserved", [](auto& p) { p[14] = std::byte{1}; });
    refused("reserved", [](auto& p) { p[15] = std::byte{1}; });
    refused("a tile that does not exist", [](auto& p) { p[16] |= std::byte{0x80}; });
    refused("a tile without a size", [](auto& p) { p[16] ^= std::byte{1}; });
    refused("trailing bytes", [](auto& p) { p.push_back(std::byte{0}); });
    for (std::size_t size = 0; size < sound.size(); ++size) {
        EXPECT_FALSE(parse({sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    }
    // A size that is not in its shortest form.
    std::vector<std::byte> longer = sound;
    ASSERT_LT(static_cast<int>(longer[17]), 128);
    longer[17] |= std::byte{0x80};
    longer.insert(longer.begin() + 18, std::byte{0});
    EXPECT_FALSE(parse(longer));
}

// Any bytes, probabilities, steps and vectors of a tile decode to some samples. Sanitizer builds check the memory
// accesses.
TEST_F(CodedFile, AnyBytesDecode) {
    std::mt19937 random(2024);
    for (int round = 0; round < 60; ++round) {
        CodedImages coded = *object_.coded;
        coded.dense.has_masks = random() % 2 == 0;
        coded.dense.alpha_bits = 1 + static_cast<int>(random() % (coded.dense.has_masks ? 6 : 4));
        for (auto& p : coded.dense.probabilities) p = static_cast<std::uint16_t>(16 * (1 + random() % 255));
        for (CodedImage& image : coded.images) {
            image.head.step = static_cast<int>(random() % (kMaxStep + 1));
            for (auto& motion : image.head.global_motion) {
                motion = {static_cast<std::int16_t>(static_cast<int>(random() % 2047) - 1023),
                          static_cast<std::int16_t>(static_cast<int>(random() % 2047) - 1023)};
            }
            image.bytes.resize(image.tiles.size() * 200);
            for (auto& b : image.bytes) b = static_cast<std::byte>(random());
            for (std::size_t t = 0; t < image.tiles.size(); ++t) {
                image.tiles[t] = {static_cast<std::uint32_t>(t * 200), static_cast<std::uint32_t>(random() % 200),
                                  true};
            }
        }
        RaySpaceObject object = object_;
        object.coded = std::make_shared<CodedImages>(std::move(coded));
        decode_images(object);
        ASSERT_EQ(object.images.back().y.width(), object.width);
    }
}

}  // namespace
}  // namespace rs::codec
