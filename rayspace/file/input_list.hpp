#pragma once
// What a piece of work was made of: the files that a tool has read, with their sums, so that whoever would start it
// again can see whether anything has changed.
//
// Text: "rayspace inputs 1", then a line "XXH64 BYTES MODIFIED_NS PATH" for each file, sorted by path. Paths are
// absolute; control characters and '%' in them stand as %XX.

#include "rayspace/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rs {

// A tool that has succeeded writes its list to the file that this variable of the environment names (tool_main.hpp).
inline constexpr const char* kInputListVariable = "RAYSPACE_INPUTS";
inline constexpr std::uint64_t kInputListCap_bytes = 64 << 20;

struct InputStamp {
    std::filesystem::path path;
    std::uint64_t sum = 0;  // XXH64 of the bytes
    std::uint64_t bytes = 0;
    std::int64_t modified_ns = 0;  // since 1970

    friend bool operator==(const InputStamp&, const InputStamp&) = default;
};

// XXH64 of a file's bytes, read a piece at a time. The file does not become an input (input_file.hpp).
Result<std::uint64_t> sum_of_file(const std::filesystem::path& path);

// Every file that this process has read since keep_inputs(), as it is now; fails where one is gone.
Result<std::vector<InputStamp>> input_stamps();

std::string input_list_text(const std::vector<InputStamp>& stamps);
// `where` names the text in errors. Takes about as much memory as the text. Pure.
Result<std::vector<InputStamp>> parse_input_list(std::string_view text, const std::string& where);

// Whether every file is as it was: of the same size and time, or else of the same sum.
bool are_unchanged(const std::vector<InputStamp>& stamps);

}  // namespace rs
