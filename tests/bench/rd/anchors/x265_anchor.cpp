#include "tests/bench/rd/anchors/x265_anchor.hpp"

#include "rayspace/base/parallel.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/bench/rd/anchors/tool_process.hpp"

#include <system_error>

namespace rs::bench {
namespace {

Status write_film(const std::filesystem::path& path, const std::vector<Image<Rgba8>>& shown,
                  const FrameFormat& format) {
    std::vector<std::vector<std::byte>> frames(shown.size());
    const auto convert = [&](int n) -> Status {
        const auto view = static_cast<std::size_t>(n);
        frames[view] = frame_from_image(shown[view], format);
        return {};
    };
    if (Status status = for_each_in_parallel(static_cast<int>(shown.size()), "", nullptr, convert); !status) {
        return status;
    }
    Result<StagedFile> file = StagedFile::create(path);
    if (!file) return file.error();
    for (const auto& frame : frames) {
        if (Status status = file->write(frame); !status) return status;
    }
    return file->commit();
}

}  // namespace

Result<Coded> code_x265(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown,
                        const X265Settings& settings, const std::filesystem::path& folder) {
    const FrameFormat format{images.width, images.height, settings.full_chroma};
    const std::filesystem::path in = folder / "x265-in.yuv";
    const std::filesystem::path stream = folder / "x265.hevc";
    const std::filesystem::path out = folder / "x265-out.yuv";
    if (Status status = write_film(in, shown, format); !status) return status.error();
    std::vector<std::string> command = {
        "x265",
        "--input",
        in.string(),
        "--input-res",
        std::to_string(format.frame_width()) + "x" + std::to_string(format.frame_height()),
        "--fps",
        "25",
        "--input-csp",
        settings.full_chroma ? "i444" : "i420",
        "--preset",
        "medium",
        "--crf",
        std::to_string(settings.crf),
        "--frame-threads",
        "1",
        "--no-info",
        "--recon",
        out.string(),
        "--output",
        stream.string()};
    if (settings.intra) command.insert(command.end(), {"--keyint", "1"});
    if (settings.tune_psnr) command.insert(command.end(), {"--tune", "psnr"});
    if (const Result<std::string> ran = run_tool(command); !ran) return ran.error();

    const auto film_bytes = format.frame_bytes() * shown.size();
    const auto film = read_file(out, film_bytes);
    if (!film) return film.error();
    std::error_code error;
    Coded coded;
    coded.bytes = std::filesystem::file_size(stream, error);
    if (error || film->size() != film_bytes) {
        return Error{out.string() + ": x265 did not write all frames; try another version of it"};
    }
    std::vector<ObjectError> errors(shown.size());
    const auto compare = [&](int n) -> Status {
        const auto view = static_cast<std::size_t>(n);
        const auto frame = std::span(*film).subspan(view * format.frame_bytes(), format.frame_bytes());
        errors[view] = object_error(images, view, image_from_frame(frame, format));
        return {};
    };
    if (Status status = for_each_in_parallel(static_cast<int>(shown.size()), "", nullptr, compare); !status) {
        return status.error();
    }
    for (const ObjectError& part : errors) coded.error += part;
    return coded;
}

}  // namespace rs::bench
