#include "capture/photos/intake/colour_difference.hpp"

#include <gtest/gtest.h>

namespace rs::capture {
namespace {

TEST(AlikeInSomeLight, LightMakesNoOtherSurface) {
    EXPECT_TRUE(alike_in_some_light({0.4F, 0.3F, 0.2F}, {0.2F, 0.15F, 0.1F}));
    EXPECT_TRUE(alike_in_some_light({0.1F, 0.075F, 0.05F}, {0.4F, 0.3F, 0.2F}));
    EXPECT_FALSE(alike_in_some_light({0.4F, 0.3F, 0.2F}, {0.2F, 0.3F, 0.4F}));
    EXPECT_FALSE(alike_in_some_light({0.8F, 0.6F, 0.4F}, {0.04F, 0.03F, 0.02F})) << "twenty times as bright";
}

}  // namespace
}  // namespace rs::capture
