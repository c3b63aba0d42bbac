#include "capture/calibration/model/turntable_model.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rs::capture {
namespace {

TEST(TurntableModel, MedianStepIsSigned) {
    EXPECT_DOUBLE_EQ(median_step(std::vector<double>{0, -0.1, -0.2, -0.9}), -0.1);
    EXPECT_EQ(median_step(std::vector<double>{0}), 0);
}

}  // namespace
}  // namespace rs::capture
