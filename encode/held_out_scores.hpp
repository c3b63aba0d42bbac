#pragma once
// How near the answers to held-out views came to the true pictures, for one way of answering.

#include <string>
#include <vector>

namespace rs::encode {

struct HeldOutScore {
    int view = 0;         // index in the rig of the whole set
    std::string picture;  // its file_path
    double psnr_db = 0;   // picture_metrics.hpp
    double ssim = 0;
};

struct MethodScores {
    std::string method;
    std::vector<HeldOutScore> views;
    double mean_psnr_db = 0;    // mean over views of the views' dB
    double pooled_psnr_db = 0;  // dB of all views' object pixels taken together
    double mean_ssim = 0;
    double build_seconds = 0;  // making the object from the kept views, reading their pictures included
};

}  // namespace rs::encode
