#include "compositor/farm/work/result_sums.hpp"

#include "compositor/farm/work/tool_job.hpp"
#include "rayspace/file/folder_list.hpp"
#include "rayspace/file/input_list.hpp"

#include <xxhash.h>

#include <cstdio>
#include <set>
#include <vector>

namespace rs::farm {
namespace {

namespace fs = std::filesystem;

std::string hexadecimal(std::uint64_t sum) {
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum));
    return text;
}

}  // namespace

std::string sum_text(std::string_view bytes) {
    return hexadecimal(XXH64(bytes.data(), bytes.size(), 0));
}

Result<std::string> sum_of_result(const fs::path& path) {
    std::error_code error;
    const bool folder = fs::is_directory(path, error);
    const Result<std::uint64_t> sum = sum_of_file(folder ? list_of_files(path) : path);
    if (!sum) return sum.error();
    if (folder) {
        const Result<std::vector<std::string>> files = listed_files(path);
        if (!files) return files.error();
        for (const std::string& file : *files) {
            if (!fs::exists(path / file, error)) {
                return Error{path.string() + ": lacks " + file + "; make it again"};
            }
        }
    }
    return hexadecimal(*sum);
}

std::string key_of(const ToolOrder& order) {
    std::string text = std::string(RAYSPACE_VERSION) + '\0' + order.tool + '\0';
    std::error_code ignored;
    for (const std::string& argument : order.arguments) {
        text += argument + '\0';
        // Such a name means something else elsewhere.
        if (!fs::path(argument).is_absolute() && fs::exists(argument, ignored))
            text += fs::current_path().string() + '\0';
    }
    std::set<std::string> names;
    if (!order.folder.empty()) {
        std::error_code error;
        for (auto at = fs::recursive_directory_iterator(order.folder, error);
             !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
            names.insert(at->path().lexically_relative(order.folder).string());
        }
    }
    for (const std::string& name : names) text += name + '\0';
    return sum_text(text);
}

}  // namespace rs::farm
