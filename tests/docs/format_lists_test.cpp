// The lists of docs/formats.md are those of the readers. RAYSPACE_UPDATE_DOCS=1 test_formats rewrites them.

#include "capture/posed/cameras/colmap_model.hpp"
#include "compositor/scene/vrml/node_table.hpp"
#include "compositor/scene/vrml1/tree.hpp"
#include "rayspace/geometry/rig_lens.hpp"
#include "rayspace/models/gltf_extensions.hpp"
#include "rayspace/models/mtl_text.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ranges>
#include <sstream>
#include <string>

namespace rs {
namespace {

constexpr std::string_view kHeading =
    "## Lists\n\nFrom the tables of the readers; `RAYSPACE_UPDATE_DOCS=1 test_formats` writes them.\n";

template <class Names>
std::string listed_names(const Names& names) {
    std::string text;
    for (const auto& name : names) {
        if (!std::string_view(name).empty()) text += (text.empty() ? "`" : " `") + std::string(name) + "`";
    }
    return text;
}

std::string lists() {
    std::string text(kHeading);
    const auto add = [&](const std::string& title, const std::string& names) {
        text += "\n**" + title + ":** " + names + "\n";
    };
    add("`camera_model` of `transforms.json`, pinholes", listed_names(kPinholeLensNames));
    add("`camera_model` of `transforms.json`, fisheye (posed photos only)", listed_names(kFisheyeLensNames));
    add("Keys of lens distortion in `transforms.json` (removed by `rs-capture import --known`, refused in capture "
        "sets)",
        listed_names(kDistortionKeys));
    add("Flags of `transforms.json` that are refused if they are true",
        listed_names(kPanoramaFlags) + " (`is_fisheye` is a fisheye)");
    add("COLMAP camera models, read", listed_names(capture::colmap_camera_models()));
    add("COLMAP camera models, refused", listed_names(capture::refused_colmap_camera_models()));
    add("glTF extensions, read", listed_names(supported_gltf_extensions()));
    add("glTF content that is ignored with a warning", listed_names(ignored_gltf_contents()));
    add("MTL keywords, known", listed_names(mtl_keywords()));
    add("VRML 97 and X3D nodes, read", listed_names(compositor::vrml::node_table() | std::views::keys));
    add("VRML 97 and X3D nodes without effect in still images, ignored", listed_names(compositor::vrml::behaviours()));
    add("VRML 1.0 nodes, read", listed_names(compositor::vrml1::node_kinds() | std::views::keys));
    return text;
}

TEST(FormatLists, AreThoseOfTheReaders) {
    const std::filesystem::path file = std::filesystem::path(RAYSPACE_SOURCE_DIR) / "docs/formats.md";
    std::stringstream content;
    content << std::ifstream(file).rdbuf();
    const std::string text = content.str();
    const std::size_t begin = text.find("## Lists");
    ASSERT_NE(begin, std::string::npos);
    if (std::getenv("RAYSPACE_UPDATE_DOCS") != nullptr) {
        std::ofstream(file) << text.substr(0, begin) << lists();
        GTEST_SKIP() << file << " was written";
    }
    EXPECT_EQ(text.substr(begin), lists()) << "write them by RAYSPACE_UPDATE_DOCS=1 test_formats";
}

}  // namespace
}  // namespace rs
