#include "rayspace/models/gltf_extensions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>

namespace rs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> warnings_of(std::string_view text) {
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    const Result<GltfFile> file = prepare_gltf({first, first + text.size()}, "a.gltf");
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file.ok() ? file->warnings : std::vector<std::string>{};
}

TEST(GltfExtensions, ContentThatIsIgnoredIsNamed) {
    EXPECT_THAT(warnings_of(R"({"animations": [{}], "skins": [{}], "meshes": [{"primitives": [{"targets": [{}]}]}]})"),
                ElementsAre(HasSubstr("a.gltf: animations are not played"), HasSubstr("skins are ignored"),
                            HasSubstr("morph targets are ignored")));
    EXPECT_THAT(warnings_of(R"({"animations": [], "nodes": [{"name": "skins"}], "meshes": [{"primitives": 3}, 4]})"),
                ElementsAre());
    EXPECT_THAT(warnings_of(R"({"extensionsUsed": ["KHR_materials_unlit", "EXT_a", 5]})"),
                ElementsAre(HasSubstr("EXT_a is not supported")));
}

}  // namespace
}  // namespace rs
