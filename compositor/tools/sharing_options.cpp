#include "compositor/tools/sharing_options.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <xxhash.h>

#include <memory>

namespace rs::compositor {
namespace {

constexpr std::uint64_t kMaxSharedScene_bytes = 4ULL << 30U;

// Digest of the scene file and the objects that are added to it. The name of the file is not part of it.
Result<std::uint64_t> scene_digest(const std::filesystem::path& scene, const std::vector<std::string>& objects) {
    std::uint64_t digest = 0;
    if (!scene.empty()) {
        RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(scene, kMaxSharedScene_bytes));
        digest = XXH3_64bits(bytes.data(), bytes.size());
    }
    for (const std::string& object : objects) digest = XXH3_64bits_withSeed(object.data(), object.size(), digest);
    return digest;
}

}  // namespace

void add_sharing_options(CLI::App& command, SharingOptions& options) {
    command
        .add_option("--share", options.share,
                    "windows: share view and lights with others that run with --follow HOST:PORT")
        ->type_name("[ADDR:]PORT");
    command.add_option("--follow", options.follow)->type_name("HOST:PORT")->group("");
}

void check_sharing_options(const SharingOptions& options, bool has_window) {
    if (!options.is_given()) return;
    if (options.share && options.follow) {
        throw CLI::ValidationError(
            "--share and --follow exclude each other; start another leader, or follow the first");
    }
    if (has_window) return;
    throw CLI::ValidationError(std::string(options.share ? "--share" : "--follow") +
                               " is for windows; leave it out, or -o");
}

Result<SharingPeers> sharing_peers(const SharingOptions& options, const std::filesystem::path& scene,
                                   const std::vector<std::string>& objects) {
    SharingPeers peers;
    if (!options.is_given()) return peers;
    RS_ASSIGN_OR_RETURN(const std::uint64_t digest, scene_digest(scene, objects));
    peers.scene = scene;
    if (options.share) {
        std::optional<NetworkEndpoint> place = parse_network_endpoint(*options.share);
        if (!place) {
            return Error{"--share " + printable(*options.share) +
                         ": must be PORT or ADDRESS:PORT, such as 4250 or 0.0.0.0:4250"};
        }
        if (place->host.empty()) place->host = "127.0.0.1";
        Result<ViewLeader> leader = ViewLeader::listen(*place, digest);
        if (!leader) return Error{"--share " + leader.error().message};
        peers.leader = std::make_shared<ViewLeader>(std::move(*leader));
        return peers;
    }
    const std::optional<NetworkEndpoint> leader = parse_network_endpoint(*options.follow);
    if (!leader || leader->host.empty()) {
        return Error{"--follow " + printable(*options.follow) + ": must be HOST:PORT, such as master:4250"};
    }
    peers.follower = std::make_shared<ViewFollower>(*leader, digest);
    return peers;
}

}  // namespace rs::compositor
