#include "rayspace/models/mtl_text.hpp"

#include <gtest/gtest.h>

namespace rs {
namespace {

TEST(MtlText, TextureStatementsAreNormalised) {
    const auto rewritten = [](const std::string& line) { return rewrite_mtl("newmtl a\n" + line).text.substr(9); };
    EXPECT_EQ(rewritten("map_Kd my texture.png"), "map_Kd my texture.png\n");
    EXPECT_EQ(rewritten("  MAP_KD t.png  \r\n"), "map_Kd t.png\n");
    EXPECT_EQ(rewritten("bump t.png -bm 0.5"), "bump -bm 0.5 t.png\n");
    EXPECT_EQ(rewritten("map_Kd -texres 512 sub\\t.png"), "map_Kd sub\\t.png\n");
    EXPECT_EQ(rewritten("map_Kd -clamp on -o 0 0 0 -s 1 1 1 my t.png"), "map_Kd -clamp on my t.png\n");
    EXPECT_EQ(rewritten("map_Kd -s 2 3.png"), "map_Kd 3.png\n");
    EXPECT_EQ(rewritten("map_Kd -s 2 1"), "");
    EXPECT_EQ(rewritten("# comment\nKd 1 0 0\nunknown 1"), "Kd 1 0 0\nunknown 1\n");
}

TEST(MtlText, PlacementsAreThoseOfColourTextures) {
    const MtlText text =
        rewrite_mtl("newmtl a\nmap_Kd -s 2 1 1 -o 0.5 t.png\nmap_bump -s 3 3 3 b.png\nnewmtl b\nmap_Kd t.png");
    ASSERT_EQ(text.placements.size(), 1U);
    EXPECT_EQ(text.placements.at("a").scale, glm::vec2(2, 1));
    EXPECT_EQ(text.placements.at("a").offset, glm::vec2(0.5, 0));
}

TEST(MtlText, FullTransparencyOfOpaqueMaterialsIsRemoved) {
    EXPECT_EQ(rewrite_mtl("newmtl a\nTr 1.0\nillum 1\n").text, "newmtl a\nillum 1\n");
    EXPECT_EQ(rewrite_mtl("newmtl a\nTr 1.0\nillum 4\n").text, "newmtl a\nillum 4\nTr 1.0\n");
    EXPECT_EQ(rewrite_mtl("newmtl a\nTr 0.5\n").text, "newmtl a\nTr 0.5\n");
    EXPECT_EQ(rewrite_mtl("newmtl a\nd 1\nTr 1\nillum 4").text, "newmtl a\nd 1\nillum 4\n");
}

TEST(MtlText, StatementsOutsideOfMaterialsAreRemoved) {
    EXPECT_EQ(rewrite_mtl("\xEF\xBB\xBF"
                          "newmtl a\nKd 1 1 1")
                  .text,
              "newmtl a\nKd 1 1 1\n");
    EXPECT_EQ(rewrite_mtl("Kd 1 1 1\n").text, "");
    EXPECT_EQ(rewrite_mtl("").text, "");
}

}  // namespace
}  // namespace rs
