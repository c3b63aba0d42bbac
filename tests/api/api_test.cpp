// The public library as its users call it.

#include "rayspace/api/builder.hpp"
#include "rayspace/api/evaluation.hpp"
#include "rayspace/api/executor.hpp"
#include "rayspace/api/renderer.hpp"
#include "rayspace/api/version.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <thread>

namespace rs::api {
namespace {

using testing::HasSubstr;

constexpr int kViews = 12;

// An object of the drawn balls.
class Api : public testing::Test {
protected:
    static void SetUpTestSuite() {
        work_ = std::make_unique<test::TemporaryFolder>();
        test::write_drawn_set(*work_ / "set", test::drawn_ring(kViews));
        BuildOptions options;
        options.planes = 8;
        options.progress = [](const std::string& stage, double fraction) {
            EXPECT_GE(fraction, 0) << stage;
            EXPECT_LE(fraction, 1) << stage;
            stages_.insert(stage);
        };
        const auto built = build_object(*work_ / "set", options);
        ASSERT_TRUE(built.ok()) << built.error().message;
        EXPECT_GT(built->photos_psnr_db.value_or(0), 30);
        ASSERT_TRUE(built->object.write(*work_ / "balls.rso").ok());
    }
    static void TearDownTestSuite() { work_.reset(); }

    static Object object(int level = 3) {
        auto opened = Object::open(*work_ / "balls.rso", {.level = level});
        EXPECT_TRUE(opened.ok()) << opened.error().message;
        return std::move(opened).value();
    }
    static Renderer renderer(const std::string& executor) {
        auto created = ExecutorTable().create(executor);
        EXPECT_TRUE(created.ok()) << created.error().message;
        auto made = Renderer::create(object(), std::move(*created));
        EXPECT_TRUE(made.ok()) << made.error().message;
        return std::move(made).value();
    }
    static Camera camera(int width = 96) {
        const auto cameras = object().orbit(5, {.width = width});
        EXPECT_TRUE(cameras.ok()) << cameras.error().message;
        return (*cameras)[1];
    }

    static inline std::unique_ptr<test::TemporaryFolder> work_;
    static inline std::set<std::string> stages_;
};

TEST_F(Api, ObjectIsInspected) {
    const Object opened = object();
    EXPECT_TRUE(opened.has_all_photos());
    EXPECT_EQ(opened.name(), "set");
    EXPECT_EQ(opened.photos(), kViews);
    EXPECT_EQ(opened.width(), 96);
    EXPECT_EQ(opened.height(), 80);
    EXPECT_DOUBLE_EQ(opened.units_per_radius(), 0.9);
    ASSERT_EQ(opened.rings().size(), 1U);
    EXPECT_EQ(opened.rings()[0].photos, kViews);
    EXPECT_EQ(opened.rings()[0].planes, 8);
    EXPECT_TRUE(opened.rings()[0].has_depth);
    EXPECT_NEAR(opened.rings()[0].elevation_deg, 0, 1e-6);
    EXPECT_GT(stages_.size(), 2U);
    EXPECT_THAT(Object::open(*work_ / "none.rso").error().message, HasSubstr("none.rso"));
    EXPECT_THAT(Object::open(*work_ / "balls.rso", {.level = 4}).error().message, HasSubstr("0..3"));
}

TEST_F(Api, PhotosAreDecodedOneByOne) {
    const Object opened = object();
    const auto cameras = opened.captured_cameras();
    ASSERT_TRUE(cameras.ok());
    ASSERT_EQ(cameras->size(), std::size_t{kViews});
    const auto read = read_cameras(*work_ / "set");
    ASSERT_TRUE(read.ok());
    const auto first = Object::create(opened.unpacked());
    ASSERT_TRUE(first.ok());
    for (const int n : {0, 3, 7}) {
        const auto photo = opened.photo(n);
        ASSERT_TRUE(photo.ok()) << photo.error().message;
        EXPECT_EQ(*photo, *first->photo(n));
        const auto file = read_image(*work_ / "set" / (std::to_string(n) + ".png"));
        ASSERT_TRUE(file.ok());
        EXPECT_GT(compare_images(*photo, *file)->psnr_db, 30);
        const auto i = static_cast<std::size_t>(n);
        for (std::size_t row = 0; row < 4; ++row) {
            EXPECT_THAT((*cameras)[i].camera.world_from_camera[row],
                        testing::Pointwise(testing::DoubleNear(1e-8), (*read)[i].camera.world_from_camera[row]));
        }
    }
    EXPECT_FALSE(opened.photo(kViews).ok());
    EXPECT_FALSE(opened.photo(-1).ok());
    const Object coarse = object(0);
    EXPECT_FALSE(coarse.has_all_photos());
    EXPECT_TRUE(coarse.photo(0).ok());
    EXPECT_THAT(coarse.photo(1).error().message, HasSubstr("not loaded"));
    EXPECT_THAT(coarse.extract(*work_ / "coarse").error().message, HasSubstr("not loaded"));
    EXPECT_TRUE(Renderer::create(coarse).ok());
    EXPECT_FALSE(Renderer::create(coarse, std::move(*ExecutorTable().create("scalar"))).ok());
}

TEST_F(Api, EveryExecutorGivesTheSameView) {
    const auto core = Renderer::create(object());
    ASSERT_TRUE(core.ok());
    const auto expected = core->render(camera(), {.depth = true});
    ASSERT_TRUE(expected.ok()) << expected.error().message;
    for (const char* name : {"core", "scalar"}) {
        const auto view = renderer(name).render(camera(), {.depth = true});
        ASSERT_TRUE(view.ok()) << name << ": " << view.error().message;
        EXPECT_EQ(view->image, expected->image) << name;
        EXPECT_EQ(view->depth, expected->depth) << name;
    }
    for (int y = 0; y < expected->image.height(); ++y) {
        for (int x = 0; x < expected->image.width(); ++x) {
            EXPECT_EQ(expected->depth(x, y) > 0, expected->image(x, y).a > 0) << x << ", " << y;
        }
    }
    EXPECT_TRUE(core->render(camera())->depth.empty());
}

TEST_F(Api, FiltersDiffer) {
    const auto core = Renderer::create(object());
    const auto image = [&](int width, Filter filter) { return core->render(camera(width), {.filter = filter})->image; };
    EXPECT_NE(image(96, Filter::kSharp), image(96, Filter::kBilinear));
    EXPECT_NE(image(96, Filter::kSmooth), image(96, Filter::kBilinear));
    EXPECT_EQ(image(96, Filter::kAuto), image(96, Filter::kSharp));
    EXPECT_EQ(image(84, Filter::kAuto), image(84, Filter::kBilinear));
    EXPECT_EQ(image(48, Filter::kAuto), image(48, Filter::kSmooth));
}

TEST_F(Api, RendersFromSeveralThreads) {
    for (const char* name : {"core", "scalar"}) {
        const Renderer shared = renderer(name);
        const Image<Rgba8> expected = shared.render(camera())->image;
        std::vector<std::thread> threads;
        for (int n = 0; n < 4; ++n) {
            threads.emplace_back([&] { EXPECT_EQ(shared.render(camera())->image, expected); });
        }
        for (std::thread& thread : threads) thread.join();
    }
}

TEST_F(Api, RendererSharesTheObject) {
    std::optional<Object> kept;
    {
        const auto core = Renderer::create(object());
        kept = core->object();
    }
    EXPECT_EQ(kept->photo(3).value(), object().photo(3).value());
}

// An executor from outside: the core with limits, or with defects.
class TestExecutor final : public Executor {
public:
    TestExecutor() : core_(std::move(ExecutorTable().create("core")).value()) { traits_.name = "test"; }

    const ExecutorTraits& traits() const override { return traits_; }
    Result<std::optional<int>> load(const RaySpaceObject& data) override {
        if (has_no_room_) return std::optional<int>();
        return core_->load(data);
    }
    Status evict(int slot) override { return core_->evict(slot); }
    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override {
        auto rendered = core_->render(views);
        if (is_wrong_size_) rendered->front().image = Image<Rgba8>(1, 1);
        return rendered;
    }

    std::unique_ptr<Executor> core_;
    ExecutorTraits traits_;
    bool has_no_room_ = false;
    bool is_wrong_size_ = false;
};

TEST_F(Api, ExecutorsAreAddedToATableByValue) {
    ExecutorTable table;
    const std::string before = table.names();
    const auto create = [](const std::string& argument) -> Result<std::unique_ptr<Executor>> {
        auto made = std::make_unique<TestExecutor>();
        if (argument == "no-depth") made->traits_.depth = false;
        if (argument == "no-filters") made->traits_.filters = false;
        if (argument == "upright") made->traits_.tilted = false;
        made->has_no_room_ = argument == "full";
        made->is_wrong_size_ = argument == "wrong";
        return std::unique_ptr<Executor>(std::move(made));
    };
    ASSERT_TRUE(table.add({"test", "WHICH", create}).ok());
    EXPECT_EQ(table.names(), before + ", test:WHICH");
    EXPECT_EQ(ExecutorTable().names(), before);
    EXPECT_THAT(table.add({"core", "", create}).error().message, HasSubstr("core"));
    EXPECT_FALSE(table.add({"a:b", "", create}).ok());
    EXPECT_FALSE(table.add({"", "", create}).ok());
    EXPECT_FALSE(table.add({"none", "", {}}).ok());
    EXPECT_THAT(table.create("test").error().message, HasSubstr(table.names()));
    EXPECT_THAT(table.create("core:x").error().message, HasSubstr(table.names()));

    const auto with = [&](const std::string& which) {
        return Renderer::create(object(), std::move(table.create("test:" + which)).value());
    };
    EXPECT_THAT(with("full").error().message, HasSubstr("no free memory"));
    EXPECT_THAT(with("wrong")->render(camera()).error().message, HasSubstr("another size"));
    EXPECT_THAT(with("no-depth")->render(camera(), {.depth = true}).error().message, HasSubstr("no depth"));
    EXPECT_TRUE(with("no-depth")->render(camera()).ok());
    EXPECT_THAT(with("no-filters")->render(camera(), {.filter = Filter::kSharp}).error().message, HasSubstr("filter"));
    EXPECT_EQ(with("no-filters")->render(camera())->image,
              with("any")->render(camera(), {.filter = Filter::kBilinear})->image);
    const auto from_above = object().look_at({0, 2, 3}, {0, 0, 0});
    ASSERT_TRUE(from_above.ok());
    EXPECT_THAT(with("upright")->render(*from_above).error().message, HasSubstr("tilted"));
    EXPECT_TRUE(with("any")->render(*from_above).ok());
}

TEST_F(Api, CamerasAreChecked) {
    const auto valid = look_at({0, 0, 3}, {0, 0, 0}, 0.7, 64, 48);
    ASSERT_TRUE(valid.ok());
    EXPECT_EQ(valid->world_from_camera[2][3], 3);
    EXPECT_EQ(valid->world_from_camera[0][0], 1);
    EXPECT_FALSE(look_at({0, 0, 3}, {0, 0, 3}, 0.7, 64, 48).ok());
    EXPECT_FALSE(look_at({0, 0, NAN}, {0, 0, 3}, 0.7, 64, 48).ok());
    EXPECT_FALSE(look_at({0, 0, 3}, {0, 0, 0}, 4, 64, 48).ok());
    EXPECT_FALSE(look_at({0, 0, 3}, {0, 0, 0}, 0.7, 0, 48).ok());
    EXPECT_FALSE(object().orbit(0).ok());
    EXPECT_FALSE(object().orbit(3, {.width = 9000}).ok());
    EXPECT_FALSE(object().orbit(3, {.fov_x_rad = -1}).ok());
    EXPECT_THAT(read_cameras("nowhere").error().message, HasSubstr("nowhere"));
    Camera scaled = *valid;
    scaled.world_from_camera[0][0] = 2;
    EXPECT_THAT(Renderer::create(object())->render(scaled).error().message, HasSubstr("rotation"));
}

TEST_F(Api, ScoresPhotosThatAreHeldOut) {
    const auto held_out = evaluate_held_out(*work_ / "set", {.every = 3, .planes = 8});
    ASSERT_TRUE(held_out.ok()) << held_out.error().message;
    ASSERT_EQ(held_out->views.size(), 4U);
    EXPECT_EQ(held_out->views[0].photo, "1.png");
    EXPECT_GT(held_out->mean_psnr_db, 14);
    EXPECT_FALSE(evaluate_held_out(*work_ / "set", {.every = 1}).ok());

    const auto own = compare_with_photos(*Renderer::create(object()), *work_ / "set");
    ASSERT_TRUE(own.ok()) << own.error().message;
    EXPECT_EQ(own->views.size(), std::size_t{kViews});
    EXPECT_GT(own->mean_psnr_db, held_out->mean_psnr_db);
    EXPECT_THAT(compare_with_photos(*Renderer::create(object()), "nowhere").error().message, HasSubstr("nowhere"));
    EXPECT_FALSE(compare_images(Image<Rgba8>(2, 2), Image<Rgba8>(2, 3)).ok());
}

TEST_F(Api, BuildOptionsAreChecked) {
    const auto set = *work_ / "set";
    EXPECT_THAT(build_object(set, {.planes = 2}).error().message, HasSubstr("3..64"));
    EXPECT_THAT(build_object(set, {.quality = 0}).error().message, HasSubstr("1..100"));
    EXPECT_THAT(build_object(set, {.psnr_db = 90}).error().message, HasSubstr("10..60"));
    EXPECT_THAT(build_object(set, {.effort = 10}).error().message, HasSubstr("1..9"));
    EXPECT_THAT(build_object(set, {.alpha_bits = 7}).error().message, HasSubstr("1..6"));
    EXPECT_THAT(build_object("nowhere").error().message, HasSubstr("nowhere"));
    const auto raw = build_object(set, {.name = "raw", .map = MapKind::kPlane, .coding = PhotoCoding::kRaw});
    ASSERT_TRUE(raw.ok()) << raw.error().message;
    EXPECT_EQ(raw->object.name(), "raw");
    EXPECT_FALSE(raw->photos_psnr_db.has_value());
    EXPECT_FALSE(raw->object.rings()[0].has_depth);
    const auto core = Renderer::create(raw->object);
    ASSERT_TRUE(core.ok());
    EXPECT_EQ(core->object().photo(2).value(), raw->object.photo(2).value());
    EXPECT_TRUE(raw->object.extract(*work_ / "extracted").ok());
}

TEST(ApiVersion, IsThatOfTheProject) {
    std::ifstream file(RAYSPACE_SOURCE_DIR "/CMakeLists.txt");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_THAT(text, HasSubstr("VERSION " + version_text() + " "));
}

// Users need nothing but the standard library.
TEST(ApiHeaders, IncludeOnlyTheStandardLibraryAndOneAnother) {
    static const std::regex kInclude(R"(^#include ([<"])([^>"]+)[>"])");
    int headers = 0;
    for (const char* folder : {"/rayspace/api", "/rayspace/api/types"}) {
        for (const auto& entry : std::filesystem::directory_iterator(std::string(RAYSPACE_SOURCE_DIR) + folder)) {
            if (entry.path().extension() != ".hpp") continue;
            ++headers;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);) {
                std::smatch match;
                if (!std::regex_search(line, match, kInclude)) continue;
                const std::string name = match[2];
                const bool is_standard = match[1] == "<" && name.find_first_of("./") == std::string::npos;
                const bool is_public = name.starts_with("rayspace/api/") && !name.starts_with("rayspace/api/internal/");
                EXPECT_TRUE(is_standard || is_public) << entry.path() << ": " << name;
            }
        }
    }
    EXPECT_GT(headers, 14);
}

}  // namespace
}  // namespace rs::api
