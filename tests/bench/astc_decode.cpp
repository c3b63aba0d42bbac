// Decoding speed of astcenc on whole images, for comparison with the engine's in bench_core. Uses the decoding time
// that astcenc prints. Skipped, with a message, if the command is not installed.

#include "rayspace/geometry/rig.hpp"
#include "tests/bench/ball_image.hpp"
#include "tests/bench/rd/anchors/tool_process.hpp"

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>

#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace rs::bench {
namespace {

constexpr int kSide = 512;
constexpr const char* kThreads = "2";

// Temporary folder, removed by the destructor.
class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("rayspace-astc-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

// Parses "    Decoding time:               0.0331 s".
std::optional<double> decoding_seconds(const std::string& printed) {
    const std::string label = "Decoding time:";
    const std::size_t at = printed.find(label);
    if (at == std::string::npos) return std::nullopt;
    return std::strtod(printed.c_str() + at + label.size(), nullptr);
}

void astc_decode(benchmark::State& state, const char* block) {
    const Folder folder;
    const Rig rig = make_ring(
        {.count = 4, .distance = 3.5, .fl_px = 1.4 * kSide, .width = kSide, .height = kSide, .first_rad = 0.01});
    const Image<Rgba8> ball = ball_image(rig.views.front().camera);
    const cv::Mat bytes(kSide, kSide, CV_8UC4, const_cast<Rgba8*>(ball.data()));  // read only
    if (!cv::imwrite(folder.file("ball.png"), bytes)) return state.SkipWithError("the image could not be written");
    const auto coded =
        run_tool({"astcenc", "-cs", folder.file("ball.png"), folder.file("ball.astc"), block, "-medium", "-silent"});
    if (!coded) return state.SkipWithError(coded.error().message.c_str());
    for (auto _ : state) {
        const auto printed =
            run_tool({"astcenc", "-ds", folder.file("ball.astc"), folder.file("out.png"), "-j", kThreads});
        const auto seconds = printed ? decoding_seconds(*printed) : std::nullopt;
        if (!seconds) return state.SkipWithError("astcenc -ds does not print its decoding time");
        state.SetIterationTime(*seconds);
    }
    state.SetItemsProcessed(state.iterations() * kSide * kSide);
}
BENCHMARK_CAPTURE(astc_decode, 6x6, "6x6")->UseManualTime()->Iterations(20);
BENCHMARK_CAPTURE(astc_decode, 10x10, "10x10")->UseManualTime()->Iterations(20);

}  // namespace
}  // namespace rs::bench
