#include "tests/bench/rd/anchors/x265_anchor.hpp"

#include "rayspace/base/parallel.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/bench/rd/anchors/tool_process.hpp"

#include <system_error>

namespace rs::bench {
namespace {

Status write_raw_video(const std::filesystem::path& path, const std::vector<Image<Rgba8>>& shown,
                       const FrameFormat& format) {
    std::vector<std::vector<std::byte>> frames(shown.size());
    const auto convert = [&](int n) -> Status {
        const auto view = static_cast<std::size_t>(n);
        frames[view] = frame_from_image(shown[view], format);
        return {};
    };
    RS_TRY(for_each_in_parallel(static_cast<int>(shown.size()), "", nullptr, convert));
    RS_ASSIGN_OR_RETURN(StagedFile file, StagedFile::create(path));
    for (const auto& frame : frames) {
        RS_TRY(file.write(frame));
    }
    return file.commit();
}

}  // namespace

Result<CodingResult> code_x265(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown,
                               const X265Settings& settings, const std::filesystem::path& folder) {
    const FrameFormat format{images.width, images.height, settings.full_chroma};
    const std::filesystem::path in = folder / "x265-in.yuv";
    const std::filesystem::path stream = folder / "x265.hevc";
    const std::filesystem::path out = folder / "x265-out.yuv";
    RS_TRY(write_raw_video(in, shown, format));
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
    RS_TRY(run_tool(command));

    const auto film_bytes = format.frame_bytes() * shown.size();
    RS_ASSIGN_OR_RETURN(const auto film, read_file(out, film_bytes));
    std::error_code error;
    CodingResult coded;
    coded.bytes = std::filesystem::file_size(stream, error);
    if (error || film.size() != film_bytes) {
        return Error{out.string() + ": x265 did not write all frames; try another version of it"};
    }
    std::vector<ObjectError> errors(shown.size());
    const auto compare = [&](int n) -> Status {
        const auto view = static_cast<std::size_t>(n);
        const auto frame = std::span(film).subspan(view * format.frame_bytes(), format.frame_bytes());
        errors[view] = object_error(images, view, image_from_frame(frame, format));
        return {};
    };
    RS_TRY(for_each_in_parallel(static_cast<int>(shown.size()), "", nullptr, compare));
    for (const ObjectError& part : errors) coded.error += part;
    return coded;
}

}  // namespace rs::bench
