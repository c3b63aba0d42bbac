#include "rayspace/geometry/rig.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace {

using namespace rs;
using nlohmann::json;
using test::TemporaryFolder;
using testing::HasSubstr;

const char* const kIdentity = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";

std::string one_frame(const std::string& top, const std::string& frame) {
    return "{" + top + R"("frames":[{"file_path":"a.png","transform_matrix":)" + kIdentity + frame + "}]}";
}

std::string rig_error(const std::string& text) {
    const auto rig = rig_from_json(text, "R");
    EXPECT_FALSE(rig.ok()) << text;
    if (rig.ok()) return "";
    EXPECT_EQ(rig.error().message.find('\n'), std::string::npos) << rig.error().message;
    return rig.error().message;
}

Rig ring() {
    RingOptions options;
    options.count = 7;
    options.elevation_rad = radians(20);
    options.fl_px = 611.3;
    options.first_rad = 0.1;
    return make_ring(options);
}

void expect_same_camera(const Camera& a, const Camera& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.fl_x, b.fl_x);
    EXPECT_EQ(a.fl_y, b.fl_y);
    EXPECT_EQ(a.cx, b.cx);
    EXPECT_EQ(a.cy, b.cy);
    EXPECT_EQ(a.world_from_camera, b.world_from_camera);
}

TEST(Rig, DoublesComeBackExactly) {
    Rig rig = ring();
    rig.object_radius = 1.0 / 3;
    rig.foot_height = -0.1;
    rig.views[2].depth_file_path = "depth/2.exr";
    const auto back = rig_from_json(rig_to_json(rig), "R");
    ASSERT_TRUE(back.ok()) << back.error().message;
    ASSERT_EQ(back->views.size(), rig.views.size());
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        expect_same_camera(back->views[i].camera, rig.views[i].camera);
        EXPECT_EQ(back->views[i].file_path, rig.views[i].file_path);
        EXPECT_EQ(back->views[i].depth_file_path, rig.views[i].depth_file_path);
    }
    EXPECT_EQ(back->object_radius, rig.object_radius);
    EXPECT_EQ(back->foot_height, rig.foot_height);
    rig.foot_height.reset();
    EXPECT_EQ(rig_from_json(rig_to_json(rig), "R")->foot_height, std::nullopt);
    EXPECT_TRUE(back->extras.empty()) << back->extras;
}

TEST(Rig, SharedIntrinsicsStandAtTheTopOnly) {
    const json shared = json::parse(rig_to_json(ring()));
    EXPECT_EQ(shared["w"], 512);
    EXPECT_EQ(shared["fl_x"], 611.3);
    EXPECT_NEAR(shared["camera_angle_x"].get<double>(), 2 * std::atan(256 / 611.3), 1e-15);
    EXPECT_FALSE(shared["frames"][0].contains("w"));

    Rig mixed = ring();
    mixed.views[3].camera.cx += 1;
    const json own = json::parse(rig_to_json(mixed));
    EXPECT_FALSE(own.contains("w"));
    EXPECT_EQ(own["frames"][3]["cx"], 257.0);
    const auto back = rig_from_json(own.dump(), "R");
    ASSERT_TRUE(back.ok());
    expect_same_camera(back->views[3].camera, mixed.views[3].camera);
    expect_same_camera(back->views[4].camera, mixed.views[4].camera);
}

TEST(Rig, UnknownKeysSurvive) {
    const auto rig = rig_from_json(
        one_frame(
            R"("w":8,"h":6,"fl_x":10,"k1":0.25,"applied_transform":[[1,0],[0,1]],"aabb_scale":16,"note":"\u00e4",)",
            R"(,"sharpness":41.5,"tags":["a","b"])"),
        "R");
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->extras["k1"], 0.25);
    const auto back = rig_from_json(rig_to_json(*rig), "R");
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->extras, rig->extras);
    EXPECT_EQ(back->extras["note"], "\u00e4");
    EXPECT_EQ(back->extras["aabb_scale"], 16);
    EXPECT_EQ(back->views[0].extras, rig->views[0].extras);
    EXPECT_EQ(back->views[0].extras["tags"], json({"a", "b"}));
}

TEST(Rig, ExtrasDoNotOverruleWhatTheRigKnows) {
    Rig rig = ring();
    rig.extras["w"] = 3;
    rig.extras["frames"] = json::array();
    rig.views[0].extras["file_path"] = "wrong.png";
    const auto back = rig_from_json(rig_to_json(rig), "R");
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->views[0].camera.width, 512);
    EXPECT_EQ(back->views[0].file_path, "images/0000.png");
}

TEST(Rig, AnglesStandInForFocalLengths) {
    const auto rig = rig_from_json(one_frame(R"("w":800,"h":600,"camera_angle_x":0.6911112070083618,)", ""), "R");
    ASSERT_TRUE(rig.ok());
    const Camera& camera = rig->views[0].camera;
    EXPECT_NEAR(camera.fl_x, 1111.111, 1e-3);
    EXPECT_EQ(camera.fl_y, camera.fl_x);
    EXPECT_EQ(camera.cx, 400);
    EXPECT_EQ(camera.cy, 300);
}

TEST(Rig, FramesOverruleTheTop) {
    const auto rig = rig_from_json(one_frame(R"("w":800,"h":600,"fl_x":500,"fl_y":501,"cx":1,"cy":2,)",
                                             R"(,"w":400.0,"h":300,"fl_x":250,"fl_y":251,"cx":3)"),
                                   "R");
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    const Camera& camera = rig->views[0].camera;
    EXPECT_EQ(camera.width, 400);
    EXPECT_EQ(camera.fl_x, 250);
    EXPECT_EQ(camera.fl_y, 251);
    EXPECT_EQ(camera.cx, 3);
    EXPECT_EQ(camera.cy, 2);
}

TEST(Rig, ThreeRowsMakeAMatrixToo) {
    const auto rig = rig_from_json(
        R"({"w":8,"h":8,"fl_x":9,"frames":[{"file_path":"a","transform_matrix":[[1,0,0,4],[0,1,0,5],[0,0,1,6]]}]})",
        "R");
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->views[0].camera.centre(), glm::dvec3(4, 5, 6));
}

TEST(Rig, ErrorsNamePlaceAndRemedy) {
    const std::string size = R"("w":8,"h":6,"fl_x":10,)";
    EXPECT_THAT(rig_error("{\n\n\"a\": nan}"), HasSubstr("R: is not valid JSON at line 3"));
    EXPECT_THAT(rig_error(""), HasSubstr("not valid JSON"));
    EXPECT_THAT(rig_error("[1]"), HasSubstr("must be an object"));
    EXPECT_THAT(rig_error("{}"), HasSubstr("frames is missing"));
    EXPECT_THAT(rig_error(R"({"frames":[]})"), HasSubstr("R: frames: must have 1 to 4096 entries"));
    EXPECT_THAT(rig_error(R"({"frames":{}})"), HasSubstr("R: frames: must be a list"));
    EXPECT_THAT(rig_error(R"({"frames":[7]})"), HasSubstr("R: frames[0]: must be an object"));
    EXPECT_THAT(rig_error(R"({"frames":[{}]})"), HasSubstr("R: frames[0]: file_path is missing"));
    EXPECT_THAT(rig_error(R"({"frames":[{"file_path":7}]})"), HasSubstr("file_path: must be a text"));
    EXPECT_THAT(rig_error(R"({"frames":[{"file_path":"a\u0000b"}]})"), HasSubstr("zero character"));
    EXPECT_THAT(rig_error(R"({"frames":[{"file_path":"a"}]})"), HasSubstr("transform_matrix is missing"));
    EXPECT_THAT(rig_error(R"({"frames":[{"file_path":"a","transform_matrix":[[1,2],[3,4]]}]})"),
                HasSubstr("transform_matrix: must have 3 to 4 entries"));
    EXPECT_THAT(rig_error(one_frame("", "")), HasSubstr("R: frames[0]: has no w and h"));
    EXPECT_THAT(rig_error(one_frame(R"("w":8,"h":6,)", "")), HasSubstr("no fl_x or camera_angle_x"));
    EXPECT_THAT(rig_error(one_frame(R"("w":"8","h":6,"fl_x":1,)", "")), HasSubstr("R: w: must be a whole number"));
    EXPECT_THAT(rig_error(one_frame(R"("w":8.5,"h":6,"fl_x":1,)", "")),
                HasSubstr("w: must be a whole number from 1 to 8192"));
    EXPECT_THAT(rig_error(one_frame(R"("w":8193,"h":6,"fl_x":1,)", "")),
                HasSubstr("w: must be a whole number from 1 to 8192"));
    EXPECT_THAT(rig_error(one_frame(R"("w":8,"h":0,"fl_x":1,)", "")),
                HasSubstr("h: must be a whole number from 1 to 8192"));
    EXPECT_THAT(rig_error(one_frame(R"("w":8,"h":6,"fl_x":-1,)", "")),
                HasSubstr("fl_x: must be a number from 0.001 to 1e+07"));
    EXPECT_THAT(rig_error(one_frame(R"("w":8,"h":6,"fl_x":1e999,)", "")), HasSubstr("out of range"));
    EXPECT_THAT(rig_error(one_frame(R"("w":8,"h":6,"camera_angle_x":4,)", "")),
                HasSubstr("camera_angle_x: must be a number"));
    EXPECT_THAT(rig_error(one_frame(size, R"(,"cy":true)")), HasSubstr("R: frames[0].cy: must be a number"));
    EXPECT_THAT(rig_error(one_frame(size + R"("object_radius":-1,)", "")),
                HasSubstr("object_radius: must be a number from 0"));
}

TEST(Rig, RefusesMatricesThatAreNotRigid) {
    const auto with_matrix = [](const std::string& rows) {
        return R"({"w":8,"h":8,"fl_x":9,"frames":[{"file_path":"a","transform_matrix":)" + rows + "}]}";
    };
    EXPECT_THAT(rig_error(with_matrix("[[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]")), HasSubstr("remove the scale"));
    EXPECT_THAT(rig_error(with_matrix("[[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")), HasSubstr("mirrors"));
    EXPECT_THAT(rig_error(with_matrix("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]")), HasSubstr("0 0 0 1"));
    EXPECT_THAT(rig_error(with_matrix("[[1,0,0,1e300],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")),
                HasSubstr("transform_matrix[0][3]: must be a number"));
    EXPECT_THAT(rig_error(with_matrix("[[1,0,0,null],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")),
                HasSubstr("transform_matrix[0][3]: must be a number"));
    // Within the tolerance of 1e-3: rounded by other tools.
    EXPECT_TRUE(rig_from_json(with_matrix("[[1.0004,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"), "R").ok());
}

TEST(Rig, HostileTextIsRefused) {
    EXPECT_THAT(rig_error(std::string(1 << 20, '[')), HasSubstr("brackets"));
    std::string many = R"({"w":8,"h":8,"fl_x":9,"frames":[)";
    for (int i = 0; i <= kMaxViews; ++i) many += (i == 0 ? "{}" : ",{}");
    EXPECT_THAT(rig_error(many + "]}"), HasSubstr("frames: must have 1 to 4096 entries"));
    EXPECT_THAT(rig_error(R"({"frames":[{"file_path":")" + std::string(5000, 'a') + "\"}]}"), HasSubstr("too long"));
    // Brackets in strings do not nest.
    EXPECT_TRUE(
        rig_from_json(one_frame(R"("w":8,"h":6,"fl_x":10,"x":"\")" + std::string(500, '[') + "\",", ""), "R").ok());
}

TEST(Rig, FilesRoundTrip) {
    const TemporaryFolder folder;
    const Rig rig = ring();
    const Status written = write_rig(folder / kRigFileName, rig);
    ASSERT_TRUE(written.ok()) << written.error().message;
    for (const auto& path : {folder.path(), folder / kRigFileName}) {
        const auto back = read_rig(path);
        ASSERT_TRUE(back.ok()) << back.error().message;
        expect_same_camera(back->views[6].camera, rig.views[6].camera);
    }
}

TEST(Rig, ReadNamesTheMissingFile) {
    const TemporaryFolder folder;
    EXPECT_THAT(read_rig(folder.path()).error().message, HasSubstr("transforms.json: does not exist"));
}

TEST(Rig, WriteRefusesWhatJsonCannotHold) {
    const TemporaryFolder folder;
    Rig rig = ring();
    rig.views[1].camera.fl_x = std::nan("");
    EXPECT_THAT(write_rig(folder / "r.json", rig).error().message, HasSubstr("frame 1"));
    rig = ring();
    rig.views[2].file_path = "\xff\xfe.png";
    EXPECT_THAT(write_rig(folder / "r.json", rig).error().message, HasSubstr("UTF-8"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Rig, TakesTheSizeFromTheFirstImage) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "train");
    const auto text = R"({"camera_angle_x":0.7,"frames":[{"file_path":"./train/r_0","transform_matrix":)" +
                      std::string(kIdentity) + "}]}";
    std::ofstream(folder / kRigFileName) << text;
    EXPECT_THAT(read_rig(folder.path()).error().message,
                HasSubstr("no w and h, and they cannot be read from its image"));
    ASSERT_TRUE(write_png(folder.path() / "train" / "r_0.png", Image<Rgba8>(20, 10)).ok());
    const auto rig = read_rig(folder.path());
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->views[0].camera.width, 20);
    EXPECT_EQ(rig->views[0].camera.height, 10);
    EXPECT_NEAR(rig->views[0].camera.fl_x, 10 / std::tan(0.35), 1e-12);
    EXPECT_EQ(rig->views[0].file_path, "./train/r_0");
}

TEST(Rig, TakesTheSizesFromTheImages) {
    const TemporaryFolder folder;
    const auto frame = [](const std::string& name) {
        return R"({"file_path":")" + name + R"(","transform_matrix":)" + std::string(kIdentity) + "}";
    };
    std::ofstream(folder / kRigFileName) << R"({"fl_x":30,"frames":[)" << frame("a") << "," << frame("b") << ","
                                         << frame("missing") << "]}";
    ASSERT_TRUE(write_png(folder / "a.png", Image<Rgba8>(20, 10)).ok());
    ASSERT_TRUE(write_png(folder / "b.png", Image<Rgba8>(10, 20)).ok());
    const auto rig = read_rig(folder.path());
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->views[1].camera.height, 20) << "portrait and landscape";
    EXPECT_EQ(rig->views[2].camera.height, 10) << "as the first";
}

TEST(Rig, ImagePathAddsTheExtensionWhereNeeded) {
    const TemporaryFolder folder;
    const auto path_of = [&](const std::string& name) {
        RigView view;
        view.file_path = name;
        return image_path(folder.path(), view).filename().string();
    };
    std::ofstream(folder / "there.jpg") << "x";
    std::ofstream(folder / "frame.01.png") << "x";
    EXPECT_EQ(path_of("there.jpg"), "there.jpg");
    EXPECT_EQ(path_of("frame.01"), "frame.01.png");
    EXPECT_EQ(path_of("none"), "none.png");
    EXPECT_EQ(path_of("none.png"), "none.png");
}

TEST(Rig, RingStandsWhereItIsSaidTo) {
    RingOptions options;
    options.count = 4;
    options.distance = 3;
    options.elevation_rad = radians(30);
    options.look_at_height = 0.5;
    options.fl_px = 100;
    options.width = 64;
    options.height = 48;
    const Rig rig = make_ring(options);
    ASSERT_EQ(rig.views.size(), 4U);
    const glm::dvec3 first = rig.views[0].camera.centre();
    EXPECT_NEAR(first.x, 0, 1e-12);
    EXPECT_NEAR(first.y, 0.5 + 1.5, 1e-12);
    EXPECT_NEAR(first.z, 3 * std::cos(radians(30)), 1e-12);
    EXPECT_GT(rig.views[1].camera.centre().x, 2.5) << "from +Z the ring turns towards +X";
    for (const RigView& view : rig.views) {
        EXPECT_EQ(view.camera.fl_x, 100);
        EXPECT_LT(rotation_error(view.camera), 1e-14);
        const glm::dvec3 middle = view.camera.project({0, 0.5, 0});
        EXPECT_NEAR(middle.x, 32, 1e-9);
        EXPECT_NEAR(middle.y, 24, 1e-9);
        EXPECT_NEAR(middle.z, 3, 1e-9);
    }
    options.elevation_rad = 0;
    for (const RigView& view : make_ring(options).views) EXPECT_TRUE(is_upright(view.camera));
}

}  // namespace
