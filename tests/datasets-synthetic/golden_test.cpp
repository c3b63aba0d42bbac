// Objects are bit-identical with every compiler, optimisation level and C library. An intended change of an object
// updates its hash here, with the reason in the commit message; any other change of a hash is a defect.

#include "datasets-synthetic/objects.hpp"
#include "tests/datasets-synthetic/digest.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>

namespace rs::synthetic {
namespace {

const std::map<std::string, std::uint64_t> kGolden{
    {"vase", 0xEA85A33D57F25713ULL},  {"flower", 0x506E3028B14DF799ULL},  {"doll", 0x0E66F19138461C66ULL},
    {"lamp", 0xF22367353B4201BBULL},  {"lattice", 0xA2EFC3F2F8A7DB0AULL}, {"blocks", 0xDAF3D5AD6A5E5714ULL},
    {"phone", 0x06B82F1FEC5F69B1ULL},
};

TEST(Golden, ObjectsAreTheSameBitsEverywhere) {
    EXPECT_EQ(kGolden.size(), object_names().size());
    for (const auto& [name, expected] : kGolden) {
        const Result<capture::Scene> scene = generate(name, nullptr, 7);
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(digest(*scene), expected) << name << ": 0x" << std::hex << digest(*scene);
    }
}

}  // namespace
}  // namespace rs::synthetic
