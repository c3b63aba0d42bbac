#include "engine/conformance/view_files.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/file/file_output.hpp"

#include <cstring>
#include <system_error>

namespace rs::engine {
namespace {

constexpr std::uint64_t kBytesPerPixel = 4;  // both for colours and for depths

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& test_case, std::size_t view,
                              const char* ending) {
    return folder / test_case / (std::to_string(view) + ending);
}

Result<std::vector<std::byte>> read_sized(const std::filesystem::path& path, int width, int height) {
    const std::uint64_t expected =
        kBytesPerPixel * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    RS_ASSIGN_OR_RETURN(auto bytes, read_file(path, expected + 1));
    if (bytes.size() != expected) {
        return Error{path.string() + ": has " + std::to_string(bytes.size()) + " bytes; expected for a view of " +
                     std::to_string(width) + "x" + std::to_string(height) + ": " + std::to_string(expected)};
    }
    return std::vector<std::byte>(bytes.begin(), bytes.end());
}

}  // namespace

Status write_view_files(const std::filesystem::path& folder, const std::string& test_case, std::size_t view,
                        const ExecutedView& executed) {
    std::error_code error;
    std::filesystem::create_directories(folder / test_case, error);
    if (error) return Error{(folder / test_case).string() + ": cannot create the folder: " + error.message()};
    ByteWriter colours;
    for (const Rgba8 p : executed.image.pixels()) {
        for (const std::uint8_t channel : {p.r, p.g, p.b, p.a}) colours.put(channel);
    }
    RS_TRY(write_file(file_of(folder, test_case, view, ".rgba"), colours.bytes()));
    if (executed.depth_q20.empty()) return {};
    ByteWriter depths;
    for (const std::int32_t depth : executed.depth_q20.pixels()) depths.put(depth);
    return write_file(file_of(folder, test_case, view, ".depth"), depths.bytes());
}

Result<ExecutedView> read_view_files(const std::filesystem::path& folder, const std::string& test_case,
                                     std::size_t view, int width, int height) {
    ExecutedView executed;
    RS_ASSIGN_OR_RETURN(const auto colours, read_sized(file_of(folder, test_case, view, ".rgba"), width, height));
    executed.image = Image<Rgba8>(width, height);
    ByteReader in(colours);
    for (Rgba8& p : executed.image.pixels()) {
        for (std::uint8_t* const channel : {&p.r, &p.g, &p.b, &p.a}) *channel = in.get<std::uint8_t>();
    }
    const std::filesystem::path depth_file = file_of(folder, test_case, view, ".depth");
    if (!std::filesystem::exists(depth_file)) return executed;
    RS_ASSIGN_OR_RETURN(const auto depths, read_sized(depth_file, width, height));
    executed.depth_q20 = Image<std::int32_t>(width, height);
    ByteReader from(depths);
    for (std::int32_t& depth : executed.depth_q20.pixels()) depth = from.get<std::int32_t>();
    return executed;
}

}  // namespace rs::engine
