#include "compositor/displays/network_endpoint.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

TEST(NetworkEndpoint, HostsAndPortsAreParsed) {
    EXPECT_EQ(parse_network_endpoint("4250"), (NetworkEndpoint{"", 4250}));
    EXPECT_EQ(parse_network_endpoint("wall-2:1"), (NetworkEndpoint{"wall-2", 1}));
    EXPECT_EQ(parse_network_endpoint("[::1]:65535"), (NetworkEndpoint{"::1", 65535}));
    EXPECT_EQ((NetworkEndpoint{"::1", 7}).text(), "[::1]:7");
    for (const char* const wrong : {"", ":", ":1", "0", "host:0", "host:65536", "host:", "host", "host:-1", "1 "}) {
        EXPECT_FALSE(parse_network_endpoint(wrong).has_value()) << wrong;
    }
}

}  // namespace
}  // namespace rs::compositor
