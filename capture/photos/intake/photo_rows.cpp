#include "capture/photos/intake/photo_rows.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace rs::capture {
namespace {

// A turn has at least three photos; so must two of the rows, and the rows on average.
constexpr std::size_t kMinPhotosOfRow = 3;

constexpr std::string_view kDigitCharacters = "0123456789";
constexpr std::string_view kLetterCharacters = "abcdefghijklmnopqrstuvwxyz";

constexpr std::array<std::string_view, 15> kRowWords = {"row",   "r",    "ring",   "level",     "layer",
                                                        "tier",  "elev", "el",     "elevation", "lat",
                                                        "pitch", "tilt", "height", "turn",      "orbit"};
constexpr std::array<std::string_view, 16> kColumnWords = {"col",   "c",   "column", "az",   "azim",  "azimuth",
                                                           "angle", "lon", "yaw",    "view", "frame", "step",
                                                           "pos",   "deg", "photo",  "rot"};
// Photos of one pose that differ in something else.
constexpr std::array<std::string_view, 9> kSamePoseWords = {"exp",   "exposure", "ev",   "bracket", "focus",
                                                            "stack", "light",    "take", "iso"};

struct HeightWord {
    std::string_view word;
    int height;
};
constexpr std::array<HeightWord, 15> kHeightWords = {{{"bottom", 0},
                                                      {"low", 1},
                                                      {"lower", 1},
                                                      {"l", 1},
                                                      {"mid", 2},
                                                      {"middle", 2},
                                                      {"medium", 2},
                                                      {"center", 2},
                                                      {"centre", 2},
                                                      {"eye", 2},
                                                      {"m", 2},
                                                      {"high", 3},
                                                      {"upper", 3},
                                                      {"h", 3},
                                                      {"top", 4}}};

template <std::size_t kCount>
bool is_listed(const std::array<std::string_view, kCount>& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

bool is_in(std::string_view characters, char c) {
    return characters.find(c) != std::string_view::npos;
}

enum class NamePartKind { kWord, kNumber };

// Run of letters or digits of a name; separators are dropped.
struct NamePart {
    NamePartKind kind = NamePartKind::kWord;
    std::string text;        // in lower case
    bool has_minus = false;  // a minus precedes the number: a sign or a separator
    char before = 0;         // character before the minus or the number; 0 at the start of the name
};

// Characters of the number at the start of the text. With `decimals`, "12.5" is one number, but "10.23.45" three.
std::size_t number_length(std::string_view text, bool decimals) {
    const std::size_t digits = std::min(text.find_first_not_of(kDigitCharacters), text.size());
    const std::size_t run = std::min(text.find_first_not_of("0123456789."), text.size());
    const auto dots = std::ranges::count(text.substr(0, run), '.');
    return decimals && dots == 1 && text[run - 1] != '.' ? run : digits;
}

std::vector<NamePart> parts_of_name(const std::string& name, bool decimals) {
    std::string stem = std::filesystem::path(name).stem().string();
    std::ranges::transform(stem, stem.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    std::vector<NamePart> parts;
    for (std::size_t at = 0; at < stem.size();) {
        const std::string_view rest = std::string_view(stem).substr(at);
        std::size_t length = 1;
        if (is_in(kDigitCharacters, rest[0])) {
            length = number_length(rest, decimals);
            const bool has_minus = at > 0 && stem[at - 1] == '-';
            const std::size_t start = has_minus ? at - 1 : at;
            parts.push_back({NamePartKind::kNumber, std::string(rest.substr(0, length)), has_minus,
                             start > 0 ? stem[start - 1] : '\0'});
        } else if (is_in(kLetterCharacters, rest[0])) {
            length = std::min(rest.find_first_not_of(kLetterCharacters), rest.size());
            parts.push_back({NamePartKind::kWord, std::string(rest.substr(0, length))});
        }
        at += length;
    }
    return parts;
}

// [photo][part]. Empty if the names have different kinds of parts.
using NameTable = std::vector<std::vector<NamePart>>;

NameTable name_table(std::span<const std::string> names, bool decimals) {
    NameTable table;
    for (const std::string& name : names) {
        table.push_back(parts_of_name(name, decimals));
        if (!std::ranges::equal(table.front(), table.back(), {}, &NamePart::kind, &NamePart::kind)) return {};
    }
    return table;
}

bool all_numbers(const NameTable& table, std::size_t part, std::size_t digits, int least, int most) {
    return std::ranges::all_of(table, [&](const std::vector<NamePart>& parts) {
        const std::string& text = parts[part].text;
        if (text.size() != digits || text.find('.') != std::string::npos) return false;
        const int value = std::atoi(text.c_str());
        return value >= least && value <= most;
    });
}

bool all_compact_dates(const NameTable& table, std::size_t part) {
    return std::ranges::all_of(table, [&](const std::vector<NamePart>& parts) {
        const std::string& text = parts[part].text;
        if (text.size() != 8 || text.find('.') != std::string::npos) return false;
        const int date = std::atoi(text.c_str());
        const int month = date / 100 % 100, day = date % 100;
        return date >= 19900000 && date < 21000000 && month >= 1 && month <= 12 && day >= 1 && day <= 31;
    });
}

// Number of the parts from numbers[at] on that are a date: 20240115, 2024-01-15 or 15-01-2024.
std::size_t date_length(const NameTable& table, std::span<const std::size_t> numbers) {
    if (!numbers.empty() && all_compact_dates(table, numbers[0])) return 1;
    if (numbers.size() < 3) return 0;
    const auto is_year = [&](std::size_t i) { return all_numbers(table, numbers[i], 4, 1990, 2099); };
    const auto is_day = [&](std::size_t i) { return all_numbers(table, numbers[i], 2, 1, 31); };
    return is_day(1) && ((is_year(0) && is_day(2)) || (is_day(0) && is_year(2))) ? 3 : 0;
}

// The same of a time after a date: 102345 with or without fractions of a second, or 10.23.45.
std::size_t time_length(const NameTable& table, std::span<const std::size_t> numbers) {
    const auto is_long = [&](const std::vector<NamePart>& parts) { return parts[numbers[0]].text.size() >= 6; };
    if (!numbers.empty() && std::ranges::all_of(table, is_long)) return 1;
    const bool is_separated = numbers.size() >= 3 && all_numbers(table, numbers[0], 2, 0, 23) &&
                              all_numbers(table, numbers[1], 2, 0, 59) && all_numbers(table, numbers[2], 2, 0, 59);
    return is_separated ? 3 : 0;
}

// Indices of the parts that are numbers, without dates and times.
std::vector<std::size_t> number_parts(const NameTable& table) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < table.front().size(); ++i) {
        if (table.front()[i].kind == NamePartKind::kNumber) numbers.push_back(i);
    }
    for (std::size_t at = 0; at < numbers.size(); ++at) {
        const std::span<const std::size_t> rest = std::span(numbers).subspan(at);
        const std::size_t date = date_length(table, rest);
        if (date == 0) continue;
        const std::size_t length = date + time_length(table, rest.subspan(date));
        const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at);
        numbers.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
        break;
    }
    return numbers;
}

// Part that differs between the names.
struct NameField {
    std::string keyword;             // word before the number; empty if there is none
    std::vector<std::string> texts;  // [photo], with sign
    std::vector<double> values;      // [photo]
    bool is_word = false;

    [[nodiscard]] std::set<double> distinct() const { return {values.begin(), values.end()}; }
    [[nodiscard]] bool is_row() const { return is_word || is_listed(kRowWords, keyword); }
    [[nodiscard]] bool is_column() const { return is_listed(kColumnWords, keyword); }
    [[nodiscard]] bool spans_half_a_turn() const {
        const auto [least, most] = std::ranges::minmax(values);
        return most - least > 180;
    }
};

NameField number_field(const NameTable& table, std::size_t part) {
    NameField field;
    if (part > 0 && table.front()[part - 1].kind == NamePartKind::kWord) field.keyword = table.front()[part - 1].text;
    // Signs are minuses of some of the names, where the others have nothing. Elevations may all be negative.
    const auto has_minus = [&](const std::vector<NamePart>& parts) { return parts[part].has_minus; };
    const auto is_alike = [&](const std::vector<NamePart>& parts) {
        return parts[part].before == table.front()[part].before;
    };
    const bool is_sign = std::ranges::all_of(table, is_alike) &&
                         (!std::ranges::all_of(table, has_minus) || field.keyword.starts_with("el"));
    for (const std::vector<NamePart>& parts : table) {
        const bool is_negative = is_sign && parts[part].has_minus;
        field.texts.push_back((is_negative ? "-" : "") + parts[part].text);
        field.values.push_back(std::strtod(field.texts.back().c_str(), nullptr));
    }
    return field;
}

// Heights in words, or consecutive letters: "L" and "R" are a stereo pair. Empty for other words.
std::optional<NameField> word_field(const NameTable& table, std::size_t part) {
    NameField field;
    field.is_word = true;
    for (const std::vector<NamePart>& parts : table) field.texts.push_back(parts[part].text);
    const auto height_of = [](const std::string& text) {
        return std::ranges::find(kHeightWords, text, &HeightWord::word);
    };
    const auto is_height = [&](const std::string& text) { return height_of(text) != kHeightWords.end(); };
    const bool are_heights = std::ranges::all_of(field.texts, is_height);
    if (!are_heights && !std::ranges::all_of(field.texts, [](const std::string& t) { return t.size() == 1; }))
        return {};
    for (const std::string& text : field.texts) field.values.push_back(are_heights ? height_of(text)->height : text[0]);
    const auto [least, most] = std::ranges::minmax(field.values);
    const auto count = static_cast<double>(field.distinct().size());
    if (!are_heights && most - least != count - 1) return {};
    return field;
}

// Empty if the names differ in more than one word, or in one that is no height and no letter.
std::vector<NameField> varying_fields(const NameTable& table) {
    if (table.empty()) return {};
    std::vector<NameField> fields;
    bool has_word = false;
    for (std::size_t part = 0; part < table.front().size(); ++part) {
        if (table.front()[part].kind != NamePartKind::kWord) continue;
        const std::string& text = table.front()[part].text;
        const auto is_same = [&](const std::vector<NamePart>& parts) { return parts[part].text == text; };
        if (std::ranges::all_of(table, is_same)) continue;
        std::optional<NameField> field = word_field(table, part);
        if (has_word || !field) return {};
        has_word = true;
        fields.push_back(std::move(*field));
    }
    for (const std::size_t part : number_parts(table)) {
        NameField field = number_field(table, part);
        if (field.distinct().size() > 1) fields.push_back(std::move(field));
    }
    return fields;
}

// True if each value of one field goes with one value of the other.
bool are_equivalent(const NameField& a, const NameField& b) {
    std::set<std::pair<double, double>> pairs;
    for (std::size_t i = 0; i < a.values.size(); ++i) pairs.emplace(a.values[i], b.values[i]);
    return pairs.size() == a.distinct().size() && pairs.size() == b.distinct().size();
}

// Removes counters of all photos, and repetitions of another field, such as an angle beside an index.
void remove_redundant(std::vector<NameField>& fields) {
    if (fields.size() <= 2) return;
    std::erase_if(fields, [](const NameField& field) { return field.distinct().size() == field.values.size(); });
    std::vector<NameField> kept;
    for (NameField& field : fields) {
        const auto same = std::ranges::find_if(kept, [&](const NameField& k) { return are_equivalent(k, field); });
        if (same == kept.end()) {
            kept.push_back(std::move(field));
        } else if (!same->is_row() && !same->is_column()) {
            *same = std::move(field);
        }
    }
    fields = std::move(kept);
}

struct RowAndColumn {
    NameField row, column;
    bool is_stated = false;  // by a keyword of the row
};

// True if the first of two numbers without keywords is the column.
bool is_column_first(const NameField& first, const NameField& second) {
    if (first.spans_half_a_turn() != second.spans_half_a_turn()) return first.spans_half_a_turn();
    return first.distinct().size() >= 2 * second.distinct().size();
}

std::optional<RowAndColumn> choose_fields(std::vector<NameField> fields) {
    if (std::ranges::any_of(fields, [](const NameField& f) { return is_listed(kSamePoseWords, f.keyword); })) return {};
    const auto row = std::ranges::find_if(fields, &NameField::is_row);
    const auto column = std::ranges::find_if(fields, &NameField::is_column);
    if (row != fields.end() && column != fields.end()) return RowAndColumn{*row, *column, true};
    remove_redundant(fields);
    if (fields.size() != 2) return {};
    NameField& first = fields[0];
    NameField& second = fields[1];
    const bool is_swapped = second.is_row() || first.is_column() ||
                            (!first.is_row() && !second.is_column() && is_column_first(first, second));
    if (is_swapped) std::swap(first, second);
    const bool is_stated = first.is_row() && !first.is_word;
    return RowAndColumn{std::move(first), std::move(second), is_stated};
}

using RowsByValue = std::map<double, std::map<double, std::size_t>>;  // [row][column]: photo

// True if the longest row has at least half of the columns of each other row: counters start again in each row.
bool have_common_columns(const RowsByValue& rows) {
    const auto size = [](const auto& row) { return row.second.size(); };
    const auto longest = std::ranges::max_element(rows, {}, size);
    return std::ranges::all_of(rows, [&](const auto& row) {
        const auto shared =
            std::ranges::count_if(row.second, [&](const auto& c) { return longest->second.contains(c.first); });
        return 2 * static_cast<std::size_t>(shared) >= row.second.size();
    });
}

std::vector<PhotoRow> photo_rows(const RowAndColumn& fields) {
    const std::size_t count = fields.row.values.size();
    RowsByValue rows;
    for (std::size_t i = 0; i < count; ++i) {
        if (!rows[fields.row.values[i]].emplace(fields.column.values[i], i).second) return {};
    }
    const auto turns = std::ranges::count_if(rows, [](const auto& r) { return r.second.size() >= kMinPhotosOfRow; });
    if (turns < 2 || count < kMinPhotosOfRow * rows.size()) return {};
    if (!fields.is_stated && !have_common_columns(rows)) return {};
    std::vector<PhotoRow> found;
    for (const auto& [value, columns] : rows) {
        PhotoRow row;
        for (const auto& [column, photo] : columns) row.photos.push_back(photo);
        const bool has_keyword = is_listed(kRowWords, fields.row.keyword);
        row.label = (has_keyword ? fields.row.keyword : "") + fields.row.texts[row.photos.front()];
        found.push_back(std::move(row));
    }
    return found;
}

}  // namespace

std::vector<PhotoRow> rows_by_name(std::span<const std::string> names) {
    if (names.empty()) return {};
    for (const bool decimals : {true, false}) {
        const std::optional<RowAndColumn> fields = choose_fields(varying_fields(name_table(names, decimals)));
        if (!fields) continue;
        std::vector<PhotoRow> rows = photo_rows(*fields);
        if (!rows.empty()) return rows;
    }
    return {};
}

}  // namespace rs::capture
