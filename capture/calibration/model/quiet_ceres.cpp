#include "capture/calibration/model/quiet_ceres.hpp"

#include <glog/logging.h>

namespace rs::capture {

void silence_ceres() {
    static const bool done = [] {
        FLAGS_minloglevel = google::GLOG_FATAL;  // failed steps are part of a solver's life; the summary tells the rest
        return true;
    }();
    static_cast<void>(done);
}

}  // namespace rs::capture
