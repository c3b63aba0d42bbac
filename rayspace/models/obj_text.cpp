#include "rayspace/models/obj_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <functional>

namespace rs {
namespace {

constexpr std::string_view kObjBlanks = " \t";
constexpr std::array kKinds = {"vertex", "texture coordinate", "normal"};

std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(kObjBlanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kObjBlanks));
    line.remove_prefix(word.size());
    return word;
}

using Counts = std::array<long, 3>;  // vertices, texture coordinates, normals

void count(std::string_view keyword, Counts& counts) {
    if (keyword == "v") ++counts[0];
    if (keyword == "vt") ++counts[1];
    if (keyword == "vn") ++counts[2];
}

// Checks a corner such as "3/1/2" or "-1//-2".
std::string corner_fault(std::string_view corner, const Counts& so_far, const Counts& all) {
    for (std::size_t kind = 0; kind < kKinds.size() && !corner.empty(); ++kind) {
        const std::string_view number = corner.substr(0, corner.find('/'));
        corner.remove_prefix(std::min(number.size() + 1, corner.size()));
        long index = 0;
        const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), index);
        if (fault != std::errc() || end == number.data()) continue;
        const bool exists = index > 0 ? index <= all.at(kind) : index < 0 && -index <= so_far.at(kind);
        if (!exists) {
            return std::string("names ") + kKinds.at(kind) + " " + std::to_string(index) + " of " +
                   std::to_string(index > 0 ? all.at(kind) : so_far.at(kind));
        }
    }
    return "";
}

// Calls `visit` with each line and its number from 1 until it returns false.
void for_each_line(std::string_view text, const std::function<bool(std::string_view, std::size_t)>& visit) {
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (!visit(line, number)) return;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

}  // namespace

std::string find_bad_obj_index(std::string_view text) {
    Counts all{}, so_far{};
    for_each_line(text, [&](std::string_view line, std::size_t) {
        count(take_word(line), all);
        return true;
    });
    std::string found;
    for_each_line(text, [&](std::string_view line, std::size_t number) {
        const std::string_view keyword = take_word(line);
        count(keyword, so_far);
        if (keyword != "f" && keyword != "l" && keyword != "p") return true;
        for (std::string_view corner = take_word(line); !corner.empty(); corner = take_word(line)) {
            const std::string fault = corner_fault(corner, so_far, all);
            if (fault.empty()) continue;
            found = "line " + std::to_string(number) + ": " + fault;
            return false;
        }
        return true;
    });
    return found;
}

ObjNames names_in_obj(std::string_view text) {
    ObjNames names;
    for_each_line(text, [&](std::string_view line, std::size_t) {
        const std::string_view keyword = take_word(line);
        names.has_free_forms |= keyword == "curv" || keyword == "curv2" || keyword == "surf";
        if (keyword != "mtllib" && keyword != "usemtl") return true;
        line.remove_prefix(std::min(line.find_first_not_of(kObjBlanks), line.size()));
        std::string name(line.substr(0, line.find_last_not_of(kObjBlanks) + 1));
        const bool is_none = name.empty() || name == "None" || name == "(null)";
        if (!is_none) (keyword == "mtllib" ? names.libraries : names.materials).insert(std::move(name));
        return true;
    });
    return names;
}

}  // namespace rs
