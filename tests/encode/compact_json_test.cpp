#include "encode/compact_json.hpp"

#include <gtest/gtest.h>

namespace rs::encode {
namespace {

TEST(CompactJson, SaysTheSameInFewerBytes) {
    EXPECT_EQ(compact_json("{\n  \"w\": 684,\n  \"b\": [0.1, -0.0, 1e-20],\n  \"a\": {\"x\": 2871.5243293016447}\n}"),
              "{\"w\":684,\"b\":[0.1,0.0,1e-20],\"a\":{\"x\":2871.52433}}");
}

TEST(CompactJson, IsTheSameAgain) {
    const std::string once = compact_json("[0.12345678949999999, 123456789012.5, \"0.12345678949999999\", null, true]");
    EXPECT_EQ(once, "[0.123456789,123456789000.0,\"0.12345678949999999\",null,true]");
    EXPECT_EQ(compact_json(once), once);
}

}  // namespace
}  // namespace rs::encode
