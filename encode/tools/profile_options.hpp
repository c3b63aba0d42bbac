#pragma once
// The options of `rs-encode build` that choose how images are stored.

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
    std::string size;  // bytes of the images, with k, M or G; empty: not given
    int effort = ImageGoal{}.effort;
    std::optional<int> alpha_bits;  // nothing: as suits the quality
};

void add_profile_options(CLI::App& command, ProfileArguments& arguments);

// Nothing for images that are stored raw.
Result<std::optional<ImageGoal>> goal_of(const ProfileArguments& arguments);

}  // namespace rs::encode
