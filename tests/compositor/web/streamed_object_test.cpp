// Objects of pages while their file arrives (compositor/web/view/streamed_object.hpp).

#include "compositor/web/view/streamed_object.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rs::web {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kPrefix_bytes = 1024;

std::vector<std::byte> saved_file(const RaySpaceObject& object) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(write_object(folder / "thing.rso", object).ok());
    return read_file(folder / "thing.rso", 1U << 24).value();
}

const std::vector<std::byte>& coded_file(int rings = 1) {
    static std::vector<std::byte> files[3];
    std::vector<std::byte>& file = files[rings];
    if (file.empty()) {
        RaySpaceObject object = test::coded_object({.rings = rings, .views_per_ring = 16, .width = 40, .height = 36},
                                                   {.effort = encode::kMinEffort});
        for (std::size_t r = 0; r < object.rings.size(); ++r) object.rings[r].shape = test::small_shape(object, r);
        file = saved_file(object);
    }
    return file;
}

OrbitView view_at(const ObjectView& shown, double azimuth_rad) {
    const CapturedCamera& captured = shown.captured()[0];
    return {30, 28, azimuth_rad, captured.elevation_rad + 0.02, captured.distance};
}

Image<Rgba8> rendered(ObjectView& shown, const OrbitView& view) {
    const Status status = shown.render(view);
    EXPECT_TRUE(status.ok()) << status.error().message;
    return shown.image();
}

void expect_equal_views(ObjectView& shown, const std::vector<std::byte>& file) {
    Result<ObjectView> whole = ObjectView::open(file, "whole", 3);
    ASSERT_TRUE(whole.ok());
    for (const double azimuth_rad : {0.0, 0.3, 2.0, 4.4}) {
        EXPECT_EQ(rendered(shown, view_at(shown, azimuth_rad)), rendered(*whole, view_at(*whole, azimuth_rad)));
    }
}

struct Page {
    std::optional<ObjectView> shown;
    StreamedObject stream;
    explicit Page(std::optional<std::uint64_t> size_bytes) : stream("thing.rso", size_bytes, shown) {}
    Status add(const std::vector<std::byte>& file, ByteRange range) {
        const auto bytes = std::span(file).subspan(static_cast<std::size_t>(range.begin));
        return stream.add(range.begin, bytes.first(static_cast<std::size_t>(range.end - range.begin)));
    }
    // Also before the object is known.
    [[nodiscard]] OrbitView view(double azimuth_rad = 0) const {
        return shown ? view_at(*shown, azimuth_rad) : OrbitView{1, 1, 0, 0, 1};
    }
};

TEST(StreamedObject, FilesInPiecesGiveTheViewsOfTheWhole) {
    RaySpaceObject raw = test::small_object_with_shape({.rings = 2});
    for (const std::vector<std::byte>& file : {coded_file(1), coded_file(2), saved_file(raw)}) {
        for (const std::size_t piece : {std::size_t{1}, std::size_t{37}, std::size_t{1000}, file.size()}) {
            Page page(std::nullopt);
            std::size_t photos = 0;
            for (std::size_t at = 0; at < file.size();) {
                const std::size_t size = std::min(piece, file.size() - at);
                ASSERT_TRUE(page.add(file, {at, at + size}).ok());
                at += size;
                photos += page.stream.take_new_photos().size();
                EXPECT_FALSE(page.stream.is_complete() && at < file.size());
            }
            ASSERT_TRUE(page.stream.is_complete());
            EXPECT_TRUE(page.stream.finish(file.size()).ok());
            EXPECT_EQ(photos, page.shown->object().views.size());
            expect_equal_views(*page.shown, file);
        }
    }
}

TEST(StreamedObject, RangesCoverTheFileOnceTheViewFirst) {
    constexpr double kAzimuth_rad = 2.1;  // near view 5 of 16, whose lowest neighbour is view 8
    for (const int rings : {1, 2}) {
        const std::vector<std::byte>& file = coded_file(rings);
        Page page(file.size());
        ASSERT_TRUE(page.add(file, {0, kPrefix_bytes}).ok());
        std::uint64_t loaded_bytes = kPrefix_bytes;
        std::vector<std::uint32_t> photos;
        bool was_shown = false;
        while (!page.stream.is_complete()) {
            const ByteRange range = page.stream.next_range(page.view(kAzimuth_rad), {});
            ASSERT_FALSE(range.empty());
            // The range is not offered twice, and nothing else before the first photo is there.
            const ByteRange requested[] = {range};
            const ByteRange other = page.stream.next_range(page.view(kAzimuth_rad), requested);
            EXPECT_TRUE(other.empty() || !page.shown || was_shown);
            EXPECT_TRUE(other.empty() || other.end <= range.begin || other.begin >= range.end);
            ASSERT_TRUE(page.add(file, range).ok());
            loaded_bytes += range.end - range.begin;
            for (const std::uint32_t photo : page.stream.take_new_photos()) photos.push_back(photo);
            EXPECT_EQ(page.stream.can_render(page.view(kAzimuth_rad)), !photos.empty());
            was_shown = was_shown || page.stream.can_render(page.view(kAzimuth_rad));
        }
        EXPECT_EQ(loaded_bytes, file.size());
        EXPECT_EQ(photos.front(), 8U) << "the nearest photo of level 0";
        EXPECT_EQ(photos.size(), 16U * static_cast<unsigned>(rings));
        expect_equal_views(*page.shown, file);
    }
}

// With the shape map and the photos that a view reads, its image is that of the whole object.
TEST(StreamedObject, ViewsAreExactBeforeAllPhotosAreThere) {
    const std::vector<std::byte>& file = coded_file();
    Result<ObjectView> whole = ObjectView::open(file, "whole", 3);
    const ContainerReader container = ContainerReader::over(file, "whole").value();
    const auto bytes_of = [&](ChunkName name, std::uint32_t index) {
        const ChunkEntry* const entry = container.find(name, index);
        return ByteRange{entry->offset_bytes, entry->offset_bytes + (entry->size_bytes + 15) / 16 * 16};
    };
    Page page(file.size());
    ASSERT_TRUE(page.add(file, {0, bytes_of(object_chunks::kShape, 0).begin}).ok());
    ASSERT_TRUE(page.shown);
    const OrbitView view = view_at(*whole, 0.2);
    const Image<Rgba8> exact = rendered(*whole, view);
    ASSERT_TRUE(page.add(file, bytes_of(object_chunks::kImage, 0)).ok());
    EXPECT_NE(rendered(*page.shown, view), exact);
    // Photos 0 and 1, from 2, 4 and 8.
    for (const std::uint32_t photo : {1U, 2U, 8U, 4U}) {
        ASSERT_TRUE(page.add(file, bytes_of(object_chunks::kImage, photo)).ok());
    }
    EXPECT_NE(rendered(*page.shown, view), exact) << "without the shape map";
    EXPECT_TRUE(page.shown->object().rings[0].shape.empty());
    ASSERT_TRUE(page.add(file, bytes_of(object_chunks::kShape, 0)).ok());
    EXPECT_EQ(rendered(*page.shown, view), exact);
    EXPECT_NE(rendered(*page.shown, view_at(*page.shown, 3)), rendered(*whole, view_at(*whole, 3)));
}

TEST(StreamedObject, LostConnectionsAreContinued) {
    const std::vector<std::byte>& file = coded_file();
    const std::uint64_t third = file.size() / 3;
    Page page(file.size());
    ASSERT_TRUE(page.add(file, {0, third + 5}).ok());
    ASSERT_TRUE(page.add(file, {third + 5, file.size()}).ok()) << "from where it ended";
    EXPECT_TRUE(page.stream.is_complete());
    Page again(file.size());
    ASSERT_TRUE(again.add(file, {0, third + 5}).ok());
    ASSERT_TRUE(again.add(file, {0, third}).ok()) << "from the start";
    ASSERT_TRUE(again.add(file, {third, file.size()}).ok());
    EXPECT_TRUE(again.stream.is_complete());
    expect_equal_views(*again.shown, file);
}

// Loads by ranges until an error, which is returned. What is shown is rendered then.
Status load(const std::vector<std::byte>& file, std::uint64_t stated_bytes) {
    Page page(stated_bytes);
    ByteRange range{0, std::min<std::uint64_t>(kPrefix_bytes, file.size())};
    Status status;
    while (!range.empty() && range.end <= file.size()) {
        status = page.add(file, range);
        if (!status) break;
        range = page.stream.next_range(page.view(), {});
    }
    if (status && !page.stream.is_complete()) status = page.stream.finish(file.size());
    if (page.shown && page.stream.can_render(page.view())) {
        EXPECT_TRUE(page.shown->render(page.view()).ok());
    }
    EXPECT_THAT(status ? "thing.rso: " : status.error().message, testing::StartsWith("thing.rso: "));
    return status;
}

TEST(StreamedObject, EveryDamagedByteIsFound) {
    const std::vector<std::byte>& good = coded_file();
    ASSERT_TRUE(load(good, good.size()).ok());
    std::mt19937 random(1);
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::vector<std::byte> bad = good;
        bad[i] ^= static_cast<std::byte>(1U << (random() % 8));
        EXPECT_FALSE(load(bad, bad.size()).ok()) << "byte " << i;
    }
}

TEST(StreamedObject, EveryTruncationIsFound) {
    const std::vector<std::byte>& good = coded_file();
    for (std::size_t size = 0; size < good.size(); size += 11) {
        const std::vector<std::byte> part(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(load(part, size).ok()) << size;
        Page page(std::nullopt);  // a server that does not state the size
        const Status added = page.add(part, {0, size});
        EXPECT_FALSE(added.ok() && page.stream.finish(size).ok()) << size;
    }
}

TEST(StreamedObject, AfterADamagedPhotoTheOthersAreShown) {
    std::vector<std::byte> file = coded_file();
    const ChunkEntry entry = *ContainerReader::over(file, "whole").value().find(object_chunks::kImage, 3);
    file[static_cast<std::size_t>(entry.offset_bytes + entry.size_bytes / 2)] ^= std::byte{4};
    Page page(std::nullopt);
    const Status added = page.add(file, {0, file.size()});
    ASSERT_FALSE(added.ok());
    EXPECT_THAT(added.error().message, HasSubstr("thing.rso: chunk PICT 3: its checksum does not match"));
    EXPECT_FALSE(page.stream.is_complete());
    ASSERT_TRUE(page.stream.can_render(page.view()));
    EXPECT_GT(page.stream.take_new_photos().size(), 8U);
    const Image<Rgba8> image = rendered(*page.shown, page.view());
    EXPECT_TRUE(std::any_of(image.pixels().begin(), image.pixels().end(), [](Rgba8 p) { return p.a == 255; }));
    EXPECT_FALSE(page.add(file, {0, 10}).ok()) << "the error stays";
}

}  // namespace
}  // namespace rs::web
