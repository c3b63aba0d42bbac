#pragma once
// The options of `rs-encode build` that choose how pictures are stored.

#include "encode/encode_pictures.hpp"
#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace rs::encode {

struct ProfileArguments {
    std::string profile = "dense";
    double quality = PictureGoal{}.quality;
    std::optional<double> psnr_db;
    std::string size;  // bytes of the pictures, with k, M or G; empty: not given
    int effort = PictureGoal{}.effort;
    std::optional<int> alpha_bits;  // nothing: as suits the quality
};

void add_profile_options(CLI::App& command, ProfileArguments& arguments);

// Nothing for pictures that are stored raw.
Result<std::optional<PictureGoal>> goal_of(const ProfileArguments& arguments);

}  // namespace rs::encode
