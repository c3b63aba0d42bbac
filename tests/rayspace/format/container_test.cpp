#include "rayspace/format/container.hpp"
#include "tests/support/put_number.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#define XXH_INLINE_ALL  // no library to link
#include <xxhash.h>

#include <cstring>
#include <fstream>
#include <random>
#include <thread>

namespace {

using namespace rs;
using test::TemporaryFolder;
using testing::HasSubstr;

constexpr ChunkName kAbcd = {'A', 'B', 'C', 'D'};
constexpr ChunkName kData = {'D', 'A', 'T', '2'};

std::vector<std::byte> payload(std::size_t size, unsigned seed) {
    std::vector<std::byte> bytes(size);
    std::mt19937 random(seed);
    for (std::byte& b : bytes) b = static_cast<std::byte>(random());
    return bytes;
}

// Sizes on both sides of the alignment, and 0.
const std::vector<std::size_t> kSizes = {5, 16, 0, 17, 33};

std::vector<std::byte> sample_file() {
    const TemporaryFolder folder;
    auto writer = ContainerWriter::create(folder / "a.rso", static_cast<std::uint32_t>(kSizes.size()));
    EXPECT_TRUE(writer.ok());
    for (unsigned i = 0; i < kSizes.size(); ++i) {
        EXPECT_TRUE(writer->add(i == 0 ? kAbcd : kData, i, payload(kSizes[i], i)).ok());
    }
    EXPECT_TRUE(writer->commit().ok());
    return std::move(read_file(folder / "a.rso", 1 << 20)).value();
}

// Opens the container and reads every chunk, as "verify" does.
Status verify(std::vector<std::byte> bytes) {
    const auto reader = ContainerReader::over(std::move(bytes), "F");
    if (!reader) return reader.error();
    for (const ChunkEntry& entry : reader->table()) {
        const auto read = reader->read(entry);
        if (!read) return read.error();
    }
    return {};
}

// Corrects the checksums of header and table, so that a test reaches the check after them.
void seal(std::vector<std::byte>& bytes) {
    std::uint32_t chunks = 0;
    std::memcpy(&chunks, bytes.data() + 12, sizeof chunks);
    const std::size_t table_bytes = std::min<std::size_t>(std::size_t{chunks} * 32, bytes.size() - 48);
    test::put_number(bytes, 32, XXH64(bytes.data() + 48, table_bytes, 0), 8);
    test::put_number(bytes, 40, XXH64(bytes.data(), 40, 0), 8);
}

std::string sealed_error(std::vector<std::byte> bytes, std::size_t offset, std::uint64_t number, std::size_t size) {
    test::put_number(bytes, offset, number, size);
    seal(bytes);
    const Status status = verify(std::move(bytes));
    EXPECT_FALSE(status.ok());
    return status.ok() ? "" : status.error().message;
}

TEST(Container, ChunksComeBack) {
    const auto reader = ContainerReader::over(sample_file(), "F");
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    ASSERT_EQ(reader->table().size(), kSizes.size());
    for (unsigned i = 0; i < kSizes.size(); ++i) {
        const ChunkEntry* const entry = reader->find(i == 0 ? kAbcd : kData, i);
        ASSERT_NE(entry, nullptr);
        EXPECT_EQ(entry, &reader->table()[i]);
        EXPECT_EQ(entry->offset_bytes % 16, 0U);
        const auto read = reader->read(*entry);
        ASSERT_TRUE(read.ok());
        EXPECT_EQ(*read, payload(kSizes[i], i));
    }
    EXPECT_EQ(reader->find(kAbcd, 1), nullptr);
    EXPECT_EQ(reader->find({'Z', 'Z', 'Z', 'Z'}, 0), nullptr);
}

// The literal bytes of encode/FORMAT.md: a change of the layout must change this test and the version.
TEST(Container, LayoutIsTheDocumentedOne) {
    const TemporaryFolder folder;
    auto writer = ContainerWriter::create(folder / "a.rso", 1);
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE(writer->add(kAbcd, 0x01020304, payload(3, 9)).ok());
    ASSERT_TRUE(writer->commit().ok());
    const auto file = read_file(folder / "a.rso", 1000);
    ASSERT_TRUE(file.ok());
    std::vector<std::byte> expected(48 + 32 + 16);
    const unsigned char magic[] = {0x89, 'R', 'S', 'O', '\r', '\n', 0x1A, '\n'};
    std::memcpy(expected.data(), magic, 8);
    test::put_number(expected, 8, 2, 2);
    test::put_number(expected, 10, 4, 2);
    test::put_number(expected, 12, 1, 4);
    test::put_number(expected, 16, 48, 8);
    test::put_number(expected, 24, 96, 8);
    std::memcpy(expected.data() + 48, "ABCD", 4);
    test::put_number(expected, 52, 0x01020304, 4);
    test::put_number(expected, 56, 80, 8);
    test::put_number(expected, 64, 3, 8);
    const auto bytes = payload(3, 9);
    test::put_number(expected, 72, XXH64(bytes.data(), 3, 0), 8);
    std::memcpy(expected.data() + 80, bytes.data(), 3);
    seal(expected);
    EXPECT_EQ(*file, expected);
}

TEST(Container, EveryFlippedBitIsFound) {
    const std::vector<std::byte> good = sample_file();
    ASSERT_TRUE(verify(good).ok());
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::vector<std::byte> bad = good;
            bad[i] ^= static_cast<std::byte>(1 << bit);
            EXPECT_FALSE(verify(std::move(bad)).ok()) << "byte " << i << " bit " << bit;
        }
    }
}

TEST(Container, EveryTruncationAndExtensionIsFound) {
    const std::vector<std::byte> good = sample_file();
    for (std::size_t size = 0; size < good.size(); ++size) {
        EXPECT_FALSE(ContainerReader::over({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}, "F").ok())
            << size;
    }
    std::vector<std::byte> longer = good;
    longer.resize(longer.size() + 16);
    EXPECT_FALSE(ContainerReader::over(longer, "F").ok());
}

TEST(Container, EachRuleHasItsMessage) {
    const std::vector<std::byte> good = sample_file();
    const auto text_mode = [&] {
        std::vector<std::byte> bad = good;
        bad.erase(bad.begin() + 4);  // CR LF became LF
        return bad;
    }();
    EXPECT_THAT(verify(text_mode).error().message, HasSubstr("text mode"));
    EXPECT_THAT(verify(payload(100, 1)).error().message, HasSubstr("is not a ray-space object"));
    EXPECT_THAT(verify({}).error().message, HasSubstr("is not a ray-space object"));
    EXPECT_THAT(verify({good.begin(), good.begin() + 20}).error().message, HasSubstr("ends inside its header"));
    EXPECT_THAT(sealed_error(good, 8, 3, 2), HasSubstr("format version 3, newer than the 2"));
    EXPECT_THAT(sealed_error(good, 8, 0, 2), HasSubstr("version 0"));
    EXPECT_THAT(sealed_error(good, 12, 0, 4), HasSubstr("claims 0 chunks"));
    EXPECT_THAT(sealed_error(good, 12, 65537, 4), HasSubstr("claims 65537 chunks"));
    EXPECT_THAT(sealed_error(good, 12, 1000, 4), HasSubstr("table reaches beyond"));
    EXPECT_THAT(sealed_error(good, 16, 64, 8), HasSubstr("table is not where it must be"));
    EXPECT_THAT(sealed_error(good, 24, good.size() + 1, 8), HasSubstr("bytes long instead of"));
    EXPECT_THAT(sealed_error(good, 48, '1', 1), HasSubstr("not letters and digits"));
    EXPECT_THAT(sealed_error(good, 49, '\n', 1), HasSubstr("not letters and digits"));
    EXPECT_THAT(sealed_error(good, 56, 224, 8), HasSubstr("does not begin where"));
    EXPECT_THAT(sealed_error(good, 64, (std::uint64_t{1} << 30) + 1, 8), HasSubstr("larger than 1 GiB"));
    EXPECT_THAT(sealed_error(good, 64, ~std::uint64_t{0}, 8), HasSubstr("larger than 1 GiB"));
    EXPECT_THAT(sealed_error(good, 64, 4096, 8), HasSubstr("reaches beyond the end"));
    EXPECT_THAT(sealed_error(good, 64, 17, 8), HasSubstr("chunk DAT2 1: does not begin where"));
    EXPECT_THAT(sealed_error(good, 64, 6, 8), HasSubstr("chunk ABCD 0: its checksum does not match"));
    EXPECT_THAT(sealed_error(good, 48 + 32 + 4, 3, 4), HasSubstr("chunk DAT2 3: is there twice"));
    std::vector<std::byte> padded = good;
    padded[48 + 5 * 32 + 15] = std::byte{1};
    EXPECT_THAT(verify(padded).error().message, HasSubstr("padding"));
}

TEST(Container, NewerMinorVersionsAreRead) {
    std::vector<std::byte> newer = sample_file();
    test::put_number(newer, 10, 7, 2);
    seal(newer);
    EXPECT_TRUE(verify(newer).ok());
}

// For any contents: the rest of the header is not read.
TEST(Container, VersionOneIsRefused) {
    const std::string advice = ", which is read no more; encode its set anew with these tools (rs-encode build)";
    std::vector<std::byte> old = sample_file();
    test::put_number(old, 8, 1, 2);
    test::put_number(old, 10, 6, 2);
    EXPECT_EQ(verify(old).error().message, "F: is written in format 1.6" + advice);
    seal(old);
    EXPECT_EQ(verify(old).error().message, "F: is written in format 1.6" + advice);
    test::put_number(old, 10, 0, 2);
    EXPECT_EQ(verify(old).error().message, "F: is written in format 1.0" + advice);
    // Errors contain the file's name.
    const TemporaryFolder folder;
    std::ofstream(folder / "old.rso", std::ios::binary)
        .write(reinterpret_cast<const char*>(old.data()), static_cast<std::streamsize>(old.size()));
    EXPECT_EQ(ContainerReader::open(folder / "old.rso").error().message,
              (folder / "old.rso").string() + ": is written in format 1.0" + advice);
}

TEST(Container, RandomTablesNeverCrash) {
    const unsigned seed = 20261;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const std::vector<std::byte> good = sample_file();
    int accepted = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::vector<std::byte> soup = good;
        const int changes = 1 + static_cast<int>(random() % 4);
        for (int i = 0; i < changes; ++i) {
            const std::size_t at = 8 + random() % (soup.size() - 8);
            soup[at] = static_cast<std::byte>(random() % 3 == 0 ? 0 : random());
        }
        if (random() % 4 == 0) soup.resize(48 + random() % soup.size());
        test::put_number(soup, 24, soup.size(), 8);
        seal(soup);
        accepted += verify(std::move(soup)).ok() ? 1 : 0;
    }
    // Changes of the minor version and of indices are legal; most others are not.
    EXPECT_LT(accepted, 10000);
}

TEST(Container, FilesAreReadFromDiskByManyThreads) {
    const TemporaryFolder folder;
    auto writer = ContainerWriter::create(folder / "a.rso", 64);
    ASSERT_TRUE(writer.ok());
    for (unsigned i = 0; i < 64; ++i) ASSERT_TRUE(writer->add(kData, i, payload(10000 + i, i)).ok());
    ASSERT_TRUE(writer->commit().ok());
    const auto reader = ContainerReader::open(folder / "a.rso");
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    std::atomic<int> good{0};
    {
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < 4; ++t) {
            threads.emplace_back([&, t] {
                for (unsigned i = 0; i < 64; ++i) {
                    const unsigned n = (i * 7 + t * 13) % 64;
                    const auto read = reader->read(*reader->find(kData, n));
                    good += read.ok() && *read == payload(10000 + n, n) ? 1 : 0;
                }
            });
        }
    }
    EXPECT_EQ(good, 4 * 64);
    // Copies of a reader share the open file.
    const ContainerReader copy = *reader;
    EXPECT_TRUE(copy.read(copy.table()[0]).ok());
}

TEST(Container, FilesThatShrinkAreAnError) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.rso", std::ios::binary).write(reinterpret_cast<const char*>(sample_file().data()), 0);
    const auto good = sample_file();
    std::ofstream(folder / "a.rso", std::ios::binary)
        .write(reinterpret_cast<const char*>(good.data()), static_cast<std::streamsize>(good.size()));
    const auto reader = ContainerReader::open(folder / "a.rso");
    ASSERT_TRUE(reader.ok());
    std::filesystem::resize_file(folder / "a.rso", good.size() - 20);
    const auto read = reader->read(reader->table().back());
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.error().message, HasSubstr("became shorter"));
}

TEST(Container, OpenNamesWhatIsNoFile) {
    const TemporaryFolder folder;
    EXPECT_THAT(ContainerReader::open(folder / "none").error().message, HasSubstr("cannot be opened"));
    EXPECT_THAT(ContainerReader::open(folder.path()).error().message, HasSubstr("is a folder"));
    EXPECT_THAT(ContainerReader::open("/dev/zero").error().message, HasSubstr("is no regular file"));
}

TEST(Container, NothingAppearsBeforeCommit) {
    const TemporaryFolder folder;
    {
        auto writer = ContainerWriter::create(folder / "a.rso", 2);
        ASSERT_TRUE(writer.ok());
        ASSERT_TRUE(writer->add(kAbcd, 0, payload(10, 1)).ok());
        EXPECT_FALSE(std::filesystem::exists(folder / "a.rso"));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ContainerDeathTest, WritersOfNonsenseAreStopped) {
    const TemporaryFolder folder;
    auto writer = ContainerWriter::create(folder / "a.rso", 2);
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE(writer->add(kAbcd, 0, {}).ok());
    EXPECT_DEATH((void)writer->add(kAbcd, 0, {}), "check failed");
    EXPECT_DEATH((void)writer->add({'1', 'A', 'A', 'A'}, 0, {}), "check failed");
    EXPECT_DEATH((void)writer->commit(), "check failed");
}

}  // namespace
