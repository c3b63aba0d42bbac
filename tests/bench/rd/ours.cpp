#include "tests/bench/rd/ours.hpp"

#include "rayspace/format/object_chunks.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/bench/rd/anchors/tool_process.hpp"

#include <system_error>

namespace rs::bench {
namespace {

struct Profile {
    std::string name;
    std::vector<int> qualities;  // empty: no option --quality
};

const std::vector<Profile>& profiles() {
    static const std::vector<Profile> table = {
        {"raw", {}},
        {"dense", {20, 28, 35, 42, 50, 58, 65, 72, 80}},
        {"board", {40, 60, 75, 90}},
    };
    return table;
}

Result<Coded> read_back(const ReferenceImages& images, const std::filesystem::path& encoder,
                        const std::filesystem::path& file) {
    const Result<ContainerReader> container = ContainerReader::open(file);
    if (!container) return container.error();
    Coded coded;
    coded.bytes = container->size_bytes();
    coded.has_alpha = true;
    for (const ChunkSummary& chunk : summarise_chunks(*container)) {
        if (chunk.name == to_string(object_chunks::kMap) || chunk.name == to_string(object_chunks::kShape)) {
            coded.bytes -= chunk.size_bytes;
        }
    }
    // The encoder decodes its own file, since it may be of another build.
    const std::filesystem::path folder = file.parent_path() / "ours-images";
    const Result<std::string> ran = run_tool({encoder.string(), "extract", file.string(), "-o", folder.string(), "-q"});
    if (!ran) return ran.error();
    const Result<ReferenceImages> decoded = read_reference_images(folder, nullptr);
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    if (!decoded) return decoded.error();
    if (decoded->views.size() != images.views.size() || decoded->width != images.width ||
        decoded->height != images.height) {
        return Error{file.string() + ": does not hold the set's images at their size; try another --encoder"};
    }
    for (std::size_t view = 0; view < images.views.size(); ++view) {
        coded.error += object_error(images, view, decoded->views[view]);
    }
    return coded;
}

Result<Coded> code_ours(const ReferenceImages& images, const std::vector<std::string>& options,
                        const std::filesystem::path& encoder, const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "ours.rso";
    std::vector<std::string> command = {encoder.string(), "build", images.folder.string(), "-o", file.string(), "-q"};
    command.insert(command.end(), options.begin(), options.end());
    // Fastest RS map, as the map does not count.
    command.insert(command.end(), {"--raymap", "plane"});
    if (const Result<std::string> ran = run_tool(command); !ran) return ran.error();
    Result<Coded> coded = read_back(images, encoder, file);
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    return coded;
}

}  // namespace

const std::vector<std::string>& profile_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Profile& profile : profiles()) list.push_back(profile.name);
        return list;
    }();
    return names;
}

Status check_encoder(const std::filesystem::path& encoder, const std::set<std::string>& names) {
    std::string needing;
    for (const Profile& profile : profiles()) {
        if (names.contains(profile.name) && !profile.qualities.empty())
            needing += (needing.empty() ? "" : ", ") + profile.name;
    }
    if (needing.empty()) return {};
    const Result<std::string> help = run_tool({encoder.string(), "build", "--help"});
    if (!help) return help.error();
    for (const std::string option : {"--profile", "--quality"}) {
        if (help->find(option) == std::string::npos) {
            return Error{encoder.string() + ": its build has no " + option + ", which is needed for " + needing +
                         "; give another --encoder, or --only anchors, or --only raw"};
        }
    }
    return {};
}

Result<std::vector<Measurement>> measure_ours(const ReferenceImages& images, const std::set<std::string>& names,
                                              const std::filesystem::path& encoder, const WorkFolder& work,
                                              Progress& progress) {
    struct Point {
        std::string profile;
        std::string setting;
        std::vector<std::string> options;
    };
    std::vector<Point> points;
    for (const Profile& profile : profiles()) {
        if (!names.contains(profile.name)) continue;
        if (profile.qualities.empty()) points.push_back({profile.name, "stored", {"--profile", profile.name}});
        for (const int quality : profile.qualities) {
            const std::string number = std::to_string(quality);
            points.push_back({profile.name, "q" + number, {"--profile", profile.name, "--quality", number}});
        }
    }
    progress.start(images.name + ": ours", static_cast<std::int64_t>(points.size()));
    std::vector<Measurement> measured;
    for (const Point& point : points) {
        const Result<Coded> coded = code_ours(images, point.options, encoder, work.scratch());
        if (!coded) return coded.error();
        measured.push_back(measurement_of(images, point.profile, "", point.setting, *coded));
        progress.advance();
    }
    progress.finish();
    return measured;
}

}  // namespace rs::bench
