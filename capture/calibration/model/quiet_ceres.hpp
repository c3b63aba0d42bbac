#pragma once
// Libraries of this project do not print; Ceres does, through glog.

namespace rs::capture {

// Call before ceres::Solve. Thread-safe; affects the whole process.
void silence_ceres();

}  // namespace rs::capture
