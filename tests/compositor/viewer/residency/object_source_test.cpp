// Measured memory of loading an object against the estimate.

#include "compositor/viewer/residency/object_source.hpp"

#include "engine/model/board.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/sphere_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <malloc.h>

#include <atomic>
#include <thread>

namespace rs::compositor {
namespace {

std::int64_t allocated_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

// Peak of the bytes allocated by `work`.
template <class Work>
std::int64_t most_allocated(const Work& work) {
    std::atomic<bool> done = false;
    std::atomic<std::int64_t> most = 0;
    const std::int64_t before = allocated_bytes();
    std::thread watcher([&] {
        while (!done) most = std::max(most.load(), allocated_bytes() - before);
    });
    work();
    done = true;
    watcher.join();
    return most;
}

// With a shape map, which boards do not support, or without.
RaySpaceObject ball(bool coded, bool shape) {
    test::RingObjectOptions options = test::sphere_options();
    options.width = 200;
    options.height = 220;
    options.fl_px = 310;
    RaySpaceObject object = test::sphere_object(options, {});
    if (!shape) object.rings[0].shape = {};
    if (!coded) return object;
    std::vector<Image<Rgba8>> images;
    for (const RigView& view : test::ring_rig(options).views) images.push_back(test::sphere_image({}, view.camera));
    for (PlanarImage& image : object.images) image = {};
    object.coded = std::make_shared<codec::CodedImages>(test::code_images(object, images, {}));
    return object;
}

class FileObjectSource : public ::testing::TestWithParam<std::tuple<bool, bool>> {};

TEST_P(FileObjectSource, TakeNoMoreThanForeseenAndNotMuchLess) {
    const auto [coded, with_board] = GetParam();
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "ball.rso", ball(coded, !with_board)));
    std::unique_ptr<engine::Executor> board;
    if (with_board) {
        const auto config = engine::model::read_board_config("prototype-2000");
        ASSERT_TRUE(config);
        board = engine::model::make_simulated_board(*config, true);
    }
    const auto engine = std::make_shared<engine::RenderSession>(engine::RenderSessionLimits{}, std::move(board));
    const std::unique_ptr<ObjectSource> source = make_file_source(engine, true);
    const Result<std::int64_t> foreseen = source->most_bytes(folder / "ball.rso");
    ASSERT_TRUE(foreseen) << foreseen.error().message;
    std::optional<Result<ViewableObject>> read;
    std::vector<float> progress;
    const std::int64_t most = most_allocated(
        [&] { read.emplace(source->read(folder / "ball.rso", *foreseen, [&](float p) { progress.push_back(p); })); });
    ASSERT_TRUE(*read) << read->error().message;
    const std::int64_t kept = (*read)->memory_bytes();
    RecordProperty("than estimated", std::to_string(*foreseen));
    RecordProperty("most", std::to_string(most));
    RecordProperty("kept", std::to_string(kept));
    std::printf("foreseen %lld, most %lld, kept %lld bytes\n", static_cast<long long>(*foreseen),
                static_cast<long long>(most), static_cast<long long>(kept));
    EXPECT_EQ((*read)->for_board != nullptr, with_board && !coded) << "this board takes raw images";
    EXPECT_LE(most, *foreseen);
    EXPECT_LE(kept, *foreseen);
    EXPECT_LE(*foreseen, (with_board && coded ? 5 * kept : 5 * kept / 2));
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.back(), 1);
    // The file has grown since it was measured.
    EXPECT_FALSE(source->read(folder / "ball.rso", *foreseen / 8, [](float) {}));
}

INSTANTIATE_TEST_SUITE_P(RawAndCoded, FileObjectSource, ::testing::Combine(::testing::Bool(), ::testing::Bool()));

TEST(ObjectMemory, CountsWhatAnObjectHolds) {
    RaySpaceObject object = ball(false, true);
    const std::int64_t before = object_memory_bytes(object);
    const std::int64_t image = object_memory_bytes(object) - [&] {
        object.images[0] = {};
        return object_memory_bytes(object);
    }();
    EXPECT_EQ(image, 200 * 220 + 2 * 100 * 110 + 200 * 220);
    EXPECT_GT(before, 36 * image);
}

}  // namespace
}  // namespace rs::compositor
