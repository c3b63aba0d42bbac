#pragma once
// Options of rs-view that share the view of a window between machines (compositor/sharing).

#include "compositor/tools/scene_options.hpp"
#include "compositor/window/visit_sharing.hpp"
#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace rs::compositor {

struct SharingOptions {
    std::optional<std::string> share;   // [ADDRESS:]PORT to listen at
    std::optional<std::string> follow;  // HOST:PORT of a leader

    [[nodiscard]] bool is_given() const { return share || follow; }
};

/// Adds --share, and --follow, which its text describes: lists of options fit on a screen.
void add_sharing_options(CLI::App& command, SharingOptions& options);
/// Throws CLI::ValidationError if both are given, or one without a window.
void check_sharing_options(const SharingOptions& options, bool has_window);

/// Opens the leader's port, or prepares a follower. Fails for what is not an address, and if the port cannot be opened.
/// \param scene its file; its bytes and `objects`, the arguments of --object, must be the same on all machines
Result<SharingPeers> sharing_peers(const SharingOptions& options, const std::filesystem::path& scene,
                                   const std::vector<std::string>& objects);

}  // namespace rs::compositor
