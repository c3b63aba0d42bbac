#include "rayspace/models/mtl_text.hpp"

#include "rayspace/file/input_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>

namespace rs {
namespace {

constexpr std::string_view kBlanks = " \t";

// Keywords that Assimp reads, in its spelling.
constexpr std::array<std::string_view, 33> kKeywords = {
    "newmtl",   "Ka",       "Kd",     "Ks",     "Ke",     "Tf",      "Ns",           "Ni",     "d",
    "Tr",       "illum",    "map_Ka", "map_Kd", "map_Ks", "map_Ke",  "map_emissive", "map_Ns", "map_d",
    "map_bump", "map_Bump", "bump",   "disp",   "refl",   "norm",    "map_Kn",       "Pr",     "Pm",
    "Pc",       "Pcr",      "aniso",  "map_Pr", "map_Pm", "map_Disp"};

// Option of a texture statement and its largest number of values.
struct TextureOption {
    std::string_view name;
    std::size_t values;
    bool numeric;
};
constexpr std::array<TextureOption, 12> kTextureOptions = {{{"-blendu", 1, false},
                                                            {"-blendv", 1, false},
                                                            {"-boost", 1, true},
                                                            {"-bm", 1, true},
                                                            {"-cc", 1, false},
                                                            {"-clamp", 1, false},
                                                            {"-imfchan", 1, false},
                                                            {"-mm", 2, true},
                                                            {"-o", 3, true},
                                                            {"-s", 3, true},
                                                            {"-t", 3, true},
                                                            {"-texres", 1, true}}};
constexpr TextureOption kTypeOption{"-type", 1, false};

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::string_view trim(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(kBlanks), text.size());
    text.remove_prefix(first);
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

bool is_number(std::string_view word, float& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    return fault == std::errc() && end == word.data() + word.size();
}

const TextureOption* find_option(std::string_view word) {
    const std::string name = lower(word);
    if (name == kTypeOption.name) return &kTypeOption;
    const auto* const found = std::ranges::find(kTextureOptions, name, &TextureOption::name);
    return found == kTextureOptions.end() ? nullptr : found;
}

std::string usual_keyword(std::string_view word) {
    if (std::ranges::find(kKeywords, word) != kKeywords.end()) return std::string(word);
    const std::string wanted = lower(word);
    const auto* const found = std::ranges::find_if(kKeywords, [&](std::string_view k) { return lower(k) == wanted; });
    return std::string(found == kKeywords.end() ? word : *found);
}

bool names_texture(std::string_view keyword) {
    return keyword.starts_with("map_") || keyword == "bump" || keyword == "disp" || keyword == "refl" ||
           keyword == "norm";
}

struct TextureStatement {
    std::string options;  // without "-s", "-o" and "-texres"
    std::string file;     // may contain spaces
    TexturePlacement placement;
};

// Parses "[options] FILE [options]".
TextureStatement parse_texture(std::string_view arguments) {
    TextureStatement statement;
    std::size_t file_begin = std::string_view::npos, file_end = 0;
    for (std::size_t at = 0; at < arguments.size();) {
        const std::size_t begin = arguments.find_first_not_of(kBlanks, at);
        if (begin == std::string_view::npos) break;
        at = std::min(arguments.find_first_of(kBlanks, begin), arguments.size());
        const std::string_view word = arguments.substr(begin, at - begin);
        const TextureOption* const option = find_option(word);
        if (option == nullptr) {
            file_begin = std::min(file_begin, begin);
            file_end = at;
            continue;
        }
        std::string values;
        std::array<float, 3> numbers{};
        std::size_t count = 0;
        while (count < option->values) {
            const std::size_t next = arguments.find_first_not_of(kBlanks, at);
            if (next == std::string_view::npos) break;
            const std::size_t end = std::min(arguments.find_first_of(kBlanks, next), arguments.size());
            const std::string_view value = arguments.substr(next, end - next);
            if (option->numeric && !is_number(value, numbers.at(count))) break;
            values += ' ';
            values += value;
            at = end;
            ++count;
        }
        if (option->name == "-s" || option->name == "-o") {
            glm::vec2& target = option->name == "-s" ? statement.placement.scale : statement.placement.offset;
            for (std::size_t i = 0; i < std::min<std::size_t>(count, 2); ++i) {
                target[static_cast<int>(i)] = numbers.at(i);
            }
        } else if (option->name != "-texres") {
            statement.options += std::string(option->name) + values + ' ';
        }
    }
    if (file_begin < file_end) statement.file = arguments.substr(file_begin, file_end - file_begin);
    return statement;
}

// One material: its statements are written when it is complete.
class MaterialBlock {
public:
    void begin(std::string_view name) { name_ = name; }

    void add(const std::string& keyword, std::string_view arguments, MtlText& result) {
        if (keyword == "illum") {
            float model = 0;
            if (is_number(arguments, model)) transparent_ = model == 4 || model == 6 || model == 7 || model == 9;
        }
        if (keyword == "d") has_opacity_ = true;
        float transparency = 0;
        if (keyword == "Tr" && is_number(arguments, transparency) && transparency >= 1) {
            full_transparency_ = "Tr " + std::string(arguments) + '\n';
            return;
        }
        if (!names_texture(keyword)) {
            lines_ += keyword + ' ' + std::string(arguments) + '\n';
            return;
        }
        const TextureStatement texture = parse_texture(arguments);
        if (texture.file.empty()) return;
        lines_ += keyword + ' ' + texture.options + texture.file + '\n';
        const bool moved = texture.placement.scale != glm::vec2(1) || texture.placement.offset != glm::vec2(0);
        if (keyword == "map_Kd" && moved) result.placements[name_] = texture.placement;
    }

    void finish(MtlText& result) {
        if (transparent_ && !has_opacity_) lines_ += full_transparency_;
        result.text += lines_;
        *this = {};
    }

private:
    std::string name_;
    std::string lines_;
    std::string full_transparency_;
    bool transparent_ = false;
    bool has_opacity_ = false;
};

}  // namespace

std::span<const std::string_view> mtl_keywords() {
    return kKeywords;
}

MtlText rewrite_mtl(std::string_view text) {
    MtlText result;
    MaterialBlock block;
    bool in_material = false;
    text = without_byte_order_mark(text);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view line = trim(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#') continue;
        const std::size_t space = std::min(line.find_first_of(kBlanks), line.size());
        const std::string keyword = usual_keyword(line.substr(0, space));
        const std::string_view arguments = trim(line.substr(space));
        if (keyword == "newmtl") {
            block.finish(result);
            block.begin(arguments);
            result.materials.emplace(arguments);
            in_material = true;
        }
        if (in_material) block.add(keyword, arguments, result);
    }
    block.finish(result);
    return result;
}

}  // namespace rs
