#include "compositor/sequence/converter.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/file/child_process.hpp"

#include <unistd.h>

#include <utility>

namespace rs::compositor {
namespace {

// Returns true if `what` was found.
bool replace_all(std::string& word, const std::string& what, const std::string& by) {
    bool found = false;
    for (std::size_t at = word.find(what); at != std::string::npos; at = word.find(what, at + by.size())) {
        word.replace(at, what.size(), by);
        found = true;
    }
    return found;
}

}  // namespace

Result<std::vector<std::string>> parse_converter_command(const std::string& command, const std::filesystem::path& in,
                                                         const std::filesystem::path& out) {
    std::vector<std::string> words;
    bool in_word = false;
    char quote = 0;
    for (const char c : command) {
        if (quote == 0 && (c == ' ' || c == '\t')) {
            in_word = false;
            continue;
        }
        if (!in_word) words.emplace_back();
        in_word = true;
        if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
        } else if (c == quote) {
            quote = 0;
        } else {
            words.back() += c;
        }
    }
    if (quote != 0) return Error{"--convert: a quotation mark is not closed; close it"};
    bool has_in = false;
    bool has_out = false;
    for (std::string& word : words) {
        has_out = replace_all(word, "{out}", out.string()) || has_out;
        has_in = replace_all(word, "{in}", in.string()) || has_in;
    }
    if (!has_in || !has_out || words.size() < 2) {
        return Error{"--convert: the command must name {in} and {out}; give for example 'my-converter {in} {out}'"};
    }
    return words;
}

Result<ConvertedScene> convert_scene(const std::string& command, const std::filesystem::path& in) {
    const std::filesystem::path place =
        std::filesystem::temp_directory_path() / ("rayspace-converted-" + std::to_string(getpid()));
    RS_ASSIGN_OR_RETURN(StagedFolder folder, StagedFolder::create(place, "converted files"));
    std::filesystem::path out = folder.temporary_path() / "scene";
    RS_ASSIGN_OR_RETURN(const auto words, parse_converter_command(command, in, out));
    const Result<int> status = run_program(words);
    const std::string name = printable(words.front());
    if (!status) {
        return Error{"--convert: " + name + " cannot be run (" + status.error().message + "); correct the command"};
    }
    if (*status != 0) {
        return Error{printable(in.string()) + ": the converter " + name + " ended with " + std::to_string(*status) +
                     "; see its output above"};
    }
    std::error_code error;
    if (!std::filesystem::exists(out, error)) {
        return Error{printable(in.string()) + ": the converter " + name +
                     " has written nothing to {out}; it must make a folder with a frames.json, or an OBJ, there"};
    }
    return ConvertedScene{std::move(folder), std::move(out)};
}

}  // namespace rs::compositor
