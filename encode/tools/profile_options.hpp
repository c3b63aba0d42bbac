#pragma once
// Options of `rs-encode build` for the storage of images.

#include "encode/encode_images.hpp"
#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace rs::encode {

struct ProfileArguments {
    std::string profile = "dense";
    double quality = ImageGoal{}.quality;
    std::optional<double> psnr_db;
    std::string size;  // bytes of the images with suffix k, M or G; empty: not given
    int effort = ImageGoal{}.effort;
    std::optional<int> alpha_bits;  // nullopt: chosen by encode_images()
};

void add_profile_options(CLI::App& command, ProfileArguments& arguments);

/// Converts the options; nullopt for raw images.
Result<std::optional<ImageGoal>> parse_goal(const ProfileArguments& arguments);

}  // namespace rs::encode
