#include "compositor/sequence/sequence.hpp"
#include "compositor/sequence/converter.hpp"
#include "compositor/sequence/frames_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr const char* kMaterials =
    "newmtl Grey\nKd 0.5 0.5 0.5\n\nnewmtl Red\nNs 32\nKa 0.1 0.2 0.3\nKd 0.8 0 0\nKs 0.5 0.5 0.5\n";
constexpr const char* kBase =
    "mtllib all.mtl\no Ground\nusemtl Grey\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nf 1 2 3 4\n"
    "o Post\nv 0 0 0\nv 1 0 0\nv 0 2 0\nf -3 -2 -1\ninstance Post 3 1 0 0 0 0 1 1 1 -\ncamera 0 2 9 0 0 0 60\n";
constexpr const char* kCars =
    "mtllib all.mtl\no Car\nusemtl Grey\nv 4 0 0\nv 6 0 0\nv 4 1 0\nv 6 1 0\nf 1 2 3\nusemtl Red\nf 2 4 3\n"
    "o Van\nusemtl Red\nv 0 0 0\nv 1 0 0\nv 0 3 0\nf -3 -2 -1\n";

class SequenceFiles : public ::testing::Test {
protected:
    SequenceFiles() {
        fs::create_directories(out());
        write(folder_ / "models" / "base.obj", kBase);
        write(folder_ / "models" / "cars.obj", kCars);
        write(folder_ / "models" / "all.mtl", kMaterials);
    }
    [[nodiscard]] fs::path out() const { return folder_ / "maps" / "town" / "anim" / "out"; }
    static void write(const fs::path& path, const std::string& text) {
        fs::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    void frames(const std::vector<std::string>& texts, const std::string& more = "") const {
        std::string names;
        for (std::size_t i = 0; i < texts.size(); ++i) {
            const std::string name = "f" + std::to_string(i) + ".obj";
            write(out() / name, texts[i]);
            names += (i == 0 ? "\"" : ", \"") + name + "\"";
        }
        write(
            out() / "frames.json", R"({"base": "../../../../models/base.obj", "models": ["../../../../models/cars.obj"],
            "frames": [)" + names + "]" +
                                       more + "}");
    }
    Result<Sequence> read() const { return read_sequence(folder_ / "maps" / "town"); }

    test::TemporaryFolder folder_;
};

TEST_F(SequenceFiles, TheDefaultFloorDoesNotHideAGroundOfTheFrames) {
    const fs::path list = folder_ / "frames.json";
    write(list, R"({"frames": ["frame.obj"]})");
    const std::string ground = "o Ground\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3\n";
    write(folder_ / "frame.obj", ground);
    const auto still = read_sequence(list);
    ASSERT_TRUE(still) << still.error().message;
    EXPECT_FALSE(still->scene.floor);
    write(folder_ / "frame.obj", ground + "instance Ground 0 2 0 0 0 0 1 1 1 -\n");
    const auto moving = read_sequence(list);
    ASSERT_TRUE(moving) << moving.error().message;
    EXPECT_TRUE(moving->scene.floor);
    // The floor of a base scene stays.
    write(folder_ / "base.json", R"({"floor": {"height": -1}})");
    write(folder_ / "frame.obj", ground);
    write(list, R"({"base": "base.json", "frames": ["frame.obj"]})");
    const auto based = read_sequence(list);
    ASSERT_TRUE(based) << based.error().message;
    ASSERT_TRUE(based->scene.floor);
    EXPECT_EQ(based->scene.floor->height, -1);
}

TEST_F(SequenceFiles, StaticPartsStandAndInstancesTakeSlots) {
    frames({"instance Car 1 0 0 0 0 0 1 1 1 -\ninstance Car 2 0 0 0 0 0 1 1 1 -\n",
            "instance Car 5 0 0 0 90 0 1 1 1 -\ncamera 1 1 1 0 0 0 45\n", ""});
    const auto sequence = read();
    ASSERT_TRUE(sequence) << sequence.error().message;
    EXPECT_EQ(sequence->name, "town");
    EXPECT_EQ(sequence->scene.shading, Shading::kPhong);
    ASSERT_THAT(sequence->slots, SizeIs(2));
    EXPECT_THAT(sequence->slots[0].geometry, SizeIs(2));  // two materials
    EXPECT_EQ(sequence->slots[0].middle, glm::dvec3(5, 0.5, 0));
    std::size_t still = 0;
    for (const GeometryNode& node : sequence->scene.geometry) still += node.moving ? 0 : 1;
    EXPECT_EQ(still, 2U);  // the ground, and the post, which only occurs as an instance

    const SlotTransforms first = slot_transforms(*sequence, 0);
    ASSERT_TRUE(first.geometry[0] && first.geometry[1]);
    EXPECT_EQ(glm::dvec3(*first.geometry[1] * glm::dvec4(5, 0.5, 0, 1)), glm::dvec3(2, 0, 0));
    const SlotTransforms second = slot_transforms(*sequence, 1);
    ASSERT_TRUE(second.geometry[0]);
    EXPECT_FALSE(second.geometry[1]);
    EXPECT_FALSE(slot_transforms(*sequence, 2).geometry[0]);
    EXPECT_THAT(scene_at(*sequence, 2).geometry, SizeIs(2));  // the default scene

    EXPECT_EQ(camera_of(*sequence, 0)->pose.eye, glm::dvec3(0, 2, 9));  // of the base
    EXPECT_EQ(camera_of(*sequence, 1)->pose.eye, glm::dvec3(1, 1, 1));
}

TEST_F(SequenceFiles, ObjectsAndMaterialsAreNamedOrCounted) {
    frames({"instance 1 0 0 0 0 0 0 1 1 1 0\ninstance Car 0 0 0 0 0 0 1 1 1 Red\ninstance 2 0 0 0 0 0 0 1 1 1 -1\n"});
    const auto sequence = read();
    ASSERT_TRUE(sequence) << sequence.error().message;
    ASSERT_THAT(sequence->slots, SizeIs(3));
    const auto diffuse = [&](std::size_t slot, std::size_t part) {
        return sequence->scene.geometry[sequence->slots[slot].geometry.at(part)].material.diffuse;
    };
    EXPECT_EQ(diffuse(0, 0), glm::vec3(0.5F));  // the van with a grey material
    EXPECT_EQ(diffuse(1, 0), glm::vec3(0.8F, 0, 0));
    EXPECT_EQ(diffuse(1, 1), glm::vec3(0.8F, 0, 0));
    EXPECT_EQ(sequence->slots[2].geometry.size(),
              1U);  // index 2 follows the two models: the base's first object, the ground
    const Material& red = sequence->scene.geometry[sequence->slots[1].geometry[0]].material;
    ASSERT_TRUE(red.phong);
    EXPECT_FLOAT_EQ(red.phong->exponent, 32);
    EXPECT_LT(glm::distance(red.phong->ambient, glm::vec3(0.1F, 0.2F, 0.3F)), 1e-6F);
}

TEST_F(SequenceFiles, MeshesOfFramesAreReadOnceAndStandWhereTheyAre) {
    const std::string mesh = "o Thing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no Rest\nv 5 5 5\nf 1 2 4\n";
    frames({mesh + "instance 0 1 0 0 0 0 0 1 1 1 -\n", mesh + "instance Thing 2 0 0 0 0 0 1 1 1 -\n"});
    const auto sequence = read();
    ASSERT_TRUE(sequence) << sequence.error().message;
    ASSERT_THAT(sequence->slots, SizeIs(2));
    EXPECT_EQ(*slot_transforms(*sequence, 1).geometry[1], glm::dmat4(1.0));
}

TEST_F(SequenceFiles, FaultsNameFileAndLine) {
    const std::pair<const char*, const char*> faulty[] = {
        {"\ninstance Bus 0 0 0 0 0 0 1 1 1 -\n", "f0.obj:2: there is no object 'Bus'"},
        {"instance 7 0 0 0 0 0 0 1 1 1 -\n", "f0.obj:1: there is no object '7' (there are 4"},
        {"instance Car 0 0 0 0 0 0 1 1 1 Blue\n", "f0.obj:1: there is no material 'Blue'"},
        {"instance Car 0 0 0 0 0 0 1 1 1 2\n", "f0.obj:1: there is no material '2' (there are 2"},
        {"instance vase.rso 0 0 0 0 0 0 1 1 1 -\n", "f0.obj:1: there is no object "},
        {"instance vase.rso 0 0 0 0 0 0 1 2 1 -\n", "f0.obj:1: a ray-space object keeps its shape"},
        {"o A\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "f0.obj:2: the material library 'none.mtl'"},
    };
    for (const auto& [text, what] : faulty) {
        frames({text});
        const auto sequence = read();
        ASSERT_FALSE(sequence) << what;
        EXPECT_THAT(sequence.error().message, HasSubstr(what));
    }
}

TEST_F(SequenceFiles, FramesFilesAreStrict) {
    const auto fault = [](const std::string& text) {
        const auto read = frames_from_json(text, "maps/a/frames.json");
        return read ? std::string() : read.error().message;
    };
    EXPECT_EQ(fault(R"({"frames": ["a.obj"]})"), "");
    EXPECT_THAT(fault(R"({"frames": []})"), HasSubstr("frames"));
    EXPECT_THAT(fault(R"({"frame": ["a.obj"]})"), HasSubstr("frames.json"));
    EXPECT_THAT(fault(R"({"frames": ["a.obj"], "fps": 3})"), HasSubstr("fps"));
    EXPECT_THAT(fault(R"({"frames": ["a.obj"], "weather": "hail"})"), HasSubstr("weather"));
    EXPECT_THAT(fault(R"({"frames": ["a.obj"], "frames_per_second": 0})"), HasSubstr("frames_per_second"));
    EXPECT_THAT(fault(R"({"frames": ["a.obj"], "haze_m": 0})"), HasSubstr("haze_m"));
    EXPECT_EQ(fault(R"({"frames": ["a.obj"], "haze_m": 900})"), "");
}

TEST_F(SequenceFiles, MapsAreFound) {
    frames({""});
    EXPECT_TRUE(find_sequence(folder_ / "maps" / "town"));
    EXPECT_TRUE(find_sequence(folder_.path()));
    EXPECT_TRUE(find_sequence(out() / "frames.json"));
    EXPECT_TRUE(find_sequence(folder_ / "models" / "base.obj"));
    EXPECT_THAT(find_sequence(folder_ / "models").error().message, HasSubstr("has no frames.json"));
    write(folder_ / "maps" / "city" / "anim" / "out" / "frames.json", "{}");
    EXPECT_THAT(find_sequence(folder_.path()).error().message, HasSubstr("several maps"));
}

TEST(Converter, WordsAreTakenWithoutAShell) {
    const auto words = parse_converter_command(R"(my 'one word' "it's" {in}.x a$HOME;b {out})", "in dir", "out");
    ASSERT_TRUE(words);
    EXPECT_THAT(*words, ElementsAre("my", "one word", "it's", "in dir.x", "a$HOME;b", "out"));
    EXPECT_FALSE(parse_converter_command("my {in}", "a", "b"));
    EXPECT_FALSE(parse_converter_command("my '{in} {out}", "a", "b"));
}

TEST_F(SequenceFiles, ConvertersAreChecked) {
    frames({""});
    const auto copied = convert_scene("cp -r {in} {out}", folder_ / "maps" / "town");
    ASSERT_TRUE(copied) << copied.error().message;
    EXPECT_TRUE(find_sequence(copied->path));
    const fs::path in = folder_ / "maps";
    EXPECT_THAT(convert_scene("false {in} {out}", in).error().message, HasSubstr("ended with 1"));
    EXPECT_THAT(convert_scene("true {in} {out}", in).error().message, HasSubstr("written nothing"));
    EXPECT_THAT(convert_scene("no-such-converter {in} {out}", in).error().message, HasSubstr("cannot be run"));
}

}  // namespace
}  // namespace rs::compositor
